/* Merges vertices of a one-to-one plane map, so that it has fewer triangles. */
#ifndef ICCP_COARSEN_H
#define ICCP_COARSEN_H

#include "map/compatible/plmap.h"

/* Merges inner vertices into neighbours as long as possible. The symmetric Dirichlet energy around
 * a vertex may rise by the share `rise`, or up to the mean of the whole map. All triangles stay
 * exactly positive before and after the map. No new edge joins two fixed vertices, and the boundary
 * stays. *n_gone counts the merges. O(n). On failure the map is valid, and part of the work is
 * done. */
icc_status iccp_coarsen(iccp_plmap *map, double rise, size_t *n_gone, const iccp_env *env);

/* Like iccp_coarsen(), but the energy around a vertex may rise by the share `rise` only, and no new
 * edge is longer than `longest`. Lengths are measured after the map, and before it and
 * stretched. */
icc_status iccp_coarsen_within(iccp_plmap *map, double rise, double longest, size_t *n_gone,
                               const iccp_env *env);

/* Like iccp_coarsen(), but the energy around a vertex may rise by the amount `worth`, not by a
 * share. The amount is an integral over the stretched area. */
icc_status iccp_coarsen_worthless(iccp_plmap *map, double worth, size_t *n_gone,
                                  const iccp_env *env);

#endif

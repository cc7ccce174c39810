/* Fewer triangles for a one-to-one plane map. */
#ifndef ICCP_COARSEN_H
#define ICCP_COARSEN_H

#include "map/compatible/plmap.h"

/* Merges inner vertices into neighbours as long as possible. The symmetric Dirichlet energy around
 * a vertex may rise by the share `rise`, or up to the mean of the whole map. All triangles stay
 * exactly positive before and after the map. No new edge joins two fixed vertices, and the boundary
 * stays. *n_gone counts the merges. O(n). On failure the map is valid, and part of the work is
 * done. */
icc_status iccp_coarsen(iccp_plmap *map, double rise, size_t *n_gone, const iccp_env *env);

/* The same without the mean: the energy may rise by the share `rise` only. No new edge is longer
 * than `longest`, after the map or before it and stretched. */
icc_status iccp_coarsen_within(iccp_plmap *map, double rise, double longest, size_t *n_gone,
                               const iccp_env *env);

#endif

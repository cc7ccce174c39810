/* Fewer triangles for a one-to-one piecewise linear map. */
#ifndef ICCP_COARSEN_H
#define ICCP_COARSEN_H

#include "map/compatible/plmap.h"

/* Merges inner vertices into neighbours as long as that is possible, where the symmetric Dirichlet
 * energy of the triangles round the vertex rises by no more than the share `rise`, or where its
 * mean stays below that of the whole map. All triangles are positive before and after the map,
 * which they stay, exactly; no new edge joins two fixed vertices; the boundary stays. O(n). On
 * failure the map is valid, and part of the work is done. */
icc_status iccp_coarsen(iccp_plmap *map, double rise, size_t *n_gone, const iccp_env *env);

/* The same, but only where the energy rises by no more than that share, and no new edge is longer
 * than `longest`, after the map or before it and stretched. */
icc_status iccp_coarsen_within(iccp_plmap *map, double rise, double longest, size_t *n_gone,
                               const iccp_env *env);

#endif

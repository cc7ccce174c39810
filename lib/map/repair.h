/* Making every triangle of a piecewise linear map positive. */
#ifndef ICCP_REPAIR_H
#define ICCP_REPAIR_H

#include "map/newton.h"

/* Turns edges (unless `keep_mesh`), untangles patches and then everything; where that is not enough and
 * the mesh may change, refines it round what is left and begins again. Gives up early on a mesh that may
 * change where many triangles are inverted. The boundary's images stay. Iterations are capped, clocks
 * are not read: the same input gives the same bits. `n_left` tells how many triangles are not positive
 * in the end: 0 unless it failed. */
icc_status iccp_repair(iccp_plmap *map, bool keep_mesh, size_t *n_left, const iccp_env *env);

#endif

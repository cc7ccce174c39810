/* The one-to-one map that is nearest to a caller's warp. */
#ifndef ICCP_NEAREST_MAP_H
#define ICCP_NEAREST_MAP_H

#include "icc/fit.h"
#include "map/map.h"

/* A warp in the caller's coordinates. All arrays are borrowed. */
typedef struct iccp_warp {
    size_t n_vertices;
    const double *points, *images; /* 2 n_vertices each */
    size_t n_triangles;
    const uint32_t *triangles; /* 3 n_triangles, in any orientation */
    size_t n_held;
    const uint32_t *held; /* n_held vertices whose images must stay */
} iccp_warp;

/* See icc_map_create_nearest(). The caller has checked for NULL, counts and the held vertices.
 * Fills in `report`, which must not be NULL, except for its size. */
icc_status iccp_nearest_map_create(icc_map **out, const iccp_warp *warp, icc_nearest_report *report,
                                   const iccp_env *env, icc_error *err);

#endif

/* A common refinement of two triangulations of polygons whose corners correspond. */
#ifndef ICCP_OVERLAY_H
#define ICCP_OVERLAY_H

#include "mesh/corners.h"

/* A polygon with n corners, counter-clockwise, cut into n - 2 triangles by diagonals. Several
 * corners may lie in one place: only the triangles need to be positive. */
typedef struct iccp_ngon {
    const double *points;              /* 2 n */
    const uint32_t *triangles, *twins; /* 3 (n - 2), corners numbered as in mesh/trimesh.h */
} iccp_ngon;

/* Triangles that are positive in both polygons, but for rounding. */
typedef struct iccp_overlay {
    iccp_memory memory;
    size_t n_vertices; /* the polygons' corners, in their order, then crossings of diagonals */
    double *points, *images;
    iccp_corners corners;
} iccp_overlay;

/* ICC_ERR_RESOLUTION when the diagonals cross more than 100,000 + 100 n times, the memory's cap.
 * O(n log n + crossings log crossings). */
icc_status iccp_overlay_create(iccp_overlay *overlay, uint32_t n, const iccp_ngon *source,
                               const iccp_ngon *target, const iccp_env *env);
void iccp_overlay_free(iccp_overlay *overlay);

#endif

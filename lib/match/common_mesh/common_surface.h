/* Two surfaces with the same triangles. */
#ifndef ICCP_COMMON_SURFACE_H
#define ICCP_COMMON_SURFACE_H

#include "match/common_mesh/sphere_overlay.h"

typedef struct iccp_common_surface {
    size_t n_vertices, n_faces;
    uint32_t *faces;     /* 3 n_faces: corners, counter-clockwise from outside */
    double *x[2];        /* 3 n_vertices: their places on each surface */
    uint32_t *origin[2]; /* n_vertices: the surface's vertex at that place; or ICCP_NO_EDGE */
    uint32_t *within[2]; /* n_faces: the surface's face that contains each triangle */
} iccp_common_surface;

/* Makes the common surface: the overlay of two drawings, whose faces are cut into triangles along
 * diagonals. x has the surfaces' coordinates by vertex. Each triangle on one surface is mapped
 * one-to-one onto its partner, and so are both surfaces. Vertices of a surface keep their
 * coordinates bit by bit. Others lie on its edges and faces up to rounding. ICC_ERR_MEMORY. Free it
 * in any case. O(n). */
icc_status iccp_common_surface_create(iccp_common_surface *common,
                                      const iccp_sphere_overlay *overlay,
                                      const iccp_half_edges *const m[2],
                                      const double *const directions[2], const double *const x[2],
                                      const iccp_memory *memory, icc_error *err);
/* Before the call, `to` must be freed or never made. Free it in any case. */
icc_status iccp_common_surface_copy(iccp_common_surface *to, const iccp_common_surface *c,
                                    const iccp_memory *memory);
/* Removes vertices and triangles that collapses have removed. m has the present triangles. The rest
 * keeps its order. `became`: for each old vertex, the new number of the vertex that it was merged
 * into. */
void iccp_common_surface_compact(iccp_common_surface *c, const iccp_half_edges *m,
                                 uint32_t *became);
void iccp_common_surface_free(iccp_common_surface *common, const iccp_memory *memory);

#endif

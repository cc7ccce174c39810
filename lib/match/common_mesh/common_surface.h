/* Two surfaces with the same triangles. */
#ifndef ICCP_COMMON_SURFACE_H
#define ICCP_COMMON_SURFACE_H

#include "match/common_mesh/sphere_overlay.h"

typedef struct iccp_common_surface {
    size_t n_vertices, n_faces;
    uint32_t *faces;     /* 3 n_faces: corners, counter-clockwise from outside */
    double *x[2];        /* 3 n_vertices: where they are on either surface */
    uint32_t *origin[2]; /* n_vertices: the vertex of a surface that is there; or ICCP_NO_EDGE */
    uint32_t *within[2]; /* n_faces: the face of a surface that each is a part of */
} iccp_common_surface;

/* The overlay of two drawings, its faces cut into triangles along diagonals, and the surfaces that
 * were drawn, x by vertex, with these triangles. Between two surfaces that are cut so each triangle
 * is mapped onto its partner one-to-one, and all together are. Vertices of a surface are in their
 * places bit by bit; others lie on its edges and faces up to rounding. ICC_ERR_MEMORY; to be freed
 * in any case. O(n). */
icc_status iccp_common_surface_create(iccp_common_surface *common,
                                      const iccp_sphere_overlay *overlay,
                                      const iccp_half_edges *const m[2],
                                      const double *const directions[2], const double *const x[2],
                                      const iccp_memory *memory, icc_error *err);
/* `to`: freed, or never made, before; to be freed in any case. */
icc_status iccp_common_surface_copy(iccp_common_surface *to, const iccp_common_surface *c,
                                    const iccp_memory *memory);
/* Leaves out what is no longer there after collapses (m: its triangles, now); the rest keeps its
 * order. `became`: of each vertex that was there the number of the one that it has come to. */
void iccp_common_surface_compact(iccp_common_surface *c, const iccp_half_edges *m,
                                 uint32_t *became);
void iccp_common_surface_free(iccp_common_surface *common, const iccp_memory *memory);

#endif

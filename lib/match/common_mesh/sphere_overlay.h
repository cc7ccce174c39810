/* The common refinement of two drawings on the sphere. */
#ifndef ICCP_SPHERE_OVERLAY_H
#define ICCP_SPHERE_OVERLAY_H

#include "match/surface/half_edges.h"

/* Corners of a face: what a triangle and a triangle have in common. */
enum { ICCP_OVERLAY_CORNERS = 6 };

/* Nodes: the vertices of the first drawing; behind them those of the second, where those that are
 * also the first's are left out, so that their numbers stand for nothing; behind them the crossings
 * of edges. */
typedef struct iccp_sphere_overlay {
    size_t n_vertices[2];
    size_t n_crossings;
    size_t n_nodes;          /* that stand for something */
    uint32_t (*crossing)[2]; /* n_crossings: the half-edges of both drawings; the second one runs
                                from the right to the left of the first */
    uint32_t *partner;       /* by vertex of the first drawing: the second's that it also is; or
                          ICCP_NO_EDGE */
    uint32_t *face[2]; /* by vertex of each drawing that is not the other's: the other's face that
                          it is in */
    size_t n_faces;
    uint32_t *begin;     /* n_faces + 1: where the corners of each face begin */
    uint32_t *corner;    /* nodes, counter-clockwise; at most ICCP_OVERLAY_CORNERS a face */
    uint32_t *within[2]; /* n_faces: the face of each drawing that a face is a part of */
} iccp_sphere_overlay;

/* Of two certified drawings, directions by vertex, all of both surfaces being there. Vertices of
 * both that have the same direction are one; an edge between two such vertices in both drawings is
 * one. Everything else is as if moved by match/surface/perturbed.h: where a vertex lies on an edge,
 * or edges overlap, faces without area come about.
 *
 * By exact signs alone: both drawings have been walked through the other with the same crossings,
 * and the faces make a sphere. ICC_ERR_RESOLUTION if there are more than `most_crossings`, or 2^28;
 * ICC_ERR_CERTIFICATE if one of these does not hold, which is to say never; ICC_ERR_MEMORY,
 * ICC_ERR_CANCELLED. To be freed in any case. O(n log n) for n vertices, edges and crossings. */
icc_status iccp_sphere_overlay_create(iccp_sphere_overlay *overlay,
                                      const iccp_half_edges *const m[2],
                                      const double *const directions[2], size_t most_crossings,
                                      const iccp_env *env, icc_error *err);
void iccp_sphere_overlay_free(iccp_sphere_overlay *overlay, const iccp_memory *memory);

#endif

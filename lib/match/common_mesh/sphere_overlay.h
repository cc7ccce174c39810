/* The overlay of two drawings on the sphere: their common refinement. */
#ifndef ICCP_SPHERE_OVERLAY_H
#define ICCP_SPHERE_OVERLAY_H

#include "match/surface/half_edges.h"

/* Corners of a face, which is the intersection of two triangles. */
enum { ICCP_OVERLAY_CORNERS = 6 };

/* Nodes are the vertices of the first drawing, then those of the second, then the crossings of
 * edges. A common vertex has its number in the first drawing; its second number is not used. */
typedef struct iccp_sphere_overlay {
    size_t n_vertices[2];
    size_t n_crossings;
    size_t n_nodes;          /* in use */
    uint32_t (*crossing)[2]; /* n_crossings: the half-edges of both drawings; the second one runs
                                from the right of the first to its left */
    uint32_t *partner;       /* by vertex of the first drawing: the same vertex in the second; or
                                ICCP_NO_EDGE */
    uint32_t *face[2]; /* by vertex of each drawing that is not common: the other drawing's face
                          that contains it */
    size_t n_faces;
    uint32_t *begin;     /* n_faces + 1: the first corner of each face */
    uint32_t *corner;    /* nodes, counter-clockwise; at most ICCP_OVERLAY_CORNERS for a face */
    uint32_t *within[2]; /* n_faces: the face of each drawing that contains each face */
} iccp_sphere_overlay;

/* Overlays two certified drawings with all vertices present; directions are by vertex. Vertices
 * with the same direction are one, and an edge between two such vertices in both drawings is one.
 * Everything else is perturbed as in match/surface/perturbed.h. So faces without area arise where a
 * vertex lies on an edge or where edges overlap.
 *
 * Only exact signs decide. Each drawing is walked through the other. Both walks must find the same
 * crossings, and the faces must form a sphere. ICC_ERR_CERTIFICATE if they do not, which should
 * never happen. ICC_ERR_RESOLUTION if there are more than `most_crossings`, or 2^28.
 * ICC_ERR_MEMORY, ICC_ERR_CANCELLED. Free it in any case. O(n log n) for n vertices, edges and
 * crossings. */
icc_status iccp_sphere_overlay_create(iccp_sphere_overlay *overlay,
                                      const iccp_half_edges *const m[2],
                                      const double *const directions[2], size_t most_crossings,
                                      const iccp_env *env, icc_error *err);
void iccp_sphere_overlay_free(iccp_sphere_overlay *overlay, const iccp_memory *memory);

#endif

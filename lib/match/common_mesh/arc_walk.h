/* The edges of one drawing on the sphere, walked through the faces of another. */
#ifndef ICCP_ARC_WALK_H
#define ICCP_ARC_WALK_H

#include "match/surface/half_edges.h"

/* A drawing beside another. Vertices of both are counted together; a vertex of one that is also one
 * of the other has one number. */
typedef struct iccp_drawing {
    const iccp_half_edges *m; /* all of it there */
    const double *directions;
    uint32_t *number;  /* by vertex */
    uint32_t *partner; /* by vertex: the other drawing's that it also is, or ICCP_NO_EDGE */
} iccp_drawing;

/* By half-edge of the drawing that is walked. Each edge is walked one way. */
typedef struct iccp_arc_walk {
    uint32_t *begin;    /* where the crossings of the edge begin, for the way that it was walked;
                          ICCP_NO_EDGE for the other way */
    uint32_t *n;        /* how many they are; the same for both ways */
    uint32_t *sector;   /* from a vertex that is also the other's: the other's half-edge from there
                          that comes before it, clockwise, or lies on it */
    uint8_t *is_common; /* whether it lies on it: the edge is one of both drawings */
    uint32_t *face;     /* by vertex that is not the other's: the other's face that it is in */
    size_t n_crossed, room;
    uint32_t *crossed; /* the other's half-edges, from right to left, in the order of the way */
} iccp_arc_walk;

/* Directions are as if moved by match/surface/perturbed.h, so that edges pass no vertices and
 * overlap no edges but those that are of both. Both drawings are certified. ICC_ERR_RESOLUTION if
 * there are more than `most` crossings; ICC_ERR_MEMORY, ICC_ERR_CANCELLED; to be freed in any case.
 * O(1) for each edge and crossing, besides O(n) for the first vertex and O(degree) at common ones.
 */
icc_status iccp_arc_walk_create(iccp_arc_walk *walk, const iccp_drawing *walked,
                                const iccp_drawing *other, size_t most, const iccp_env *env,
                                icc_error *err);
void iccp_arc_walk_free(iccp_arc_walk *walk, const iccp_memory *memory);

#endif

/* Walks the edges of one drawing on the sphere through the faces of another. */
#ifndef ICCP_ARC_WALK_H
#define ICCP_ARC_WALK_H

#include "match/surface/half_edges.h"

/* One of two drawings. The vertices of both are numbered together. A vertex common to both has one
 * number. */
typedef struct iccp_drawing {
    const iccp_half_edges *m; /* all of it present */
    const double *directions;
    uint32_t *number;  /* by vertex */
    uint32_t *partner; /* by vertex: the same vertex in the other drawing, or ICCP_NO_EDGE */
} iccp_drawing;

/* The walks, by half-edge of the drawing that is walked. Each edge is walked in one direction. */
typedef struct iccp_arc_walk {
    uint32_t *begin;    /* the first crossing of the edge, for the direction walked; ICCP_NO_EDGE
                           for the other direction */
    uint32_t *n;        /* number of crossings; the same for both directions */
    uint32_t *sector;   /* if it starts at a common vertex: the other drawing's half-edge there
                           that comes before it, clockwise, or lies on it */
    uint8_t *is_common; /* true if it lies on that half-edge: the edge belongs to both drawings */
    uint32_t *face;     /* by vertex that is not common: the other drawing's face that contains
                           it */
    size_t n_crossed, room;
    uint32_t *crossed; /* the other drawing's half-edges, from right to left, in the order of the
                          walk */
} iccp_arc_walk;

/* Walks all edges. Directions are perturbed as in match/surface/perturbed.h. So an edge passes
 * through no vertex and overlaps no edge unless both drawings share it. Both drawings are
 * certified. ICC_ERR_RESOLUTION if there are more than `most` crossings; ICC_ERR_MEMORY,
 * ICC_ERR_CANCELLED. Free it in any case. O(1) for each edge and crossing, plus O(n) for the first
 * vertex and O(degree) at common ones. */
icc_status iccp_arc_walk_create(iccp_arc_walk *walk, const iccp_drawing *walked,
                                const iccp_drawing *other, size_t most, const iccp_env *env,
                                icc_error *err);
void iccp_arc_walk_free(iccp_arc_walk *walk, const iccp_memory *memory);

#endif

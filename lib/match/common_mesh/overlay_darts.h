/* The pieces of the edges of two drawings that cut each other, and their order around vertices and
 * crossings. */
#ifndef ICCP_OVERLAY_DARTS_H
#define ICCP_OVERLAY_DARTS_H

#include "match/common_mesh/paired_crossings.h"

/* An edge is cut into pieces by its crossings. Piece k has two darts: 2 k in the direction in which
 * the edge was walked, and 2 k + 1 back. */
typedef struct iccp_overlay_darts {
    iccp_drawing drawing[2];
    iccp_arc_walk walk[2];
    uint32_t *piece[2]; /* by half-edge that was walked: its first piece */
    iccp_paired_crossings paired;
    size_t n_pieces, n_first; /* pieces of the first drawing come first */
    uint32_t *along;          /* by piece: the half-edge that was walked */
    uint32_t *origin;         /* by dart: the node where it starts */
    uint32_t *back;           /* by dart: the next dart at the node, clockwise */
} iccp_overlay_darts;

static inline uint32_t iccp_dart_reversed(uint32_t dart)
{
    return dart ^ 1;
}

/* Sets `piece`, n_pieces and n_first, once both walks are made. */
void iccp_overlay_number_pieces(iccp_overlay_darts *g);

/* Fills in `along`, `origin` and `back`. Nodes are the vertices, n_vertices of both drawings, and
 * then the crossings. */
void iccp_overlay_turn(iccp_overlay_darts *g, size_t n_vertices);

#endif

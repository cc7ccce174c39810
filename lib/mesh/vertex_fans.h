/* The corners at each vertex of a triangle mesh whose boundary may touch itself.
 *
 * A fan is a set of triangles around a vertex that follow one another across common edges. A vertex
 * has several fans where parts of the boundary touch there. */
#ifndef ICCP_VERTEX_FANS_H
#define ICCP_VERTEX_FANS_H

#include "mesh/corners.h"

typedef struct iccp_fans {
    size_t n;         /* vertices that may have several fans; later ones have one */
    uint32_t *corner; /* of each vertex: a corner at it, or ICCP_NO_NEIGHBOUR */
    uint32_t *first;  /* n + 1: where the list of each vertex begins; it is empty for one fan */
    uint32_t *begin;  /* of each fan: the vertex at the end of its clockwise border */
    uint32_t *start;  /* of each fan: its corner at that border */
} iccp_fans;

icc_status iccp_fans_create(iccp_fans *fans, const iccp_corners *mesh, size_t n_vertices,
                            const iccp_memory *memory);
void iccp_fans_free(iccp_fans *fans, const iccp_memory *memory);

/* Notes that a corner is at its vertex, after its triangle has changed. Changes may cut and flip
 * edges inside, but the boundary must stay. */
void iccp_fans_note(iccp_fans *fans, const iccp_corners *mesh, uint32_t corner);

/* Returns the smaller of the two corners that face the edge between a and b, or ICCP_NO_NEIGHBOUR
 * if there is no such edge. */
uint32_t iccp_fans_edge(const iccp_fans *fans, const iccp_corners *mesh, uint32_t a, uint32_t b);

/* A turn around a vertex, counter-clockwise in each fan. */
typedef struct iccp_turn {
    uint32_t corner; /* where it is; ICCP_NO_NEIGHBOUR after the last corner */
    uint32_t first;  /* where the current fan was entered */
    uint32_t fan, n_fans;
} iccp_turn;

iccp_turn iccp_turn_begin(const iccp_fans *fans, const iccp_corners *mesh, uint32_t vertex);

static inline void iccp_turn_next(iccp_turn *turn, const iccp_fans *fans, const iccp_corners *mesh)
{
    const uint32_t twin = mesh->twin[iccp_after(turn->corner)];
    const bool goes_on = twin != ICCP_NO_NEIGHBOUR && iccp_after(twin) != turn->first;
    if (goes_on)
        turn->corner = iccp_after(twin);
    else if (++turn->fan < turn->n_fans)
        turn->corner = turn->first = fans->start[turn->fan];
    else
        turn->corner = ICCP_NO_NEIGHBOUR;
}

#endif

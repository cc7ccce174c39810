/* Numbers the pieces of the edges of two drawings that cut each other, and puts them in order
 * around vertices and crossings. A graph on a surface is described by the cyclic order of the edges
 * at each node: J. Edmonds, A Combinatorial Representation for Polyhedral Surfaces, 1960. */
#include "match/common_mesh/overlay_darts.h"

/* The first dart of a half-edge. An edge of both drawings has the darts of the first drawing. */
static uint32_t first_dart(const iccp_overlay_darts *g, int side, uint32_t h)
{
    if (side == 1 && g->walk[1].is_common[h])
        return first_dart(g, 0, g->walk[1].sector[h]);
    const uint32_t twin = g->drawing[side].m->twin[h];
    return g->walk[side].begin[h] != ICCP_NO_EDGE
               ? 2 * g->piece[side][h]
               : 2 * (g->piece[side][twin] + g->walk[side].n[h]) + 1;
}

void iccp_overlay_number_pieces(iccp_overlay_darts *g)
{
    for (int side = 0; side < 2; ++side) {
        g->n_first = g->n_pieces;
        for (uint32_t h = 0; h < 3 * g->drawing[side].m->n_faces; ++h) {
            const bool counts =
                g->walk[side].begin[h] != ICCP_NO_EDGE && !(side == 1 && g->walk[1].is_common[h]);
            g->piece[side][h] = (uint32_t)g->n_pieces;
            if (counts)
                g->n_pieces += g->walk[side].n[h] + 1;
        }
    }
}

static void name_pieces(iccp_overlay_darts *g)
{
    for (int side = 0; side < 2; ++side)
        for (uint32_t h = 0; h < 3 * g->drawing[side].m->n_faces; ++h) {
            const bool counts =
                g->walk[side].begin[h] != ICCP_NO_EDGE && !(side == 1 && g->walk[1].is_common[h]);
            for (uint32_t k = 0; counts && k <= g->walk[side].n[h]; ++k)
                g->along[g->piece[side][h] + k] = h;
        }
}

/* Puts `dart` clockwise after `before`. Both start at a node. */
static void put(iccp_overlay_darts *g, uint32_t before, uint32_t dart, uint32_t node)
{
    g->back[before] = dart;
    g->origin[before] = node;
}

/* Sets the order of darts at vertices. At a vertex of one drawing alone it is that drawing's order.
 * At a common vertex it is that of the second drawing, and edges of the first drawing alone are put
 * into its angles. */
static void turn_round_vertices(iccp_overlay_darts *g)
{
    for (int side = 0; side < 2; ++side) {
        const iccp_drawing *const d = &g->drawing[side];
        for (uint32_t v = 0; v < d->m->n_vertices; ++v) {
            uint32_t h = d->m->out[v];
            if (h == ICCP_NO_EDGE || d->partner[v] != ICCP_NO_EDGE)
                continue;
            do {
                const uint32_t next = iccp_edge_turn(d->m, h);
                put(g, first_dart(g, side, next), first_dart(g, side, h), d->number[v]);
                h = next;
            } while (h != d->m->out[v]);
        }
    }
}

/* Puts those half-edges of the first drawing, from h on counter-clockwise, that lie in the angle
 * after `sector` behind the dart `last`. Returns the new last dart. */
static uint32_t turn_through(iccp_overlay_darts *g, uint32_t *h, uint32_t sector, uint32_t last,
                             uint32_t node)
{
    while (g->walk[0].sector[*h] == sector) {
        if (!g->walk[0].is_common[*h]) {
            put(g, first_dart(g, 0, *h), last, node);
            last = first_dart(g, 0, *h);
        }
        *h = iccp_edge_turn(g->drawing[0].m, *h);
    }
    return last;
}

static void turn_round_common(iccp_overlay_darts *g)
{
    const iccp_half_edges *const a = g->drawing[0].m, *const b = g->drawing[1].m;
    for (uint32_t v = 0; v < a->n_vertices; ++v) {
        const uint32_t w = g->drawing[0].partner[v], node = g->drawing[0].number[v];
        if (w == ICCP_NO_EDGE || a->degree[v] == 0)
            continue;
        /* The first edge of the first drawing inside its angle. */
        uint32_t h = a->out[v];
        for (uint32_t k = 0; k < a->degree[v]; ++k) {
            const uint32_t next = iccp_edge_turn(a, h);
            const bool begins = g->walk[0].sector[next] != g->walk[0].sector[h];
            h = next;
            if (begins)
                break;
        }
        const uint32_t first = g->walk[0].sector[h];
        uint32_t e = first, last = first_dart(g, 1, e);
        do {
            last = turn_through(g, &h, e, last, node);
            e = iccp_edge_turn(b, e);
            put(g, first_dart(g, 1, e), last, node);
            last = first_dart(g, 1, e);
        } while (e != first);
    }
}

/* Sets the order at a crossing: on along the first edge, left along the second, back, and right. */
static void turn_round_crossings(iccp_overlay_darts *g, size_t n_vertices)
{
    for (uint32_t p = 0; p < g->walk[0].n_crossed; ++p) {
        const uint32_t q = g->paired.place[p], node = (uint32_t)(n_vertices + p);
        const uint32_t h = g->paired.edge_of[0][p], e = g->paired.edge_of[1][q];
        const uint32_t on = 2 * (g->piece[0][h] + p - g->walk[0].begin[h] + 1);
        const uint32_t up = 2 * (g->piece[1][e] + q - g->walk[1].begin[e] + 1);
        const uint32_t back = iccp_dart_reversed(on - 2), down = iccp_dart_reversed(up - 2);
        const bool to_left = g->walk[0].crossed[p] == e;
        const uint32_t left = to_left ? up : down, right = to_left ? down : up;
        put(g, on, right, node);
        put(g, right, back, node);
        put(g, back, left, node);
        put(g, left, on, node);
    }
}

void iccp_overlay_turn(iccp_overlay_darts *g, size_t n_vertices)
{
    name_pieces(g);
    turn_round_vertices(g);
    turn_round_common(g);
    turn_round_crossings(g, n_vertices);
}

/* A border between nodes that only one layer has takes the pieces on both sides out, and so their
 * partners in the other layer: pieces that lie on the same side of paired borders. An island that
 * only one layer has is filled: its two rings vanish. Islands inside it stay if both layers have
 * them. */
#include "match/coverage/leave_out.h"

#include "base/sets.h"

#include <string.h>

#define NONE UINT32_MAX

void iccp_kept_free(iccp_kept *kept, const iccp_memory *memory)
{
    iccp_free(memory, kept->ring);
    iccp_free(memory, kept->border);
}

size_t iccp_borders_alone(icc_coverage_difference *out, size_t capacity,
                          const iccp_layer_pairing *pairing, int e)
{
    const iccp_layer_graph *const graph = pairing->graph[e];
    const iccp_layer *const layer = graph->layer;
    const uint32_t *const partner = e == 0 ? pairing->border : pairing->back;
    size_t n = 0;
    for (uint32_t b = 0; b < graph->n_borders; ++b) {
        const iccp_border *const border = &graph->border[b];
        if (partner[b] != NONE)
            continue;
        if (n < capacity && out != NULL) {
            icc_coverage_difference *const d = &out[n];
            *d = (icc_coverage_difference){.size = sizeof *d, .side = e + 1, .n_ids = 1};
            d->kind = border->is_island ? ICC_DIFFERENCE_ISLAND : ICC_DIFFERENCE_BORDER;
            d->ids[0] = layer->regions->id[border->region[0]];
            if (border->region[1] != ICCP_NO_REGION)
                d->ids[d->n_ids++] = layer->regions->id[border->region[1]];
            iccp_layer_given(layer, graph->at[border->first + border->n / 2], d->place);
        }
        ++n;
    }
    return n;
}

typedef struct choice {
    const iccp_layer_pairing *pairing;
    const iccp_layer_rings *rings; /* of both layers */
    uint32_t *set;                 /* pieces of both layers that are partners; the source's first */
    bool *is_out;                  /* of each set */
    bool *is_filled;               /* of each piece: an island that only one layer has */
} choice;

static uint32_t piece_of(const choice *c, int e, uint32_t border, int side)
{
    const uint32_t piece = c->pairing->graph[e]->border[border].piece[side];
    return piece == NONE || e == 0 ? piece : piece + (uint32_t)c->rings[0].n_walks;
}

/* Unites the pieces beside paired borders. */
static void unite(choice *c)
{
    const uint32_t *const partner = c->pairing->border;
    for (uint32_t b = 0; b < c->pairing->graph[0]->n_borders; ++b)
        for (int side = 0; side < 2 && partner[b] != NONE; ++side) {
            const uint32_t p = piece_of(c, 0, b, side), q = piece_of(c, 1, partner[b], side);
            if (p != NONE && q != NONE)
                iccp_sets_join(c->set, p, q);
        }
}

/* Marks what stands beside borders without partners. */
static void mark(choice *c)
{
    for (int e = 0; e < 2; ++e) {
        const uint32_t *const partner = e == 0 ? c->pairing->border : c->pairing->back;
        const iccp_layer_graph *const graph = c->pairing->graph[e];
        for (uint32_t b = 0; b < graph->n_borders; ++b)
            for (int side = 0; side < 2; ++side) {
                const uint32_t p = piece_of(c, e, b, side);
                if (partner[b] == NONE && !graph->border[b].is_island && p != NONE)
                    c->is_out[iccp_sets_leader(c->set, p)] = true;
            }
    }
    /* The ring inside an island is positive, the one outside is not. */
    for (size_t e = 0, first = 0; e < 2; first += c->rings[e++].n_walks)
        for (size_t r = 0; r < c->rings[e].n; ++r) {
            const iccp_ring *const ring = &c->rings[e].ring[r];
            const uint32_t b = c->rings[e].course[ring->first] / 2;
            const uint32_t *const partner = e == 0 ? c->pairing->border : c->pairing->back;
            if (ring->area > 0 && c->pairing->graph[e]->border[b].is_island && partner[b] == NONE)
                c->is_filled[first + ring->piece] = true;
        }
}

static void keep(iccp_kept *kept, choice *c)
{
    const iccp_layer_rings *const rings = &c->rings[0];
    for (size_t r = 0; r < rings->n; ++r) {
        const iccp_ring *const ring = &rings->ring[r];
        const uint32_t *const course = rings->course + ring->first;
        kept->ring[r] =
            !c->is_out[iccp_sets_leader(c->set, ring->piece)] && !c->is_filled[ring->piece];
        for (size_t k = 0; k < ring->n; ++k)
            kept->ring[r] = kept->ring[r] && c->pairing->border[course[k] / 2] != NONE;
        kept->n_rings += kept->ring[r];
        for (size_t k = 0; k < ring->n && kept->ring[r]; ++k)
            kept->border[course[k] / 2] = true;
    }
}

icc_status iccp_kept_find(iccp_kept *kept, const iccp_layer_pairing *pairing,
                          const iccp_layer_rings *rings, const iccp_env *env)
{
    const iccp_memory *const memory = &env->memory;
    const size_t n = rings[0].n_walks + rings[1].n_walks;
    choice c = {.pairing = pairing, .rings = rings};
    *kept = (iccp_kept){0};
    kept->ring = iccp_alloc_zero(memory, rings[0].n, sizeof *kept->ring);
    kept->border = iccp_alloc_zero(memory, pairing->graph[0]->n_borders, sizeof *kept->border);
    c.set = iccp_alloc(memory, n, sizeof *c.set);
    c.is_out = iccp_alloc_zero(memory, n, sizeof *c.is_out);
    c.is_filled = iccp_alloc_zero(memory, n, sizeof *c.is_filled);
    const bool has_all = kept->ring != NULL && kept->border != NULL && c.set != NULL &&
                         c.is_out != NULL && c.is_filled != NULL;
    if (has_all) {
        iccp_sets_begin(c.set, n);
        unite(&c);
        mark(&c);
        keep(kept, &c);
    }
    iccp_free(memory, c.set);
    iccp_free(memory, c.is_out);
    iccp_free(memory, c.is_filled);
    return has_all ? ICC_OK : ICC_ERR_MEMORY;
}

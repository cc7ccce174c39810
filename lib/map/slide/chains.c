/* Finds the chains of a network: from each stop along each side, until the next stop. */
#include "map/slide/chains.h"

#include <string.h>

typedef struct walk {
    iccp_chains *c;
    const icc_domain *domain;
    const iccp_network *network;
    uint8_t *is_stop; /* by node */
} walk;

static void find_stops(walk *w)
{
    const iccp_features *features = w->domain->features;
    const uint32_t *node = w->network->node;
    for (size_t v = 0; v < w->domain->n_vertices; ++v)
        w->is_stop[node[v]] = iccp_network_degree(w->network, node[v]) != 2;
    for (size_t f = 0; f < features->n; ++f) {
        const iccp_feature *feature = &features->item[f];
        if (!iccp_feature_is_ring(feature->kind))
            w->is_stop[node[feature->first]] = w->is_stop[node[feature->first + feature->n - 1]] =
                1;
    }
}

/* Adds the chain that begins with a half-side at a stop. It ends at the next stop. */
static void follow(walk *w, uint32_t half)
{
    iccp_chains *c = w->c;
    size_t n = c->first[c->n];
    uint32_t node;
    do {
        c->half[n] = half;
        c->chain[half / 2] = (uint32_t)c->n;
        c->order[half / 2] = (uint32_t)n++;
        node = iccp_network_origin(w->network, w->domain, half ^ 1);
        const uint32_t *leaving = w->network->leaving + w->network->first[node];
        if (!w->is_stop[node])
            half = leaving[0] == (half ^ 1) ? leaving[1] : leaving[0];
    } while (!w->is_stop[node]);
    c->first[++c->n] = n;
}

static bool is_new(const walk *w, uint32_t side)
{
    return iccp_network_is_side(w->network, w->domain, side) && w->c->chain[side] == UINT32_MAX;
}

/* Chains between given stops come first. What is left is closed chains. The stop of each is where
 * its smallest side begins. */
static void follow_all(walk *w)
{
    const uint32_t n_sides = (uint32_t)w->domain->features->n_places;
    for (uint32_t h = 0; h < 2 * n_sides; ++h)
        if (is_new(w, h / 2) && w->is_stop[iccp_network_origin(w->network, w->domain, h)])
            follow(w, h);
    for (uint32_t f = 0; f < n_sides; ++f)
        if (is_new(w, f)) {
            w->is_stop[iccp_network_origin(w->network, w->domain, 2 * f)] = 1;
            follow(w, 2 * f);
        }
}

icc_status iccp_chains_create(iccp_chains *chains, const icc_domain *domain,
                              const iccp_memory *memory)
{
    const iccp_network *network = iccp_network_of(domain);
    const size_t n = domain->features->n_places;
    iccp_chains *c = chains;
    *c = (iccp_chains){.memory = *memory,
                       .first = iccp_alloc(memory, network->n_sides + 1, sizeof *c->first),
                       .half = iccp_alloc(memory, network->n_sides, sizeof *c->half),
                       .chain = iccp_alloc(memory, n, sizeof *c->chain),
                       .order = iccp_alloc(memory, n, sizeof *c->order)};
    walk w = {c, domain, network, iccp_alloc_zero(memory, domain->n_vertices, 1)};
    const bool is_there = c->first != NULL && c->half != NULL && c->chain != NULL &&
                          c->order != NULL && w.is_stop != NULL;
    if (is_there) {
        c->first[0] = 0;
        memset(c->chain, 0xff, n * sizeof *c->chain);
        find_stops(&w);
        follow_all(&w);
    } else {
        iccp_chains_free(c);
    }
    iccp_free(memory, w.is_stop);
    return is_there ? ICC_OK : ICC_ERR_MEMORY;
}

void iccp_chains_free(iccp_chains *chains)
{
    iccp_free(&chains->memory, chains->first);
    iccp_free(&chains->memory, chains->half);
    iccp_free(&chains->memory, chains->chain);
    iccp_free(&chains->memory, chains->order);
    *chains = (iccp_chains){.memory = chains->memory};
}

/* Searches for a short loop of a class, breadth first in a covering of the surface.
 *
 * Source: J. Erickson, S. Har-Peled, Optimally cutting a surface into a disk, 2004: the
 * shortest loop through a vertex that is not of a given kind is a path of the breadth-first tree,
 * an edge, and a path back. Here the tree grows in the covering whose loops are those with sum 0 of
 * witness->zero. Its nodes are a vertex and a sum, and each node keeps the sum of witness->other.
 * An edge between two nodes whose sums do not fit closes a witness. The tree's paths visit no
 * vertex twice. The search ends when a loop does not either, or
 * when it has taken as many nodes again as for the first loop. */
#include "map/topology/witness_loop.h"

#include <string.h>

/* Most nodes of one search. A search that begins near a handle needs about as many as the handle
 * has vertices. */
enum { MOST_NODES = 1 << 18 };

/* Most searches for the first loop. */
enum { MOST_STARTS = 16 };

#define NO_NODE UINT32_MAX

typedef struct node {
    uint64_t zero, other; /* sums along the tree */
    uint32_t vertex, parent, depth;
} node;

typedef struct search {
    const iccp_witness *witness;
    const iccp_region_surface *surface;
    node *nodes;
    uint32_t *table; /* of nodes by vertex and sum, open addressing; a power of 2 */
    size_t n_nodes, n_table;
    uint32_t *loop, *best; /* vertices; room for n_room */
    uint8_t *seen;         /* by vertex */
    size_t n_room, n_loop, n_best;
    bool best_is_simple;
} search;

static void end(search *s, const iccp_memory *memory)
{
    iccp_free(memory, s->nodes);
    iccp_free(memory, s->table);
    iccp_free(memory, s->loop);
    iccp_free(memory, s->best);
    iccp_free(memory, s->seen);
}

static icc_status begin(search *s, const iccp_memory *memory)
{
    s->n_table = 2 * MOST_NODES;
    s->n_room = 2 * MOST_NODES;
    s->nodes = iccp_alloc(memory, MOST_NODES, sizeof *s->nodes);
    s->table = iccp_alloc(memory, s->n_table, sizeof *s->table);
    s->loop = iccp_alloc(memory, s->n_room, sizeof *s->loop);
    s->best = iccp_alloc(memory, s->n_room, sizeof *s->best);
    s->seen = iccp_alloc_zero(memory, s->surface->n_vertices, sizeof *s->seen);
    const bool has_memory = s->nodes != NULL && s->table != NULL && s->loop != NULL &&
                            s->best != NULL && s->seen != NULL;
    return has_memory ? ICC_OK : ICC_ERR_MEMORY;
}

/* Returns the table's place for a vertex and a sum: that of their node, or an empty one. */
static size_t find_place(const search *s, uint32_t vertex, uint64_t zero)
{
    const size_t mask = s->n_table - 1;
    /* Sums are random, but for small multiples of each other; the multiplier mixes them. */
    size_t at = (size_t)((zero + vertex) * 0x9e3779b97f4a7c15u >> 32) & mask;
    for (; s->table[at] != NO_NODE; at = (at + 1) & mask) {
        const node *other = &s->nodes[s->table[at]];
        if (other->vertex == vertex && other->zero == zero)
            break;
    }
    return at;
}

/* Writes the loop that an edge between two nodes closes, without the way from the root that both
 * share. */
static void close_loop(search *s, uint32_t a, uint32_t b)
{
    const node *nodes = s->nodes;
    size_t n = 0, n_back = 0;
    uint32_t p = a, q = b;
    while (p != q)
        if (nodes[p].depth >= nodes[q].depth) {
            s->loop[n++] = nodes[p].vertex;
            p = nodes[p].parent;
        } else {
            ++n_back;
            q = nodes[q].parent;
        }
    s->loop[n++] = nodes[p].vertex;
    s->n_loop = n + n_back;
    for (q = b; n_back-- > 0; q = nodes[q].parent)
        s->loop[n + n_back] = nodes[q].vertex;
}

static bool is_simple(const search *s)
{
    bool simple = true;
    for (size_t i = 0; i < s->n_loop; ++i) {
        simple = simple && !s->seen[s->loop[i]];
        s->seen[s->loop[i]] = 1;
    }
    for (size_t i = 0; i < s->n_loop; ++i)
        s->seen[s->loop[i]] = 0;
    return simple;
}

/* Keeps the loop if it is better than the best one. Returns true if it does. */
static bool keep_loop(search *s)
{
    const bool simple = is_simple(s);
    if (s->n_best > 0 && (simple == s->best_is_simple ? s->n_loop >= s->n_best : !simple))
        return false;
    uint32_t *swap = s->best;
    s->best = s->loop;
    s->loop = swap;
    s->n_best = s->n_loop;
    s->best_is_simple = simple;
    return true;
}

/* Returns true if the tree's path to a node visits a vertex. */
static bool visits(const search *s, uint32_t at, uint32_t vertex)
{
    while (at != NO_NODE && s->nodes[at].vertex != vertex)
        at = s->nodes[at].parent;
    return at != NO_NODE;
}

/* Goes from a node along an edge. Returns true if that closes a loop. */
static bool go(search *s, uint32_t from, uint32_t edge)
{
    const iccp_witness *witness = s->witness;
    const uint32_t *ends = s->surface->ends;
    const uint32_t v = s->nodes[from].vertex;
    const uint32_t w = ends[2 * (size_t)edge + (ends[2 * (size_t)edge] == v)];
    const uint64_t zero =
        iccp_residue_add(s->nodes[from].zero, iccp_class_along(witness->zero, ends, edge, v));
    const uint64_t other =
        iccp_residue_add(s->nodes[from].other, iccp_class_along(witness->other, ends, edge, v));
    const size_t at = find_place(s, w, zero);
    if (s->table[at] == NO_NODE) {
        if (!visits(s, from, w)) {
            s->table[at] = (uint32_t)s->n_nodes;
            s->nodes[s->n_nodes++] = (node){zero, other, w, from, s->nodes[from].depth + 1};
        }
        return false;
    }
    if (s->nodes[s->table[at]].other == other)
        return false;
    close_loop(s, from, s->table[at]);
    return true;
}

/* Searches for a loop through a vertex. Returns true if it finds a better one. */
static bool search_from(search *s, uint32_t vertex)
{
    const iccp_region_surface *surface = s->surface;
    size_t n_most = MOST_NODES;
    bool better = false;
    memset(s->table, 0xff, s->n_table * sizeof *s->table);
    s->n_nodes = 1;
    s->nodes[0] = (node){.vertex = vertex, .parent = NO_NODE};
    s->table[find_place(s, vertex, 0)] = 0;
    for (uint32_t done = 0; done < s->n_nodes; ++done) {
        const uint32_t v = s->nodes[done].vertex;
        for (size_t i = surface->edge_first[v]; i < surface->edge_first[v + 1]; ++i) {
            if (s->n_nodes >= n_most)
                return better;
            if (!go(s, done, surface->at_vertex[i]))
                continue;
            better = keep_loop(s) || better;
            if (s->best_is_simple)
                return better;
            n_most = n_most == MOST_NODES && 2 * s->n_nodes < n_most ? 2 * s->n_nodes : n_most;
        }
    }
    return better;
}

icc_status iccp_witness_draw(uint32_t **loop, size_t *n, const iccp_witness *witness,
                             iccp_region_pair *pair)
{
    const iccp_region_surface *surface = &pair->surface;
    search s = {.witness = witness, .surface = surface};
    bool confirmed = false;
    icc_status status = begin(&s, &pair->memory);
    *loop = NULL;
    *n = 0;
    for (size_t i = 0; status == ICC_OK && i < witness->n_starts && i < MOST_STARTS; ++i)
        (void)search_from(&s, surface->ends[2 * (size_t)surface->loops[witness->starts[i]]]);
    while (s.n_best > 0 && search_from(&s, s.best[s.n_best / 2]))
        ;
    if (s.n_best > 0)
        status = iccp_witness_confirm(witness, pair, s.n_best, s.best, &confirmed);
    if (status == ICC_OK && confirmed) {
        *loop = s.best;
        *n = s.n_best;
        s.best = NULL;
    }
    end(&s, &pair->memory);
    return status;
}

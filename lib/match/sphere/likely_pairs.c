/* Finds pairs of vertices of two surfaces that correspond, judged by distances. Based on: A. Elad,
 * R. Kimmel, On Bending Invariant Signatures for Surfaces, 2003: distances within a surface hardly
 * change when limbs are bent. Distances are measured along edges by E. W. Dijkstra, A Note on Two
 * Problems in Connexion with Graphs, 1959. */
#include "match/sphere/likely_pairs.h"

#include "base/heap.h"
#include "base/minmax.h"
#include "math/vec.h"

/* Vertices that are tried for each pair that may be found. */
enum { TRIES = 3 };

/* Distances on surfaces of area 4 pi. A vertex closer than `near` to a pair needs no pair of its
 * own. Distances of partners may differ by the share `differ` of the vertex's distance from all
 * pairs, or of `least_far` if that is larger. The search back from the partner may miss the vertex
 * by `back`. Tried on t01 to t08 with 4 landmarks. */
static const double near = 0.43, least_far = 1.06, back = 0.35, differ = 0.25;

typedef struct likely {
    const iccp_half_edges *m[2];
    const double *x[2], *scale;
    double *row[2]; /* by pair and vertex: its distance */
    iccp_heap heap;
} likely;

static double *row_of(const likely *l, int side, size_t k)
{
    return l->row[side] + k * l->m[side]->n_vertices;
}

/* Finds the distances from a vertex. A vertex that is not present is infinitely far. */
static void find_distances(likely *l, int side, uint32_t from, double *row)
{
    const iccp_half_edges *const m = l->m[side];
    for (uint32_t v = 0; v < m->n_vertices; ++v)
        row[v] = HUGE_VAL;
    row[from] = 0;
    iccp_heap_put(&l->heap, from, 0);
    while (l->heap.n_entries > 0) {
        const uint32_t v = iccp_heap_pop(&l->heap);
        uint32_t h = m->out[v];
        for (uint32_t k = 0; k < m->degree[v]; ++k, h = iccp_edge_turn(m, h)) {
            const uint32_t w = iccp_edge_end(m, h);
            const double at =
                row[v] + l->scale[side] * iccp_vec_distance(3, l->x[side] + 3 * (size_t)v,
                                                            l->x[side] + 3 * (size_t)w);
            if (at < row[w]) {
                row[w] = at;
                iccp_heap_put(&l->heap, w, at);
            }
        }
    }
}

/* Finds the vertex of a side whose distances to n pairs are closest to those of a vertex of the
 * other side. *off is the largest difference. */
static uint32_t find_partner(const likely *l, int side, size_t n, uint32_t other, double *off)
{
    uint32_t best = 0;
    *off = HUGE_VAL;
    for (uint32_t v = 0; v < l->m[side]->n_vertices; ++v) {
        double most = l->m[side]->degree[v] > 0 ? 0 : HUGE_VAL;
        for (size_t k = 0; k < n && most < *off; ++k)
            most = iccp_max(most, fabs(row_of(l, side, k)[v] - row_of(l, 1 - side, k)[other]));
        if (most < *off) {
            *off = most;
            best = v;
        }
    }
    return best;
}

/* Tries the vertex that is farthest from all pairs and from all vertices tried before (`room`, by
 * vertex). *any is true if there was one. */
static void try_one(likely *l, double *room, uint32_t *const vertices[2], size_t *n, bool *any)
{
    double off, none;
    uint32_t a = 0;
    for (uint32_t v = 1; v < l->m[0]->n_vertices; ++v)
        a = room[v] > room[a] ? v : a;
    const double far = room[a];
    *any = far >= near;
    if (!*any)
        return;
    const uint32_t b = find_partner(l, 1, *n, a, &off), again = find_partner(l, 0, *n, b, &none);
    double *const from_a = row_of(l, 0, *n);
    find_distances(l, 0, a, from_a);
    for (uint32_t v = 0; v < l->m[0]->n_vertices; ++v)
        room[v] = iccp_min(room[v], from_a[v]);
    if (from_a[again] < back && off < differ * iccp_max(least_far, far)) {
        find_distances(l, 1, b, row_of(l, 1, *n));
        vertices[0][*n] = a;
        vertices[1][(*n)++] = b;
    }
}

/* Finds the distances from the given pairs, then tries one vertex after the other. */
static icc_status find(likely *l, double *room, uint32_t *const vertices[2], size_t *n, size_t most,
                       const iccp_env *env)
{
    const size_t tries = TRIES * (most - *n);
    icc_status status = ICC_OK;
    bool any = true;
    for (size_t k = 0; k < *n; ++k)
        for (int side = 0; side < 2; ++side)
            find_distances(l, side, vertices[side][k], row_of(l, side, k));
    for (uint32_t v = 0; v < l->m[0]->n_vertices; ++v) {
        room[v] = l->m[0]->degree[v] > 0 ? HUGE_VAL : 0;
        for (size_t k = 0; k < *n; ++k)
            room[v] = iccp_min(room[v], row_of(l, 0, k)[v]);
    }
    for (size_t k = 0; k < tries && *n < most && any && status == ICC_OK; ++k) {
        try_one(l, room, vertices, n, &any);
        status = iccp_progress(env, "match", (double)(k + 1) / (double)tries);
    }
    return status;
}

icc_status iccp_likely_pairs_find(uint32_t *const vertices[2], size_t *n, size_t most,
                                  const iccp_half_edges *const m[2], const double *const x[2],
                                  const double scale[2], const iccp_env *env)
{
    const iccp_memory *const memory = &env->memory;
    likely l = {.m = {m[0], m[1]}, .x = {x[0], x[1]}, .scale = scale};
    const size_t n_first = m[0]->n_vertices, n_second = m[1]->n_vertices;
    icc_status status = ICC_ERR_MEMORY;
    double *const room = iccp_alloc(memory, n_first, sizeof *room);
    for (int side = 0; side < 2; ++side)
        l.row[side] = iccp_alloc(memory, m[side]->n_vertices, most * sizeof *l.row[side]);
    if (iccp_heap_create(&l.heap, n_first > n_second ? n_first : n_second, memory) &&
        room != NULL && l.row[0] != NULL && l.row[1] != NULL)
        status = find(&l, room, vertices, n, most, env);
    iccp_heap_free(&l.heap, memory);
    iccp_free(memory, room);
    for (int side = 0; side < 2; ++side)
        iccp_free(memory, l.row[side]);
    return status;
}

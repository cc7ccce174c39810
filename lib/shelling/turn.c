/* An order by itself is not what matters, but through which sides of each simplex leaves enter, and
 * at each face inside, that leaves come to it in one simplex and go from it in one (docs/theory.md,
 * foliations of simplices). Whether a facet can be crossed the other way is a question to the two
 * simplices at it: each still has sides of both kinds, and at each face of the facet the simplices
 * whose sides there are all entered, and those whose sides are all left, are as many as before.
 * That leaves do not run in circles must be seen to besides: when they do after a pass, what it
 * turned there is turned back. */
#include "shelling/turn.h"

#include "shelling/heap.h"

#include <stdbool.h>
#include <string.h>

enum { MOST_PASSES = 20 };

typedef struct turner {
    const iccp_order_wish *wish;
    uint8_t *entered; /* of each simplex: the sides that leaves enter by, side i being bit i */
    uint32_t *turned; /* in this pass, each as seen from the simplex that was of greater rank */
    size_t n_turned;
    iccp_heap heap;    /* of sides */
    uint8_t *barred;   /* of each side: 1: it has been turned back */
    uint8_t *in;       /* of each simplex: 0: it has been taken out */
    uint32_t *waiting; /* of each simplex: neighbours that must be taken out before it */
    uint32_t *queue;
} turner;

static bool in_star(const uint32_t *rank, size_t s)
{
    return rank[s] == 0;
}

static void find_entered(turner *t, const uint32_t *rank)
{
    const iccp_simplices *mesh = t->wish->mesh;
    const size_t n_sides = mesh->dim + 1;
    memset(t->entered, 0, mesh->n_simplices);
    for (size_t side = 0; side < n_sides * mesh->n_simplices; ++side) {
        const uint32_t across = mesh->across[side];
        if (across >= ICCP_ON_BOUNDARY ||
            rank[iccp_simplex_of(mesh, across)] > rank[side / n_sides])
            t->entered[side / n_sides] |= (uint8_t)(1u << side % n_sides);
    }
}

/* Whether a simplex has, at a side that leaves leave by, or enter by, a neighbour that is in. */
static bool is_before(const turner *t, size_t s, size_t i, bool by_leaving)
{
    const iccp_simplices *mesh = t->wish->mesh;
    const uint32_t across = mesh->across[(mesh->dim + 1) * s + i];
    const bool leaves = (t->entered[s] >> i & 1) == 0;
    return across < ICCP_ON_BOUNDARY && leaves == by_leaving &&
           t->in[iccp_simplex_of(mesh, across)] != 0;
}

/* Of each corner of one simplex the bit of the same corner in another, or 0. */
static void match_corners(const iccp_simplices *mesh, size_t a, size_t b, unsigned *bit)
{
    const size_t n = mesh->dim + 1;
    for (size_t i = 0; i < n; ++i) {
        bit[i] = 0;
        for (size_t j = 0; j < n; ++j)
            if (mesh->corners[n * a + i] == mesh->corners[n * b + j])
                bit[i] = 1u << j;
    }
}

static unsigned translate(unsigned set, const unsigned *bit)
{
    unsigned other = 0;
    for (size_t i = 0; set >> i != 0; ++i)
        other |= (set >> i & 1) != 0 ? bit[i] : 0;
    return other;
}

/* Of two simplices, by the sides that they enter by: how many have all of these sides entered, and
 * how many all left. */
static int count_alike(unsigned a, unsigned sides_a, unsigned b, unsigned sides_b)
{
    const int entered = ((a & sides_a) == sides_a) + ((b & sides_b) == sides_b);
    const int left = ((a & sides_a) == 0) + ((b & sides_b) == 0);
    return 3 * entered + left;
}

/* Whether leaves may enter by a side that they leave by. The sides at a face are those opposite to
 * other corners. */
static bool may_turn(const turner *t, uint32_t side)
{
    const iccp_simplices *mesh = t->wish->mesh;
    const size_t n = mesh->dim + 1;
    const uint32_t twin = mesh->across[side];
    const size_t a = side / n, b = twin / n;
    const unsigned all = (1u << n) - 1, own = 1u << side % n, others = 1u << twin % n;
    const unsigned a_was = t->entered[a], a_is = a_was | own;
    const unsigned b_was = t->entered[b], b_is = b_was & ~others;
    unsigned bit[ICC_MAX_DIM + 1];
    if (a_is == all || b_is == 0)
        return false;
    match_corners(mesh, a, b, bit);
    const unsigned facet = all & ~own;
    for (unsigned face = facet; face != 0; face = (face - 1) & facet) {
        const unsigned sides_a = all & ~face, sides_b = all & ~translate(face, bit);
        if (face != facet && count_alike(a_was, sides_a, b_was, sides_b) !=
                                 count_alike(a_is, sides_a, b_is, sides_b))
            return false;
    }
    return true;
}

static void turn(turner *t, uint32_t side)
{
    const iccp_simplices *mesh = t->wish->mesh;
    const size_t n = mesh->dim + 1;
    const uint32_t twin = mesh->across[side];
    t->entered[side / n] ^= (uint8_t)(1u << side % n);
    t->entered[twin / n] ^= (uint8_t)(1u << twin % n);
}

/* Turns what may be turned, what carries most flux first. */
static icc_status pass(turner *t, const uint32_t *rank, const iccp_env *env)
{
    const iccp_simplices *mesh = t->wish->mesh;
    const size_t n = mesh->dim + 1;
    for (size_t side = 0; side < n * mesh->n_simplices; ++side) {
        const uint32_t across = mesh->across[side];
        const bool leaves = (t->entered[side / n] >> side % n & 1) == 0;
        if (across < ICCP_ON_BOUNDARY && leaves && t->wish->flux[side] < 0 && !t->barred[side] &&
            !in_star(rank, side / n) && !in_star(rank, across / n))
            iccp_heap_put(&t->heap, (uint32_t)side, t->wish->flux[side]);
    }
    t->n_turned = 0;
    while (t->heap.n_entries > 0) {
        const uint32_t side = iccp_heap_pop(&t->heap);
        if (may_turn(t, side)) {
            turn(t, side);
            t->turned[t->n_turned++] = side;
        }
    }
    return iccp_progress(env, "order", 0);
}

/* A. B. Kahn, Topological sorting of large networks, 1962: takes out, one after the other, the
 * simplices that are in and that leaves come to from none that is in, or, from below, go from to
 * none that is in. The queue holds them in this order. Returns how many. */
static size_t take_out(turner *t, bool from_below)
{
    const iccp_simplices *mesh = t->wish->mesh;
    const size_t n = mesh->dim + 1;
    size_t n_out = 0, n_reached = 0;
    for (size_t s = 0; s < mesh->n_simplices; ++s) {
        t->waiting[s] = 0;
        for (size_t i = 0; i < n && t->in[s]; ++i)
            t->waiting[s] += is_before(t, s, i, from_below);
        if (t->in[s] && t->waiting[s] == 0)
            t->queue[n_reached++] = (uint32_t)s;
    }
    for (; n_out < n_reached; ++n_out) {
        const size_t s = t->queue[n_out];
        t->in[s] = 0;
        for (size_t i = 0; i < n; ++i)
            if (is_before(t, s, i, !from_below)) {
                const size_t next = iccp_simplex_of(mesh, mesh->across[n * s + i]);
                if (--t->waiting[next] == 0)
                    t->queue[n_reached++] = (uint32_t)next;
            }
    }
    return n_out;
}

/* Ranks all simplices but the star; or, where leaves run in circles, leaves those in that do or lie
 * between. */
static bool rank_anew(turner *t, uint32_t *rank)
{
    const size_t n = t->wish->mesh->n_simplices;
    size_t n_all = 0;
    for (size_t s = 0; s < n; ++s) {
        t->in[s] = rank[s] != 0;
        n_all += t->in[s];
    }
    const size_t n_ranked = take_out(t, true);
    if (n_ranked < n_all) {
        (void)take_out(t, false);
        return false;
    }
    for (size_t k = 0; k < n_ranked; ++k)
        rank[t->queue[k]] = (uint32_t)(k + 1);
    return true;
}

/* Turns facets of this pass back, the last one first: all, or those between simplices that are in,
 * for good. */
static size_t turn_back(turner *t, bool all)
{
    const iccp_simplices *mesh = t->wish->mesh;
    size_t n_kept = t->n_turned, n_back = 0;
    for (size_t k = t->n_turned; k-- > 0;) {
        const uint32_t side = t->turned[k], twin = mesh->across[side];
        const bool is_in = t->in[iccp_simplex_of(mesh, side)] && t->in[iccp_simplex_of(mesh, twin)];
        if (all || (is_in && may_turn(t, twin))) {
            turn(t, side);
            t->barred[side] = 1;
            ++n_back;
        } else {
            t->turned[--n_kept] = side;
        }
    }
    memmove(t->turned, t->turned + n_kept, (t->n_turned - n_kept) * sizeof *t->turned);
    t->n_turned -= n_kept;
    return n_back;
}

static icc_status turn_all(turner *t, uint32_t *rank, size_t *n_turned, const iccp_env *env)
{
    icc_status status = ICC_OK;
    *n_turned = 0;
    find_entered(t, rank);
    for (int k = 0; k < MOST_PASSES && status == ICC_OK; ++k) {
        status = pass(t, rank, env);
        while (t->n_turned > 0 && !rank_anew(t, rank))
            if (turn_back(t, false) == 0)
                (void)turn_back(t, true);
        if (t->n_turned == 0)
            break;
        *n_turned += t->n_turned;
    }
    return status;
}

icc_status iccp_order_turn(const iccp_order_wish *wish, uint32_t *rank, size_t *n_turned,
                           const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const size_t n = wish->mesh->n_simplices, n_sides = (wish->mesh->dim + 1) * n;
    turner t = {.wish = wish};
    t.entered = iccp_alloc(memory, n, sizeof *t.entered);
    t.turned = iccp_alloc(memory, n_sides, sizeof *t.turned);
    t.barred = iccp_alloc_zero(memory, n_sides, sizeof *t.barred);
    t.in = iccp_alloc(memory, n, sizeof *t.in);
    t.waiting = iccp_alloc(memory, n, sizeof *t.waiting);
    t.queue = iccp_alloc(memory, n, sizeof *t.queue);
    icc_status status = ICC_ERR_MEMORY;
    if (iccp_heap_create(&t.heap, n_sides, memory) && t.entered != NULL && t.turned != NULL &&
        t.barred != NULL && t.in != NULL && t.waiting != NULL && t.queue != NULL)
        status = turn_all(&t, rank, n_turned, env);
    iccp_heap_free(&t.heap, memory);
    iccp_free(memory, t.entered);
    iccp_free(memory, t.turned);
    iccp_free(memory, t.barred);
    iccp_free(memory, t.in);
    iccp_free(memory, t.waiting);
    iccp_free(memory, t.queue);
    return status;
}

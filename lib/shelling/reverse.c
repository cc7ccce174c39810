/* Improves an order by reversing facets. Source: docs/theory/charts-space.md, "foliations of
 * simplices", hypotheses 2 and 3 of the theorem.
 *
 * Only two things about an order matter. Leaves enter each simplex by some sides and leave it by
 * others. At each face inside, leaves come to it in exactly one simplex and go from it in exactly
 * one.
 *
 * So the two simplices at a facet decide whether leaves may cross it the other way. Each simplex
 * must keep sides of both kinds. At each face of the facet, two counts must not change. One is the
 * number of simplices whose sides there are all entered, the other the number whose sides there are
 * all left.
 *
 * Leaves must not run in circles. If they do after a pass, its reversals on the circles are
 * undone. */
#include "shelling/reverse.h"

#include "base/heap.h"

#include <stdbool.h>
#include <string.h>

enum { MOST_PASSES = 20 };

typedef struct reversal {
    const iccp_order_priority *priority;
    uint8_t *entered; /* of each simplex: the sides by which leaves enter; bit i is side i */
    uint8_t *inner;   /* of each simplex: the sides to simplices outside the star */
    uint32_t *wrong;  /* sides that the flux crosses the wrong way and that may be tried */
    size_t n_wrong;
    uint32_t *reversed; /* sides reversed in this pass, as seen from the simplex that had the
                           greater rank */
    size_t n_reversed;
    iccp_heap heap;     /* of sides */
    uint8_t *remaining; /* of each simplex: 0 if it has been taken out */
    uint32_t *waiting;  /* of each simplex: number of neighbours that must be taken out before it */
    uint32_t *queue;    /* simplices */
} reversal;

/* Finds the sides by which leaves enter: from greater rank and from outside the domain. A side
 * is wrong if leaves leave by it and the flux enters by it. Facets at the star are not tried. */
static void find_sides(reversal *t, const uint32_t *rank)
{
    const iccp_simplices *mesh = t->priority->mesh;
    const uint32_t n_sides = (uint32_t)mesh->dim + 1;
    t->n_wrong = 0;
    for (uint32_t s = 0, side = 0; s < mesh->n_simplices; ++s) {
        unsigned entered = 0, inner = 0;
        for (uint32_t i = 0; i < n_sides; ++i, ++side) {
            const uint32_t across = mesh->across[side];
            const bool outside = across >= ICCP_ON_BOUNDARY;
            const uint32_t other = outside ? UINT32_MAX : rank[iccp_simplex_of(mesh, across)];
            entered |= (unsigned)(other > rank[s]) << i;
            inner |= (unsigned)(!outside && other != 0) << i;
            if (other <= rank[s] && other != 0 && rank[s] != 0 && t->priority->flux[side] < 0)
                t->wrong[t->n_wrong++] = side;
        }
        t->entered[s] = (uint8_t)entered;
        t->inner[s] = (uint8_t)inner;
    }
}

/* Returns true if side i of a simplex has a neighbour that has not been taken out. In addition,
 * leaves must pass to it (`by_leaving`) or come from it. */
static bool has_neighbour(const reversal *t, size_t s, size_t i, bool by_leaving)
{
    const iccp_simplices *mesh = t->priority->mesh;
    const uint32_t across = mesh->across[(mesh->dim + 1) * s + i];
    const bool leaves = (t->entered[s] >> i & 1) == 0;
    return across < ICCP_ON_BOUNDARY && leaves == by_leaving &&
           t->remaining[iccp_simplex_of(mesh, across)] != 0;
}

/* Writes for each corner of simplex a the bit of the same corner in simplex b, or 0. translate()
 * uses this to carry sets of corners from a to b. */
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

/* Translates a set of corners to the other simplex, by the bits from match_corners(). */
static unsigned translate(unsigned set, const unsigned *bit)
{
    unsigned other = 0;
    for (size_t i = 0; set >> i != 0; ++i)
        other |= (set >> i & 1) != 0 ? bit[i] : 0;
    return other;
}

/* Counts how many of two simplices have all of the given sides entered, and how many have all of
 * them left. `a` and `b` are the sides by which leaves enter. */
static int count_alike(unsigned a, unsigned sides_a, unsigned b, unsigned sides_b)
{
    const int entered = ((a & sides_a) == sides_a) + ((b & sides_b) == sides_b);
    const int left = ((a & sides_a) == 0) + ((b & sides_b) == 0);
    return 3 * entered + left;
}

/* Returns true if a facet may be reversed, so that leaves enter by a side that they leave by
 * now. Each simplex must keep sides of both kinds. At every face of the facet, the two simplices
 * must give the same counts as before, because other simplices at the face do not change. The
 * sides at a face are those opposite to the corners outside it. */
static bool can_reverse(const reversal *t, uint32_t side)
{
    const iccp_simplices *mesh = t->priority->mesh;
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

/* Reverses a facet: both its sides change kind. Doing it twice changes nothing. */
static void reverse_facet(reversal *t, uint32_t side)
{
    const iccp_simplices *mesh = t->priority->mesh;
    const size_t n = mesh->dim + 1;
    const uint32_t twin = mesh->across[side];
    t->entered[side / n] ^= (uint8_t)(1u << side % n);
    t->entered[twin / n] ^= (uint8_t)(1u << twin % n);
}

/* One pass. It queues the facets that the flux crosses the wrong way, and takes those with the
 * most flux first. It reverses each that may be reversed at that moment, and none twice. */
static icc_status reverse_pass(reversal *t, const iccp_env *env)
{
    size_t n_left = 0;
    for (size_t k = 0; k < t->n_wrong; ++k)
        iccp_heap_put(&t->heap, t->wrong[k], t->priority->flux[t->wrong[k]]);
    t->n_reversed = 0;
    while (t->heap.n_entries > 0) {
        const uint32_t side = iccp_heap_pop(&t->heap);
        if (can_reverse(t, side)) {
            reverse_facet(t, side);
            t->reversed[t->n_reversed++] = side;
        } else {
            t->wrong[n_left++] = side;
        }
    }
    t->n_wrong = n_left;
    return iccp_progress(env, "order", 0);
}

/* Takes out, one after the other, simplices from which leaves go to no simplex that is still in.
 * `queue` holds them in this order. Returns their number, which is too small if leaves run in
 * circles. Source: A. B. Kahn, Topological sorting of large networks, 1962. */
static size_t sort_from_below(reversal *t)
{
    const iccp_simplices *mesh = t->priority->mesh;
    const size_t n = mesh->dim + 1;
    size_t n_out = 0, n_reached = 0;
    for (size_t s = 0; s < mesh->n_simplices; ++s) {
        t->waiting[s] = (uint32_t)iccp_set_size(t->inner[s] & ~(unsigned)t->entered[s]);
        if (t->remaining[s] && t->waiting[s] == 0)
            t->queue[n_reached++] = (uint32_t)s;
    }
    for (; n_out < n_reached; ++n_out) {
        const size_t s = t->queue[n_out];
        const unsigned above = t->inner[s] & t->entered[s];
        t->remaining[s] = 0;
        for (size_t i = 0; above >> i != 0; ++i)
            if ((above >> i & 1) != 0) {
                const size_t next = iccp_simplex_of(mesh, mesh->across[n * s + i]);
                if (--t->waiting[next] == 0)
                    t->queue[n_reached++] = (uint32_t)next;
            }
    }
    return n_out;
}

/* Sorts the rest from above: takes out simplices to which leaves come from no simplex that is
 * still in. */
static void sort_from_above(reversal *t)
{
    const iccp_simplices *mesh = t->priority->mesh;
    const size_t n = mesh->dim + 1;
    size_t n_reached = 0;
    for (size_t s = 0; s < mesh->n_simplices; ++s) {
        t->waiting[s] = 0;
        for (size_t i = 0; i < n && t->remaining[s]; ++i)
            t->waiting[s] += has_neighbour(t, s, i, false);
        if (t->remaining[s] && t->waiting[s] == 0)
            t->queue[n_reached++] = (uint32_t)s;
    }
    for (size_t k = 0; k < n_reached; ++k) {
        const size_t s = t->queue[k];
        t->remaining[s] = 0;
        for (size_t i = 0; i < n; ++i)
            if (has_neighbour(t, s, i, true)) {
                const size_t next = iccp_simplex_of(mesh, mesh->across[n * s + i]);
                if (--t->waiting[next] == 0)
                    t->queue[n_reached++] = (uint32_t)next;
            }
    }
}

/* Ranks all simplices outside the star by sorting from below. Returns false if leaves run in
 * circles. The rest is then sorted from above, too, so only simplices on circles, or between two
 * circles, stay in. */
static bool rank_anew(reversal *t, uint32_t *rank)
{
    const size_t n = t->priority->mesh->n_simplices;
    size_t n_all = 0;
    for (size_t s = 0; s < n; ++s) {
        t->remaining[s] = rank[s] != 0;
        n_all += t->remaining[s];
    }
    const size_t n_ranked = sort_from_below(t);
    if (n_ranked < n_all) {
        sort_from_above(t);
        return false;
    }
    for (size_t k = 0; k < n_ranked; ++k)
        rank[t->queue[k]] = (uint32_t)(k + 1);
    return true;
}

/* Undoes reversals of this pass, the last one first: all of them, or only those between
 * simplices that are still in, where the circles are. Reversals that are kept stay in
 * `reversed`. Returns the number undone. */
static size_t undo_reversals(reversal *t, bool all)
{
    const iccp_simplices *mesh = t->priority->mesh;
    size_t n_kept = t->n_reversed, n_back = 0;
    for (size_t k = t->n_reversed; k-- > 0;) {
        const uint32_t side = t->reversed[k], twin = mesh->across[side];
        const bool is_in =
            t->remaining[iccp_simplex_of(mesh, side)] && t->remaining[iccp_simplex_of(mesh, twin)];
        if (all || (is_in && can_reverse(t, twin))) {
            reverse_facet(t, side);
            ++n_back;
        } else {
            t->reversed[--n_kept] = side;
        }
    }
    memmove(t->reversed, t->reversed + n_kept, (t->n_reversed - n_kept) * sizeof *t->reversed);
    t->n_reversed -= n_kept;
    return n_back;
}

/* Runs passes until one changes nothing. Each ends with an order without circles. Reversals on
 * circles are undone first. If none of them can be undone, the whole pass is. */
static icc_status reverse_all(reversal *t, uint32_t *rank, size_t *n_reversed, const iccp_env *env)
{
    icc_status status = ICC_OK;
    *n_reversed = 0;
    find_sides(t, rank);
    for (int k = 0; k < MOST_PASSES && status == ICC_OK; ++k) {
        status = reverse_pass(t, env);
        while (t->n_reversed > 0 && !rank_anew(t, rank))
            if (undo_reversals(t, false) == 0)
                (void)undo_reversals(t, true);
        if (t->n_reversed == 0)
            break;
        *n_reversed += t->n_reversed;
    }
    return status;
}

icc_status iccp_order_reverse(const iccp_order_priority *priority, uint32_t *rank,
                              size_t *n_reversed, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const size_t n = priority->mesh->n_simplices, n_sides = (priority->mesh->dim + 1) * n;
    reversal t = {.priority = priority};
    t.entered = iccp_alloc(memory, n, sizeof *t.entered);
    t.reversed = iccp_alloc(memory, n_sides, sizeof *t.reversed);
    t.inner = iccp_alloc(memory, n, sizeof *t.inner);
    t.wrong = iccp_alloc(memory, n_sides, sizeof *t.wrong);
    t.remaining = iccp_alloc(memory, n, sizeof *t.remaining);
    t.waiting = iccp_alloc(memory, n, sizeof *t.waiting);
    t.queue = iccp_alloc(memory, n, sizeof *t.queue);
    icc_status status = ICC_ERR_MEMORY;
    if (iccp_heap_create(&t.heap, n_sides, memory) && t.entered != NULL && t.reversed != NULL &&
        t.inner != NULL && t.wrong != NULL && t.remaining != NULL && t.waiting != NULL &&
        t.queue != NULL)
        status = reverse_all(&t, rank, n_reversed, env);
    iccp_heap_free(&t.heap, memory);
    iccp_free(memory, t.entered);
    iccp_free(memory, t.reversed);
    iccp_free(memory, t.inner);
    iccp_free(memory, t.wrong);
    iccp_free(memory, t.remaining);
    iccp_free(memory, t.waiting);
    iccp_free(memory, t.queue);
    return status;
}

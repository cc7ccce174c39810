/* Based on: G. M. Ziegler, Lectures on Polytopes, section 8.1, for shellings; M. Campen, C. Silva,
 * D. Zorin, Bijective Maps from Simplicial Foliations, 2016, for what they are good for.
 *
 * Growing and peeling are one procedure. Simplices go over, one by one, to a set that is the star
 * of the centre at first when growing, and the outside of the domain when peeling. A simplex T may
 * go if what it has in common with the set is nothing but its facets there: no face that lies in
 * none of them. Such faces all contain R, the corners opposite to the facets, so that R is the one
 * to ask for.
 *
 * When growing, this is the rule itself. When peeling, let U be what remains, a ball, and K the set
 * R of T: the face K is not on the boundary of U, so U without T is a ball again. The rule for the
 * way back is about the other corners, K'. The face K' lies in all facets of T on the boundary of
 * U, and its facets there are these; so the link of K' in U is a ball whose boundary is that of the
 * simplex K, with K as a member. It has no room for more: T is the only simplex of U with the face
 * K'.
 *
 * Once a face touches the set it does so for good. So a simplex that may not go need not be looked
 * at again before one of its neighbours went. */
#include "shelling/shelling_order.h"

#include "base/heap.h"
#include "base/minmax.h"
#include "shelling/element.h"

#include <assert.h>
#include <math.h>
#include <string.h>

enum { GONE = 0x80 }; /* beyond the bits of 7 corners */

static const size_t STEPS_PER_REPORT = 1 << 14;

typedef struct front {
    const iccp_order_priority *priority;
    const iccp_env *env;
    bool peeling;
    uint32_t *rank;
    uint8_t
        *facing; /* of each simplex: its corners opposite to the set; GONE: it is not to be taken
                    (again) */
    uint8_t *touched; /* whether a face belongs to the set */
    iccp_heap heap;
} front;

/* The rule of shelling/shelling_order.h, in constant time: whether the face with the corners
 * `facing` touches the set is a look at `touched`. */
static bool can_join(const front *f, size_t s)
{
    const unsigned facing = f->facing[s];
    const size_t size = iccp_set_size(facing);
    return size <= f->priority->mesh->dim &&
           (size == f->priority->mesh->dim ||
            !f->touched[iccp_face(f->priority->faces, s, facing)]);
}

/* How much the potential of a simplex differs from that of a neighbour, at most. */
static double step_of(const iccp_order_priority *priority, size_t simplex)
{
    const iccp_simplices *mesh = priority->mesh;
    const size_t first = (mesh->dim + 1) * simplex;
    double step = 0;
    for (size_t side = first; side <= first + mesh->dim; ++side)
        if (mesh->across[side] < ICCP_ON_BOUNDARY) {
            const double there = priority->potential[iccp_simplex_of(mesh, mesh->across[side])];
            step = iccp_max(step, fabs(there - priority->potential[simplex]));
        }
    return step;
}

/* The potential, and a penalty: the share of the simplex's flux that would run from smaller to
 * greater rank if it went now, times a step of the potential. */
static double key_of(const front *f, size_t s)
{
    const iccp_order_priority *w = f->priority;
    const double *flux = w->flux + (w->mesh->dim + 1) * s;
    double reversed = 0, total = 0;
    for (size_t i = 0; i <= w->mesh->dim; ++i) {
        const bool leaves = (f->facing[s] >> i & 1) != f->peeling;
        total += fabs(flux[i]);
        reversed += leaves == (flux[i] < 0) ? fabs(flux[i]) : 0;
    }
    const double potential = w->potential[s] + (w->bias != NULL ? w->bias[s] : 0);
    const double penalty = reversed > 0 ? w->beta * (reversed / total) * step_of(w, s) : 0;
    return (f->peeling ? -potential : potential) + penalty;
}

/* The set has come to another side of a simplex, which may be taken now, or has another key than
 * before. */
static void approach(front *f, size_t s, size_t corner)
{
    f->facing[s] |= (uint8_t)(1u << corner);
    if ((f->facing[s] & GONE) == 0 && can_join(f, s))
        iccp_heap_put(&f->heap, (uint32_t)s, key_of(f, s));
}

static void join_simplex(front *f, size_t s)
{
    const iccp_simplices *mesh = f->priority->mesh;
    const size_t n_sides = mesh->dim + 1, per_simplex = f->priority->faces->per_simplex;
    const uint32_t *face = f->priority->faces->number + per_simplex * s;
    uint8_t *const touched = f->touched;
    f->facing[s] |= GONE;
    for (size_t k = 0; k < per_simplex; ++k)
        touched[face[k]] = 1;
    for (size_t i = 0; i < n_sides; ++i) {
        const uint32_t across = mesh->across[n_sides * s + i];
        if (across < ICCP_ON_BOUNDARY)
            approach(f, iccp_simplex_of(mesh, across), across % n_sides);
    }
}

/* A side to the outside, with its faces. */
static void join_side(front *f, size_t s, size_t corner)
{
    const size_t dim = f->priority->mesh->dim;
    const unsigned corners = ((2u << dim) - 1) ^ 1u << corner;
    for (unsigned set = corners; set != 0; set = (set - 1) & corners)
        if (iccp_set_size(set) < dim)
            f->touched[iccp_face(f->priority->faces, s, set)] = 1;
    approach(f, s, corner);
}

/* The star of the centre has rank 0 and is not to be taken. Returns how many simplices there are
 * besides. */
static uint32_t rank_star(front *f)
{
    const iccp_simplices *mesh = f->priority->mesh;
    uint32_t n = 0;
    for (size_t s = 0; s < mesh->n_simplices; ++s) {
        const bool in_star = iccp_element_has(mesh, s, f->priority->centre);
        f->rank[s] = in_star ? 0 : UINT32_MAX;
        f->facing[s] = in_star ? GONE : 0;
        n += !in_star;
    }
    return n;
}

/* The set as it is at first. Only when it is complete can be told which simplices may go: they are
 * asked again when the queue gives them out. */
static void begin(front *f)
{
    const iccp_simplices *mesh = f->priority->mesh;
    const size_t n_sides = mesh->dim + 1;
    for (size_t s = 0; s < mesh->n_simplices; ++s) {
        if (!f->peeling && f->rank[s] == 0)
            join_simplex(f, s);
        for (size_t i = 0; i < n_sides && f->peeling; ++i)
            if (mesh->across[n_sides * s + i] >= ICCP_ON_BOUNDARY)
                join_side(f, s, i);
    }
}

/* Takes the simplex with the least key until none may go. A simplex that may not go any more
 * when its turn comes is dropped: its neighbours put it back when they go. */
static icc_status advance(front *f, uint32_t n, size_t *n_left)
{
    uint32_t n_gone = 0;
    for (size_t step = 0; f->heap.n_entries > 0; ++step) {
        if (step % STEPS_PER_REPORT == 0) {
            const icc_status status = iccp_progress(f->env, "order", (double)n_gone / (double)n);
            if (status != ICC_OK)
                return status;
        }
        const uint32_t s = iccp_heap_pop(&f->heap);
        if (!can_join(f, s))
            continue;
        f->rank[s] = f->peeling ? n - n_gone : n_gone + 1;
        ++n_gone;
        join_simplex(f, s);
    }
    *n_left = n - n_gone;
    return ICC_OK;
}

/* Growing and peeling differ in where the set starts, in the sign of the key and in the
 * direction of the ranks only. */
static icc_status find_order(const iccp_order_priority *priority, bool peeling, uint32_t *rank,
                             size_t *n_left, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    front f = {.priority = priority, .env = env, .peeling = peeling, .rank = rank};
    assert(priority->centre >= priority->mesh->n_boundary &&
           priority->centre < priority->mesh->n_points);
    f.facing = iccp_alloc(memory, priority->mesh->n_simplices, sizeof *f.facing);
    f.touched = iccp_alloc_zero(memory, priority->faces->n_faces, sizeof *f.touched);
    icc_status status = ICC_ERR_MEMORY;
    if (iccp_heap_create(&f.heap, priority->mesh->n_simplices, memory) && f.facing != NULL &&
        f.touched != NULL) {
        const uint32_t n = rank_star(&f);
        begin(&f);
        status = advance(&f, n, n_left);
    }
    iccp_heap_free(&f.heap, memory);
    iccp_free(memory, f.touched);
    iccp_free(memory, f.facing);
    return status;
}

icc_status iccp_order_grow(const iccp_order_priority *priority, uint32_t *rank, size_t *n_left,
                           const iccp_env *env)
{
    return find_order(priority, false, rank, n_left, env);
}

icc_status iccp_order_peel(const iccp_order_priority *priority, uint32_t *rank, size_t *n_left,
                           const iccp_env *env)
{
    return find_order(priority, true, rank, n_left, env);
}

/* Makes orders by growing and peeling.
 *
 * Sources: G. M. Ziegler, Lectures on Polytopes, section 8.1, for shellings. M. Campen, C. Silva,
 * D. Zorin, Bijective Maps from Simplicial Foliations, 2016, for their use.
 *
 * Growing and peeling are one procedure. Simplices pass, one by one, to a set. When growing, the
 * set is at first the star of the centre. When peeling, it is the outside of the domain. A simplex
 * T may pass if it shares with the set only facets and their faces, but no face outside these
 * facets. All faces outside them contain R, the corners opposite to the facets, so only R has to be
 * checked.
 *
 * When growing, this is the rule itself. When peeling, let U be the ball that remains, and K the
 * set R of T. The face K is not on the boundary of U, so U without T is a ball again. The rule for
 * the way back is about the other corners, K'. The face K' lies in all facets of T on the boundary
 * of U, and its facets there are these. So the link of K' in U is a ball whose boundary is that of
 * the simplex K, and K belongs to it. The link has no room for more, so T is the only simplex of U
 * with the face K'.
 *
 * A face that touches the set does so for good. So a simplex that may not pass need not be
 * checked again before one of its neighbours has passed. */
#include "shelling/shelling_order.h"

#include "base/heap.h"
#include "base/minmax.h"
#include "shelling/element.h"

#include <assert.h>
#include <math.h>
#include <string.h>

enum { GONE = 0x80 }; /* a bit beyond the bits of 7 corners */

static const size_t STEPS_PER_REPORT = 1 << 14;

typedef struct front {
    const iccp_order_priority *priority;
    const iccp_env *env;
    bool peeling;
    uint32_t *rank;
    uint8_t *facing; /* of each simplex: its corners opposite to the set; GONE: it must not be taken
                    (again) */
    uint8_t *touched; /* of each face: whether it belongs to the set */
    iccp_heap heap;
} front;

/* The rule of shelling/shelling_order.h, in constant time: `touched` tells whether the face with
 * the corners `facing` belongs to the set. */
static bool can_join(const front *f, size_t s)
{
    const unsigned facing = f->facing[s];
    const size_t size = iccp_set_size(facing);
    return size <= f->priority->mesh->dim &&
           (size == f->priority->mesh->dim ||
            !f->touched[iccp_face(f->priority->faces, s, facing)]);
}

/* The greatest difference between the potential of a simplex and that of a neighbour. */
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

/* The key of a simplex: its potential and a penalty. If the simplex passed now, a share of its
 * flux would run from smaller to greater rank. The penalty is that share times a step of the
 * potential. */
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

/* Notes that the set has reached another side of a simplex. The simplex may then become free to
 * pass, or its key may change. */
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

/* Adds a side on the domain's boundary to the set, with its faces. */
static void join_side(front *f, size_t s, size_t corner)
{
    const size_t dim = f->priority->mesh->dim;
    const unsigned corners = ((2u << dim) - 1) ^ 1u << corner;
    for (unsigned set = corners; set != 0; set = (set - 1) & corners)
        if (iccp_set_size(set) < dim)
            f->touched[iccp_face(f->priority->faces, s, set)] = 1;
    approach(f, s, corner);
}

/* Gives rank 0 to the star of the centre, whose simplices are never taken. Returns the number of
 * the other simplices. */
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

/* Fills in the initial set. Only when it is complete is it known which simplices may pass. So
 * they are checked again when the queue returns them. */
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

/* Takes the simplex with the least key until none may pass. A simplex that may no longer pass
 * when its turn comes is dropped. Its neighbours put it back when they pass. */
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

/* Growing and peeling differ only in the initial set, the sign of the key, and the direction of
 * the ranks. */
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

/* docs/theory.md, the mesh map; Newton's method itself is in map/energy/newton.c.
 *
 * Images may move, and so may points, by the energy of the inverse map: the same but for how
 * triangles count, by their area after the map. A triangle that is tiny on one side costs next to
 * nothing there, however flat it becomes on the other, down to where doubles take it for one
 * without area, which has no energy on that other side. So where triangles come near to that, their
 * corners go back. */
#include "map/compatible/descent.h"

#include "base/threads.h"
#include "map/compatible/candidate.h"
#include "map/energy/movable.h"
#include "map/energy/newton.h"

#include <math.h>
#include <string.h>

/* Half of a descent, as far as progress goes. */
static const double TYPICAL_STEPS = 8;

/* Triangles become no flatter than this. What doubles say of a triangle's area is off by so much
 * where it is some 1e-8 of the domain across. */
static const double LEAST_ROUNDNESS = 1e-8;

static icc_status go_down(iccp_newton *newton, const iccp_simplicial_map *map,
                          const iccp_descent *descent, iccp_work *work,
                          iccp_improvement *improvement, const iccp_env *env)
{
    improvement->is_converged = false;
    if (!iccp_work_fits(work, map->n_simplices))
        return ICC_OK;
    const iccp_energy first = descent->majorised > 0 ? ICCP_DIRICHLET_MAJORISED : ICCP_DIRICHLET;
    iccp_env part = iccp_round(env, 0, TYPICAL_STEPS);
    uint8_t *movable;
    icc_status status = iccp_movable_create(&movable, map, env);
    if (status == ICC_OK)
        status = iccp_newton_create(newton, map, movable, &first, &part);
    iccp_free(&env->memory, movable);
    if (status != ICC_OK)
        return status;
    double energy = iccp_newton_energy(newton, ICCP_DIRICHLET, 0);
    /* Doubles may take what is positive for flat, and no step is known then. */
    const size_t n_free = map->dim == 2 || energy < HUGE_VAL ? newton->assembly.n_free : 0;
    size_t n_slow = 0;
    for (size_t k = 0; status == ICC_OK && k < descent->iterations && n_free > 0 &&
                       iccp_work_take(work, map->n_simplices);
         ++k) {
        const iccp_energy model =
            k < descent->majorised ? ICCP_DIRICHLET_MAJORISED : ICCP_DIRICHLET;
        double slope;
        part = iccp_round(env, k + 1, TYPICAL_STEPS);
        status = iccp_progress(&part, "improve", 0);
        if (status == ICC_OK)
            status = iccp_newton_solve(newton, model, 0, &slope, &part);
        if (status != ICC_OK)
            break;
        const double after = iccp_newton_move(newton, model, 0, energy, slope);
        const double gain = energy - after;
        energy = after;
        ++improvement->n_iterations;
        if (k < descent->majorised)
            continue;
        n_slow = gain <= descent->slow * energy ? n_slow + 1 : 0;
        improvement->is_converged = gain <= descent->tolerance * energy;
        if (n_slow == (descent->is_hasty ? 1 : 2) || improvement->is_converged)
            break;
    }
    return status == ICC_ERR_SOLVER ? ICC_OK : status;
}

typedef struct ending {
    const iccp_simplicial_map *map;
    iccp_newton newton;
    double energy;
} ending;

/* To give the memory back takes about as long as to sum the energy. */
static icc_status end(void *argument, size_t k, const iccp_env *env, icc_error *err)
{
    ending *e = argument;
    (void)err;
    if (k == 0)
        e->energy = iccp_simplicial_energy_at_once(e->map, env);
    else
        iccp_newton_free(&e->newton);
    return ICC_OK;
}

/* `energy`: the map's at the end; NULL if nobody asks. */
static icc_status improve(const iccp_simplicial_map *map, const iccp_descent *descent,
                          iccp_work *work, iccp_improvement *improvement, double *energy,
                          const iccp_env *env)
{
    ending e = {.map = map, .newton.assembly.memory = env->memory};
    iccp_env quiet = *env;
    quiet.progress = NULL;
    const icc_status status = go_down(&e.newton, map, descent, work, improvement, env);
    if (energy == NULL)
        iccp_newton_free(&e.newton);
    else
        (void)iccp_side_by_side(&quiet, 2, end, &e, NULL);
    if (energy != NULL)
        *energy = e.energy;
    return status;
}

icc_status iccp_improve_images(const iccp_simplicial_map *map, const iccp_descent *descent,
                               iccp_work *work, iccp_improvement *improvement, const iccp_env *env)
{
    iccp_improvement ignored = {0};
    return improvement != NULL ? improve(map, descent, work, improvement, &improvement->energy, env)
                               : improve(map, descent, work, &ignored, NULL, env);
}

/* ---- both sides ---- */

typedef struct retreat {
    iccp_plmap *map;
    double *before; /* the images that were, */
    uint8_t *back;  /* of each vertex: that it has it again */
} retreat;

static double roundness_of(const double *places, const uint32_t *v)
{
    return iccp_roundness(places + 2 * (size_t)v[0], places + 2 * (size_t)v[1],
                          places + 2 * (size_t)v[2]);
}

/* Whether the image of a triangle is too flat, and flatter than it was; or what doubles make of it
 * on one side or the other has no area or no energy. */
static bool is_spoilt(const retreat *r, uint32_t triangle)
{
    const uint32_t *v = r->map->corners.vertex + 3 * (size_t)triangle;
    if (!iccp_plmap_positive_image(r->map, triangle) ||
        roundness_of(r->map->images, v) < iccp_min(LEAST_ROUNDNESS, roundness_of(r->before, v)))
        return true;
    return !iccp_candidate_is_sound(r->map, v[0], v[1], v[2]);
}

/* Gives the corners of a triangle the images that they had; false when they all have them. */
static bool send_back(const retreat *r, uint32_t triangle)
{
    bool any = false;
    for (size_t k = 0; k < 3; ++k) {
        const size_t v = r->map->corners.vertex[3 * (size_t)triangle + k];
        any |= !r->back[v];
        r->back[v] = 1;
        memcpy(r->map->images + 2 * v, r->before + 2 * v, 2 * sizeof *r->before);
    }
    return any;
}

/* Where corners go back their neighbours may become flat: again, until nothing changes. Each round
 * but the last sends a vertex back for good. */
static void send_back_spoilt(const retreat *r, double energy_before)
{
    const size_t n = r->map->n_vertices;
    bool any = true, ever = false;
    memset(r->back, 0, n);
    while (any) {
        any = false;
        for (uint32_t t = 0; t < r->map->corners.n_triangles; ++t)
            if (is_spoilt(r, t) && send_back(r, t))
                any = ever = true;
    }
    if (ever && !(iccp_plmap_energy(r->map) <= energy_before))
        memcpy(r->map->images, r->before, 2 * n * sizeof *r->before);
}

icc_status iccp_improve_both_sides(iccp_plmap *map, const iccp_descent *descent, iccp_work *work,
                                   iccp_improvement *improvement, const iccp_env *env)
{
    const size_t n = map->n_vertices;
    retreat r = {map, iccp_alloc(&env->memory, n, 2 * sizeof *r.before),
                 iccp_alloc(&env->memory, n, sizeof *r.back)};
    icc_status status = r.before != NULL && r.back != NULL ? ICC_OK : ICC_ERR_MEMORY;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 1}, env);
    for (int side = 0; side < 2; ++side) {
        const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
        if (status == ICC_OK) {
            const double energy = iccp_simplicial_energy_at_once(&simplicial, env);
            memcpy(r.before, map->images, 2 * n * sizeof *r.before);
            status = improve(&simplicial, descent, work, improvement, NULL, &part[side]);
            send_back_spoilt(&r, energy);
        }
        iccp_plmap_swap(map);
    }
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
    improvement->energy = iccp_simplicial_energy_at_once(&simplicial, env);
    iccp_free(&env->memory, r.before);
    iccp_free(&env->memory, r.back);
    return status;
}

/* docs/theory.md, the mesh map; energies and their derivatives: map/energy/dirichlet.c. */
#include "map/compatible/improve.h"

#include "base/minmax.h"
#include "base/sort.h"
#include "base/threads.h"
#include "map/compatible/flips.h"
#include "map/energy/dirichlet.h"
#include "math/vec.h"

#include <math.h>

/* First steps with SLIM's model, which gets far from a bad start; then Newton's, which
 * converges. */
enum { MAJORISED_STEPS = 3 };

/* Half of all descents, as far as progress goes. */
static const double TYPICAL_LEVELS = 2;

/* A refinement cuts the triangles that carry this share of the energy above an isometry's, but no
 * more than this share of all. */
static const double EXCESS_SHARE = 0.7, MOST_CUT = 0.2;

/* Before the first step, only if they are no more than this share. */
static const double VERY_FEW = 0.002;

/* It multiplies the triangles by about GROWTH, and is made where there is work for so many STEPS on
 * what comes of it. */
static const double GROWTH = 1.4, STEPS = 6;

/* Steps on all meshes but the last end when two in turn gain less than this, and after so many: a
 * refinement gains more. */
static const double SLOW = 5e-3;
enum { MOST_STEPS = 20 };

/* Triangles that a thread ranks at once. */
enum { GRAIN = 1024 };

/* A refinement is in vain when it gains less than this. The first one is the last, or the second in
 * turn where the energy is HIGH: what is locked there may take two cuts to come free. */
static const double LEAST_GAIN = 0.01, HIGH = 20;

/* Where a map that was relaxed is as good as this, a refinement in vain can be told beforehand. */
static const double NEAR = 5;

/* ---- in the plane ---- */

static size_t count(const void *map)
{
    const iccp_plmap *pl = map;
    return pl->corners.n_triangles;
}

static double energy_of(const void *map, const iccp_env *env)
{
    (void)env;
    return iccp_plmap_energy(map);
}

static icc_status descend(void *map, const iccp_descent *descent, bool both_sides, iccp_work *work,
                          iccp_improvement *improvement, const iccp_env *env)
{
    if (both_sides)
        return iccp_improve_both_sides(map, descent, work, improvement, env);
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
    return iccp_improve_images(&simplicial, descent, work, improvement, env);
}

typedef struct ranked {
    double excess;
    uint32_t triangle;
} ranked;

static int by_excess(const void *a, const void *b)
{
    const ranked *p = a, *q = b;
    if (p->excess < q->excess || p->excess > q->excess)
        return p->excess > q->excess ? 1 : -1;
    return (p->triangle < q->triangle) - (p->triangle > q->triangle);
}

/* The corner that faces the edge which is longest, before and after the map taken together. */
static uint32_t longest_edge(const iccp_plmap *map, uint32_t triangle)
{
    uint32_t best = 3 * triangle;
    double length = -1;
    for (uint32_t c = 3 * triangle; c < 3 * triangle + 3; ++c) {
        const uint32_t a = iccp_after(c), b = iccp_before(c);
        const double own =
            map->stretch * map->stretch *
                iccp_vec_distance2(2, iccp_plmap_point(map, a), iccp_plmap_point(map, b)) +
            iccp_vec_distance2(2, iccp_plmap_image(map, a), iccp_plmap_image(map, b));
        if (own > length) {
            length = own;
            best = c;
        }
    }
    return best;
}

typedef struct ranking {
    iccp_simplicial_map map;
    ranked *list;
} ranking;

static icc_status rank(void *argument, size_t begin, size_t end)
{
    const ranking *r = argument;
    for (size_t t = begin; t < end; ++t) {
        const double *image[3];
        double element[ICCP_ELEMENT(2)];
        iccp_simplicial_images(2, &r->map, t, image);
        iccp_simplicial_element(&r->map, t, element);
        r->list[t] =
            (ranked){iccp_dirichlet_energy(2, element, image) - 4 * element[0], (uint32_t)t};
    }
    return ICC_OK;
}

/* Cuts the triangles that carry EXCESS_SHARE, the one with most first: `most` of them at most, or
 * none if those are more and it is all or nothing. A heap is enough: they are few. */
static icc_status cut_worst(iccp_plmap *map, double most, bool all_or_nothing, size_t *n_cut,
                            const iccp_env *env)
{
    const size_t n = map->corners.n_triangles;
    iccp_env quiet = *env;
    ranking r = {iccp_plmap_simplicial(map), iccp_alloc(&env->memory, n, sizeof(ranked))};
    double excess = 0, reached = 0;
    quiet.progress = NULL;
    *n_cut = 0;
    if (r.list == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = iccp_for_chunks(&quiet, "improve", n, GRAIN, rank, &r);
    for (size_t t = 0; t < n; ++t)
        excess += r.list[t].excess;
    iccp_sort_begin(r.list, n, sizeof(ranked), by_excess);
    size_t left = n;
    for (; left > 0 && (double)(n - left) < most && reached < EXCESS_SHARE * excess; --left) {
        reached += r.list[0].excess;
        iccp_sort_next(r.list, left, sizeof(ranked), by_excess);
    }
    if (all_or_nothing && reached < EXCESS_SHARE * excess)
        left = n;
    for (size_t k = n; status == ICC_OK && k-- > left;) {
        bool done;
        status = iccp_plmap_cut(map, longest_edge(map, r.list[k].triangle), &done);
        *n_cut += status == ICC_OK && done;
    }
    iccp_free(&env->memory, r.list);
    return status;
}

icc_status iccp_refine(iccp_plmap *map, size_t *n_cut, const iccp_env *env)
{
    return cut_worst(map, MOST_CUT * (double)map->corners.n_triangles, false, n_cut, env);
}

static icc_status refine_and_flip(void *map, size_t *n_cut, const iccp_env *env)
{
    size_t n_flips;
    const icc_status status = iccp_refine(map, n_cut, env);
    return status == ICC_OK && *n_cut > 0 ? iccp_flip_edges(map, &n_flips, env) : status;
}

/* Where very few triangles have most of the energy, no step gets far before the first of them
 * flips, and all others wait for it. */
static icc_status unlock(iccp_plmap *map, const iccp_env *env)
{
    size_t n_cut, n_flips;
    if (!(iccp_plmap_energy(map) > HIGH))
        return ICC_OK;
    const double few = VERY_FEW * (double)map->corners.n_triangles;
    const icc_status status = cut_worst(map, few, true, &n_cut, env);
    return status == ICC_OK && n_cut > 0 ? iccp_flip_edges(map, &n_flips, env) : status;
}

icc_status iccp_improve(iccp_plmap *map, const iccp_schedule *schedule, iccp_work *work,
                        iccp_improvement *improvement, const iccp_env *env)
{
    static const iccp_profile PLANE = {.majorised = MAJORISED_STEPS,
                                       .least_gain = LEAST_GAIN,
                                       .count = count,
                                       .energy = energy_of,
                                       .descend = descend,
                                       .refine = refine_and_flip};
    const bool starts = schedule->levels > 0 && !schedule->is_relaxed;
    const icc_status status = starts ? unlock(map, env) : ICC_OK;
    return status == ICC_OK ? iccp_improve_by(&PLANE, map, schedule, work, improvement, env)
                            : status;
}

/* ---- in either ---- */

static bool may_refine(double n_simplices, const iccp_schedule *schedule, const iccp_work *work,
                       const iccp_improvement *improvement)
{
    const double n = GROWTH * n_simplices;
    return improvement->n_levels < schedule->levels && n <= schedule->most &&
           STEPS * n <= work->left;
}

/* Whether the next refinement of a map NEAR an isometry is in vain, as its gain falls short of the
 * last one's by the same share as that of the one before. */
static bool is_settled(double energy, double least_gain, double gain, double gain_before)
{
    return energy < NEAR && gain < gain_before && gain * gain < least_gain * gain_before;
}

/* Refinements, with steps after each, as long as they pay. */
static icc_status refine_often(const iccp_profile *profile, void *map,
                               const iccp_schedule *schedule, double slow, iccp_work *work,
                               iccp_improvement *improvement, const iccp_env *env)
{
    const size_t most = schedule->iterations < MOST_STEPS ? schedule->iterations : MOST_STEPS;
    const iccp_descent descent = {0, most, schedule->tolerance, slow, schedule->is_relaxed};
    size_t n_in_vain = 0;
    double gain_before = 0;
    icc_status status = ICC_OK;
    while (status == ICC_OK && n_in_vain <= (improvement->energy > HIGH) &&
           may_refine((double)profile->count(map), schedule, work, improvement)) {
        const double before = improvement->energy;
        const iccp_env part = iccp_round(env, improvement->n_levels, TYPICAL_LEVELS);
        size_t n_changes;
        status = profile->refine(map, &n_changes, env);
        if (status != ICC_OK || n_changes == 0)
            break;
        status = profile->descend(map, &descent, schedule->both_sides, work, improvement, &part);
        ++improvement->n_levels;
        const double gain = (before - improvement->energy) / before;
        n_in_vain = gain < profile->least_gain ? n_in_vain + 1 : 0;
        if (status == ICC_OK && schedule->is_relaxed &&
            is_settled(improvement->energy, profile->least_gain, gain, gain_before)) {
            improvement->is_converged = true;
            break;
        }
        gain_before = gain;
    }
    return status;
}

icc_status iccp_improve_by(const iccp_profile *profile, void *map, const iccp_schedule *schedule,
                           iccp_work *work, iccp_improvement *improvement, const iccp_env *env)
{
    const double slow = iccp_max(SLOW, schedule->tolerance);
    const iccp_descent last = {0, schedule->iterations, schedule->tolerance, 0, false};
    iccp_descent first = {profile->majorised, schedule->iterations, schedule->tolerance, slow,
                          false};
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){2, 2, 1}, env);
    *improvement = (iccp_improvement){0};
    if (schedule->levels == 0)
        first.slow = 0;
    icc_status status = ICC_OK;
    if (schedule->is_relaxed && schedule->levels > 0)
        improvement->energy = profile->energy(map, env);
    else
        status = profile->descend(map, &first, schedule->both_sides, work, improvement, &part[0]);
    if (status == ICC_OK && schedule->levels > 0)
        status = refine_often(profile, map, schedule, slow, work, improvement, &part[1]);
    if (status == ICC_OK && schedule->levels > 0 && !improvement->is_converged)
        status = profile->descend(map, &last, false, work, improvement, &part[2]);
    return status;
}

/* Improves a plane map (docs/theory/plane-maps.md). map/energy/refinement.c decides when to take
 * steps and when to refine. This file cuts the triangles that have most of the energy, and in the
 * end merges the vertices that are not worth their triangles. */
#include "map/compatible/improve.h"

#include "base/minmax.h"
#include "base/sort.h"
#include "base/threads.h"
#include "domain/network.h"
#include "map/compatible/coarsen.h"
#include "map/compatible/flips.h"
#include "map/compatible/points_and_images.h"
#include "map/compatible/triangle_quality.h"
#include "map/energy/dirichlet.h"
#include "math/vec.h"

#include <math.h>

/* The first steps use SLIM's model, which gets far from a bad start. Later steps use the true
 * Hessian, which converges. */
enum { MAJORISED_STEPS = 3 };

/* A refinement cuts the triangles that carry EXCESS_SHARE of the energy above an isometry's, but at
 * most MOST_CUT of all triangles. */
static const double EXCESS_SHARE = 0.7, MOST_CUT = 0.2;

/* unlock() cuts them before the first step, but only if they are at most this share of all. */
static const double VERY_FEW = 0.002;

/* A refinement that gains less than this share was in vain. */
static const double LEAST_GAIN = 0.01;

/* Triangles in a chunk for one thread. */
enum { GRAIN = 1024 };

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

static icc_status descend(void *map, const iccp_descent *descent, bool moves_points,
                          iccp_newton *newton, iccp_work *work, iccp_improvement *improvement,
                          const iccp_env *env)
{
    if (moves_points) {
        iccp_newton_free(newton);
        return iccp_improve_points_and_images(map, descent, work, improvement, env);
    }
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
    return iccp_improve_images(&simplicial, descent, newton, work, improvement, env);
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

/* Returns the corner that faces the longest edge, by the sum of the squared lengths before and
 * after the map. */
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

/* Cuts the triangles that carry EXCESS_SHARE, the one with most first, but at most `most` of them.
 * With `all_or_nothing` it cuts none if there are more. They are few, so a heap sorts them. */
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
    if (status == ICC_OK)
        status = iccp_plmap_expect_cuts(map, n - left);
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

/* Cuts the triangles with most of the energy if they are very few. No step would get far before the
 * first of them flips, and all others would wait for it. */
static icc_status unlock(iccp_plmap *map, const iccp_env *env)
{
    size_t n_cut, n_flips;
    const double few = VERY_FEW * (double)map->corners.n_triangles;
    const icc_status status = cut_worst(map, few, true, &n_cut, env);
    return status == ICC_OK && n_cut > 0 ? iccp_flip_edges(map, &n_flips, env) : status;
}

/* ---- vertices that are not worth their triangles ---- */

/* Returns the energy that a vertex must save to stay. A refinement that is not in vain gains at
 * least LEAST_GAIN with cuts of up to MOST_CUT of the triangles. This is the gain of one such
 * cut. */
static double least_worth(const iccp_plmap *map)
{
    const uint32_t *v = map->corners.vertex;
    iccp_quality all = iccp_no_quality();
    for (size_t t = 0; t < map->corners.n_triangles; ++t)
        iccp_quality_add(&all, map, v[3 * t], v[3 * t + 1], v[3 * t + 2]);
    return LEAST_GAIN * all.energy / (MOST_CUT * (double)map->corners.n_triangles);
}

/* Merges vertices that save less, and takes steps on the mesh that is left. */
static icc_status merge_and_descend(iccp_plmap *map, const iccp_schedule *schedule, iccp_work *work,
                                    iccp_improvement *improvement, size_t *n_gone,
                                    const iccp_env *env)
{
    const iccp_descent descent = {0, schedule->iterations, schedule->tolerance, 0, false};
    iccp_newton newton = {.assembly.memory = env->memory};
    size_t n_flips;
    icc_status status = iccp_coarsen_worthless(map, least_worth(map), n_gone, env);
    if (status == ICC_OK && *n_gone > 0)
        status = iccp_flip_edges(map, &n_flips, env);
    if (status == ICC_OK && *n_gone > 0)
        status = descend(map, &descent, schedule->moves_points, &newton, work, improvement, env);
    iccp_newton_free(&newton);
    return status;
}

/* Merges vertices in rounds, until a round merges less than a share of LEAST_GAIN of them. A round
 * that fails, or after which the energy is above `most`, is undone and is the last one. */
static icc_status thin_out(iccp_plmap *map, const iccp_schedule *schedule, double most,
                           iccp_work *work, iccp_improvement *improvement, const iccp_env *env)
{
    icc_status status = ICC_OK;
    for (bool goes_on = true; status == ICC_OK && goes_on;) {
        const double energy = improvement->energy, n = (double)map->n_vertices;
        size_t n_gone = 0;
        iccp_plmap before;
        status = iccp_plmap_copy(&before, map, &map->memory);
        if (status != ICC_OK)
            break;
        before.plan = map->plan;
        status = merge_and_descend(map, schedule, work, improvement, &n_gone, env);
        goes_on = (double)n_gone >= LEAST_GAIN * n;
        if (status != ICC_OK || !(improvement->energy <= most)) {
            const iccp_plmap worse = *map;
            *map = before;
            before = worse;
            improvement->energy = energy;
            goes_on = false;
        }
        iccp_plmap_free(&before);
    }
    return status;
}

/* Whether three or more sides of a network meet somewhere. */
static bool has_junctions(const iccp_plmap *map)
{
    return map->featured != NULL && iccp_network_of(map->featured)->n_junctions > 0;
}

icc_status iccp_improve(iccp_plmap *map, double energy, const iccp_schedule *schedule,
                        iccp_work *work, iccp_improvement *improvement, const iccp_env *env)
{
    static const iccp_profile PLANE = {.majorised = MAJORISED_STEPS,
                                       .least_gain = LEAST_GAIN,
                                       .count = count,
                                       .energy = energy_of,
                                       .descend = descend,
                                       .refine = refine_and_flip};
    const bool starts = schedule->levels > 0 && !schedule->is_relaxed;
    icc_status status = starts && energy > ICCP_HIGH_ENERGY ? unlock(map, env) : ICC_OK;
    if (status == ICC_OK)
        status = iccp_improve_by(&PLANE, map, schedule, work, improvement, env);
    if (status == ICC_OK && schedule->levels > 0 && has_junctions(map))
        status = thin_out(map, schedule, iccp_min((1 + LEAST_GAIN) * improvement->energy, energy),
                          work, improvement, env);
    return status;
}

#include "map/plane/fit.h"

#include "base/clock.h"
#include "base/minmax.h"

/* Defaults of icc_improve_options. */
static const double TOLERANCE = 1e-4;
enum { ITERATIONS = 60, LEVELS = 16 };

/* Refinements left to us stop at so many times the triangles of the start, or of a SMALL one. */
static const double MOST_GROWTH = 4, SMALL = 8000;

/* What improvement left to us may cost, in steps times triangles: so much, and so much for each
 * facet. And as a share of that, relaxing an overlay. */
static const double WORK = 3e5, WORK_PER_FACET = 300, RELAXING_SHARE = 0.5;

/* And what all of them together may cost, with what an overlay costs before the first step: as
 * little as it takes to stay within the time that icc_map_create() names. */
static const double ALL_WORK = 1.6e6, ALL_PER_FACET = 225;

iccp_allowance iccp_allow(size_t n_facets)
{
    const double work = WORK + WORK_PER_FACET * (double)n_facets;
    return (iccp_allowance){.search.left = work,
                            .overlay.left = HUGE_VAL,
                            .improvement.left = work,
                            .relaxing = RELAXING_SHARE * work,
                            .all = ALL_WORK + ALL_PER_FACET * (double)n_facets};
}

double iccp_spent(const iccp_allowance *work)
{
    return work->search.spent + work->overlay.spent + work->improvement.spent;
}

iccp_work *iccp_bound(iccp_work *part, const iccp_allowance *work)
{
    part->left = iccp_min(part->left, iccp_max(0, work->all - iccp_spent(work)));
    return part;
}

const iccp_schedule iccp_fit_plain = {0}, iccp_fit_relaxed = {.is_relaxed = true},
                    iccp_fit_both_sides = {.both_sides = true, .is_relaxed = true};

iccp_schedule iccp_fit_schedule(const icc_improve_options *options, const iccp_schedule *how,
                                double most)
{
    return (iccp_schedule){.iterations =
                               options->iterations > 0 ? (size_t)options->iterations : ITERATIONS,
                           .tolerance = options->tolerance > 0 ? options->tolerance : TOLERANCE,
                           .levels = options->levels < 0    ? 0
                                     : options->levels == 0 ? LEVELS
                                                            : (size_t)options->levels,
                           .most = most,
                           .both_sides = how->both_sides,
                           .is_relaxed = how->is_relaxed};
}

iccp_work iccp_fit_work(const icc_improve_options *options, size_t n_facets)
{
    const bool is_free = options->iterations > 0 || options->levels != 0 || options->tolerance > 0;
    return is_free ? iccp_work_unlimited() : iccp_allow(n_facets).improvement;
}

double iccp_fit_most(const iccp_work *work, size_t n_simplices)
{
    return work->left < HUGE_VAL ? MOST_GROWTH * iccp_max(SMALL, (double)n_simplices) : HUGE_VAL;
}

icc_status iccp_fit_improve(iccp_plmap *pl, const icc_improve_options *options,
                            const iccp_schedule *how, iccp_work *work, bool *cancelled,
                            iccp_improvement *improvement, const iccp_env *env)
{
    const iccp_schedule schedule =
        iccp_fit_schedule(options, how, iccp_fit_most(work, pl->corners.n_triangles));
    const iccp_env part = iccp_part(env, "improve", 0, 1);
    const icc_status status = iccp_improve(pl, &schedule, work, improvement, &part);
    *cancelled = status == ICC_ERR_CANCELLED;
    return *cancelled ? ICC_OK : status;
}

icc_status iccp_fit_complete(iccp_mesh_map *map, const icc_improve_options *options,
                             const iccp_schedule *how, iccp_work *work, icc_map_info *info,
                             const iccp_env *env)
{
    const double begin = iccp_seconds();
    icc_status status = ICC_OK;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){4, 1}, env);
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(&map->pl);
    info->energy_start = info->energy = iccp_simplicial_energy_at_once(&simplicial, env);
    if (options->iterations >= 0) {
        iccp_improvement improvement;
        bool cancelled;
        status = iccp_fit_improve(&map->pl, options, how, work, &cancelled, &improvement, &part[0]);
        if (status == ICC_OK && cancelled)
            status = ICC_ERR_CANCELLED;
        info->energy = improvement.energy;
        info->n_iterations = improvement.n_iterations;
        info->n_levels = (int32_t)improvement.n_levels;
    }
    info->seconds_improve = iccp_seconds() - begin;
    return status == ICC_OK ? iccp_mesh_map_finish(map, info, &part[1]) : status;
}

void iccp_fit_keep_plan(iccp_mesh_map *map, iccp_newton_plan *plan)
{
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(&map->pl);
    map->pl.plan = NULL;
    if (plan != NULL && iccp_newton_plan_fits(plan, &simplicial))
        (void)iccp_once_keep(&map->plan, iccp_newton_plan_retain(plan));
}

/* Improves a mesh map in the plane within its allowance (docs/theory/plane-maps.md). */
#include "map/plane/plane_improve.h"

#include "base/clock.h"
#include "base/minmax.h"

icc_status iccp_plane_improve(iccp_plmap *pl, double energy, const icc_improve_options *options,
                              const iccp_schedule *how, iccp_work *work, bool *cancelled,
                              iccp_improvement *improvement, const iccp_env *env)
{
    const iccp_schedule schedule =
        iccp_schedule_of(options, how, iccp_schedule_most(work, pl->corners.n_triangles));
    const iccp_env part = iccp_part(env, "improve", 0, 1);
    const icc_status status = iccp_improve(pl, energy, &schedule, work, improvement, &part);
    *cancelled = status == ICC_ERR_CANCELLED;
    return *cancelled ? ICC_OK : status;
}

icc_status iccp_plane_complete(iccp_mesh_map *map, const icc_improve_options *options,
                               const iccp_schedule *how, iccp_work *work, iccp_map_facts *info,
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
        status = iccp_plane_improve(&map->pl, info->energy_start, options, how, work, &cancelled,
                                    &improvement, &part[0]);
        if (status == ICC_OK && cancelled)
            status = ICC_ERR_CANCELLED;
        info->energy = improvement.energy;
        info->n_iterations = improvement.n_iterations;
        info->n_levels = (int32_t)improvement.n_levels;
    }
    info->seconds_improve = iccp_seconds() - begin;
    return status == ICC_OK ? iccp_mesh_map_finish(map, info, &part[1]) : status;
}

void iccp_plane_keep_plan(iccp_mesh_map *map, iccp_newton_plan *plan, const iccp_plmap *mesh)
{
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(mesh);
    map->pl.plan = NULL;
    if (plan != NULL && iccp_newton_plan_fits(plan, &simplicial))
        (void)iccp_once_keep(&map->plan, iccp_newton_plan_retain(plan));
}

icc_status iccp_mesh_map_improve(iccp_mesh_map **out, const iccp_mesh_map *map, size_t n_facets,
                                 const icc_improve_options *options, icc_improve_report *report,
                                 const iccp_env *env)
{
    iccp_mesh_map *better = iccp_alloc_zero(&env->memory, 1, sizeof *better);
    *out = NULL;
    if (better == NULL)
        return ICC_ERR_MEMORY;
    memcpy(better->reach, map->reach, sizeof better->reach);
    iccp_work work = iccp_schedule_work(options, n_facets);
    iccp_improvement improvement = {0};
    bool cancelled = false;
    iccp_map_facts info = {0};
    report->energy_start = iccp_plmap_energy(&map->pl);
    icc_status status = iccp_plmap_copy(&better->pl, &map->pl, &env->memory);
    if (status == ICC_OK)
        status = iccp_plane_improve(&better->pl, report->energy_start, options,
                                    &iccp_schedule_plain, &work, &cancelled, &improvement, env);
    const iccp_env quiet = iccp_quiet(env);
    if (status == ICC_OK)
        status = iccp_mesh_map_finish(better, &info, &quiet);
    if (status != ICC_OK) {
        iccp_mesh_map_free(better, &env->memory);
        return status;
    }
    better->work = work.spent;
    report->energy = improvement.energy;
    report->n_iterations = improvement.n_iterations;
    report->n_simplices = info.n_simplices;
    report->n_levels = (int32_t)improvement.n_levels;
    report->cancelled = cancelled;
    *out = better;
    return ICC_OK;
}

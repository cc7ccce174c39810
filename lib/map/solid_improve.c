/* docs/theory.md, the mesh map in space. */
#include "map/solid_improve.h"

static icc_status descend(iccp_solid_map *map, const iccp_descent *descent, iccp_work *work,
                          iccp_improvement *improvement, const iccp_env *env)
{
    const iccp_simplicial_map simplicial = iccp_solid_simplicial(map);
    const icc_status status = iccp_improve_images(&simplicial, descent, work, improvement, env);
    improvement->energy = iccp_simplicial_energy_at_once(&simplicial, env);
    return status;
}

icc_status iccp_solid_improve(iccp_solid_map *map, const icc_domain *source,
                              const iccp_schedule *schedule, iccp_work *work,
                              iccp_improvement *improvement, const iccp_env *env)
{
    const iccp_descent descent = {0, schedule->iterations, schedule->tolerance, 0, false};
    (void)source;
    *improvement = (iccp_improvement){0};
    return descend(map, &descent, work, improvement, env);
}

/* Improves a map on finer and finer meshes, in the plane and in space (docs/theory/plane-maps.md).
 * The energy falls by steps on one mesh (descent.h). When these gain little, the mesh is refined
 * where most of the energy is. It ends when refinements gain little, too. */
#include "map/energy/refinement.h"

#include "base/minmax.h"

#include <math.h>

/* Reports of progress take this many levels for half of them. */
static const double TYPICAL_LEVELS = 2;

/* A refinement multiplies the simplices by about GROWTH. It is made if there is work for so many
 * STEPS afterwards. */
static const double GROWTH = 1.4, STEPS = 6;

/* On all meshes but the last, steps end when two in turn gain less than SLOW, and after MOST_STEPS.
 * A refinement gains more. */
static const double SLOW = 5e-3;
enum { MOST_STEPS = 20 };

/* For a relaxed map with less energy than this, has_converged() predicts the next gain. */
static const double NEAR = 5;

static bool may_refine(double n_simplices, const iccp_schedule *schedule, const iccp_work *work,
                       const iccp_improvement *improvement)
{
    const double n = GROWTH * n_simplices;
    return improvement->n_levels < schedule->levels && n <= schedule->most &&
           STEPS * n <= work->left;
}

/* Whether the next refinement of a map NEAR an isometry will gain too little. Gains are taken to
 * fall by the same factor each time, so the next one is gain^2 / gain_before. */
static bool has_converged(double energy, double least_gain, double gain, double gain_before)
{
    return energy < NEAR && gain < gain_before && gain * gain < least_gain * gain_before;
}

/* Refines the mesh and takes steps, again and again, as long as that pays. */
static icc_status refine_often(const iccp_profile *profile, void *map,
                               const iccp_schedule *schedule, double slow, iccp_newton *newton,
                               iccp_work *work, iccp_improvement *improvement, const iccp_env *env)
{
    const size_t most = schedule->iterations < MOST_STEPS ? schedule->iterations : MOST_STEPS;
    const iccp_descent descent = {0, most, schedule->tolerance, slow, schedule->is_relaxed};
    size_t n_in_vain = 0;
    double gain_before = 0;
    icc_status status = ICC_OK;
    while (status == ICC_OK && n_in_vain <= (improvement->energy > ICCP_HIGH_ENERGY) &&
           may_refine((double)profile->count(map), schedule, work, improvement)) {
        const double before = improvement->energy;
        const iccp_env part = iccp_round(env, improvement->n_levels, TYPICAL_LEVELS);
        size_t n_changes;
        iccp_newton_free(newton);
        status = profile->refine(map, &n_changes, env);
        if (status != ICC_OK || n_changes == 0)
            break;
        status = profile->descend(map, &descent, schedule->moves_points, newton, work, improvement,
                                  &part);
        ++improvement->n_levels;
        const double gain = (before - improvement->energy) / before;
        n_in_vain = gain < profile->least_gain ? n_in_vain + 1 : 0;
        if (status == ICC_OK && schedule->is_relaxed &&
            has_converged(improvement->energy, profile->least_gain, gain, gain_before)) {
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
    iccp_newton newton = {.assembly.memory = env->memory};
    iccp_split(part, 3, (const double[]){2, 2, 1}, env);
    *improvement = (iccp_improvement){0};
    if (schedule->levels == 0)
        first.slow = 0;
    icc_status status = ICC_OK;
    if (schedule->is_relaxed && schedule->levels > 0)
        improvement->energy = profile->energy(map, env);
    else
        status = profile->descend(map, &first, schedule->moves_points, &newton, work, improvement,
                                  &part[0]);
    if (status == ICC_OK && schedule->levels > 0)
        status = refine_often(profile, map, schedule, slow, &newton, work, improvement, &part[1]);
    if (status == ICC_OK && schedule->levels > 0 && !improvement->is_converged)
        status = profile->descend(map, &last, false, &newton, work, improvement, &part[2]);
    iccp_newton_free(&newton);
    return status;
}

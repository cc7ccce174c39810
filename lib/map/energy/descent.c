/* Lowers the energy by Newton steps on one mesh (docs/theory/plane-maps.md). newton.c makes one
 * step. */
#include "map/energy/descent.h"

#include "map/energy/movable.h"

#include <math.h>

/* Reports of progress take this many steps for half of them. */
static const double TYPICAL_STEPS = 8;

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
        status = iccp_newton_prepare(newton, map, movable, &first, &part);
    iccp_free(&env->memory, movable);
    if (status != ICC_OK)
        return status;
    double energy = iccp_newton_energy(newton, ICCP_DIRICHLET, 0);
    /* A simplex that is exactly positive may have no volume in doubles. Then there is no step. */
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

icc_status iccp_take_steps(const iccp_simplicial_map *map, const iccp_descent *descent,
                           iccp_work *work, iccp_improvement *improvement, const iccp_env *env)
{
    iccp_newton newton = {.assembly.memory = env->memory};
    iccp_improvement ignored = {0};
    const icc_status status =
        go_down(&newton, map, descent, work, improvement != NULL ? improvement : &ignored, env);
    iccp_newton_free(&newton);
    return status;
}

icc_status iccp_improve_images(const iccp_simplicial_map *map, const iccp_descent *descent,
                               iccp_newton *newton, iccp_work *work, iccp_improvement *improvement,
                               const iccp_env *env)
{
    const icc_status status = go_down(newton, map, descent, work, improvement, env);
    improvement->energy = iccp_simplicial_energy_at_once(map, env);
    return status;
}

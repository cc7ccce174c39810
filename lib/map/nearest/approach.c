/* Moves a one-to-one plane map towards a model by Newton's method. The energy is that of Newton's
 * steps near a model (map/energy/model.h). */
#include "map/nearest/approach.h"

#include "map/energy/newton.h"

/* The pull of the model. It becomes stronger in stages, because from a start that is far away,
 * steps with the last pull end soon before triangles that are about to flip. With 1 / PULL from
 * 1e-7 to 1e-3, errors of the result change by a thousandth, and the least determinant from 4e-4 to
 * 0.17. */
enum { STAGES = 3 };
static const double PULL[STAGES] = {1e2, 1e3, 1e4};

/* The steps of a stage end when one gains no more than this share of the energy. */
static const double LEAST_GAIN[STAGES] = {1e-2, 1e-2, 1e-3};

/* STEPS: the most in a stage. TYPICAL_STEPS: half of the progress. */
static const size_t STEPS[STAGES] = {4, 4, 20};
enum { TYPICAL_STEPS = 8 };

/* Takes the steps of a stage. *n_steps counts those of all stages. */
static icc_status take_steps(iccp_newton *newton, int stage, size_t *n_steps, const iccp_env *env)
{
    newton->map.pull = PULL[stage];
    double energy = iccp_newton_energy(newton, ICCP_DIRICHLET, 0);
    icc_status status = ICC_OK;
    for (size_t k = 0; k < STEPS[stage] && newton->assembly.n_free > 0; ++k) {
        const iccp_env part = iccp_round(env, *n_steps, TYPICAL_STEPS);
        double slope;
        status = iccp_progress(&part, "improve", 0);
        if (status == ICC_OK)
            status = iccp_newton_solve(newton, ICCP_DIRICHLET, 0, &slope, &part);
        if (status != ICC_OK)
            break;
        const double after = iccp_newton_move(newton, ICCP_DIRICHLET, 0, energy, slope);
        const double gain = energy - after;
        energy = after;
        ++*n_steps;
        if (gain <= LEAST_GAIN[stage] * energy)
            break;
    }
    return status;
}

icc_status iccp_approach(const iccp_simplicial_map *map, const uint8_t *movable, bool is_far,
                         size_t *n_iterations, const iccp_env *env)
{
    iccp_newton newton;
    const int begin = is_far ? 0 : STAGES - 1;
    size_t n_steps = 0;
    icc_status status = iccp_newton_create(&newton, map, movable, NULL, env);
    if (status != ICC_OK)
        return status;
    for (int stage = begin; status == ICC_OK && stage < STAGES; ++stage)
        status = take_steps(&newton, stage, &n_steps, env);
    iccp_newton_free(&newton);
    *n_iterations += n_steps;
    return status == ICC_ERR_SOLVER ? ICC_OK : status;
}

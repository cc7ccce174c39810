/* Moves a one-to-one plane map towards a model by Newton's method. The energy is that of Newton's
 * steps near a model (map/energy/model.h). */
#include "map/nearest/approach.h"

#include "map/energy/newton.h"

/* With 1 / PULL from 1e-7 to 1e-3, errors of the result change by a thousandth. Steps range from 3
 * to 17, and the least determinant from 4e-4 to 0.17. */
static const double PULL = 1e4;

/* Steps end when one gains no more than this share of the energy. */
static const double LEAST_GAIN = 1e-4;

/* STEPS: the most. TYPICAL_STEPS: half of the progress. */
enum { STEPS = 25, TYPICAL_STEPS = 8 };

static icc_status take_steps(iccp_newton *newton, size_t *n_iterations, const iccp_env *env)
{
    double energy = iccp_newton_energy(newton, ICCP_DIRICHLET, 0);
    icc_status status = ICC_OK;
    for (size_t k = 0; k < STEPS && newton->assembly.n_free > 0; ++k) {
        const iccp_env part = iccp_round(env, k, TYPICAL_STEPS);
        double slope;
        status = iccp_progress(&part, "improve", 0);
        if (status == ICC_OK)
            status = iccp_newton_solve(newton, ICCP_DIRICHLET, 0, &slope, &part);
        if (status != ICC_OK)
            break;
        const double after = iccp_newton_move(newton, ICCP_DIRICHLET, 0, energy, slope);
        const double gain = energy - after;
        energy = after;
        ++*n_iterations;
        if (gain <= LEAST_GAIN * energy)
            break;
    }
    return status == ICC_ERR_SOLVER ? ICC_OK : status;
}

icc_status iccp_approach(const iccp_simplicial_map *map, const uint8_t *movable,
                         size_t *n_iterations, const iccp_env *env)
{
    iccp_newton newton;
    iccp_simplicial_map pulled = *map;
    const iccp_energy first = ICCP_DIRICHLET;
    pulled.pull = PULL;
    icc_status status = iccp_newton_create(&newton, &pulled, movable, &first, env);
    if (status != ICC_OK)
        return status;
    status = take_steps(&newton, n_iterations, env);
    iccp_newton_free(&newton);
    return status;
}

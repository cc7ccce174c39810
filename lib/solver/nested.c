/* Nested iteration: the active inequalities are those of the coarser grid but for a few along their
 * border, and so is the function but for its detail. */
#include "solver/nested.h"

#include "solver/coarse_qp.h"
#include "solver/interior_point.h"
#include "solver/smoothing.h"

#include <math.h>
#include <string.h>

/* What the interior point method stops at on the coarsest grid: a mean of slack * multiplier. */
static const double COARSEST_TARGET = 1e-16;

/* Residual of the coarser grids: more digits than that do not outlast the finer grid. */
static const double COARSE_ENOUGH = 1e-7;

static icc_status solve_coarsest(const iccp_qp *qp, double *f, double *multiplier,
                                 icc_function_info *info, const iccp_env *env)
{
    iccp_interior_point ip;
    bool stuck;
    icc_status status = iccp_interior_point_create(&ip, qp, info, env);
    if (status != ICC_OK)
        return status;
    status = iccp_interior_point_run(&ip, COARSEST_TARGET, &stuck, info, env);
    memcpy(f, ip.newton.f, qp->unknowns->n * sizeof *f);
    memcpy(multiplier, ip.newton.multiplier, iccp_qp_inequalities(qp) * sizeof *multiplier);
    info->n_iterations += ip.n_iterations;
    iccp_interior_point_free(&ip);
    return status;
}

static icc_status solve(const iccp_qp *qp, int32_t function, size_t coarsest, double *f,
                        double *multiplier, icc_function_info *info, const iccp_env *env);

/* The guess for qp from the next coarser grid. ICC_ERR_SOLVER: there is none. */
static icc_status guess(const iccp_qp *qp, int32_t function, size_t coarsest, double *f,
                        double *multiplier, icc_function_info *info, const iccp_env *env)
{
    iccp_coarse_qp coarse;
    bool useful;
    icc_status status = iccp_coarse_qp_create(&coarse, &useful, qp, function, env);
    if (status != ICC_OK || !useful)
        return status != ICC_OK ? status : ICC_ERR_SOLVER;
    double *coarse_f = iccp_alloc(&env->memory, coarse.unknowns.n, sizeof *coarse_f);
    double *coarse_multiplier =
        iccp_alloc(&env->memory, iccp_qp_inequalities(&coarse.qp), sizeof *coarse_multiplier);
    status = coarse_f != NULL && coarse_multiplier != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = solve(&coarse.qp, function, coarsest, coarse_f, coarse_multiplier, info, env);
    if (status == ICC_OK)
        status = iccp_coarse_qp_prolong(&coarse, coarse_f, coarse_multiplier, f, multiplier, env);
    iccp_free(&env->memory, coarse_f);
    iccp_free(&env->memory, coarse_multiplier);
    iccp_coarse_qp_free(&coarse);
    return status;
}

/* From the guess of the coarser grids to a candidate; f and multiplier, of the last iterate, may be
 * NULL. */
static icc_status improve(const iccp_qp *qp, int32_t function, size_t coarsest, double enough,
                          iccp_candidate *candidate, uint8_t *active, double *f, double *multiplier,
                          icc_function_info *info, const iccp_env *env)
{
    const size_t n = qp->unknowns->n, m = iccp_qp_inequalities(qp);
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){1, 1, 4}, env);
    double *start = iccp_alloc(&env->memory, n + m, sizeof *start);
    if (start == NULL)
        return ICC_ERR_MEMORY;
    iccp_newton_qp newton;
    icc_status status = guess(qp, function, coarsest, start, start + n, info, &part[0]);
    if (status == ICC_OK)
        status = iccp_newton_qp_create(&newton, qp, info, &part[1]);
    if (status == ICC_OK) {
        memcpy(newton.f, start, n * sizeof *newton.f);
        memcpy(newton.multiplier, start + n, m * sizeof *newton.multiplier);
        status = iccp_smoothing(&newton, enough, candidate, active, info, &part[2]);
        if (f != NULL) {
            memcpy(f, newton.f, n * sizeof *f);
            memcpy(multiplier, newton.multiplier, m * sizeof *multiplier);
        }
        iccp_newton_qp_free(&newton);
    }
    iccp_free(&env->memory, start);
    return status;
}

/* f and multiplier on a coarser grid, from grids that are coarser still as long as these hold the
 * shape. */
static icc_status solve(const iccp_qp *qp, int32_t function, size_t coarsest, double *f,
                        double *multiplier, icc_function_info *info, const iccp_env *env)
{
    const size_t n = qp->unknowns->n;
    if (n <= coarsest)
        return solve_coarsest(qp, f, multiplier, info, env);
    iccp_candidate candidate = {iccp_alloc(&env->memory, n, sizeof *candidate.f), HUGE_VAL};
    uint8_t *active = iccp_alloc(&env->memory, iccp_qp_inequalities(qp), sizeof *active);
    icc_status status = candidate.f != NULL && active != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = improve(qp, function, coarsest, COARSE_ENOUGH, &candidate, active, f, multiplier,
                         info, env);
    iccp_free(&env->memory, candidate.f);
    iccp_free(&env->memory, active);
    return status == ICC_ERR_SOLVER ? solve_coarsest(qp, f, multiplier, info, env) : status;
}

icc_status iccp_nested(const iccp_qp *qp, int32_t function, size_t coarsest, double enough,
                       iccp_candidate *candidate, uint8_t *active, icc_function_info *info,
                       const iccp_env *env)
{
    const icc_status status =
        improve(qp, function, coarsest, enough, candidate, active, NULL, NULL, info, env);
    return status == ICC_ERR_SOLVER ? ICC_OK : status;
}

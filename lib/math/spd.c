#include "math/spd.h"

#include "math/ordering.h"

icc_status iccp_spd_create(iccp_spd *solver, const iccp_symmetric *matrix, bool iterative,
                           const iccp_env *env)
{
    *solver = (iccp_spd){.matrix = *matrix, .direct = iccp_ordering_available() && !iterative};
    if (!solver->direct)
        return ICC_OK;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 2}, env);
    icc_status status = iccp_ldlt_analyse(&solver->factor, matrix, 1, &part[0]);
    if (status != ICC_OK)
        return status;
    status = iccp_ldlt_factorise(&solver->factor, matrix, &part[1]);
    if (status != ICC_OK)
        iccp_ldlt_free(&solver->factor);
    return status;
}

void iccp_spd_free(iccp_spd *solver)
{
    if (solver->direct)
        iccp_ldlt_free(&solver->factor);
    solver->direct = false;
}

icc_status iccp_spd_solve(const iccp_spd *solver, size_t n_rhs, double *b, const iccp_env *env)
{
    const size_t n = solver->matrix.n;
    const size_t n_work = solver->direct ? n * n_rhs : ICCP_PCG_WORK * n;
    double *work = iccp_alloc(&env->memory, n_work, sizeof *work);
    if (work == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = ICC_OK;
    if (solver->direct)
        iccp_ldlt_solve(&solver->factor, n_rhs, b, work);
    else
        status = iccp_pcg_solve(&solver->matrix, n_rhs, b, work, env);
    iccp_free(&env->memory, work);
    return status;
}

/* Solves sparse symmetric positive definite systems with math/ldlt.h. */
#include "math/spd.h"

icc_status iccp_spd_create(iccp_ldlt *factor, const iccp_symmetric *matrix, const iccp_env *env)
{
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 2}, env);
    icc_status status = iccp_ldlt_analyse(factor, matrix, 1, &part[0]);
    if (status != ICC_OK)
        return status;
    status = iccp_ldlt_factorise(factor, matrix, &part[1]);
    if (status != ICC_OK)
        iccp_ldlt_free(factor);
    return status;
}

icc_status iccp_spd_solve(const iccp_ldlt *factor, size_t n_rhs, double *b, const iccp_env *env)
{
    double *work = iccp_alloc(&env->memory, factor->n, n_rhs * sizeof *work);
    if (work == NULL)
        return ICC_ERR_MEMORY;
    iccp_ldlt_solve(factor, n_rhs, b, work);
    iccp_free(&env->memory, work);
    return ICC_OK;
}

/* The factorised Laplacian. */
#include "gradient/solver/laplacian_factor.h"

#include "base/clock.h"
#include "base/minmax.h"
#include "gradient/solver/dissection.h"

#include <math.h>

/* Makes the Laplacian of the inside vertices with f = 0 outside. Neighbours outside have no entry,
 * but count in the diagonal. So it is a positive definite M-matrix. */
static icc_status set_matrix(iccp_laplacian_factor *l, const iccp_unknowns *unknowns,
                             const iccp_env *env)
{
    const size_t n = unknowns->n, degree = (size_t)unknowns->n_neighbours;
    l->first = iccp_alloc(&env->memory, n + 1, sizeof *l->first);
    l->column = iccp_alloc(&env->memory, n, degree * sizeof *l->column);
    l->value = iccp_alloc(&env->memory, n, degree * sizeof *l->value);
    l->diagonal = iccp_alloc(&env->memory, n, sizeof *l->diagonal);
    if (l->first == NULL || l->column == NULL || l->value == NULL || l->diagonal == NULL)
        return ICC_ERR_MEMORY;
    size_t p = 0;
    for (size_t k = 0; k < n; ++k) {
        l->first[k] = p;
        l->diagonal[k] = (double)degree;
        for (size_t d = 0; d < degree; ++d)
            if (unknowns->neighbour[k * degree + d] != ICCP_NONE) {
                l->column[p] = unknowns->neighbour[k * degree + d];
                l->value[p++] = -1;
            }
    }
    l->first[n] = p;
    l->matrix = (iccp_symmetric){n, l->first, l->column, l->value, l->diagonal};
    return ICC_OK;
}

static icc_status analyse(iccp_laplacian_factor *l, const iccp_unknowns *unknowns,
                          const iccp_env *env)
{
    uint32_t *order = iccp_alloc(&env->memory, unknowns->n, sizeof *order);
    if (order == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = iccp_dissection(unknowns, order, env);
    if (status == ICC_OK)
        status = iccp_ldlt_analyse_ordered(&l->factor, &l->matrix, order, env);
    iccp_free(&env->memory, order);
    return status;
}

/* Measures the time of its three parts: the matrix, the order, and the factorisation. */
icc_status iccp_laplacian_factorise(iccp_laplacian_factor *l, const iccp_unknowns *unknowns,
                                    iccp_solution *info, const iccp_env *env)
{
    *l = (iccp_laplacian_factor){.memory = env->memory, .factor = {.memory = env->memory}};
    double start = iccp_seconds();
    icc_status status = set_matrix(l, unknowns, env);
    info->seconds_setup += iccp_seconds() - start;
    start = iccp_seconds();
    if (status == ICC_OK)
        status = analyse(l, unknowns, env);
    info->seconds_order += iccp_seconds() - start;
    start = iccp_seconds();
    if (status == ICC_OK) {
        info->work = iccp_max(info->work, l->factor.work);
        status = iccp_ldlt_factorise(&l->factor, &l->matrix, env);
    }
    info->seconds_factor += iccp_seconds() - start;
    if (status != ICC_OK)
        iccp_laplacian_factor_free(l);
    return status;
}

void iccp_laplacian_factor_free(iccp_laplacian_factor *l)
{
    iccp_free(&l->memory, l->first);
    iccp_free(&l->memory, l->column);
    iccp_free(&l->memory, l->value);
    iccp_free(&l->memory, l->diagonal);
    iccp_ldlt_free(&l->factor);
    *l = (iccp_laplacian_factor){.memory = l->memory, .factor = {.memory = l->memory}};
}

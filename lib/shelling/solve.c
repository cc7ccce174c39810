/* Solves equations by conjugate gradients with an auxiliary space, or by factorisation.
 *
 * Source: J. Xu, The auxiliary space method and optimal multigrid preconditioning techniques for
 * unstructured grids, Computing 56, 1996. A smoother acts on the unknowns. An exact solution is
 * added in a smaller space: that of the continuous functions that are linear in each simplex.
 * The number of iterations does not grow with the number of simplices. */
#include "shelling/solve.h"

#include "math/pcg.h"
#include "math/spd.h"
#include "shelling/stiffness.h"

#define NONE UINT32_MAX

/* The matrix is factorised if that takes at most so many multiplications per entry. A cube of
 * 83,000 tetrahedra would take 66,000, and iterations a quarter of the time. Bodies of animals
 * take 500 to 800, and iterations twenty times as long, because of their flat tetrahedra. */
static const double MOST_WORK = 20000;

typedef struct auxiliary {
    const iccp_unknowns *unknowns;
    size_t n;      /* number of unknowns */
    uint32_t *row; /* of each point, or NONE */
    iccp_ldlt solver;
    double *value; /* of each row */
    const iccp_env *env;
} auxiliary;

/* Adds the solution in the auxiliary space. The residual goes down by the transpose of the way
 * up. */
static icc_status add_part(void *argument, const double *r, double *z)
{
    auxiliary *a = argument;
    const size_t n_points = a->unknowns->n_points;
    const uint32_t *point = a->unknowns->point;
    const double share = 1 / (double)n_points;
    for (size_t i = 0; i < a->solver.n; ++i)
        a->value[i] = 0;
    for (size_t i = 0; i < n_points * a->n; ++i)
        if (a->row[point[i]] != NONE)
            a->value[a->row[point[i]]] += share * r[i / n_points];
    const icc_status status = iccp_spd_solve(&a->solver, 1, a->value, a->env);
    for (size_t i = 0; i < n_points * a->n; ++i)
        if (a->row[point[i]] != NONE)
            z[i / n_points] += share * a->value[a->row[point[i]]];
    return status;
}

/* The stiffness matrix of the points that are not fixed. */
static icc_status create_coarse(iccp_gram *coarse, auxiliary *a)
{
    const iccp_simplices *mesh = a->unknowns->mesh;
    iccp_gram all;
    uint32_t n = 0;
    a->row = iccp_alloc(&a->env->memory, mesh->n_points, sizeof *a->row);
    if (a->row == NULL)
        return ICC_ERR_MEMORY;
    for (size_t v = 0; v < mesh->n_points; ++v)
        a->row[v] = a->unknowns->fixed[v] ? NONE : n++;
    icc_status status = iccp_stiffness_create(&all, mesh, a->env);
    if (status != ICC_OK)
        return status;
    status = iccp_stiffness_restrict(coarse, &all, a->row, a->env);
    iccp_gram_free(&all);
    return status;
}

static icc_status run(const iccp_symmetric *matrix, const iccp_gram *coarse, auxiliary *a,
                      double *b)
{
    const iccp_env *env = a->env;
    icc_status status = iccp_spd_create(&a->solver, &coarse->matrix, env);
    if (status != ICC_OK)
        return status;
    double *work = iccp_alloc(&env->memory, ICCP_PCG_WORK * matrix->n, sizeof *work);
    a->value = iccp_alloc(&env->memory, coarse->matrix.n, sizeof *a->value);
    status = ICC_ERR_MEMORY;
    if (work != NULL && a->value != NULL)
        status = iccp_pcg_solve(matrix, coarse->matrix.n > 0 ? add_part : NULL, a, b, work, env);
    iccp_free(&env->memory, work);
    iccp_free(&env->memory, a->value);
    iccp_ldlt_free(&a->solver);
    return status;
}

static icc_status iterate(const iccp_symmetric *matrix, const iccp_unknowns *unknowns, double *b,
                          const iccp_env *env)
{
    auxiliary a = {.unknowns = unknowns, .n = matrix->n, .env = env};
    iccp_gram coarse;
    icc_status status = create_coarse(&coarse, &a);
    if (status == ICC_OK) {
        status = run(matrix, &coarse, &a, b);
        iccp_gram_free(&coarse);
    }
    iccp_free(&env->memory, a.row);
    return status;
}

static icc_status factorise(iccp_ldlt *factor, const iccp_symmetric *matrix, double *b,
                            const iccp_env *env)
{
    double *work = iccp_alloc(&env->memory, matrix->n, sizeof *work);
    icc_status status = work != NULL ? iccp_ldlt_factorise(factor, matrix, env) : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        iccp_ldlt_solve(factor, 1, b, work);
    iccp_free(&env->memory, work);
    return status;
}

icc_status iccp_shelling_solve(const iccp_symmetric *matrix, const iccp_unknowns *unknowns,
                               double *b, const iccp_env *env)
{
    iccp_ldlt factor;
    icc_status status = iccp_ldlt_analyse(&factor, matrix, 1, env);
    if (status != ICC_OK)
        return status;
    const bool is_cheap = factor.work <= MOST_WORK * (double)matrix->first[matrix->n];
    status = is_cheap ? ICC_ERR_SOLVER : iterate(matrix, unknowns, b, env);
    /* Iterations may be too slow if simplices are flat, so the factorisation is the fallback. */
    if (status == ICC_ERR_SOLVER)
        status = factorise(&factor, matrix, b, env);
    iccp_ldlt_free(&factor);
    return status;
}

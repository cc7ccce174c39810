/* Bi-Laplace functions by two solves with conjugate gradients and a multigrid preconditioner.
 * Source: D. Braess, P. Peisker, On the numerical solution of the biharmonic equation and the role
 * of squaring matrices for preconditioning, IMA J. Numer. Anal. 6, 1986. Simply supported, the
 * biharmonic equation consists of two Poisson equations. */
#include "base/clock.h"
#include "gradient/solver/bilaplace.h"
#include "gradient/solver/mg_cg.h"

#include <math.h>

/* Every row must hold to that share of its own terms, however small they are. Otherwise there is no
 * result, because conjugate gradients leave only noise in long limbs. */
static const iccp_mg_goal GOAL = {.relative = 1e-11, .componentwise = 1e-9, .floor = 0};

typedef struct poisson {
    const iccp_unknowns *unknowns;
    iccp_multigrid mg;
    uint32_t *position; /* by unknown: its place among the entries of the finest level */
    double *x, *r;      /* by entry */
} poisson;

static icc_status poisson_create(poisson *p, const iccp_unknowns *unknowns, const iccp_env *env)
{
    *p = (poisson){.unknowns = unknowns, .mg = {.memory = env->memory}};
    p->position = iccp_alloc(&env->memory, unknowns->n, sizeof *p->position);
    if (p->position == NULL)
        return ICC_ERR_MEMORY;
    const icc_status status = iccp_multigrid_create(&p->mg, unknowns->tree->grid, unknowns->n,
                                                    unknowns->vertex, p->position, env);
    if (status != ICC_OK)
        return status;
    const size_t n = p->mg.level[0].n_entries;
    p->x = iccp_alloc_zero(&env->memory, n, sizeof *p->x);
    p->r = iccp_alloc_zero(&env->memory, n, sizeof *p->r);
    if (p->x == NULL || p->r == NULL)
        return ICC_ERR_MEMORY;
    return ICC_OK;
}

static void poisson_free(poisson *p, const iccp_env *env)
{
    iccp_multigrid_free(&p->mg);
    iccp_free(&env->memory, p->position);
    iccp_free(&env->memory, p->x);
    iccp_free(&env->memory, p->r);
}

/* Computes x = L^-1 r, divided by its value at the loaded unknown. */
static icc_status solve(poisson *p, size_t loaded, iccp_solution *info, const iccp_env *env)
{
    const size_t n = p->mg.level[0].n_entries;
    double size = 0;
    for (size_t i = 0; i < n; ++i) {
        p->x[i] = 0;
        size += p->r[i] * p->r[i];
    }
    const icc_status status =
        iccp_mg_cg(&p->mg, p->x, p->r, sqrt(size), &GOAL, &info->n_inner, env);
    const double unit = p->x[p->position[loaded]];
    if (status != ICC_OK || !(unit > 0))
        return status != ICC_OK ? status : ICC_ERR_SOLVER;
    for (size_t k = 0; k < p->unknowns->n; ++k)
        p->x[p->position[k]] /= unit;
    return ICC_OK;
}

static bool is_positive(const poisson *p)
{
    for (size_t k = 0; k < p->unknowns->n; ++k)
        if (!(p->x[p->position[k]] > 0))
            return false;
    return true;
}

icc_status iccp_bilaplace_iterative(const iccp_unknowns *unknowns, size_t loaded,
                                    const iccp_scaled *f, iccp_solution *info, const iccp_env *env)
{
    const double begin = iccp_seconds();
    poisson p;
    icc_status status = poisson_create(&p, unknowns, env);
    const double middle = iccp_seconds();
    info->seconds_setup += middle - begin;
    if (status == ICC_OK) {
        p.r[p.position[loaded]] = 1;
        status = solve(&p, loaded, info, env);
    }
    if (status == ICC_OK) {
        for (size_t i = 0; i < p.mg.level[0].n_entries; ++i)
            p.r[i] = p.x[i];
        status = solve(&p, loaded, info, env);
    }
    if (status == ICC_OK && !is_positive(&p))
        status = ICC_ERR_SOLVER;
    if (status == ICC_ERR_SOLVER)
        iccp_log(env, "bi-Laplace: values far from the root are too small for conjugate gradients");
    for (size_t k = 0; k < unknowns->n && status == ICC_OK; ++k)
        iccp_scaled_set(f, k, p.x[p.position[k]], 0);
    info->seconds_solve += iccp_seconds() - middle;
    poisson_free(&p, env);
    return status;
}

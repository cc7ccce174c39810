/* Bi-Laplace functions under inequalities, by an active set iteration. If it converges, the
 * function is exact up to rounding. From the empty set it needs more steps the larger the grid is,
 * and finally fails. So on large grids, coarser grids (nested.h) tell it where to begin: on letters
 * C from 400 cells on. All smaller problems that were counted, 1,100 on all shapes of
 * tests/hard_masks.h, ended from the empty set. */
#include "base/clock.h"
#include "base/minmax.h"
#include "gradient/solver/bilaplace.h"
#include "gradient/solver/inequalities.h"
#include "gradient/solver/nested.h"
#include "gradient/solver/polish.h"

#include <math.h>

/* Residuals for a maximum of 1. With ENOUGH no better one is sought, and beyond ACCEPTABLE there is
 * no result. */
static const double ENOUGH = 1e-12, ACCEPTABLE = 1e-8;

/* A slack below this, relative to the parent or the bound, counts as equality. */
static const double EQUAL = 1e-12;

/* Unknowns from which on coarser grids pay, and most unknowns of the coarsest grid. */
enum { LARGE = 50000, COARSEST = 3000 };

/* Starts on coarse grids and goes to finer ones. Smoothing finds the active inequalities, except
 * the last few. The active set finds these in 5 to 20 steps, each of which takes half as long. */
static icc_status start_coarse(const iccp_qp *qp, int32_t function, uint8_t *active,
                               iccp_candidate *candidate, iccp_solution *info, const iccp_env *env)
{
    iccp_nested nested;
    iccp_candidate smooth = {candidate->f, HUGE_VAL};
    iccp_env part[3];
    bool useful;
    iccp_split(part, 3, (const double[]){2, 3, 1}, env);
    icc_status status =
        iccp_nested_create(&nested, &useful, qp, function, COARSEST, info, &part[0]);
    if (status == ICC_OK && useful) {
        status = iccp_smoothing_run(&nested.smoothing, ICCP_NESTED_ENOUGH, &smooth, active, info,
                                    &part[1]);
        iccp_nested_free(&nested);
        if (status == ICC_OK)
            status = iccp_polish(qp, active, true, ENOUGH, candidate, info, &part[2]);
    }
    return status == ICC_ERR_SOLVER ? ICC_OK : status;
}

/* Large problems start on coarse grids. For small ones, and if that is not enough, the active set
 * runs. */
static icc_status optimise(const iccp_qp *qp, int32_t function, iccp_candidate *candidate,
                           iccp_solution *info, const iccp_env *env)
{
    const size_t m = iccp_qp_inequalities(qp);
    uint8_t *active = iccp_alloc_zero(&env->memory, m, sizeof *active);
    if (active == NULL)
        return ICC_ERR_MEMORY;
    iccp_env part[2];
    const bool is_large = qp->unknowns->n >= LARGE;
    iccp_split(part, 2, (const double[]){is_large ? 5 : 0, 1}, env);
    icc_status status = ICC_OK;
    if (is_large)
        status = start_coarse(qp, function, active, candidate, info, &part[0]);
    if (status == ICC_OK && candidate->residual > ENOUGH)
        status = iccp_polish(qp, active, false, ENOUGH, candidate, info, &part[1]);
    iccp_free(&env->memory, active);
    if (status != ICC_OK || candidate->residual <= ACCEPTABLE)
        return status;
    iccp_log(env, "bi-Laplace: the residual is still %.1e after %lu iterations",
             candidate->residual, (unsigned long)info->n_iterations);
    return ICC_ERR_SOLVER;
}

/* Raises values below the least that the leaves' bounds allow, then sweeps from the root. Also
 * updates `f`, the values as doubles. `work` has n entries. */
static void sweep(const iccp_qp *qp, double *f, const iccp_scaled *scaled, double *work)
{
    const size_t n = qp->unknowns->n;
    (void)iccp_qp_least_root(qp, work);
    for (size_t k = 0; k < n; ++k)
        iccp_scaled_set(scaled, k, k == 0 ? 1 : iccp_max(f[k], work[k]), 0);
    iccp_inequalities_sweep(qp->unknowns, qp->sigma - 1, scaled);
    for (size_t k = 0; k < n; ++k)
        f[k] = iccp_scaled_get(scaled, k, 0);
}

static size_t count_active(const iccp_qp *qp, const double *f)
{
    const uint32_t *parent = qp->unknowns->parent;
    size_t n_active = 0;
    for (size_t k = 1; k < qp->unknowns->n; ++k)
        n_active += f[parent[k]] * (1 - EQUAL) <= qp->sigma * f[k];
    for (size_t j = 0; j < qp->n_leaves; ++j)
        n_active += f[qp->leaf_unknown[j]] * (1 - EQUAL) <= qp->leaf;
    return n_active;
}

/* The sweep makes the inequalities hold in rounded arithmetic, but increases the residual. So
 * residuals before and after are reported. An inequality is then active if it holds with
 * equality. */
static icc_status sweep_and_report(const iccp_qp *qp, const iccp_candidate *candidate,
                                   const iccp_scaled *f, iccp_solution *info, const iccp_env *env)
{
    const size_t n = qp->unknowns->n;
    const double start = iccp_seconds();
    double *work = iccp_alloc(&env->memory, qp->a.n_rows + 2 * n, sizeof *work);
    if (work == NULL)
        return ICC_ERR_MEMORY;
    double *gradient = work + qp->a.n_rows + n;
    const iccp_scaled plain = {candidate->f, NULL}, force = {gradient, NULL};
    sweep(qp, candidate->f, f, work);
    iccp_energy_gradient(&qp->a, candidate->f, work, gradient);
    info->residual_before = candidate->residual;
    info->residual =
        iccp_inequalities_residual(qp->unknowns, qp->sigma - 1, qp->leaf, &plain, &force, work);
    info->n_active = count_active(qp, candidate->f);
    info->seconds_verify += iccp_seconds() - start;
    iccp_free(&env->memory, work);
    return ICC_OK;
}

/* Checks that the bounds of the leaves leave room below the root. */
static icc_status check_room(const iccp_qp *qp, double *work, const iccp_env *env)
{
    const double least = iccp_qp_least_root(qp, work);
    if (least < 1)
        return ICC_OK;
    iccp_log(env, "bi-Laplace: the inequalities ask for %g at the root, where the function is 1",
             least);
    return ICC_ERR_SOLVER;
}

icc_status iccp_bilaplace_constrained(const iccp_unknowns *unknowns, int32_t function, double eta,
                                      double leaf, const iccp_scaled *f, iccp_solution *info,
                                      const iccp_env *env)
{
    const double start = iccp_seconds();
    iccp_qp qp;
    info->n_iterations = 0;
    icc_status status = iccp_qp_create(&qp, unknowns, function, eta, leaf, env);
    if (status != ICC_OK)
        return status;
    info->seconds_setup += iccp_seconds() - start;
    iccp_candidate candidate = {iccp_alloc(&env->memory, unknowns->n, sizeof *candidate.f),
                                HUGE_VAL};
    status = candidate.f != NULL ? check_room(&qp, candidate.f, env) : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = optimise(&qp, function, &candidate, info, env);
    if (status == ICC_OK)
        status = sweep_and_report(&qp, &candidate, f, info, env);
    iccp_free(&env->memory, candidate.f);
    iccp_qp_free(&qp);
    return status;
}

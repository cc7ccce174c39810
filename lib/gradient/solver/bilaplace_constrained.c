/* Bi-Laplace functions under inequalities. An active set iteration is fast if it converges, and
 * then exact up to rounding. If it does not, an interior point method tells it where to begin. That
 * method is slower and always converges. Far from the root f is as small as the leaves' bounds.
 * There only its last iterates show which inequalities are active, so the two methods take turns.
 *
 * From the empty set, the active set needs more steps the larger the grid is, and finally fails. So
 * on large grids, coarser grids (nested.h) tell it where to begin. */
#include "base/clock.h"
#include "base/minmax.h"
#include "gradient/solver/bilaplace.h"
#include "gradient/solver/inequalities.h"
#include "gradient/solver/interior_point.h"
#include "gradient/solver/nested.h"
#include "gradient/solver/polish.h"

#include <math.h>
#include <string.h>

/* Residuals for a maximum of 1. With ENOUGH no better one is sought, with GOOD no other method is
 * tried, and beyond ACCEPTABLE there is no result. Slacks up to ENOUGH, relative to the parent or
 * the bound, count as equality. */
static const double ENOUGH = 1e-12, GOOD = 1e-11, ACCEPTABLE = 1e-8;

/* Means of slack * multiplier at which the active set is tried. The last one is never reached. */
static const double TARGETS[] = {1e-12, 1e-14, 1e-16, 1e-18, 0};

/* Unknowns from which on coarser grids pay, and most unknowns of the coarsest grid. */
enum { LARGE = 50000, COARSEST = 3000 };

/* Runs the interior point method to one target after another, and tries the active set that each
 * iterate suggests: the multiplier exceeds the slack. Ends when a residual is good enough, or when
 * rounding stops the interior point method. The last target forces that. A serpentine of 225 cells
 * needs this way. */
static icc_status alternate_methods(const iccp_qp *qp, uint8_t *active, iccp_candidate *candidate,
                                    iccp_solution *info, const iccp_env *env)
{
    iccp_interior_point ip;
    bool stuck = false;
    iccp_env part = iccp_part(env, NULL, 0, 0.1);
    icc_status status = iccp_interior_point_create(&ip, qp, info, &part);
    if (status != ICC_OK)
        return status;
    part = iccp_part(env, NULL, 0.1, 1);
    for (size_t t = 0; status == ICC_OK && !stuck && candidate->residual > ENOUGH; ++t) {
        status = iccp_interior_point_run(&ip, TARGETS[t], &stuck, info, &part);
        for (size_t i = 0; i < iccp_qp_inequalities(qp); ++i)
            active[i] = ip.newton.multiplier[i] > ip.newton.slack[i];
        const iccp_env polishing = iccp_round(&part, ip.n_iterations, ICCP_NEWTON_TYPICAL);
        if (status == ICC_OK)
            status = iccp_polish(qp, active, false, ENOUGH, candidate, info, &polishing);
    }
    info->n_iterations += ip.n_iterations;
    iccp_interior_point_free(&ip);
    return status;
}

/* Runs the active set, which give the same function with the active inequalities as
 * equations. If they lead elsewhere, the candidate stays. */
static icc_status make_exact(const iccp_qp *qp, uint8_t *active, double accepted, bool *is_exact,
                             iccp_candidate *candidate, iccp_solution *info, const iccp_env *env)
{
    const size_t n = qp->unknowns->n;
    iccp_candidate exact = {iccp_alloc(&env->memory, n, sizeof *exact.f), HUGE_VAL};
    const icc_status status =
        exact.f != NULL ? iccp_polish(qp, active, true, ENOUGH, &exact, info, env) : ICC_ERR_MEMORY;
    *is_exact = status == ICC_OK && exact.residual <= accepted;
    if (*is_exact) {
        memcpy(candidate->f, exact.f, n * sizeof *exact.f);
        candidate->residual = exact.residual;
    }
    iccp_free(&env->memory, exact.f);
    return status;
}

/* Smoothing finds the active inequalities early, except the last few. If the active set does not
 * find these, smoothing continues. */
static icc_status run_nested(const iccp_qp *qp, iccp_nested *nested, uint8_t *active,
                             iccp_candidate *candidate, iccp_solution *info, const iccp_env *env)
{
    const double residual[] = {ICCP_NESTED_ENOUGH, ENOUGH}, needed[] = {ICCP_NESTED_ENOUGH, GOOD},
                 accepted[] = {ENOUGH, GOOD};
    iccp_env part[4];
    icc_status status = ICC_OK;
    bool is_exact = false;
    iccp_split(part, 4, (const double[]){6, 1, 4, 1}, env);
    for (size_t k = 0; k < 2 && status == ICC_OK && !is_exact; ++k) {
        status = iccp_smoothing_run(&nested->smoothing, residual[k], candidate, active, info,
                                    &part[2 * k]);
        if (status == ICC_OK && candidate->residual <= needed[k])
            status =
                make_exact(qp, active, accepted[k], &is_exact, candidate, info, &part[2 * k + 1]);
    }
    return status;
}

/* Starts on coarse grids and goes to finer ones. */
static icc_status start_coarse(const iccp_qp *qp, int32_t function, uint8_t *active,
                               iccp_candidate *candidate, iccp_solution *info, const iccp_env *env)
{
    iccp_nested nested;
    iccp_env part[2];
    bool useful;
    iccp_split(part, 2, (const double[]){1, 2}, env);
    icc_status status =
        iccp_nested_create(&nested, &useful, qp, function, COARSEST, info, &part[0]);
    if (status == ICC_OK && useful) {
        status = run_nested(qp, &nested, active, candidate, info, &part[1]);
        iccp_nested_free(&nested);
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
    iccp_env part[3];
    const bool is_large = qp->unknowns->n >= LARGE;
    iccp_split(part, 3, (const double[]){is_large ? 5 : 0, 1, 4}, env);
    icc_status status = ICC_OK;
    if (is_large)
        status = start_coarse(qp, function, active, candidate, info, &part[0]);
    if (status == ICC_OK && candidate->residual > GOOD)
        status = iccp_polish(qp, active, false, ENOUGH, candidate, info, &part[1]);
    if (status == ICC_OK && candidate->residual > GOOD)
        status = alternate_methods(qp, active, candidate, info, &part[2]);
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
        n_active += f[parent[k]] * (1 - ENOUGH) <= qp->sigma * f[k];
    for (size_t j = 0; j < qp->n_leaves; ++j)
        n_active += f[qp->leaf_unknown[j]] * (1 - ENOUGH) <= qp->leaf;
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

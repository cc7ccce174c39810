/* An active set iteration is fast when it converges, and then exact up to rounding. When it does
 * not, an interior point method, which is slower and always converges, tells it where to begin. Far
 * from the root f is as small as the leaves' bounds, and what is active there shows only in the
 * last iterates of the latter; so the two take turns.
 *
 * From the empty set it takes more steps the larger the grid is, and goes astray in the end. So it
 * is told by coarser grids (nested.h) where to begin on large ones. */
#include "base/clock.h"
#include "base/minmax.h"
#include "gradient/solver/bilaplace.h"
#include "gradient/solver/inequalities.h"
#include "gradient/solver/interior_point.h"
#include "gradient/solver/nested.h"
#include "gradient/solver/polish.h"

#include <math.h>
#include <string.h>

/* Residuals, for a maximum of 1: no better one is looked for; no other method is tried; a worse one
 * is not handed out. */
static const double ENOUGH = 1e-12, GOOD = 1e-11, ACCEPTABLE = 1e-8;

/* Residual at which smoothing has found most of what is active. On letters C of 117,000 to 468,000
 * unknowns that takes 16 to 30 iterations, and the active set finds the rest in 5 to 20 steps that
 * take half as long each. */
static const double EARLY = 1e-8;

/* Means of slack * multiplier where the active set is tried. The last one is never reached. */
static const double TARGETS[] = {1e-12, 1e-14, 1e-16, 1e-18, 0};

/* A slack below this, relative to the parent or the bound, is equality. */
static const double EQUAL = 1e-12;

/* Unknowns from which on coarser grids pay, the most of the coarsest one, and steps of the active
 * set afterwards. */
enum { LARGE = 50000, COARSEST = 3000, STEPS = 60 };

/* Runs the interior point method to one target after the other and tries the active set that each
 * iterate suggests: where the multiplier exceeds the slack. Ends with a residual that is good
 * enough or when rounding stops the interior point method, which the last target forces. */
static icc_status alternate_methods(const iccp_qp *qp, uint8_t *active, iccp_candidate *candidate,
                                    icc_function_info *info, const iccp_env *env)
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
        const iccp_env polishing = iccp_round(&part, ip.n_iterations, ICCP_INTERIOR_POINT_TYPICAL);
        if (status == ICC_OK)
            status = iccp_polish(qp, active, false, ENOUGH, ICCP_POLISH_MOST, candidate, info,
                                 &polishing);
    }
    info->n_iterations += ip.n_iterations;
    iccp_interior_point_free(&ip);
    return status;
}

/* A few steps of the active set give the same function with those inequalities as equations that
 * are active. When they lead elsewhere, the candidate stays as it is. */
static icc_status make_exact(const iccp_qp *qp, uint8_t *active, double accepted, bool *is_exact,
                             iccp_candidate *candidate, icc_function_info *info,
                             const iccp_env *env)
{
    const size_t n = qp->unknowns->n;
    iccp_candidate exact = {iccp_alloc(&env->memory, n, sizeof *exact.f), HUGE_VAL};
    const icc_status status = exact.f != NULL
                                  ? iccp_polish(qp, active, true, ENOUGH, STEPS, &exact, info, env)
                                  : ICC_ERR_MEMORY;
    *is_exact = status == ICC_OK && exact.residual <= accepted;
    if (*is_exact) {
        memcpy(candidate->f, exact.f, n * sizeof *exact.f);
        candidate->residual = exact.residual;
    }
    iccp_free(&env->memory, exact.f);
    return status;
}

/* Smoothing tells early what is active but for the last few inequalities; where the active set
 * does not find those, it goes on. */
static icc_status run_nested(const iccp_qp *qp, iccp_nested *nested, uint8_t *active,
                             iccp_candidate *candidate, icc_function_info *info,
                             const iccp_env *env)
{
    const double residual[] = {EARLY, ENOUGH}, needed[] = {EARLY, GOOD},
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

/* From coarse to fine. */
static icc_status start_coarse(const iccp_qp *qp, int32_t function, uint8_t *active,
                               iccp_candidate *candidate, icc_function_info *info,
                               const iccp_env *env)
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

/* Large problems from coarse to fine first; where that is not enough, and for small ones, the
 * active set. */
static icc_status optimise(const iccp_qp *qp, int32_t function, iccp_candidate *candidate,
                           icc_function_info *info, const iccp_env *env)
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
        status =
            iccp_polish(qp, active, false, ENOUGH, ICCP_POLISH_MOST, candidate, info, &part[1]);
    if (status == ICC_OK && candidate->residual > GOOD)
        status = alternate_methods(qp, active, candidate, info, &part[2]);
    iccp_free(&env->memory, active);
    if (status != ICC_OK || candidate->residual <= ACCEPTABLE)
        return status;
    iccp_log(env, "bi-Laplace: the residual is still %.1e after %lu iterations",
             candidate->residual, (unsigned long)info->n_iterations);
    return ICC_ERR_SOLVER;
}

/* Raises what is below the least value that the leaves' bounds allow, then sweeps from the root.
 * `f` as doubles follows. work: n */
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

/* The sweep makes the inequalities hold in rounded arithmetic, at the price of the residual; that
 * before and that after are both reported. Active is then what holds with equality. */
static icc_status sweep_and_report(const iccp_qp *qp, const iccp_candidate *candidate,
                                   const iccp_scaled *f, icc_function_info *info,
                                   const iccp_env *env)
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

/* Whether the bounds of the leaves leave room below the root. */
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
                                      double leaf, const iccp_scaled *f, icc_function_info *info,
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

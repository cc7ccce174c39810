/* Interior point method. Based on: S. Mehrotra, On the implementation of a primal-dual interior
 * point method, SIAM J. Optim. 2, 1992. */
#include "gradient/solver/interior_point.h"

#include "base/clock.h"
#include "base/minmax.h"

#include <math.h>
#include <string.h>

enum {
    MAX_ITERATIONS = 200,
    /* Iterations that reduce products by less than a tenth, and hardly any residuals */
    PATIENCE = 6
};

/* Share of the first residuals above which products do not fall. */
static const double NEARLY_FEASIBLE = 1e-6;

/* The share of the way to the boundary that a step takes. */
static const double SHORTEN = 0.995;

/* Least initial slacks and multipliers. A power of ten more or less costs 2 iterations. */
static const double LEAST_SLACK = 0.01, LEAST_MULTIPLIER = 0.001;

/* If a step is shorter, the method steps to equal products instead, away from the bounds. */
static const double SHORT_STEP = 0.01;

/* Error of a step, relative to the slacks. */
static const double PREDICTOR_ERROR = 0.5, CORRECTOR_ERROR = 0.1;

static size_t n_rows(const iccp_interior_point *p)
{
    return p->newton.qp->unknowns->n;
}

static size_t n_pairs(const iccp_interior_point *p)
{
    return iccp_qp_inequalities(p->newton.qp);
}

static double mean_product(const iccp_interior_point *p)
{
    double sum = 0;
    for (size_t i = 0; i < n_pairs(p); ++i)
        sum += p->newton.slack[i] * p->newton.multiplier[i];
    return sum / (double)n_pairs(p);
}

/* Computes the step for the present residuals and products. The first correction adds what softness
 * left out, so the error may grow there. */
static void solve(iccp_interior_point *p, double tolerance)
{
    double last = HUGE_VAL;
    memset(p->newton.step_f, 0, n_rows(p) * sizeof *p->newton.step_f);
    memset(p->newton.step_multiplier, 0, n_pairs(p) * sizeof *p->newton.step_multiplier);
    for (int k = 0;; ++k) {
        const double error = iccp_newton_qp_errors(&p->newton);
        if (k > 0 && (error <= tolerance || (k > 2 && !(error < 0.7 * last))))
            return;
        last = error;
        iccp_newton_qp_add_solution(&p->newton);
    }
}

/* Returns how far one can go along a step before an entry becomes zero, at most 1. */
static double reach(const double *x, const double *step, size_t n)
{
    double most = 1;
    for (size_t i = 0; i < n; ++i)
        if (step[i] < 0)
            most = iccp_min(most, -x[i] / step[i]);
    return most;
}

static double step_length(const iccp_interior_point *p)
{
    return iccp_min(reach(p->newton.slack, p->newton.step_slack, n_pairs(p)),
                    reach(p->newton.multiplier, p->newton.step_multiplier, n_pairs(p)));
}

/* The predictor goes straight to products of 0. The corrector goes to equal products, which are
 * smaller the further the predictor got, and includes the predictor's second-order terms. If that
 * is stopped early by a bound, it goes to equal products alone. Returns the share of the residuals
 * that a whole step removes. */
static double find_step(iccp_interior_point *p)
{
    const double mean = mean_product(p);
    for (size_t i = 0; i < n_pairs(p); ++i)
        p->newton.product[i] = p->newton.slack[i] * p->newton.multiplier[i];
    solve(p, PREDICTOR_ERROR);
    const double length = step_length(p);
    double after = 0;
    for (size_t i = 0; i < n_pairs(p); ++i)
        after += (p->newton.slack[i] + length * p->newton.step_slack[i]) *
                 (p->newton.multiplier[i] + length * p->newton.step_multiplier[i]);
    after /= (double)n_pairs(p) * mean;
    for (size_t i = 0; i < n_pairs(p); ++i)
        p->newton.product[i] +=
            p->newton.step_slack[i] * p->newton.step_multiplier[i] - after * after * after * mean;
    solve(p, CORRECTOR_ERROR);
    if (step_length(p) >= SHORT_STEP)
        return 1;
    for (size_t i = 0; i < n_pairs(p); ++i) {
        p->newton.product[i] = p->newton.slack[i] * p->newton.multiplier[i] - mean;
        p->newton.primal[i] = 0;
    }
    memset(p->newton.dual, 0, n_rows(p) * sizeof *p->newton.dual);
    solve(p, CORRECTOR_ERROR);
    return 0;
}

static void take_step(iccp_interior_point *p, double length)
{
    for (size_t k = 1; k < n_rows(p); ++k)
        p->newton.f[k] += length * p->newton.step_f[k];
    for (size_t i = 0; i < n_pairs(p); ++i) {
        p->newton.slack[i] += length * p->newton.step_slack[i];
        p->newton.multiplier[i] += length * p->newton.step_multiplier[i];
    }
}

/* Returns ICC_ERR_SOLVER if the step leads nowhere. */
static icc_status iterate(iccp_interior_point *p, iccp_solution *info, const iccp_env *env)
{
    iccp_newton_qp_residuals(&p->newton);
    const icc_status status = iccp_newton_qp_factorise(&p->newton, info, env);
    if (status != ICC_OK)
        return status;
    const double start = iccp_seconds();
    const double made_up = find_step(p);
    const double length = SHORTEN * step_length(p);
    info->seconds_solve += iccp_seconds() - start;
    if (!(length > 1e-6))
        return ICC_ERR_SOLVER;
    take_step(p, length);
    p->remaining *= 1 - made_up * length;
    ++p->n_iterations;
    return ICC_OK;
}

icc_status iccp_interior_point_run(iccp_interior_point *ip, double target, bool *stuck,
                                   iccp_solution *info, const iccp_env *env)
{
    int patience = PATIENCE;
    double mean = mean_product(ip);
    *stuck = false;
    while (mean > target && !*stuck) {
        const double remaining = ip->remaining;
        const iccp_env part = iccp_round(env, ip->n_iterations, ICCP_NEWTON_TYPICAL);
        icc_status status = iccp_progress(&part, "solve", 0);
        if (status == ICC_OK)
            status = iterate(ip, info, &part);
        if (status != ICC_OK && status != ICC_ERR_SOLVER)
            return status;
        const double last = mean;
        mean = mean_product(ip);
        const bool gets_feasible =
            ip->remaining > NEARLY_FEASIBLE && ip->remaining < 0.98 * remaining;
        patience = mean < 0.9 * last || gets_feasible ? PATIENCE : patience - 1;
        *stuck = status != ICC_OK || patience == 0 || ip->n_iterations >= MAX_ITERATIONS;
    }
    return ICC_OK;
}

/* Starts from the function with the least energy plus sum of squared slacks. Takes its slacks and
 * multipliers where they are positive and large enough. */
static icc_status start(iccp_interior_point *p, iccp_solution *info, const iccp_env *env)
{
    const size_t n = n_rows(p), m = n_pairs(p);
    for (size_t i = 0; i < m; ++i) {
        p->newton.slack[i] = p->newton.multiplier[i] = 1;
        p->newton.product[i] = p->newton.step_multiplier[i] = 0;
    }
    const icc_status status = iccp_newton_qp_factorise(&p->newton, info, env);
    if (status != ICC_OK)
        return status;
    for (size_t k = 0; k < n; ++k) {
        p->newton.f[k] = k == 0;
        p->newton.step_f[k] = 0;
    }
    iccp_newton_qp_stationarity(&p->newton, p->newton.f, p->newton.step_multiplier, p->newton.dual);
    iccp_qp_slacks(p->newton.qp, p->newton.f, false, p->newton.primal);
    (void)iccp_newton_qp_errors(&p->newton);
    iccp_newton_qp_add_solution(&p->newton);
    for (size_t k = 1; k < n; ++k)
        p->newton.f[k] = p->newton.step_f[k];
    iccp_qp_slacks(p->newton.qp, p->newton.f, false, p->newton.slack);
    for (size_t i = 0; i < m; ++i) {
        p->newton.multiplier[i] = iccp_max(LEAST_MULTIPLIER, -p->newton.slack[i]);
        p->newton.slack[i] = iccp_max(LEAST_SLACK, p->newton.slack[i]);
    }
    return ICC_OK;
}

icc_status iccp_interior_point_create(iccp_interior_point *ip, const iccp_qp *qp,
                                      iccp_solution *info, const iccp_env *env)
{
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){2, 1}, env);
    *ip = (iccp_interior_point){.remaining = 1};
    icc_status status = iccp_newton_qp_create(&ip->newton, qp, info, &part[0]);
    if (status == ICC_OK)
        status = start(ip, info, &part[1]);
    if (status != ICC_OK)
        iccp_interior_point_free(ip);
    return status;
}

void iccp_interior_point_free(iccp_interior_point *ip)
{
    iccp_newton_qp_free(&ip->newton);
}

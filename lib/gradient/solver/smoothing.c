/* Smoothing method. Based on: C. Kanzow, Some noninterior continuation methods for linear
 * complementarity problems, SIAM J. Matrix Anal. Appl. 17, 1996.
 *
 * Slack s and multiplier y of an inequality are two functions of one free number v: s - unit y = v
 * and s unit y = width^2. So no step meets a bound, and any guess will do, while an interior point
 * method needs a central one. The widths shrink from iteration to iteration, and in the end v tells
 * which inequalities are active.
 *
 * Widths are relative to f, which falls by many powers of ten along limbs. Otherwise the far ends
 * would take shape only after all the rest. */
#include "gradient/solver/smoothing.h"

#include "base/clock.h"
#include "base/minmax.h"
#include "gradient/solver/inequalities.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

/* Unit of multipliers relative to slacks. Multipliers are smaller by the square of the number of
 * vertices across a limb. Chosen on a letter C of 75,000 unknowns, where a tenth of it costs a
 * third more iterations. */
static const double UNIT = 0.04;

/* Width of the first iteration, relative to f. */
static const double FIRST_WIDTH = 0.01;

/* Widths below this gain nothing, for a maximum of 1. */
static const double LEAST_WIDTH = 1e-17;

/* The width shrinks more if fewer inequalities are off by more than it. */
static const double FEW = 0.1, MANY = 0.25;
static const double FAST = 0.1, STEADY = 0.2, SLOW = 0.3;

/* Returns the square of an inequality's width. */
static double square_width(const iccp_smoothing *s, double width, size_t i)
{
    const size_t k = i < s->n - 1 ? i + 1 : s->newton->qp->leaf_unknown[i - (s->n - 1)];
    const double own = iccp_max(width * s->size[k], LEAST_WIDTH);
    return own * own;
}

/* Computes the smaller one of slack and multiplier by division, so that it keeps its digits. */
static void find_pairs(iccp_smoothing *s)
{
    for (size_t i = 0; i < s->m; ++i) {
        const double half = s->v[i] / 2, square = square_width(s, s->width, i);
        const double large = fabs(half) + sqrt(half * half + square), small = square / large;
        s->newton->slack[i] = half > 0 ? large : small;
        s->newton->multiplier[i] = (half > 0 ? small : large) / s->unit;
    }
}

static double find_residual(const iccp_smoothing *s)
{
    const iccp_newton_qp *p = s->newton;
    const iccp_qp *qp = p->qp;
    const iccp_scaled f = {p->f, NULL}, force = {p->force, NULL};
    iccp_energy_gradient(&qp->a, p->f, p->work, p->force);
    return iccp_inequalities_residual(qp->unknowns, qp->sigma - 1, qp->leaf, &f, &force, p->work);
}

static double next_width(const iccp_smoothing *s)
{
    size_t n_off = 0;
    for (size_t i = 0; i < s->m; ++i) {
        const double r = s->newton->primal[i];
        n_off += r * r > square_width(s, s->width, i);
    }
    const double share = (double)n_off / (double)s->m;
    return s->width * (share < FEW ? FAST : share < MANY ? STEADY : SLOW);
}

/* Makes one full step of Newton's method towards the next width. */
static icc_status step(iccp_smoothing *s, iccp_solution *info, const iccp_env *env)
{
    iccp_newton_qp *p = s->newton;
    const double width = next_width(s);
    const icc_status status = iccp_newton_qp_factorise(p, info, env);
    if (status != ICC_OK)
        return status;
    const double start = iccp_seconds();
    memset(p->step_f, 0, s->n * sizeof *p->step_f);
    memset(p->step_multiplier, 0, s->m * sizeof *p->step_multiplier);
    for (size_t i = 0; i < s->m; ++i)
        p->product[i] = p->slack[i] * p->multiplier[i] - square_width(s, width, i) / s->unit;
    (void)iccp_newton_qp_errors(p);
    iccp_newton_qp_add_solution(p);
    (void)iccp_newton_qp_errors(p);
    for (size_t k = 1; k < s->n; ++k)
        p->f[k] += p->step_f[k];
    for (size_t i = 0; i < s->m; ++i)
        s->v[i] =
            p->slack[i] + p->step_slack[i] - s->unit * (p->multiplier[i] + p->step_multiplier[i]);
    s->width = width;
    ++info->n_iterations;
    info->seconds_solve += iccp_seconds() - start;
    return ICC_OK;
}

/* Keeps the iterate if it is the best so far. */
static void consider(const iccp_smoothing *s, iccp_candidate *candidate, int *patience,
                     iccp_solution *info)
{
    const double start = iccp_seconds(), residual = find_residual(s);
    --*patience;
    if (residual < candidate->residual) {
        memcpy(candidate->f, s->newton->f, s->n * sizeof *candidate->f);
        candidate->residual = residual;
        *patience = ICCP_QP_PATIENCE;
    }
    info->seconds_verify += iccp_seconds() - start;
}

static icc_status iterate(iccp_smoothing *s, double enough, iccp_candidate *candidate,
                          iccp_solution *info, const iccp_env *env)
{
    int patience = ICCP_QP_PATIENCE;
    for (size_t k = 0;; ++k) {
        const iccp_env part = iccp_round(env, k, ICCP_NEWTON_TYPICAL);
        icc_status status = iccp_progress(&part, "solve", 0);
        if (status != ICC_OK)
            return status;
        find_pairs(s);
        consider(s, candidate, &patience, info);
        if (candidate->residual <= enough || patience <= 0)
            return ICC_OK;
        iccp_newton_qp_residuals(s->newton);
        status = step(s, info, &part);
        if (status != ICC_OK)
            /* The best candidate so far may suffice */
            return status == ICC_ERR_SOLVER ? ICC_OK : status;
    }
}

static void begin(iccp_smoothing *s)
{
    iccp_newton_qp *p = s->newton;
    const double dim = p->qp->unknowns->tree->grid->dim;
    s->unit = UNIT * iccp_pow((double)s->n, 2 / dim);
    s->width = FIRST_WIDTH;
    p->f[0] = 1;
    for (size_t k = 0; k < s->n; ++k)
        s->size[k] = iccp_max(p->f[k], p->qp->leaf);
    iccp_qp_slacks(p->qp, p->f, false, s->v);
    for (size_t i = 0; i < s->m; ++i)
        s->v[i] -= s->unit * p->multiplier[i];
}

icc_status iccp_smoothing_create(iccp_smoothing *smoothing, iccp_newton_qp *newton,
                                 const iccp_env *env)
{
    const size_t n = newton->qp->unknowns->n, m = iccp_qp_inequalities(newton->qp);
    double *room = iccp_alloc(&env->memory, n + m, sizeof *room);
    *smoothing = (iccp_smoothing){.newton = newton, .n = n, .m = m, .size = room};
    if (room == NULL)
        return ICC_ERR_MEMORY;
    smoothing->v = room + n;
    begin(smoothing);
    return ICC_OK;
}

void iccp_smoothing_free(iccp_smoothing *smoothing)
{
    if (smoothing->newton != NULL)
        iccp_free(&smoothing->newton->memory, smoothing->size);
    *smoothing = (iccp_smoothing){0};
}

icc_status iccp_smoothing_run(iccp_smoothing *smoothing, double enough, iccp_candidate *candidate,
                              uint8_t *active, iccp_solution *info, const iccp_env *env)
{
    const icc_status status = iterate(smoothing, enough, candidate, info, env);
    for (size_t i = 0; i < smoothing->m; ++i)
        active[i] = smoothing->v[i] < 0;
    return status;
}

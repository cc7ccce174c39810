/* Based on: Sakaridis, Kernel Coordinates (ETH Zurich 2016), section 4.1. The quadratic program of a point has as
 * many unknowns as there are handles, but only dim + 1 equations. Its dual has one unknown per equation and no
 * inequality: with x = max(0, start + C'y) minimise the convex function |x|^2 / 2 - target'y, whose derivative
 * g = Cx - target is piecewise linear. Newton's method on it ends after a few steps: it is exact once the set of
 * positive x is the right one.
 *
 * On the faces of the handles' hull the matrix of the pieces is singular, and undamped steps do not get there. So
 * a multiple of |g| is added to its diagonal, and steps that go too far are shortened. */
#include "kernel/nonneg.h"

#include <assert.h>
#include <float.h>
#include <math.h>

/* Of |g|: added to the diagonal. From 1e-6 to 1e-2 there is little to choose (tests/unit/test_weights.c). */
static const double DAMPING = 1e-4;
/* Of the size of the numbers: g is rounding. */
static const double TIGHT = 16 * DBL_EPSILON;
/* The same, where it gets no smaller any more: large multipliers cancel. */
static const double LOOSE = 1e-11;
/* Random and degenerate problems take at most 20 steps. */
enum { MOST_STEPS = 100, MOST_CUTS = 20 };

typedef struct state {
    double y[ICCP_ROWS];
    double g[ICCP_ROWS];
    double h[ICCP_ROWS][ICCP_ROWS]; /* derivative of g */
} state;

static double dot(const double *a, const double *b)
{
    return (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]);
}

/* All at y: the columns pass once. */
static void evaluate(const iccp_nonneg *p, const double *start, state *s)
{
    double g[ICCP_ROWS], h[ICCP_ROWS][ICCP_ROWS] = {{0}};
    for (size_t k = 0; k < ICCP_ROWS; ++k)
        g[k] = -p->target[k];
    for (size_t j = 0; j < p->m; ++j) {
        const double *c = p->columns + ICCP_ROWS * j;
        const double t = start[j] + dot(c, s->y), weight = t >= 0 ? 1 : p->slope;
        for (size_t k = 0; k < ICCP_ROWS; ++k)
            g[k] += weight * t * c[k];
        for (size_t r = 0; r < ICCP_ROWS; ++r)
            for (size_t k = 0; k < ICCP_ROWS; ++k)
                h[r][k] += weight * c[r] * c[k];
    }
    for (size_t r = 0; r < ICCP_ROWS; ++r) {
        s->g[r] = g[r];
        for (size_t k = 0; k < ICCP_ROWS; ++k)
            s->h[r][k] = h[r][k];
    }
}

/* step = -(h + shift)^-1 g, by LDL^T. */
static void newton_step(const state *s, double shift, double *step)
{
    double l[ICCP_ROWS][ICCP_ROWS], d[ICCP_ROWS];
    for (size_t c = 0; c < ICCP_ROWS; ++c) {
        double pivot = s->h[c][c] + shift;
        for (size_t k = 0; k < c; ++k)
            pivot -= l[c][k] * l[c][k] * d[k];
        /* Below the shift there is only rounding. */
        d[c] = fmax(pivot, shift);
        for (size_t r = c + 1; r < ICCP_ROWS; ++r) {
            double sum = s->h[r][c];
            for (size_t k = 0; k < c; ++k)
                sum -= l[r][k] * l[c][k] * d[k];
            l[r][c] = sum / d[c];
        }
    }
    for (size_t r = 0; r < ICCP_ROWS; ++r) {
        step[r] = -s->g[r];
        for (size_t k = 0; k < r; ++k)
            step[r] -= l[r][k] * step[k];
    }
    for (size_t r = ICCP_ROWS; r-- > 0;) {
        step[r] /= d[r];
        for (size_t k = r + 1; k < ICCP_ROWS; ++k)
            step[r] -= l[k][r] * step[k];
    }
}

/* Goes along the step to where the dual function rises no longer steeply: all of it, or less. */
static void advance(const iccp_nonneg *p, const double *start, const double *step, state *s)
{
    const state from = *s;
    const double fall = dot(from.g, step);
    double share = 1, low = 0, high = 1, low_slope = fall;
    for (int cut = 0; cut < MOST_CUTS; ++cut) {
        for (size_t k = 0; k < ICCP_ROWS; ++k)
            s->y[k] = from.y[k] + share * step[k];
        evaluate(p, start, s);
        const double slope = dot(s->g, step);
        if (slope <= -0.5 * fall && (share >= 1 || slope >= 0.5 * fall))
            return;
        if (slope > 0) {
            high = share;
            /* The zero of the slope if that were linear, but not too near to the ends. */
            share = low + (high - low) * fmin(fmax(low_slope / (low_slope - slope), 0.1), 0.9);
        } else {
            low = share;
            low_slope = slope;
            share = 0.5 * (low + high);
        }
    }
}

/* Whether g shows that no x meets the equations: all columns, times the total, lie on one side of a plane and the
 * target on the other, farther than by rounding. */
static bool separates(const iccp_nonneg *p, const double *g, double tolerance)
{
    double least = HUGE_VAL;
    for (size_t j = 0; j < p->m; ++j)
        least = fmin(least, dot(g, p->columns + ICCP_ROWS * j));
    return p->total * least > dot(g, p->target) + tolerance * sqrt(dot(g, g));
}

static void finish(const iccp_nonneg *p, const double *y, double *x)
{
    for (size_t j = 0; j < p->m; ++j) {
        const double t = x[j] + dot(p->columns + ICCP_ROWS * j, y);
        x[j] = t >= 0 ? t : p->slope * t;
    }
}

bool iccp_nonneg_solve(const iccp_nonneg *problem, double *x)
{
    const bool may_fail = problem->slope <= 0 && problem->total < HUGE_VAL;
    state s = {.y = {0}};
    double size = sqrt(dot(problem->target, problem->target)), before = HUGE_VAL;
    for (size_t j = 0; j < problem->m; ++j)
        size = fmax(size, fabs(x[j]));
    evaluate(problem, x, &s);
    for (int k = 0; k < MOST_STEPS; ++k) {
        double step[ICCP_ROWS];
        const double error = sqrt(dot(s.g, s.g));
        if (error <= TIGHT * size || (error >= 0.5 * before && error <= LOOSE * size)) {
            finish(problem, s.y, x);
            return true;
        }
        if (may_fail && k > 1 && separates(problem, s.g, LOOSE * size))
            return false;
        newton_step(&s, DAMPING * error, step);
        advance(problem, x, step, &s);
        before = error;
    }
    return false;
}

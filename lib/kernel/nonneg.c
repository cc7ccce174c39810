/* Based on: Sakaridis, Kernel Coordinates (ETH Zurich 2016), section 4.1. The quadratic program of
 * a point has as many unknowns as there are handles, but only dim + 1 equations. Its dual has one
 * unknown per equation and no inequality: with x = max(0, start + C'y) minimise the convex function
 * |x|^2 / 2 - target'y, whose derivative g = Cx - target is piecewise linear. Newton's method on it
 * ends after a few steps: it is exact once the set of positive x is the right one.
 *
 * On the faces of the handles' hull the matrix of the pieces is singular, and undamped steps do not
 * get there. So a multiple of |g| is added to its diagonal, and steps that go too far are
 * shortened. */
#include "kernel/nonneg.h"

#include "base/minmax.h"

#include <float.h>
#include <math.h>

/* Of |g|: added to the diagonal. */
static const double DAMPING = 1e-6;
/* Of the size of the numbers: g is rounding. */
static const double TIGHT = 16 * DBL_EPSILON;
/* The same: the target lies outside what the columns reach. */
static const double OUTSIDE = 1e-11;
/* Of the slope at the start of a step: at its end. */
static const double STEEP = 0.5;
/* Without a solution after so many steps, and half as many as there are components, the sure way is
 * taken. */
enum { FEW_STEPS = 12, MOST_STEPS = 100, MOST_CUTS = 20 };

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
static void evaluate(const iccp_nonneg *p, double slope, const double *start, state *s)
{
    double g[ICCP_ROWS], h[ICCP_ROWS][ICCP_ROWS] = {{0}};
    for (size_t k = 0; k < ICCP_ROWS; ++k)
        g[k] = -p->target[k];
    for (size_t j = 0; j < p->m; ++j) {
        const double *c = p->columns + ICCP_ROWS * j;
        const double t = start[j] + dot(c, s->y), weight = t >= 0 ? 1 : slope;
        if (!(weight > 0))
            continue;
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
        d[c] = iccp_max(pivot, shift);
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
static void advance(const iccp_nonneg *p, double slope, const double *start, const double *step,
                    state *s)
{
    const state from = *s;
    const double fall = dot(from.g, step);
    double share = 1, low = 0, high = 1, low_rise = fall;
    for (int cut = 0; cut < MOST_CUTS; ++cut) {
        for (size_t k = 0; k < ICCP_ROWS; ++k)
            s->y[k] = from.y[k] + share * step[k];
        evaluate(p, slope, start, s);
        const double rise = dot(s->g, step);
        if (rise <= -STEEP * fall && (share >= 1 || rise >= STEEP * fall))
            return;
        if (rise > 0) {
            high = share;
            /* Where the rise would be 0 if it were linear, but not too near to the ends. */
            share = low + (high - low) * iccp_min(iccp_max(low_rise / (low_rise - rise), 0.1), 0.9);
        } else {
            low = share;
            low_rise = rise;
            share = 0.5 * (low + high);
        }
    }
}

/* Whether a direction shows that no x meets the equations: the target lies farther along it than
 * all columns, times the total, by more than rounding. Where there is no solution, steps turn into
 * such a direction: they become normal to the columns with positive x. */
static bool separates(const iccp_nonneg *p, const double *step, double tolerance)
{
    const double target = dot(step, p->target) - tolerance * sqrt(dot(step, step));
    for (size_t j = 0; j < p->m; ++j)
        if (p->total * dot(step, p->columns + ICCP_ROWS * j) >= target)
            return false;
    return true;
}

typedef enum outcome { SOLVED, UNSOLVED, UNSOLVABLE } outcome;

/* Newton's method on the dual of one point, from y = 0; x, of m components, is the start and, if
 * SOLVED, the solution. With slope > 0 negative components are allowed at 1 / slope times the
 * cost. A step along which the dual function falls without end shows that there is no solution. */
static outcome iterate(const iccp_nonneg *p, double slope, size_t steps, double *x)
{
    state s = {.y = {0}};
    double size = sqrt(dot(p->target, p->target));
    for (size_t j = 0; j < p->m; ++j)
        size = iccp_max(size, fabs(x[j]));
    evaluate(p, slope, x, &s);
    for (size_t k = 0; k <= steps; ++k) {
        double step[ICCP_ROWS];
        const double error = sqrt(dot(s.g, s.g));
        const double multiplier = slope > 0 ? sqrt(dot(s.y, s.y)) : 0;
        if (error <= TIGHT * iccp_max(size, multiplier)) {
            for (size_t j = 0; j < p->m; ++j) {
                const double t = x[j] + dot(p->columns + ICCP_ROWS * j, s.y);
                x[j] = t >= 0 ? t : slope > 0 ? slope * t : 0;
            }
            return SOLVED;
        }
        newton_step(&s, DAMPING * error, step);
        if (slope <= 0 && p->total < HUGE_VAL && separates(p, step, OUTSIDE * size))
            return UNSOLVABLE;
        advance(p, slope, x, step, &s);
    }
    return UNSOLVED;
}

bool iccp_nonneg_solve(const iccp_nonneg *problem, double *x, double *work)
{
    const outcome end = iterate(problem, 0, FEW_STEPS + problem->m / 2, x);
    return end == SOLVED || (end == UNSOLVED && iccp_dual_solve(problem, x, work));
}

bool iccp_nonneg_relax(const iccp_nonneg *problem, double slope, double *x)
{
    return iterate(problem, slope, MOST_STEPS, x) == SOLVED;
}

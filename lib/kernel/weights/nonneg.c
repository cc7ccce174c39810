/* The nearest point without negative components, by Newton's method on the dual. Based on:
 * Sakaridis, Kernel Coordinates (ETH Zurich 2016), section 4.1.
 *
 * The quadratic program of a point has as many unknowns as there are handles, but only dim + 1
 * equations. Its dual has one unknown per equation and no inequality. With x = max(0, start + C'y)
 * it minimises the convex function |x|^2 / 2 - target'y. The derivative of that is g = Cx - target,
 * which is piecewise linear. Newton's method on it ends after a few steps, because it is exact once
 * the set of positive x is right.
 *
 * On the faces of the handles' hull the matrix of the pieces is singular, and undamped steps do not
 * reach them. So a multiple of |g| is added to its diagonal, and steps that go too far are
 * shortened. */
#include "kernel/weights/nonneg.h"

#include "base/compiler.h"
#include "base/minmax.h"

#include <float.h>
#include <math.h>

/* Multiple of |g| that is added to the diagonal. */
static const double DAMPING = 1e-6;
/* A g smaller than this share of the size of the numbers is rounding. */
static const double TIGHT = 16 * DBL_EPSILON;
/* If the remainder is larger than this share of that size, the columns do not reach the target. */
static const double OUTSIDE = 1e-11;
/* Largest slope at the end of a step, as a share of that at its start. */
static const double STEEP = 0.5;
/* If there is no solution after FEW_STEPS plus half as many steps as components, the reliable
 * method takes over. */
enum { FEW_STEPS = 12, MOST_STEPS = 100, MOST_CUTS = 20 };

/* The code below is compiled for three and for four equations. `rows` is a constant wherever it is
 * a parameter, loops of a fixed length are unrolled, and numbers stay in registers. */

typedef struct state {
    double y[ICCP_ROWS];
    double g[ICCP_ROWS];
    double h[ICCP_ROWS][ICCP_ROWS]; /* derivative of g */
} state;

static ICCP_INLINE double dot(const double *a, const double *b)
{
    return (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]);
}

/* Computes everything at y in one pass over the columns. `first` says that y is 0. */
static ICCP_INLINE void evaluate(const iccp_nonneg *p, size_t rows, double slope,
                                 const double *start, state *s, bool first)
{
    double g[ICCP_ROWS], h[ICCP_ROWS][ICCP_ROWS] = {{0}};
    for (size_t k = 0; k < ICCP_ROWS; ++k)
        g[k] = -p->target[k];
    for (size_t j = 0; j < p->m; ++j) {
        const double *c = p->columns + ICCP_ROWS * j;
        const double t = first ? start[j] : start[j] + dot(c, s->y), weight = t >= 0 ? 1 : slope;
        if (!(weight > 0))
            continue;
        for (size_t k = 0; k < ICCP_ROWS; ++k)
            g[k] += weight * t * c[k];
        for (size_t r = 0; r < rows; ++r)
            for (size_t k = 0; k < ICCP_ROWS; ++k)
                h[r][k] += weight * c[r] * c[k];
    }
    for (size_t k = 0; k < ICCP_ROWS; ++k)
        s->g[k] = g[k];
    for (size_t r = 0; r < rows; ++r)
        for (size_t k = 0; k < ICCP_ROWS; ++k)
            s->h[r][k] = h[r][k];
}

/* Returns a pivot. Below the shift there is only rounding. */
static ICCP_INLINE double pivot_of(double x, double shift)
{
    return iccp_max(x, shift);
}

/* Computes step = -(h + shift)^-1 g by LDL^T. The code is written out, because compilers do not
 * unroll triangles. */
static ICCP_INLINE void newton_step(const state *s, size_t rows, double shift, double *step)
{
    const double(*h)[ICCP_ROWS] = s->h, *g = s->g;
    const double d0 = pivot_of(h[0][0] + shift, shift);
    const double l10 = h[1][0] / d0, l20 = h[2][0] / d0;
    const double d1 = pivot_of(h[1][1] + shift - l10 * l10 * d0, shift);
    const double l21 = (h[2][1] - l20 * l10 * d0) / d1;
    const double d2 = pivot_of(h[2][2] + shift - l20 * l20 * d0 - l21 * l21 * d1, shift);
    const double y0 = -g[0], y1 = -g[1] - l10 * y0, y2 = -g[2] - l20 * y0 - l21 * y1;
    double l30 = 0, l31 = 0, l32 = 0;
    step[3] = 0;
    if (rows == 4) {
        l30 = h[3][0] / d0;
        l31 = (h[3][1] - l30 * l10 * d0) / d1;
        l32 = (h[3][2] - l30 * l20 * d0 - l31 * l21 * d1) / d2;
        const double rest = h[3][3] + shift - l30 * l30 * d0 - l31 * l31 * d1 - l32 * l32 * d2;
        step[3] = (-g[3] - l30 * y0 - l31 * y1 - l32 * y2) / pivot_of(rest, shift);
    }
    step[2] = y2 / d2 - l32 * step[3];
    step[1] = y1 / d1 - l21 * step[2] - l31 * step[3];
    step[0] = y0 / d0 - l10 * step[1] - l20 * step[2] - l30 * step[3];
}

/* Goes along the step to where the dual function no longer rises steeply: all of it, or less. */
static ICCP_INLINE void advance(const iccp_nonneg *p, size_t rows, double slope,
                                const double *start, const double *step, state *s)
{
    const double from[ICCP_ROWS] = {s->y[0], s->y[1], s->y[2], s->y[3]};
    const double fall = dot(s->g, step);
    double share = 1, low = 0, high = 1, low_rise = fall;
    for (int cut = 0; cut < MOST_CUTS; ++cut) {
        for (size_t k = 0; k < ICCP_ROWS; ++k)
            s->y[k] = from[k] + share * step[k];
        evaluate(p, rows, slope, start, s, false);
        const double rise = dot(s->g, step);
        if (rise <= -STEEP * fall && (share >= 1 || rise >= STEEP * fall))
            return;
        if (rise > 0) {
            high = share;
            /* The place where the rise would be 0 if it were linear, but not too near to the
             * ends. */
            share = low + (high - low) * iccp_min(iccp_max(low_rise / (low_rise - rise), 0.1), 0.9);
        } else {
            low = share;
            low_rise = rise;
            share = 0.5 * (low + high);
        }
    }
}

/* Tests whether a direction proves that no x satisfies the equations. That is so if the target lies
 * farther along it than all columns times the total, by more than rounding. If there is no
 * solution, steps turn into such a direction: they become normal to the columns with positive x. */
static ICCP_INLINE bool separates(const iccp_nonneg *p, const double *step, double tolerance)
{
    const double target = dot(step, p->target) - tolerance * sqrt(dot(step, step));
    for (size_t j = 0; j < p->m; ++j)
        if (p->total * dot(step, p->columns + ICCP_ROWS * j) >= target)
            return false;
    return true;
}

typedef enum outcome { SOLVED, UNSOLVED, UNSOLVABLE } outcome;

/* Runs Newton's method on the dual of one point, from y = 0. x, of m components, is the start and,
 * if the result is SOLVED, the solution. With slope > 0, negative components are allowed at 1 /
 * slope times the cost. If the dual function falls without end along a step, there is no
 * solution. */
static ICCP_INLINE outcome iterate_rows(const iccp_nonneg *p, size_t rows, double slope,
                                        size_t steps, double *x)
{
    state s;
    double size = sqrt(dot(p->target, p->target));
    for (size_t j = 0; j < p->m; ++j)
        size = iccp_max(size, fabs(x[j]));
    for (size_t k = 0; k < ICCP_ROWS; ++k)
        s.y[k] = 0;
    evaluate(p, rows, slope, x, &s, true);
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
        newton_step(&s, rows, DAMPING * error, step);
        if (slope <= 0 && p->total < HUGE_VAL && separates(p, step, OUTSIDE * size))
            return UNSOLVABLE;
        advance(p, rows, slope, x, step, &s);
    }
    return UNSOLVED;
}

static outcome iterate(const iccp_nonneg *p, double slope, size_t steps, double *x)
{
    return p->rows == 3 ? iterate_rows(p, 3, slope, steps, x) : iterate_rows(p, 4, slope, steps, x);
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

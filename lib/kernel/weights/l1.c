/* Least sum of absolute values. Based on: Sakaridis, Kernel Coordinates (ETH Zurich 2016), section
 * 4.4, equation 4.8.
 *
 * It has many solutions at most points. Often every x >= 0 that satisfies the equations is one,
 * because these fix the sum of x. That case is tried first. Otherwise the simplex method solves the
 * linear program with dim + 1 rows. By duality, its solutions are the x that satisfy the equations
 * and two more conditions. x is 0 where |column'y| < 1, and has the sign of column'y where that is
 * 1 or -1. Of these, the one with the least sum of squares is found as in the first case. */
#include "kernel/weights/l1.h"

#include "base/minmax.h"

#include <assert.h>
#include <math.h>

/* Tolerance within which |column'y| counts as 1. Solving for y with columns of length up to 1 loses
 * a few digits. */
static const double TIGHT = 1e-9;
/* A basic x below this share of the target is 0. */
static const double ZERO = 1e-12;
enum { MOST_STEPS = 1000 };

typedef struct basis {
    uint32_t column[ICCP_ROWS];
    double sign[ICCP_ROWS]; /* sign of each basic x; kept while x is 0 */
    double x[ICCP_ROWS], y[ICCP_ROWS];
    double lu[ICCP_ROWS][ICCP_ROWS];
    size_t order[ICCP_ROWS]; /* row of the matrix that is row r of `lu` */
} basis;

/* Computes the LU factorisation, with partial pivoting, of the matrix of basic columns. */
static void factorise(const iccp_l1 *p, basis *b)
{
    const size_t n = p->rows;
    for (size_t r = 0; r < n; ++r) {
        b->order[r] = r;
        for (size_t c = 0; c < n; ++c)
            b->lu[r][c] = p->columns[ICCP_ROWS * b->column[c] + r];
    }
    for (size_t c = 0; c < n; ++c) {
        size_t best = c;
        for (size_t r = c + 1; r < n; ++r)
            if (fabs(b->lu[r][c]) > fabs(b->lu[best][c]))
                best = r;
        const size_t row = b->order[c];
        b->order[c] = b->order[best];
        b->order[best] = row;
        for (size_t k = 0; k < n; ++k) {
            const double entry = b->lu[c][k];
            b->lu[c][k] = b->lu[best][k];
            b->lu[best][k] = entry;
        }
        for (size_t r = c + 1; r < n; ++r) {
            b->lu[r][c] /= b->lu[c][c];
            for (size_t k = c + 1; k < n; ++k)
                b->lu[r][k] -= b->lu[r][c] * b->lu[c][k];
        }
    }
}

static void solve(const basis *b, size_t n, const double *right, double *out)
{
    for (size_t r = 0; r < n; ++r) {
        out[r] = right[b->order[r]];
        for (size_t k = 0; k < r; ++k)
            out[r] -= b->lu[r][k] * out[k];
    }
    for (size_t r = n; r-- > 0;) {
        for (size_t k = r + 1; k < n; ++k)
            out[r] -= b->lu[r][k] * out[k];
        out[r] /= b->lu[r][r];
    }
}

static void solve_transpose(const basis *b, size_t n, const double *right, double *out)
{
    double z[ICCP_ROWS];
    for (size_t r = 0; r < n; ++r) {
        z[r] = right[r];
        for (size_t k = 0; k < r; ++k)
            z[r] -= b->lu[k][r] * z[k];
        z[r] /= b->lu[r][r];
    }
    for (size_t r = n; r-- > 0;)
        for (size_t k = r + 1; k < n; ++k)
            z[r] -= b->lu[k][r] * z[k];
    for (size_t r = 0; r < n; ++r)
        out[b->order[r]] = z[r];
}

static double slack(const iccp_l1 *p, const double *y, size_t j)
{
    double sum = 0;
    for (size_t k = 0; k < p->rows; ++k)
        sum += y[k] * p->columns[ICCP_ROWS * j + k];
    return sum;
}

/* Returns the column with the greatest |column'y| above 1, or m if there is none. */
static size_t entering(const iccp_l1 *p, const double *y)
{
    double most = 1 + TIGHT;
    size_t best = p->m;
    for (size_t j = 0; j < p->m; ++j) {
        const double size = fabs(slack(p, y, j));
        if (size <= most)
            continue;
        best = j;
        most = size;
    }
    return best;
}

/* Returns which basic x becomes 0 first as that of column j grows; in ties the one with the lowest
 * column. */
static size_t leaving(const iccp_l1 *p, const basis *b, size_t j, double sign)
{
    double change[ICCP_ROWS], least = HUGE_VAL;
    size_t best = p->rows;
    solve(b, p->rows, p->columns + ICCP_ROWS * j, change);
    for (size_t k = 0; k < p->rows; ++k) {
        const double speed = sign * change[k] * b->sign[k];
        if (speed <= ZERO)
            continue;
        const double when = iccp_max(b->x[k] * b->sign[k], 0) / speed;
        if (best == p->rows || when < least - ZERO ||
            (when <= least + ZERO && b->column[k] < b->column[best])) {
            least = iccp_min(least, when);
            best = k;
        }
    }
    return best;
}

/* Goes from the initial basis to an optimal one. */
static void optimise(const iccp_l1 *p, basis *b)
{
    for (size_t k = 0; k < p->rows; ++k)
        b->column[k] = p->start[k];
    factorise(p, b);
    solve(b, p->rows, p->target, b->x);
    for (size_t k = 0; k < p->rows; ++k)
        b->sign[k] = b->x[k] < 0 ? -1 : 1;
    for (int step = 0; step < MOST_STEPS; ++step) {
        solve_transpose(b, p->rows, b->sign, b->y);
        const size_t j = entering(p, b->y);
        if (j == p->m)
            return;
        const double sign = slack(p, b->y, j) < 0 ? -1 : 1;
        const size_t k = leaving(p, b, j, sign);
        if (k == p->rows)
            return; /* happens only by rounding: |x| cannot fall forever */
        b->column[k] = (uint32_t)j;
        b->sign[k] = sign;
        factorise(p, b);
        solve(b, p->rows, p->target, b->x);
    }
}

/* Finds the solution with the least sum of squares, over the columns where |column'y| = 1, with its
 * sign. If rounding hides it, the basic solution is taken, as once in test_handle_weights.c. */
static void least_squares(const iccp_l1 *p, const basis *b, double *x, double *work)
{
    double *columns = work, *part = work + ICCP_ROWS * p->m;
    iccp_nonneg face = {.rows = p->rows, .columns = columns, .total = HUGE_VAL};
    for (size_t k = 0; k < ICCP_ROWS; ++k)
        face.target[k] = p->target[k];
    for (size_t j = 0; j < p->m; ++j) {
        const double side = slack(p, b->y, j);
        x[j] = fabs(side) < 1 - TIGHT ? 0 : copysign(1, side);
        if (x[j] > -0.5 && x[j] < 0.5)
            continue;
        part[face.m] = 0;
        for (size_t k = 0; k < ICCP_ROWS; ++k)
            columns[ICCP_ROWS * face.m + k] = x[j] * p->columns[ICCP_ROWS * j + k];
        ++face.m;
    }
    if (iccp_nonneg_solve(&face, part, part + p->m)) {
        for (size_t j = 0, f = 0; j < p->m; ++j)
            if (x[j] > 0.5 || x[j] < -0.5)
                x[j] *= part[f++];
        return;
    }
    for (size_t j = 0; j < p->m; ++j)
        x[j] = 0;
    for (size_t k = 0; k < p->rows; ++k)
        x[b->column[k]] = b->x[k];
}

size_t iccp_l1_work(size_t m)
{
    return (ICCP_ROWS + 1) * m + iccp_dual_work(m);
}

void iccp_l1_solve(const iccp_l1 *problem, double *x, double *work)
{
    iccp_l1 p = *problem;
    double size = 0;
    for (size_t k = 0; k < ICCP_ROWS; ++k)
        size = iccp_max(size, fabs(p.target[k]));
    for (size_t j = 0; j < p.m; ++j)
        x[j] = 0;
    if (size <= 0)
        return;
    const double scale = (p.total < 0 ? -1 : 1) * size;
    for (size_t k = 0; k < ICCP_ROWS; ++k)
        p.target[k] /= scale;
    p.total /= scale;
    iccp_nonneg positive = {.m = p.m, .rows = p.rows, .columns = p.columns, .total = p.total};
    for (size_t k = 0; k < ICCP_ROWS; ++k)
        positive.target[k] = p.target[k];
    if (!iccp_nonneg_solve(&positive, x, work)) {
        basis b;
        optimise(&p, &b);
        least_squares(&p, &b, x, work);
    }
    for (size_t j = 0; j < p.m; ++j)
        x[j] *= scale;
}

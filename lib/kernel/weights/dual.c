/* The nearest point without negative components, by a dual method. Based on: Goldfarb and Idnani, A
 * numerically stable dual method for solving strictly convex quadratic programs, Mathematical
 * Programming 27 (1983).
 *
 * It starts from the nearest x that satisfies the equations. One negative x[p] after another is
 * raised to 0 by a force on it, and held there. That changes the forces on the held components. A
 * component whose force would have to pull is released. The cost grows with every step, so the
 * method ends, either with no negative x[p] or with one that nothing can raise.
 *
 * The equations are combined so that their rows are orthonormal over the free components. Then each
 * question is a product with one column, and rounding cannot hide what the columns span. Everything
 * follows from the set of held components and the force on x[p]. It is computed from these in every
 * step, so errors do not accumulate. */
#include "kernel/weights/dual.h"

#include "base/minmax.h"

#include <math.h>

/* Share of the size of the numbers: x[p] counts as not negative above minus this. */
static const double ZERO = 1e-13;
/* Least share of component p that neither the equations nor the held components fix. */
static const double LOOSE = 1e-12;
/* Smaller changes of a force, and smaller remainders of a row, are rounding. */
static const double CHANGES = 1e-11;
/* Steps per component. */
enum { MOST_STEPS = 20 };

typedef struct state {
    const iccp_nonneg *problem;
    const double *start;
    double *held;        /* 1 for held components, 0 for free ones */
    double *columns;     /* of the combined equations */
    double y[ICCP_ROWS]; /* x[j], or minus the force if it is held: start[j] + column j * y */
    size_t steps;        /* number of steps left */
} state;

static double dot(const double *a, const double *b)
{
    return (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]);
}

static const double *column(const state *s, size_t j)
{
    return s->columns + ICCP_ROWS * j;
}

static bool is_held(const state *s, size_t j)
{
    return s->held[j] > 0.5;
}

static double value(const state *s, size_t j)
{
    return s->start[j] + dot(column(s, j), s->y);
}

/* Returns the product of two rows over the free components. */
static double product(const state *s, size_t a, size_t b)
{
    double sum = 0;
    for (size_t j = 0; j < s->problem->m; ++j)
        if (!is_held(s, j))
            sum += column(s, j)[a] * column(s, j)[b];
    return sum;
}

/* Subtracts `share` of row `from` from row r, and divides the result. */
static void combine(state *s, double *target, size_t r, size_t from, double share, double divide)
{
    for (size_t j = 0; j < s->problem->m; ++j) {
        double *c = s->columns + ICCP_ROWS * j;
        c[r] = (c[r] - share * c[from]) * divide;
    }
    target[r] = (target[r] - share * target[from]) * divide;
}

/* Finds the nearest x that satisfies the equations, with the held components at 0. */
static void solve_held(state *s)
{
    const iccp_nonneg *p = s->problem;
    double target[ICCP_ROWS];
    for (size_t k = 0; k < ICCP_ROWS * p->m; ++k)
        s->columns[k] = p->columns[k];
    for (size_t r = 0; r < ICCP_ROWS; ++r) {
        target[r] = p->target[r];
        for (size_t k = 0; k < 2 * r; ++k)
            combine(s, target, r, k % r, product(s, r, k % r), 1);
        const double length = sqrt(product(s, r, r));
        combine(s, target, r, r, 0, length > CHANGES ? 1 / length : 0);
    }
    for (size_t r = 0; r < ICCP_ROWS; ++r)
        s->y[r] = target[r];
    for (size_t j = 0; j < p->m; ++j)
        for (size_t r = 0; !is_held(s, j) && r < ICCP_ROWS; ++r)
            s->y[r] -= s->start[j] * column(s, j)[r];
}

/* Finds the held component whose force vanishes first as `push`, the force on p, grows, and by how
 * much it grows until then. Returns m if there is none. */
static size_t first_to_go(const state *s, size_t p, double push, double *growth)
{
    size_t first = s->problem->m;
    *growth = HUGE_VAL;
    for (size_t j = 0; j < s->problem->m; ++j) {
        const double loss = -dot(column(s, j), column(s, p));
        if (!is_held(s, j) || loss <= CHANGES)
            continue;
        const double when = iccp_max(-value(s, j) - push * loss, 0) / loss;
        if (when < *growth) {
            *growth = when;
            first = j;
        }
    }
    return first;
}

/* Raises x[p] to 0 and holds it. Returns false if nothing can. */
static bool raise_and_hold(state *s, size_t p)
{
    for (double push = 0; s->steps > 0; --s->steps) {
        const double speed = 1 - dot(column(s, p), column(s, p));
        const double need = speed > LOOSE ? -value(s, p) / speed - push : HUGE_VAL;
        double growth;
        const size_t go = first_to_go(s, p, push, &growth);
        if (speed <= LOOSE && go == s->problem->m)
            return false;
        const bool enough = need <= growth;
        s->held[enough ? p : go] = enough ? 1 : 0;
        solve_held(s);
        if (enough)
            return true;
        push += growth;
    }
    return false;
}

size_t iccp_dual_work(size_t m)
{
    return (ICCP_ROWS + 1) * m;
}

bool iccp_dual_solve(const iccp_nonneg *problem, double *x, double *work)
{
    const size_t m = problem->m;
    state s = {.problem = problem, .start = x, .held = work, .columns = work + m};
    double size = sqrt(dot(problem->target, problem->target));
    for (size_t j = 0; j < m; ++j) {
        s.held[j] = 0;
        size = iccp_max(size, fabs(x[j]));
    }
    s.steps = MOST_STEPS * m;
    solve_held(&s);
    for (;;) {
        double least = -ZERO * size;
        size_t p = m;
        for (size_t j = 0; j < m; ++j)
            if (!is_held(&s, j) && value(&s, j) < least) {
                least = value(&s, j);
                p = j;
            }
        if (p == m)
            break;
        if (!raise_and_hold(&s, p))
            return false;
    }
    for (size_t j = 0; j < m; ++j)
        x[j] = is_held(&s, j) ? 0 : iccp_max(value(&s, j), 0);
    return true;
}

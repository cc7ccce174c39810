/* Conjugate gradients for the tied problem. The preconditioner is P+ M P+', with the V-cycle M and
 * P+ = (P'P)^-1 P', the weighted average over each top and its members. If M is exact, its inverse
 * is at most P'LP for any ties, and nearly equal where functions are smooth. It takes two to three
 * times the iterations that M takes without ties. (Adding a Jacobi step for each top increases
 * their number.) */
#include "gradient/solver/tied_cg.h"

#include "base/budget.h"
#include "base/minmax.h"

#include <math.h>
#include <string.h>

enum { LANES = ICCP_MG_LANES };

double iccp_mg_dot(size_t n, const double *a, const double *b)
{
    double lanes[LANES] = {0}, sum = 0;
    size_t i = 0;
    for (; i + LANES <= n; i += LANES)
        for (size_t j = 0; j < LANES; ++j)
            lanes[j] += a[i + j] * b[i + j];
    for (size_t j = 0; i + j < n; ++j)
        lanes[j] += a[i + j] * b[i + j];
    for (size_t j = 0; j < LANES; ++j)
        sum += lanes[j];
    return sum;
}

/* Computes one run of L x. n_near is a constant in every call. */
static ICCP_INLINE void apply_run(const double *x, double *restrict y, const double *const *near,
                                  size_t n, int32_t n_near)
{
    for (size_t i = 0; i < n; ++i) {
        double sum = near[0][i] + near[1][i];
        for (int32_t j = 2; j < n_near; ++j)
            sum += near[j][i];
        y[i] = n_near * x[i] - sum;
    }
}

/* y = L x */
static void laplacian(const iccp_mg_level *level, const double *x, double *y)
{
    for (size_t row = 0; row < level->n_rows; ++row)
        for (int half = 0; half < 2; ++half) {
            const iccp_mg_run *end, *run = iccp_mg_runs(level, row, half, &end);
            for (; run < end; ++run) {
                size_t offset[2 * ICC_MAX_DIM];
                const double *near[2 * ICC_MAX_DIM];
                const size_t at = iccp_mg_near(level, row, half, run->begin, offset);
                const size_t n = run->end - run->begin;
                for (int32_t j = 0; j < 2 * level->dim; ++j)
                    near[j] = x + offset[j];
                if (level->dim == 2)
                    apply_run(x + at, y + at, near, n, 4);
                else if (level->dim == 3)
                    apply_run(x + at, y + at, near, n, 6);
                else
                    apply_run(x + at, y + at, near, n, 2 * level->dim);
            }
        }
}

void iccp_tied_apply(const iccp_mg_level *level, size_t n_tied, const iccp_tie *tie, double *x,
                     double *y)
{
    for (size_t i = 0; i < n_tied; ++i)
        x[tie[i].member] = tie[i].share * x[tie[i].top];
    laplacian(level, x, y);
    for (size_t i = 0; i < n_tied; ++i) {
        y[tie[i].top] += tie[i].share * y[tie[i].member];
        y[tie[i].member] = 0;
    }
}

/* A top with members. */
typedef struct tied_top {
    size_t at;
    double weight; /* diagonal entry of P'P */
} tied_top;

typedef struct solver {
    iccp_multigrid *mg;
    const iccp_mg_level *level;
    size_t n, n_tied, n_tops;
    const iccp_tie *tie;
    tied_top *top;
    double *x, *r, *p, *q;
} solver;

static void find_tops(solver *s)
{
    for (size_t i = 0; i < s->n_tied; ++i) {
        if (i == 0 || s->tie[i].top != s->tie[i - 1].top)
            s->top[s->n_tops++] = (tied_top){s->tie[i].top, 1};
        s->top[s->n_tops - 1].weight += s->tie[i].share * s->tie[i].share;
    }
}

/* Computes z = P+ M P+' r, with z in the level's x. */
static void precondition(solver *s)
{
    float *b = s->level->b, *z = s->level->x;
    for (size_t i = 0; i < s->n; ++i)
        b[i] = (float)s->r[i];
    for (size_t i = 0; i < s->n_tops; ++i)
        b[s->top[i].at] = (float)(s->r[s->top[i].at] / s->top[i].weight);
    for (size_t i = 0; i < s->n_tied; ++i)
        b[s->tie[i].member] = (float)s->tie[i].share * b[s->tie[i].top];
    iccp_multigrid_cycle(s->mg);
    for (size_t i = 0; i < s->n_tied; ++i) {
        z[s->tie[i].top] += (float)s->tie[i].share * z[s->tie[i].member];
        z[s->tie[i].member] = 0;
    }
    for (size_t i = 0; i < s->n_tops; ++i)
        z[s->top[i].at] /= (float)s->top[i].weight;
}

static bool is_reached(const solver *s, double rr, double size, const iccp_mg_goal *goal)
{
    if (!(sqrt(rr) <= goal->relative * size))
        return false;
    double peak = 0;
    for (size_t i = 0; i < s->n; ++i)
        peak = s->x[i] > peak ? s->x[i] : peak;
    const double least = goal->floor * peak, bound = goal->componentwise * 2 * s->level->dim;
    for (size_t i = 0; i < s->n; ++i)
        if (fabs(s->r[i]) > bound * (s->x[i] > least ? s->x[i] : least))
            return false;
    return true;
}

static double dot_float(size_t n, const double *a, const float *b)
{
    double lanes[LANES] = {0}, sum = 0;
    size_t i = 0;
    for (; i + LANES <= n; i += LANES)
        for (size_t j = 0; j < LANES; ++j)
            lanes[j] += a[i + j] * (double)b[i + j];
    for (size_t j = 0; i + j < n; ++j)
        lanes[j] += a[i + j] * (double)b[i + j];
    for (size_t j = 0; j < LANES; ++j)
        sum += lanes[j];
    return sum;
}

/* Preconditioned conjugate gradients as in every textbook, on the tops. The entries of members in
 * r, p and q stay 0, or iccp_tied_apply() fills them in. Ends when the goal is reached. Fails if
 * the residual has not fallen for ICCP_CG_PATIENCE iterations. */
static icc_status iterate(solver *s, double size, const iccp_mg_goal *goal, size_t *n_iterations,
                          const iccp_env *env)
{
    double rr = iccp_mg_dot(s->n, s->r, s->r), least = HUGE_VAL, rz = 1;
    size_t since = 0;
    while (!is_reached(s, rr, size, goal)) {
        since = rr < least ? 0 : since + 1;
        least = iccp_min(rr, least);
        if (!isfinite(rr) || since > ICCP_CG_PATIENCE)
            return ICC_ERR_SOLVER;
        icc_status status = iccp_progress(env, "solve", 0);
        if (status == ICC_OK)
            status = iccp_budget_work(env, ICCP_CG_WORK * (double)s->level->n_entries);
        if (status != ICC_OK)
            return status;
        precondition(s);
        const float *z = s->level->x;
        const double next = dot_float(s->n, s->r, z), beta = next / rz;
        for (size_t i = 0; i < s->n; ++i)
            s->p[i] = (double)z[i] + beta * s->p[i];
        rz = next;
        iccp_tied_apply(s->level, s->n_tied, s->tie, s->p, s->q);
        const double curvature = iccp_mg_dot(s->n, s->p, s->q);
        if (!(rz > 0 && curvature > 0))
            return ICC_ERR_SOLVER;
        const double alpha = rz / curvature;
        for (size_t i = 0; i < s->n; ++i) {
            s->x[i] += alpha * s->p[i];
            s->r[i] -= alpha * s->q[i];
        }
        rr = iccp_mg_dot(s->n, s->r, s->r);
        ++*n_iterations;
    }
    return ICC_OK;
}

icc_status iccp_tied_cg(iccp_multigrid *mg, size_t n_tied, const iccp_tie *tie, double *x,
                        double *r, double size, const iccp_mg_goal *goal, size_t *n_iterations,
                        const iccp_env *env)
{
    solver s = {.mg = mg,
                .level = &mg->level[0],
                .n = mg->level[0].n_entries,
                .n_tied = n_tied,
                .tie = tie,
                .x = x,
                .r = r};
    s.top = iccp_alloc(&mg->memory, n_tied, sizeof *s.top);
    s.p = iccp_alloc_zero(&mg->memory, s.n, sizeof *s.p);
    s.q = iccp_alloc_zero(&mg->memory, s.n, sizeof *s.q);
    icc_status status = ICC_ERR_MEMORY;
    if (s.top != NULL && s.p != NULL && s.q != NULL) {
        find_tops(&s);
        status = iterate(&s, size, goal, n_iterations, env);
    }
    iccp_free(&mg->memory, s.top);
    iccp_free(&mg->memory, s.p);
    iccp_free(&mg->memory, s.q);
    return status;
}

/* Based on: S. Mehrotra, On the implementation of a primal-dual interior point method, SIAM J.
 * Optim. 2,
 * 1992. With slacks s and multipliers y, each step solves
 *     A'A df - G' dy = -dual,   G df + (s / y) dy = -product / y - primal
 * by eliminating dy, which leaves A'A + G'WG with W = y / s. Where an inequality gets active, W
 * grows beyond all bounds and drowns A'A. So W = 1 / (s / y + softness) is factorised instead, and
 * the residuals of the two equations correct the step: M. Friedlander, D. Orban, A primal-dual
 * regularized interior-point method for convex quadratic programs, Math. Prog. Comp. 4, 2012,
 * section 5. */
#include "solver/interior_point.h"

#include "base/clock.h"
#include "base/minmax.h"

#include <math.h>
#include <string.h>

enum {
    MAX_ITERATIONS = 200,
    MAX_CORRECTIONS = 8,
    MAX_SOFTENINGS = 4,
    PATIENCE = 6 /* iterations that reduce the products by less than a tenth, and residuals
                    hardly */
};

/* Share of the first residuals: the products do not fall before. */
static const double NEARLY_FEASIBLE = 1e-6;

/* Weights are at most its inverse, which A'A, with entries up to 4 dim (dim + 1/2), can stand
 * beside. Between 1e-8 and 1e-5 the iterations are the same. */
static const double SOFTNESS = 1e-6;

/* The share of the way to the boundary that is gone. */
static const double SHORTEN = 0.995;

/* Least slacks and multipliers to start from; a power of ten more or less costs 2 iterations. */
static const double LEAST_SLACK = 0.01, LEAST_MULTIPLIER = 0.001;

/* A step that gets less far is taken towards the middle of the way instead. */
static const double SHORT_STEP = 0.01;

/* Error of a step, relative to the slacks. */
static const double PREDICTOR_ERROR = 0.5, CORRECTOR_ERROR = 0.1;

static size_t n_rows(const iccp_interior_point *p)
{
    return p->qp->unknowns->n;
}

static size_t n_pairs(const iccp_interior_point *p)
{
    return iccp_qp_inequalities(p->qp);
}

static double mean_product(const iccp_interior_point *p)
{
    double sum = 0;
    for (size_t i = 0; i < n_pairs(p); ++i)
        sum += p->slack[i] * p->multiplier[i];
    return sum / (double)n_pairs(p);
}

/* out = A'A f - G'y but for the root, which does not move. */
static void stationarity(const iccp_interior_point *p, const double *f, const double *y,
                         double *out)
{
    iccp_energy_gradient(&p->qp->a, f, p->work, out);
    for (size_t i = 0; i < n_pairs(p); ++i)
        p->work[i] = -y[i];
    iccp_qp_add_forces(p->qp, p->work, out);
    out[0] = 0;
}

static void find_residuals(iccp_interior_point *p)
{
    stationarity(p, p->f, p->multiplier, p->dual);
    iccp_qp_slacks(p->qp, p->f, false, p->primal);
    for (size_t i = 0; i < n_pairs(p); ++i)
        p->primal[i] -= p->slack[i];
}

/* ICC_ERR_SOLVER when the matrix is not positive definite however soft it gets. */
static icc_status factorise(iccp_interior_point *p, icc_function_info *info, const iccp_env *env)
{
    const double start = iccp_seconds();
    double *w = p->weight + p->qp->a.n_rows;
    icc_status status = ICC_ERR_SOLVER;
    for (int k = 0; k < MAX_SOFTENINGS && status == ICC_ERR_SOLVER; ++k) {
        p->softness *= k == 0 ? 1 : 100;
        for (size_t i = 0; i < n_pairs(p); ++i)
            w[i] = 1 / (p->slack[i] / p->multiplier[i] + p->softness);
        iccp_gram_fill(&p->gram, &p->b, p->weight);
        status = iccp_ldlt_factorise(&p->factor, &p->gram.matrix, env);
    }
    info->seconds_factor += iccp_seconds() - start;
    return status;
}

/* Adds to the step what solves the two equations for the right sides `force` and `gap`. */
static void add_solution(iccp_interior_point *p)
{
    const double *w = p->weight + p->qp->a.n_rows;
    for (size_t i = 0; i < n_pairs(p); ++i)
        p->work[i] = w[i] * p->gap[i];
    iccp_qp_add_forces(p->qp, p->work, p->force);
    p->force[0] = 0;
    iccp_ldlt_solve(&p->factor, 1, p->force + 1, p->work);
    iccp_qp_slacks(p->qp, p->force, true, p->work);
    for (size_t k = 1; k < n_rows(p); ++k)
        p->step_f[k] += p->force[k];
    for (size_t i = 0; i < n_pairs(p); ++i)
        p->step_multiplier[i] += w[i] * (p->gap[i] - p->work[i]);
}

/* What the step leaves of the two equations; returns the largest gap in units of its slack. */
static double find_errors(iccp_interior_point *p)
{
    double error = 0;
    stationarity(p, p->step_f, p->step_multiplier, p->force);
    for (size_t k = 1; k < n_rows(p); ++k)
        p->force[k] = -p->dual[k] - p->force[k];
    iccp_qp_slacks(p->qp, p->step_f, true, p->step_slack);
    for (size_t i = 0; i < n_pairs(p); ++i) {
        p->step_slack[i] += p->primal[i];
        p->gap[i] = -(p->product[i] + p->slack[i] * p->step_multiplier[i]) / p->multiplier[i] -
                    p->step_slack[i];
        error = iccp_max(error, fabs(p->gap[i]) / p->slack[i]);
    }
    return error;
}

/* The step for the present residuals and products. The first correction brings what softness left
 * out, so that the error may grow there. */
static void solve(iccp_interior_point *p, double tolerance)
{
    double last = HUGE_VAL;
    memset(p->step_f, 0, n_rows(p) * sizeof *p->step_f);
    memset(p->step_multiplier, 0, n_pairs(p) * sizeof *p->step_multiplier);
    for (int k = 0; k <= MAX_CORRECTIONS; ++k) {
        const double error = find_errors(p);
        if (k > 0 &&
            (error <= tolerance || k == MAX_CORRECTIONS || (k > 2 && !(error < 0.7 * last))))
            return;
        last = error;
        add_solution(p);
    }
}

/* How far one can go along a step before an entry gets zero, at most 1. */
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
    return iccp_min(reach(p->slack, p->step_slack, n_pairs(p)),
                    reach(p->multiplier, p->step_multiplier, n_pairs(p)));
}

/* Predictor: straight to products of 0. Corrector: to equal products, the smaller the further the
 * predictor got, with the predictor's second order terms. Where that leads into a wall, to
 * equal products alone. Returns the share of the residuals that a whole step makes up for. */
static double find_step(iccp_interior_point *p)
{
    const double mean = mean_product(p);
    for (size_t i = 0; i < n_pairs(p); ++i)
        p->product[i] = p->slack[i] * p->multiplier[i];
    solve(p, PREDICTOR_ERROR);
    const double length = step_length(p);
    double after = 0;
    for (size_t i = 0; i < n_pairs(p); ++i)
        after += (p->slack[i] + length * p->step_slack[i]) *
                 (p->multiplier[i] + length * p->step_multiplier[i]);
    after /= (double)n_pairs(p) * mean;
    for (size_t i = 0; i < n_pairs(p); ++i)
        p->product[i] += p->step_slack[i] * p->step_multiplier[i] - after * after * after * mean;
    solve(p, CORRECTOR_ERROR);
    if (step_length(p) >= SHORT_STEP)
        return 1;
    for (size_t i = 0; i < n_pairs(p); ++i) {
        p->product[i] = p->slack[i] * p->multiplier[i] - mean;
        p->primal[i] = 0;
    }
    memset(p->dual, 0, n_rows(p) * sizeof *p->dual);
    solve(p, CORRECTOR_ERROR);
    return 0;
}

static void take_step(iccp_interior_point *p, double length)
{
    for (size_t k = 1; k < n_rows(p); ++k)
        p->f[k] += length * p->step_f[k];
    for (size_t i = 0; i < n_pairs(p); ++i) {
        p->slack[i] += length * p->step_slack[i];
        p->multiplier[i] += length * p->step_multiplier[i];
    }
}

/* ICC_ERR_SOLVER when the step leads nowhere. */
static icc_status iterate(iccp_interior_point *p, icc_function_info *info, const iccp_env *env)
{
    find_residuals(p);
    const icc_status status = factorise(p, info, env);
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
                                   icc_function_info *info, const iccp_env *env)
{
    int patience = PATIENCE;
    double mean = mean_product(ip);
    *stuck = false;
    while (mean > target && !*stuck) {
        const double remaining = ip->remaining;
        const iccp_env part = iccp_round(env, ip->n_iterations, ICCP_INTERIOR_POINT_TYPICAL);
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

static void stack_energy(iccp_sparse *b, const iccp_sparse *a, size_t *end)
{
    for (size_t i = 0; i < a->n_rows; ++i) {
        b->first[i] = *end;
        for (size_t q = a->first[i]; q < a->first[i + 1]; ++q)
            if (a->column[q] > 0) {
                b->column[*end] = a->column[q] - 1;
                b->value[(*end)++] = a->value[q];
            }
    }
}

/* B = A above G, both without the column of the root, whose value is fixed. G has the rows of qp.h
 * in their order: edges, with 1 at the parent and -sigma at the child, then the leaves' bounds.
 * With weights 1 for the rows of A and W for those of G, B'WB is the matrix that each step solves
 * with. */
static icc_status stack(iccp_interior_point *p, const iccp_env *env)
{
    const iccp_sparse *a = &p->qp->a;
    const iccp_unknowns *unknowns = p->qp->unknowns;
    iccp_sparse *b = &p->b;
    const icc_status status = iccp_sparse_create(b, a->n_rows + n_pairs(p), unknowns->n - 1,
                                                 a->first[a->n_rows] + 2 * n_pairs(p), env);
    if (status != ICC_OK)
        return status;
    size_t end = 0, i = a->n_rows;
    stack_energy(b, a, &end);
    for (uint32_t k = 1; k < unknowns->n; ++k) {
        b->first[i++] = end;
        if (unknowns->parent[k] > 0) {
            b->column[end] = unknowns->parent[k] - 1;
            b->value[end++] = 1;
        }
        b->column[end] = k - 1;
        b->value[end++] = -p->qp->sigma;
    }
    for (size_t j = 0; j < p->qp->n_leaves; ++j) {
        b->first[i++] = end;
        b->column[end] = p->qp->leaf_unknown[j] - 1;
        b->value[end++] = 1;
    }
    b->first[i] = end;
    return ICC_OK;
}

static icc_status allocate(iccp_interior_point *p, const iccp_env *env)
{
    const size_t n = n_rows(p), m = n_pairs(p), n_energy = p->qp->a.n_rows;
    double **const of_rows[] = {&p->f, &p->dual, &p->step_f, &p->force};
    double **const of_pairs[] = {&p->slack,      &p->multiplier,      &p->primal, &p->product,
                                 &p->step_slack, &p->step_multiplier, &p->gap};
    const size_t n_arrays = sizeof of_pairs / sizeof *of_pairs;
    double *room =
        iccp_alloc(&env->memory, 2 * n_energy + 4 * n + (n_arrays + 2) * m, sizeof *room);
    p->room = room;
    if (room == NULL)
        return ICC_ERR_MEMORY;
    for (size_t k = 0; k < sizeof of_rows / sizeof *of_rows; ++k, room += n)
        *of_rows[k] = room;
    for (size_t k = 0; k < n_arrays; ++k, room += m)
        *of_pairs[k] = room;
    p->weight = room;
    p->work = room + n_energy + m;
    return ICC_OK;
}

/* Slacks and multipliers of the function with the least energy and sum of squared slacks, where
 * they are positive and large enough. */
static icc_status start(iccp_interior_point *p, icc_function_info *info, const iccp_env *env)
{
    const size_t n = n_rows(p), m = n_pairs(p), n_energy = p->qp->a.n_rows;
    for (size_t i = 0; i < n_energy; ++i)
        p->weight[i] = 1;
    for (size_t i = 0; i < m; ++i) {
        p->slack[i] = p->multiplier[i] = 1;
        p->product[i] = p->step_multiplier[i] = 0;
    }
    const icc_status status = factorise(p, info, env);
    if (status != ICC_OK)
        return status;
    for (size_t k = 0; k < n; ++k) {
        p->f[k] = k == 0;
        p->step_f[k] = 0;
    }
    stationarity(p, p->f, p->step_multiplier, p->dual);
    iccp_qp_slacks(p->qp, p->f, false, p->primal);
    (void)find_errors(p);
    add_solution(p);
    for (size_t k = 1; k < n; ++k)
        p->f[k] = p->step_f[k];
    iccp_qp_slacks(p->qp, p->f, false, p->slack);
    for (size_t i = 0; i < m; ++i) {
        p->multiplier[i] = iccp_max(LEAST_MULTIPLIER, -p->slack[i]);
        p->slack[i] = iccp_max(LEAST_SLACK, p->slack[i]);
    }
    return ICC_OK;
}

icc_status iccp_interior_point_create(iccp_interior_point *ip, const iccp_qp *qp,
                                      icc_function_info *info, const iccp_env *env)
{
    iccp_interior_point *p = ip;
    *p = (iccp_interior_point){
        .memory = env->memory, .qp = qp, .softness = SOFTNESS, .remaining = 1};
    p->b.memory = p->gram.memory = p->factor.memory = env->memory;
    double clock = iccp_seconds();
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){1, 1, 1}, env);
    icc_status status = allocate(p, env);
    if (status == ICC_OK)
        status = stack(p, env);
    if (status == ICC_OK)
        status = iccp_gram_create(&p->gram, &p->b, &part[0]);
    info->seconds_setup += iccp_seconds() - clock;
    clock = iccp_seconds();
    if (status == ICC_OK)
        status = iccp_ldlt_analyse(&p->factor, &p->gram.matrix, 1, &part[1]);
    info->seconds_order += iccp_seconds() - clock;
    info->work = iccp_max(info->work, p->factor.work);
    if (status == ICC_OK)
        status = start(p, info, &part[2]);
    if (status != ICC_OK)
        iccp_interior_point_free(p);
    return status;
}

void iccp_interior_point_free(iccp_interior_point *ip)
{
    iccp_free(&ip->memory, ip->room);
    ip->room = NULL;
    iccp_sparse_free(&ip->b);
    iccp_gram_free(&ip->gram);
    iccp_ldlt_free(&ip->factor);
}

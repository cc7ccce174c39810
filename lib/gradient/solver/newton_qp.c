/* Newton's method for the quadratic program of qp.h. With slacks s and multipliers y, each step
 * solves
 *     A'A df - G' dy = -dual,   G df + (s / y) dy = -product / y - primal.
 *
 * It eliminates dy, which leaves A'A + G'WG with W = y / s. When an inequality becomes active, W
 * grows without bound and drowns A'A. So W = 1 / (s / y + softness) is factorised instead, and the
 * residuals of the two equations correct the step. Source: M. Friedlander, D. Orban, A primal-dual
 * regularized interior-point method for convex quadratic programs, Math. Prog. Comp. 4, 2012,
 * section 5. */
#include "gradient/solver/newton_qp.h"

#include "base/clock.h"
#include "base/minmax.h"

#include <math.h>

enum { MAX_SOFTENINGS = 4 };

/* Weights are at most the inverse of this. A'A has entries up to 4 dim (dim + 1/2) and keeps its
 * digits beside such weights. Between 1e-8 and 1e-5 the iterations are the same. */
static const double SOFTNESS = 1e-6;

static size_t n_rows(const iccp_newton_qp *p)
{
    return p->qp->unknowns->n;
}

static size_t n_pairs(const iccp_newton_qp *p)
{
    return iccp_qp_inequalities(p->qp);
}

void iccp_newton_qp_stationarity(const iccp_newton_qp *p, const double *f, const double *y,
                                 double *out)
{
    iccp_energy_gradient(&p->qp->a, f, p->work, out);
    for (size_t i = 0; i < n_pairs(p); ++i)
        p->work[i] = -y[i];
    iccp_qp_add_forces(p->qp, p->work, out);
    out[0] = 0;
}

void iccp_newton_qp_residuals(iccp_newton_qp *p)
{
    iccp_newton_qp_stationarity(p, p->f, p->multiplier, p->dual);
    iccp_qp_slacks(p->qp, p->f, false, p->primal);
    for (size_t i = 0; i < n_pairs(p); ++i)
        p->primal[i] -= p->slack[i];
}

icc_status iccp_newton_qp_factorise(iccp_newton_qp *p, iccp_solution *info, const iccp_env *env)
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

void iccp_newton_qp_add_solution(iccp_newton_qp *p)
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

double iccp_newton_qp_errors(iccp_newton_qp *p)
{
    double error = 0;
    iccp_newton_qp_stationarity(p, p->step_f, p->step_multiplier, p->force);
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

/* Makes B = A above G, both without the column of the root, whose value is fixed. G has the rows of
 * qp.h in their order: edges, with 1 at the parent and -sigma at the child, then the leaves'
 * bounds. With weights 1 for the rows of A and W for those of G, B'WB is the matrix that each step
 * solves with. */
static icc_status stack(iccp_newton_qp *p, const iccp_env *env)
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

static icc_status allocate(iccp_newton_qp *p, const iccp_env *env)
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

icc_status iccp_newton_qp_create(iccp_newton_qp *newton, const iccp_qp *qp, iccp_solution *info,
                                 const iccp_env *env)
{
    iccp_newton_qp *p = newton;
    *p = (iccp_newton_qp){.memory = env->memory, .qp = qp, .softness = SOFTNESS};
    p->b.memory = p->gram.memory = p->factor.memory = env->memory;
    double clock = iccp_seconds();
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 1}, env);
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
    for (size_t i = 0; i < qp->a.n_rows && status == ICC_OK; ++i)
        p->weight[i] = 1;
    if (status != ICC_OK)
        iccp_newton_qp_free(p);
    return status;
}

void iccp_newton_qp_free(iccp_newton_qp *newton)
{
    iccp_free(&newton->memory, newton->room);
    newton->room = NULL;
    iccp_sparse_free(&newton->b);
    iccp_gram_free(&newton->gram);
    iccp_ldlt_free(&newton->factor);
}

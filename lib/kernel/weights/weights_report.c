/* Computes weights at the caller's points, and measures their quality. */
#include "base/minmax.h"
#include "base/threads.h"
#include "kernel/weights/handle_weights.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

/* Places along an edge where weights are compared with linear ones. */
enum { EDGE_PLACES = 64 };
/* Weights below this are negative. Others may be negative by rounding. */
static const double NEGATIVE = -1e-9;

void iccp_weights_at(const icc_weights *weights, const double *point, double *values,
                     double *gradients)
{
    const iccp_node_set *set = weights->nodes;
    double local[ICC_MAX_DIM];
    iccp_frame_in(&set->sampling->shape->frame, (int32_t)set->dim, point, local);
    iccp_collocation_evaluate(set->collocation, set->n_handles, weights->coefficients, local,
                              values, gradients);
    const double scale = iccp_node_set_scale(set);
    for (size_t k = 0; gradients != NULL && k < set->n_handles * set->dim; ++k)
        gradients[k] *= scale;
}

static bool is_finite(size_t dim, const double *point)
{
    for (size_t k = 0; k < dim; ++k)
        if (!isfinite(point[k]))
            return false;
    return true;
}

typedef struct evaluation {
    const icc_weights *weights;
    const double *points;
    double *values, *gradients;
    icc_status *status;
} evaluation;

static icc_status evaluate_some(void *argument, size_t begin, size_t end)
{
    const evaluation *e = argument;
    const size_t dim = e->weights->nodes->dim, m = e->weights->nodes->n_handles;
    for (size_t i = begin; i < end; ++i) {
        double *weights = e->values + m * i;
        double *gradients = e->gradients != NULL ? e->gradients + dim * m * i : NULL;
        const bool finite = is_finite(dim, e->points + dim * i);
        if (finite)
            iccp_weights_at(e->weights, e->points + dim * i, weights, gradients);
        for (size_t k = 0; !finite && k < m; ++k)
            weights[k] = NAN;
        for (size_t k = 0; !finite && gradients != NULL && k < dim * m; ++k)
            gradients[k] = NAN;
        if (e->status != NULL)
            e->status[i] = finite ? ICC_OK : ICC_ERR_ARGUMENT;
    }
    return ICC_OK;
}

icc_status iccp_weights_evaluate(const icc_weights *weights, size_t n, const double *points,
                                 double *values, double *gradients, icc_status *status,
                                 size_t *n_failed, const iccp_env *env)
{
    const size_t dim = weights->nodes->dim;
    evaluation e = {weights, points, values, gradients, status};
    size_t failed = 0;
    for (size_t i = 0; i < n; ++i)
        failed += !is_finite(dim, points + dim * i);
    if (n_failed != NULL)
        *n_failed = failed;
    return iccp_for_chunks(env, "check", n, ICCP_NODES_A_TASK, evaluate_some, &e);
}

/* ---- dual functions ---- */

typedef struct dual {
    const iccp_node_set *set;
    const double *coefficients, *points;
    double *values;
} dual;

static icc_status evaluate_dual(void *argument, size_t begin, size_t end)
{
    const dual *d = argument;
    double local[ICC_MAX_DIM];
    for (size_t i = begin; i < end; ++i) {
        iccp_frame_in(&d->set->sampling->shape->frame, (int32_t)d->set->dim,
                      d->points + d->set->dim * i, local);
        iccp_collocation_evaluate(d->set->collocation, 1, d->coefficients, local, d->values + i,
                                  NULL);
    }
    return ICC_OK;
}

icc_status iccp_weights_dual(const icc_weights *weights, size_t node, size_t n,
                             const double *points, double *values, const iccp_env *env)
{
    const iccp_node_set *set = weights->nodes;
    double *unit = iccp_alloc_zero(&env->memory, set->n, sizeof *unit);
    double *coefficients = iccp_alloc(&env->memory, set->n + set->dim + 1, sizeof *coefficients);
    icc_status status = ICC_ERR_MEMORY;
    if (unit != NULL && coefficients != NULL) {
        dual d = {set, coefficients, points, values};
        unit[node] = 1;
        status = iccp_collocation_solve(set->collocation, 1, unit, coefficients, env);
        if (status == ICC_OK)
            status = iccp_for_chunks(env, "check", n, ICCP_NODES_A_TASK, evaluate_dual, &d);
    }
    iccp_free(&env->memory, unit);
    iccp_free(&env->memory, coefficients);
    return status;
}

/* ---- report ---- */

/* Measurements at one point. */
typedef struct quality {
    double unity, reproduction, least;
} quality;

typedef struct measurement {
    const icc_weights *weights;
    const iccp_memory *memory;
    const double *points;
    quality *quality; /* by point */
} measurement;

/* Measures how far m weights are from summing to 1 and reproducing their point, in the caller's
 * units. */
static quality measure(const icc_weights *weights, const double *point, double *values)
{
    const iccp_node_set *set = weights->nodes;
    quality q = {-1, 0, HUGE_VAL};
    double local[ICC_MAX_DIM];
    iccp_frame_in(&set->sampling->shape->frame, (int32_t)set->dim, point, local);
    iccp_weights_at(weights, point, values, NULL);
    for (size_t j = 0; j < set->n_handles; ++j) {
        q.unity += values[j];
        q.least = iccp_min(q.least, values[j]);
        for (size_t k = 0; k < set->dim; ++k)
            local[k] -= values[j] * set->points[set->dim * j + k];
    }
    q.unity = fabs(q.unity);
    for (size_t k = 0; k < set->dim; ++k)
        q.reproduction = iccp_hypot(q.reproduction, local[k]);
    q.reproduction /= iccp_node_set_scale(set);
    return q;
}

static icc_status measure_some(void *argument, size_t begin, size_t end)
{
    const measurement *m = argument;
    const iccp_node_set *set = m->weights->nodes;
    double *weights = iccp_alloc(m->memory, set->n_handles, sizeof *weights);
    if (weights == NULL)
        return ICC_ERR_MEMORY;
    for (size_t i = begin; i < end; ++i)
        m->quality[i] = measure(m->weights, m->points + set->dim * i, weights);
    iccp_free(m->memory, weights);
    return ICC_OK;
}

/* Returns the greatest deviation at a place from weights 1 - share and share of two handles, and 0
 * of the others. */
static double deviation(const icc_weights *weights, const double *place, const uint32_t ends[2],
                        double share, double *values)
{
    double worst = 0;
    iccp_weights_at(weights, place, values, NULL);
    for (size_t j = 0; j < weights->nodes->n_handles; ++j) {
        const double wanted = j == ends[0] ? 1 - share : j == ends[1] ? share : 0;
        worst = iccp_max(worst, fabs(values[j] - wanted));
    }
    return worst;
}

/* At handles, weights should be 1 and 0. Along edges they should be linear, which is tested at
 * EDGE_PLACES - 1 points between the ends. */
static void measure_handles(const icc_weights *weights, icc_weights_report *report, double *values)
{
    const iccp_node_set *set = weights->nodes;
    for (uint32_t j = 0; j < set->n_handles; ++j)
        report->lagrange = iccp_max(report->lagrange, deviation(weights, set->given + set->dim * j,
                                                                (uint32_t[2]){j, j}, 0, values));
    for (size_t e = 0; e < set->n_edges; ++e) {
        const double *a = set->given + set->dim * set->edges[2 * e];
        const double *b = set->given + set->dim * set->edges[2 * e + 1];
        for (int p = 1; p < EDGE_PLACES; ++p) {
            const double share = (double)p / EDGE_PLACES;
            double place[3];
            for (size_t k = 0; k < set->dim; ++k)
                place[k] = a[k] + share * (b[k] - a[k]);
            report->linearity = iccp_max(
                report->linearity, deviation(weights, place, set->edges + 2 * e, share, values));
        }
    }
}

/* Finds the worst of n points, and the mean deviation. */
static void summarise(size_t n, const quality *q, icc_weights_report *report)
{
    report->least_weight = n > 0 ? HUGE_VAL : 0;
    for (size_t i = 0; i < n; ++i) {
        report->unity = iccp_max(report->unity, q[i].unity);
        report->reproduction = iccp_max(report->reproduction, q[i].reproduction);
        report->reproduction_mean += q[i].reproduction / (double)n;
        report->least_weight = iccp_min(report->least_weight, q[i].least);
        report->n_negative += q[i].least < NEGATIVE;
    }
}

icc_status iccp_weights_measure(const icc_weights *weights, size_t n, const double *points,
                                icc_weights_report *report, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    *report = (icc_weights_report){.n_infeasible = weights->info.n_infeasible,
                                   .definiteness = weights->info.definiteness};
    quality *qualities = iccp_alloc(memory, n, sizeof *qualities);
    double *values = iccp_alloc(memory, weights->nodes->n_handles, sizeof *values);
    measurement m = {weights, memory, points, qualities};
    icc_status status = qualities != NULL && values != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = iccp_for_chunks(env, "check", n, ICCP_NODES_A_TASK, measure_some, &m);
    if (status == ICC_OK) {
        summarise(n, qualities, report);
        measure_handles(weights, report, values);
    }
    iccp_free(memory, qualities);
    iccp_free(memory, values);
    return status;
}

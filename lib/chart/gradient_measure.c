/* Based on: L. Huynh, thesis, 2013, section 6.4 (expansion edges and the area that they leave
 * uncovered, figure 6.12; compression edges), measured instead of drawn. */
#include "chart/gradient_measure.h"

#include "base/threads.h"

#include <math.h>

/* How one sample fared. */
enum { MISSED = 0, COVERED = 1, UNREACHABLE = 2, UNCOVERED = 3 };

typedef struct area_samples {
    const icc_chart *chart;
    uint8_t *verdict;
} area_samples;

/* Shapes that fill less of their bounding box than one part in this get fewer samples than wanted. */
static const double MOST_CANDIDATES = 64;

/* The R2 sequence (M. Roberts, 2018): multiples of the powers of the inverse plastic number. Its point 0
 * is the middle of the box, which is special in a symmetric shape: left out. */
static void candidate(const icc_domain *domain, size_t index, double p[2])
{
    static const double STEP[2] = {0.75487766624669276, 0.56984029099805327};
    for (int k = 0; k < 2; ++k) {
        const double x = 0.5 + STEP[k] * (double)(index + 1);
        p[k] = domain->lower[k] + (x - floor(x)) * (domain->upper[k] - domain->lower[k]);
    }
}

static uint8_t judge_point(const iccp_gradient_state *state, const double local[2])
{
    double p[2];
    iccp_gradient_to_lattice(state, local, p);
    iccp_walk2 down, up;
    iccp_fence_hit hit;
    if (iccp_walk2_start(&down, state->field, ICCP_DOWNHILL, p[0], p[1], NULL) != ICC_OK ||
        iccp_trace_downhill(&down, &state->fence, NULL, &hit) != ICC_OK ||
        iccp_walk2_start(&up, state->field, ICCP_UPHILL, p[0], p[1], NULL) != ICC_OK ||
        iccp_trace_uphill(&up, NULL, NULL) != ICC_OK)
        return UNREACHABLE;
    return down.merged ? UNCOVERED : COVERED;
}

static icc_status judge_chunk(void *argument, size_t begin, size_t end)
{
    const area_samples *samples = argument;
    const icc_domain *domain = samples->chart->domain;
    for (size_t i = begin; i < end; ++i) {
        double p[2];
        candidate(domain, i, p);
        samples->verdict[i] = iccp_domain_locate(domain, p, true, NULL, NULL) == ICC_INSIDE
                                  ? judge_point(samples->chart->state, p)
                                  : MISSED;
    }
    return ICC_OK;
}

/* How many points to spread over the bounding box so that about n lie inside. */
static size_t count_candidates(const icc_domain *domain, size_t n)
{
    const double box = (domain->upper[0] - domain->lower[0]) * (domain->upper[1] - domain->lower[1]);
    const double fill = domain->measure / box;
    return (size_t)ceil((double)n * fmin(fill > 0 ? 1 / fill : MOST_CANDIDATES, MOST_CANDIDATES));
}

static icc_status measure_area(const icc_chart *chart, size_t n_points,
                               icc_chart_measures *measures, const iccp_env *env)
{
    const size_t n = count_candidates(chart->domain, n_points);
    area_samples samples = {chart, iccp_alloc(&env->memory, n, 1)};
    if (samples.verdict == NULL)
        return ICC_ERR_MEMORY;
    const icc_status status = iccp_for_chunks(env, "measure area", n, 64, judge_chunk, &samples);
    if (status == ICC_OK) {
        size_t count[4] = {0};
        for (size_t i = 0; i < n; ++i)
            ++count[samples.verdict[i]];
        measures->n_points = n - count[MISSED];
        const double inside = measures->n_points > 0 ? (double)measures->n_points : 1;
        measures->unreachable = (double)count[UNREACHABLE] / inside;
        measures->uncovered = (double)count[UNCOVERED] / inside;
    }
    iccp_free(&env->memory, samples.verdict);
    return status;
}

typedef struct boundary_samples {
    const icc_chart *chart;
    const double *length;  /* of the boundary up to each facet, n_facets + 1 */
    size_t n;
    double *collapsed;     /* share of the way on which the curve is not alone; NaN: no curve */
    uint8_t *inward;
} boundary_samples;

static void facet_ends(const icc_domain *domain, size_t facet, const double **a, const double **b)
{
    *a = domain->vertices + 2 * (size_t)domain->facets[2 * facet];
    *b = domain->vertices + 2 * (size_t)domain->facets[2 * facet + 1];
}

/* The facet that holds the given length of boundary. */
static size_t find_facet(const boundary_samples *samples, double length)
{
    size_t low = 0, high = samples->chart->domain->n_facets;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (samples->length[middle] <= length)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static void judge_boundary_point(const boundary_samples *samples, size_t index)
{
    const icc_domain *domain = samples->chart->domain;
    const iccp_gradient_state *state = samples->chart->state;
    const double wanted = ((double)index + 0.5) / (double)samples->n * samples->length[domain->n_facets];
    const size_t facet = find_facet(samples, wanted);
    const double width = samples->length[facet + 1] - samples->length[facet];
    const double along = width > 0 ? (wanted - samples->length[facet]) / width : 0;
    const double bary[2] = {1 - along, along};
    double point[2], lattice[2], inward[2], merge;
    iccp_domain_facet_point(domain, (uint32_t)facet, bary, point);
    iccp_gradient_to_lattice(state, point, lattice);
    iccp_gradient_inward(domain, (uint32_t)facet, inward);
    samples->inward[index] = iccp_slope_sign(state->field, lattice, inward) > 0;
    samples->collapsed[index] = NAN;
    iccp_walk2 walk;
    if (iccp_gradient_depart(samples->chart, (uint32_t)facet, point, &walk, NULL) == ICC_OK &&
        iccp_trace_uphill(&walk, NULL, &merge) == ICC_OK && walk.s > 0)
        samples->collapsed[index] = 1 - merge / walk.s;
}

static icc_status judge_boundary_chunk(void *argument, size_t begin, size_t end)
{
    const boundary_samples *samples = argument;
    for (size_t i = begin; i < end; ++i)
        judge_boundary_point(samples, i);
    return ICC_OK;
}

static void sum_boundary(const boundary_samples *samples, icc_chart_measures *measures)
{
    double collapsed = 0;
    size_t n_curves = 0, n_inward = 0;
    for (size_t i = 0; i < samples->n; ++i) {
        n_inward += samples->inward[i];
        if (isnan(samples->collapsed[i]))
            continue;
        collapsed += samples->collapsed[i];
        ++n_curves;
    }
    measures->n_boundary = samples->n;
    measures->not_inward = 1 - (double)n_inward / (double)samples->n;
    measures->collapsed = n_curves > 0 ? collapsed / (double)n_curves : 0;
}

static icc_status measure_boundary(const icc_chart *chart, size_t n_points,
                                   icc_chart_measures *measures, const iccp_env *env)
{
    const icc_domain *domain = chart->domain;
    double *length = iccp_alloc(&env->memory, domain->n_facets + 1, sizeof *length);
    double *collapsed = iccp_alloc(&env->memory, n_points, sizeof *collapsed);
    uint8_t *inward = iccp_alloc(&env->memory, n_points, 1);
    icc_status status = ICC_ERR_MEMORY;
    if (length != NULL && collapsed != NULL && inward != NULL) {
        length[0] = 0;
        for (size_t f = 0; f < domain->n_facets; ++f) {
            const double *a, *b;
            facet_ends(domain, f, &a, &b);
            length[f + 1] = length[f] + hypot(b[0] - a[0], b[1] - a[1]);
        }
        boundary_samples samples = {chart, length, n_points, collapsed, inward};
        status = iccp_for_chunks(env, "measure boundary", n_points, 64, judge_boundary_chunk,
                                 &samples);
        if (status == ICC_OK)
            sum_boundary(&samples, measures);
    }
    iccp_free(&env->memory, length);
    iccp_free(&env->memory, collapsed);
    iccp_free(&env->memory, inward);
    return status;
}

icc_status iccp_gradient_measure(const icc_chart *chart, size_t n_points,
                                 icc_chart_measures *measures, const iccp_env *env)
{
    const icc_status status = measure_area(chart, n_points, measures, env);
    return status == ICC_OK ? measure_boundary(chart, n_points, measures, env) : status;
}

/* Measures what gradient coordinates miss. Based on: L. Huynh, thesis, 2013, section 6.4 (expansion
 * edges and the area that they leave uncovered, figure 6.12; compression edges), measured instead
 * of drawn. */
#include "gradient/coordinates/gradient_measure.h"

#include "base/minmax.h"
#include "base/threads.h"
#include "chart/low_discrepancy.h"
#include "gradient/coordinates/gradient_line.h"

#include <math.h>

/* Result for one sample. */
enum { MISSED, COVERED, UNREACHABLE, UNCOVERED };

typedef struct area_samples {
    const icc_chart *chart;
    uint8_t *verdict;
} area_samples;

/* Most candidates per sample. Shapes that fill a smaller share of their bounding box get fewer
 * samples than requested. */
static const double MOST_CANDIDATES = 64;

static void candidate(const icc_domain *domain, size_t index, double *p)
{
    for (int32_t k = 0; k < domain->dim; ++k)
        p[k] = domain->lower[k] +
               iccp_low_discrepancy(domain->dim, k, index) * (domain->upper[k] - domain->lower[k]);
}

/* Figure 6.12: a point is uncovered if its curve downhill merges with another one, so that no
 * boundary point of its own leads to it. */
static uint8_t check_point(const iccp_gradient_state *state, const double *local)
{
    double p[ICC_MAX_DIM];
    iccp_gradient_line down, up;
    iccp_gradient_to_lattice(state, local, p);
    if (iccp_gradient_down(state, p, NULL, NULL, &down) != ICC_OK ||
        iccp_gradient_up(state, p, NULL, NULL, &up) != ICC_OK)
        return UNREACHABLE;
    return down.merged ? UNCOVERED : COVERED;
}

static icc_status check_chunk(void *argument, size_t begin, size_t end)
{
    const area_samples *samples = argument;
    const icc_domain *domain = samples->chart->domain;
    for (size_t i = begin; i < end; ++i) {
        double p[ICC_MAX_DIM];
        candidate(domain, i, p);
        samples->verdict[i] = iccp_domain_locate(domain, p, true, NULL, NULL) == ICC_INSIDE
                                  ? check_point(samples->chart->state, p)
                                  : MISSED;
    }
    return ICC_OK;
}

/* Returns how many points to spread over the bounding box so that about n lie inside. */
static size_t count_candidates(const icc_domain *domain, size_t n)
{
    double box = 1;
    for (int32_t k = 0; k < domain->dim; ++k)
        box *= domain->upper[k] - domain->lower[k];
    const double fill = domain->measure / box;
    return (size_t)ceil((double)n *
                        iccp_min(fill > 0 ? 1 / fill : MOST_CANDIDATES, MOST_CANDIDATES));
}

/* Measures shares of the area with evenly spread points of the bounding box. Points outside do not
 * count. */
static icc_status measure_area(const icc_chart *chart, size_t n_points, icc_chart_report *measures,
                               const iccp_env *env)
{
    const size_t n = count_candidates(chart->domain, n_points);
    area_samples samples = {chart, iccp_alloc(&env->memory, n, 1)};
    if (samples.verdict == NULL)
        return ICC_ERR_MEMORY;
    const icc_status status = iccp_for_chunks(env, "check", n, 64, check_chunk, &samples);
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
    /* Extent of the boundary up to each facet, n_facets + 1, up to a factor */
    const double *extent;
    size_t n;
    /* Share of the way on which other curves have joined the curve; NaN: no curve */
    double *collapsed;
    uint8_t *inward;
} boundary_samples;

/* Returns the facet that contains the given extent of the boundary. */
static size_t find_facet(const boundary_samples *samples, double extent)
{
    size_t low = 0, high = samples->chart->domain->n_facets;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (samples->extent[middle] <= extent)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* The share of the boundary's extent gives a point's place along its facet, and the sequence its
 * other coordinates. When such numbers are sorted, they divide [0, 1] into evenly spread
 * barycentric coordinates. */
static void place_on_facet(int32_t dim, double along, size_t index, double *bary)
{
    double cut[ICC_MAX_DIM] = {along};
    for (int32_t k = 1; k < dim - 1; ++k) {
        const double x = iccp_low_discrepancy(dim - 2, k - 1, index);
        int32_t i = k;
        for (; i > 0 && cut[i - 1] < x; --i)
            cut[i] = cut[i - 1];
        cut[i] = x;
    }
    bary[0] = 1 - cut[0];
    for (int32_t k = 1; k < dim; ++k)
        bary[k] = cut[k - 1] - (k < dim - 1 ? cut[k] : 0);
}

/* Tests at a boundary point whether the function rises inward, and on which share of its curve
 * uphill other curves have joined it. */
static void check_boundary_point(const boundary_samples *samples, size_t index)
{
    const icc_domain *domain = samples->chart->domain;
    const iccp_gradient_state *state = samples->chart->state;
    const double *extent = samples->extent;
    const double wanted = ((double)index + 0.5) / (double)samples->n * extent[domain->n_facets];
    const size_t facet = find_facet(samples, wanted);
    const double width = extent[facet + 1] - extent[facet];
    const double along = width > 0 ? (wanted - extent[facet]) / width : 0;
    double bary[ICC_MAX_DIM], point[ICC_MAX_DIM], lattice[ICC_MAX_DIM], inward[ICC_MAX_DIM];
    place_on_facet(domain->dim, along, index, bary);
    iccp_domain_facet_point(domain, (uint32_t)facet, bary, point);
    iccp_gradient_to_lattice(state, point, lattice);
    iccp_facet_inward(domain, (uint32_t)facet, inward);
    samples->inward[index] = iccp_gradient_slope_sign(state, lattice, inward) > 0;
    samples->collapsed[index] = NAN;
    iccp_gradient_line line;
    if (iccp_gradient_up_from(samples->chart->state, (uint32_t)facet, point, NULL, &line) ==
            ICC_OK &&
        line.s > 0)
        samples->collapsed[index] = 1 - line.alone / line.s;
}

static icc_status check_boundary_chunk(void *argument, size_t begin, size_t end)
{
    const boundary_samples *samples = argument;
    for (size_t i = begin; i < end; ++i)
        check_boundary_point(samples, i);
    return ICC_OK;
}

static void sum_boundary(const boundary_samples *samples, icc_chart_report *measures)
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

/* The length of a facet's inward normal is its extent, up to a factor that depends only on the
 * dimension. */
static void sum_extents(const icc_domain *domain, double *extent)
{
    double inward[ICC_MAX_DIM];
    extent[0] = 0;
    for (size_t f = 0; f < domain->n_facets; ++f) {
        double square = 0;
        iccp_facet_inward(domain, (uint32_t)f, inward);
        for (int32_t k = 0; k < domain->dim; ++k)
            square += inward[k] * inward[k];
        extent[f + 1] = extent[f] + sqrt(square);
    }
}

/* Boundary points are spread by extent, so short facets count less than long ones. */
static icc_status measure_boundary(const icc_chart *chart, size_t n_points,
                                   icc_chart_report *measures, const iccp_env *env)
{
    const icc_domain *domain = chart->domain;
    double *extent = iccp_alloc(&env->memory, domain->n_facets + 1, sizeof *extent);
    double *collapsed = iccp_alloc(&env->memory, n_points, sizeof *collapsed);
    uint8_t *inward = iccp_alloc(&env->memory, n_points, 1);
    icc_status status = ICC_ERR_MEMORY;
    if (extent != NULL && collapsed != NULL && inward != NULL) {
        sum_extents(domain, extent);
        boundary_samples samples = {chart, extent, n_points, collapsed, inward};
        status = iccp_for_chunks(env, "check", n_points, 64, check_boundary_chunk, &samples);
        if (status == ICC_OK)
            sum_boundary(&samples, measures);
    }
    iccp_free(&env->memory, extent);
    iccp_free(&env->memory, collapsed);
    iccp_free(&env->memory, inward);
    return status;
}

icc_status iccp_gradient_measure(const icc_chart *chart, size_t n_points,
                                 icc_chart_report *measures, const iccp_env *env)
{
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 1}, env);
    const icc_status status = measure_area(chart, n_points, measures, &part[0]);
    return status == ICC_OK ? measure_boundary(chart, n_points, measures, &part[1]) : status;
}

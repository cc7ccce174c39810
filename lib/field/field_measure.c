/* Measures a chart of method field by sampling. Curves of this method do not merge, so nothing is
 * uncovered or collapsed. What can go wrong is a curve that does not arrive, or one that crosses
 * the boundary outward on its way up. Source: docs/theory/charts-space.md, "fields on grids". */
#include "field/field_measure.h"

#include "base/threads.h"
#include "chart/low_discrepancy.h"

#include <math.h>
#include <string.h>

enum { GRAIN = 64 };

typedef struct samples {
    const icc_chart *chart;
    const iccp_flow *flow;
    size_t n;
    const double *cumulated; /* running sum of the facets' extents; the last one is 1 */
    uint8_t *result;         /* bits, defined below, for each sample */
} samples;

enum { INSIDE = 1, UNREACHABLE = 2, OUTWARD = 4 };

/* Tells whether an evenly spread point of the bounding box lies inside, and whether it can be
 * encoded. */
static uint8_t check_point(const samples *s, size_t i)
{
    const icc_domain *domain = s->chart->domain;
    double point[ICC_MAX_DIM];
    iccp_coords coords;
    for (int32_t k = 0; k < domain->dim; ++k)
        point[k] = domain->lower[k] +
                   (domain->upper[k] - domain->lower[k]) * iccp_low_discrepancy(domain->dim, k, i);
    const icc_status status = iccp_chart_encode(s->chart, point, &coords, NULL);
    if (status == ICC_ERR_OUTSIDE)
        return 0;
    return status == ICC_OK ? INSIDE : INSIDE | UNREACHABLE;
}

/* The facet at a given share of the boundary's extent. */
static uint32_t find_facet(const samples *s, double share)
{
    size_t low = 0, high = s->chart->domain->n_facets - 1;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (s->cumulated[middle] < share)
            low = middle + 1;
        else
            high = middle;
    }
    return (uint32_t)low;
}

/* Tells whether the vector at an evenly spread point of the boundary points inward. Facets get
 * points by their share of the extent. The gaps between sorted numbers serve as barycentric
 * coordinates. */
static uint8_t check_boundary(const samples *s, size_t i)
{
    const icc_domain *domain = s->chart->domain;
    const icc_grid *grid = s->flow->grid;
    const int32_t dim = domain->dim;
    const uint32_t facet = find_facet(s, ((double)i + 0.5) / (double)s->n);
    double cut[ICC_MAX_DIM + 1], bary[ICC_MAX_DIM] = {0}, x[ICC_MAX_DIM], vector[ICC_MAX_DIM],
                                 inward = 0;
    cut[0] = 0;
    for (int32_t k = 1; k < dim; ++k) {
        int32_t at = k;
        const double u = iccp_low_discrepancy(dim, k, i);
        for (; at > 1 && cut[at - 1] > u; --at)
            cut[at] = cut[at - 1];
        cut[at] = u;
    }
    cut[dim] = 1;
    for (int32_t k = 0; k < dim; ++k)
        bary[k] = cut[k + 1] - cut[k];
    iccp_domain_facet_point(domain, facet, bary, x);
    for (int32_t k = 0; k < dim; ++k)
        x[k] = (x[k] - grid->origin[k]) / grid->spacing;
    const double *normal = s->flow->incidence->normal + (size_t)dim * facet;
    iccp_flow_place place;
    if (!iccp_flow_find(s->flow, x, normal, &place))
        return OUTWARD;
    iccp_flow_vector(s->flow, &place, vector);
    for (int32_t k = 0; k < dim; ++k)
        inward += normal[k] * vector[k];
    return inward > 0 ? 0 : OUTWARD;
}

static icc_status check_chunk(void *argument, size_t begin, size_t end)
{
    samples *s = argument;
    for (size_t i = begin; i < end; ++i)
        s->result[i] = (uint8_t)(check_point(s, i) | check_boundary(s, i));
    return ICC_OK;
}

/* The product of its edge lengths is near enough to the extent of a facet. */
static void cumulate(const icc_domain *domain, double *cumulated)
{
    double sum = 0;
    for (size_t f = 0; f < domain->n_facets; ++f) {
        const double *corner[ICC_MAX_DIM];
        double extent = 1;
        iccp_facet_corners(&domain->tree, (uint32_t)f, corner);
        for (int32_t i = 1; i < domain->dim; ++i) {
            double length2 = 0;
            for (int32_t k = 0; k < domain->dim; ++k)
                length2 += (corner[i][k] - corner[0][k]) * (corner[i][k] - corner[0][k]);
            extent *= sqrt(length2);
        }
        cumulated[f] = sum += extent;
    }
    for (size_t f = 0; f < domain->n_facets; ++f)
        cumulated[f] /= sum;
}

icc_status iccp_field_measure(const icc_chart *chart, const iccp_flow *flow, size_t n_points,
                              icc_chart_report *measures, const iccp_env *env)
{
    size_t n_unreachable = 0, n_outward = 0;
    double *cumulated = iccp_alloc(&env->memory, chart->domain->n_facets, sizeof *cumulated);
    uint8_t *result = iccp_alloc(&env->memory, n_points, sizeof *result);
    samples s = {chart, flow, n_points, cumulated, result};
    icc_status status = cumulated != NULL && result != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        cumulate(chart->domain, cumulated);
        status = iccp_for_chunks(env, "check", n_points, GRAIN, check_chunk, &s);
    }
    for (size_t i = 0; status == ICC_OK && i < n_points; ++i) {
        measures->n_points += (result[i] & INSIDE) != 0;
        n_unreachable += (result[i] & UNREACHABLE) != 0;
        n_outward += (result[i] & OUTWARD) != 0;
    }
    if (measures->n_points > 0)
        measures->unreachable = (double)n_unreachable / (double)measures->n_points;
    measures->n_boundary = n_points;
    measures->not_inward = (double)n_outward / (double)n_points;
    iccp_free(&env->memory, cumulated);
    iccp_free(&env->memory, result);
    return status;
}

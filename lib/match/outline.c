#include "match/outline.h"

#include "base/error.h"
#include "domain/polygon.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

/* Vertices in the order of the ring; backwards, but for the first, where that is clockwise. */
static icc_status walk(iccp_outline *outline, const iccp_memory *memory, icc_error *err)
{
    const icc_domain *const domain = outline->domain;
    iccp_polygon ring = {0};
    icc_status status =
        iccp_polygon_create(&ring, outline->n, domain->vertices, domain->facets, memory, err);
    for (size_t k = 0; k < outline->n && status == ICC_OK; ++k) {
        const size_t at = domain->orientation > 0 || k == 0 ? k : outline->n - k;
        outline->vertex[k] = iccp_polygon_vertex(&ring, (uint32_t)at);
        memcpy(outline->points + 2 * k, domain->vertices + 2 * (size_t)outline->vertex[k],
               2 * sizeof(double));
    }
    iccp_polygon_free(&ring, memory);
    return status;
}

static void measure(iccp_outline *outline)
{
    const size_t n = outline->n;
    memcpy(outline->points + 2 * n, outline->points, 2 * sizeof(double));
    outline->share[0] = 0;
    for (size_t k = 0; k < n; ++k) {
        const double *const p = outline->points + 2 * k;
        outline->share[k + 1] = outline->share[k] + iccp_hypot(p[2] - p[0], p[3] - p[1]);
    }
    outline->perimeter = outline->share[n];
    for (size_t k = 1; k < n; ++k)
        outline->share[k] /= outline->perimeter;
    outline->share[n] = 1;
    const icc_domain *const domain = outline->domain;
    outline->diameter =
        iccp_hypot(domain->upper[0] - domain->lower[0], domain->upper[1] - domain->lower[1]);
}

icc_status iccp_outline_create(iccp_outline *outline, const icc_domain *domain,
                               const iccp_memory *memory, icc_error *err)
{
    const size_t n = domain->n_vertices;
    *outline = (iccp_outline){.domain = domain, .n = n};
    outline->vertex = iccp_alloc(memory, n, sizeof *outline->vertex);
    outline->points = iccp_alloc(memory, 2 * (n + 1), sizeof *outline->points);
    outline->share = iccp_alloc(memory, n + 1, sizeof *outline->share);
    if (outline->vertex == NULL || outline->points == NULL || outline->share == NULL)
        return iccp_fail_memory(err);
    const icc_status status = walk(outline, memory, err);
    if (status == ICC_OK)
        measure(outline);
    return iccp_explain(err, status);
}

void iccp_outline_free(iccp_outline *outline, const iccp_memory *memory)
{
    iccp_free(memory, outline->vertex);
    iccp_free(memory, outline->points);
    iccp_free(memory, outline->share);
}

double iccp_outline_wrap(double share)
{
    const double rest = share - floor(share);
    return rest < 1 ? rest : 0;
}

size_t iccp_outline_edge(const iccp_outline *outline, double share, double *along)
{
    const double *const s = outline->share;
    const double at = iccp_outline_wrap(share);
    size_t low = 0, high = outline->n;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (s[middle] <= at)
            low = middle;
        else
            high = middle;
    }
    const double width = s[low + 1] - s[low];
    *along = width > 0 ? (at - s[low]) / width : 0;
    return low;
}

void iccp_outline_at(const iccp_outline *outline, double share, double *point)
{
    double along;
    const double *const p = outline->points + 2 * iccp_outline_edge(outline, share, &along);
    for (int k = 0; k < 2; ++k)
        point[k] = p[k] + along * (p[k + 2] - p[k]);
}

/* Rings and lines of plane domains as outlines, measured by arc length. */
#include "match/outline/outline.h"

#include "base/error.h"
#include "domain/network.h"
#include "geometry/polygon.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

/* Makes room for n vertices within a bounding box. */
static icc_status reserve(iccp_outline *outline, size_t n, const double *lower, const double *upper,
                          const iccp_memory *memory)
{
    *outline =
        (iccp_outline){.n = n, .diameter = iccp_hypot(upper[0] - lower[0], upper[1] - lower[1])};
    outline->vertex = iccp_alloc(memory, n, sizeof *outline->vertex);
    outline->points = iccp_alloc(memory, 2 * (n + 1), sizeof *outline->points);
    outline->share = iccp_alloc(memory, n + 1, sizeof *outline->share);
    return outline->vertex != NULL && outline->points != NULL && outline->share != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
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
}

void iccp_outline_place(iccp_outline *outline, const double *vertices)
{
    for (size_t k = 0; k < outline->n; ++k)
        memcpy(outline->points + 2 * k, vertices + 2 * (size_t)outline->vertex[k],
               2 * sizeof(double));
    measure(outline);
}

icc_status iccp_outline_create(iccp_outline *outline, const icc_domain *domain,
                               const iccp_memory *memory, icc_error *err)
{
    const size_t n = domain->features != NULL ? domain->features->n_outer : domain->n_vertices;
    iccp_polygon ring = {0};
    icc_status status = reserve(outline, n, domain->lower, domain->upper, memory);
    outline->domain = domain;
    if (status == ICC_OK)
        status = iccp_polygon_create(&ring, n, domain->vertices, domain->facets, memory, err);
    if (status == ICC_OK) {
        outline->is_back = domain->orientation < 0;
        for (size_t k = 0; k < n; ++k)
            outline->vertex[k] =
                iccp_polygon_vertex(&ring, (uint32_t)(outline->is_back && k > 0 ? n - k : k));
        iccp_outline_place(outline, domain->vertices);
    }
    iccp_polygon_free(&ring, memory);
    return iccp_explain(err, status);
}

/* Returns true if a ring of the domain's vertices runs clockwise. */
static bool runs_clockwise(const icc_domain *domain, size_t first, size_t n)
{
    const double *const o = domain->vertices + 2 * first;
    double twice = 0;
    for (size_t k = 1; k + 1 < n; ++k) {
        const double *const a = o + 2 * k, *const b = a + 2;
        twice += (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
    }
    return twice < 0;
}

icc_status iccp_outline_create_feature(iccp_outline *outline, const icc_domain *domain,
                                       size_t feature, bool is_back, const iccp_memory *memory)
{
    const iccp_feature *const f = &domain->features->item[feature];
    const uint32_t *const node = domain->features->network->node;
    const bool is_closed =
        f->kind == ICC_FEATURE_LINE && node[f->first + f->n - 1] == node[f->first];
    const bool is_line = f->kind == ICC_FEATURE_LINE && !is_closed;
    const uint32_t last = f->n - 1, n = is_line ? 2 * last : is_closed ? last : f->n;
    const icc_status status = reserve(outline, n, domain->lower, domain->upper, memory);
    outline->domain = domain;
    if (status != ICC_OK)
        return status;
    outline->end = is_line ? last : 0;
    outline->is_back = is_line     ? is_back
                       : is_closed ? runs_clockwise(domain, f->first, n)
                                   : f->orientation < 0;
    for (uint32_t k = 0; k < n; ++k) {
        const uint32_t on = is_line && k > last ? n - k : k;
        const uint32_t back = is_line ? last - on : k > 0 ? n - k : 0;
        outline->vertex[k] = f->first + (outline->is_back ? back : on);
    }
    iccp_outline_place(outline, domain->vertices);
    return ICC_OK;
}

icc_status iccp_outline_create_points(iccp_outline *outline, size_t n, const double *points,
                                      bool is_ring, const iccp_memory *memory)
{
    const size_t last = n - 1, n_walked = is_ring ? n : 2 * last;
    double lower[2], upper[2];
    iccp_frame_bounds(2, n, points, lower, upper);
    const icc_status status = reserve(outline, n_walked, lower, upper, memory);
    if (status != ICC_OK)
        return status;
    outline->end = is_ring ? 0 : last;
    for (size_t k = 0; k < n_walked; ++k)
        outline->vertex[k] = (uint32_t)(!is_ring && k > last ? n_walked - k : k);
    iccp_outline_place(outline, points);
    return ICC_OK;
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

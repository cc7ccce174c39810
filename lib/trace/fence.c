#include "trace/fence.h"

#include "math/predicates.h"

#include <math.h>
#include <string.h>

/* Cells that an edge misses by less than this, in cells, are entered too: far more than the
 * rounding of the slab arithmetic below, and almost free. */
static const double SLACK = 1e-9;

static size_t cell_of(double x, size_t n)
{
    if (!(x > 0))
        return 0;
    return x < (double)n ? (size_t)x : n - 1;
}

/* Visits the cells of one edge: row by row, the part of the edge within the row. */
static void visit_edge(iccp_fence *fence, uint32_t edge, bool fill)
{
    const double *a = fence->vertices + 2 * (size_t)fence->ends[2 * (size_t)edge];
    const double *b = fence->vertices + 2 * (size_t)fence->ends[2 * (size_t)edge + 1];
    if (a[1] > b[1]) {
        const double *swap = a;
        a = b;
        b = swap;
    }
    const size_t j_last = cell_of(b[1] + SLACK, fence->ny);
    const double slope = b[1] > a[1] ? (b[0] - a[0]) / (b[1] - a[1]) : 0;
    for (size_t j = cell_of(a[1] - SLACK, fence->ny); j <= j_last; ++j) {
        double x0 = a[0], x1 = b[0];
        if ((double)j > a[1] && b[1] > a[1])
            x0 = a[0] + ((double)j - a[1]) * slope;
        if ((double)(j + 1) < b[1] && b[1] > a[1])
            x1 = a[0] + ((double)(j + 1) - a[1]) * slope;
        const size_t i_last = cell_of(fmax(x0, x1) + SLACK, fence->nx);
        for (size_t i = cell_of(fmin(x0, x1) - SLACK, fence->nx); i <= i_last; ++i) {
            const size_t cell = i + fence->nx * j;
            if (fill)
                fence->edges[--fence->first[cell]] = edge;
            else
                ++fence->first[cell];
        }
    }
}

static icc_status list_edges(iccp_fence *fence, size_t n_edges)
{
    const size_t n_cells = fence->nx * fence->ny;
    for (size_t e = 0; e < n_edges; ++e)
        visit_edge(fence, (uint32_t)e, false);
    for (size_t c = 1; c <= n_cells; ++c)
        fence->first[c] += fence->first[c - 1];
    fence->edges = iccp_alloc(&fence->memory, fence->first[n_cells], sizeof *fence->edges);
    if (fence->edges == NULL)
        return ICC_ERR_MEMORY;
    for (size_t e = n_edges; e-- > 0;)
        visit_edge(fence, (uint32_t)e, true);
    return ICC_OK;
}

icc_status iccp_fence_create(iccp_fence *fence, const icc_domain *domain, const icc_grid *grid,
                             const iccp_env *env)
{
    *fence = (iccp_fence){.memory = env->memory, .ends = domain->facets};
    fence->nx = grid->shape[0] - 1;
    fence->ny = grid->shape[1] - 1;
    fence->vertices = iccp_alloc(&fence->memory, domain->n_vertices, 2 * sizeof(double));
    fence->first = iccp_alloc_zero(&fence->memory, fence->nx * fence->ny + 1, sizeof(size_t));
    if (fence->vertices == NULL || fence->first == NULL) {
        iccp_fence_free(fence);
        return ICC_ERR_MEMORY;
    }
    for (size_t v = 0; v < domain->n_vertices; ++v)
        for (size_t k = 0; k < 2; ++k)
            fence->vertices[2 * v + k] =
                (domain->vertices[2 * v + k] - grid->origin[k]) / grid->spacing;
    const icc_status status = list_edges(fence, domain->n_facets);
    if (status != ICC_OK)
        iccp_fence_free(fence);
    return status;
}

void iccp_fence_free(iccp_fence *fence)
{
    iccp_free(&fence->memory, fence->vertices);
    iccp_free(&fence->memory, fence->first);
    iccp_free(&fence->memory, fence->edges);
    memset(fence, 0, sizeof *fence);
}

static double cross(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static double clamp01(double x)
{
    return x > 0 ? (x < 1 ? x : 1) : 0;
}

/* Whether b lies between a and c, all three on one line. */
static bool between(const double a[2], const double b[2], const double c[2])
{
    return (a[0] - b[0]) * (c[0] - b[0]) <= 0 && (a[1] - b[1]) * (c[1] - b[1]) <= 0;
}

/* An edge on the line of the step: the step begins on it or meets the end that comes first. */
static bool hit_collinear(const double p[2], const double q[2], const double a[2],
                          const double b[2], iccp_fence_hit *hit)
{
    if (between(a, p, b)) {
        hit->share = 0;
        hit->along = clamp01(hypot(p[0] - a[0], p[1] - a[1]) / hypot(b[0] - a[0], b[1] - a[1]));
        return true;
    }
    const bool meets_a = between(p, a, q), meets_b = between(p, b, q);
    if (!meets_a && !meets_b)
        return false;
    const double length = hypot(q[0] - p[0], q[1] - p[1]);
    const double to_a = meets_a ? hypot(a[0] - p[0], a[1] - p[1]) : HUGE_VAL;
    const double to_b = meets_b ? hypot(b[0] - p[0], b[1] - p[1]) : HUGE_VAL;
    hit->along = to_a <= to_b ? 0 : 1;
    hit->share = length > 0 ? clamp01(fmin(to_a, to_b) / length) : 0;
    return true;
}

static bool hit_edge(const double p[2], const double q[2], const double a[2], const double b[2],
                     iccp_fence_hit *hit)
{
    const int side_p = iccp_orient2d(a, b, p), side_q = iccp_orient2d(a, b, q);
    if (side_p == 0 && side_q == 0)
        return hit_collinear(p, q, a, b, hit);
    if (side_p * side_q > 0)
        return false;
    if (iccp_orient2d(p, q, a) * iccp_orient2d(p, q, b) > 0)
        return false;
    const double from_p = cross(a, b, p), from_q = cross(a, b, q);
    const double from_a = cross(p, q, a), from_b = cross(p, q, b);
    hit->share = side_p == 0 ? 0 : clamp01(from_p / (from_p - from_q));
    hit->along = clamp01(from_a / (from_a - from_b));
    return true;
}

bool iccp_fence_first(const iccp_fence *fence, size_t i, size_t j, const double p[2],
                      const double q[2], iccp_fence_hit *hit)
{
    const size_t cell = i + fence->nx * j;
    bool found = false;
    for (size_t k = fence->first[cell]; k < fence->first[cell + 1]; ++k) {
        const uint32_t edge = fence->edges[k];
        const double *a = fence->vertices + 2 * (size_t)fence->ends[2 * (size_t)edge];
        const double *b = fence->vertices + 2 * (size_t)fence->ends[2 * (size_t)edge + 1];
        iccp_fence_hit candidate = {.facet = edge};
        if (hit_edge(p, q, a, b, &candidate) && (!found || candidate.share < hit->share)) {
            *hit = candidate;
            found = true;
        }
    }
    return found;
}

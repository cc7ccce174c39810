/* The edges of a polygon in each cell of a grid. */
#include "gradient/trace/boundary_cells2.h"

#include "base/minmax.h"
#include "math/elementary.h"
#include "math/predicates.h"

#include <math.h>
#include <string.h>

/* Edges are also entered into cells that they miss by less than this, in cells. It exceeds the
 * rounding of the slab arithmetic below by far, and costs almost nothing. */
static const double SLACK = 1e-9;

static size_t cell_of(double x, size_t n)
{
    if (!(x > 0))
        return 0;
    return x < (double)n ? (size_t)x : n - 1;
}

/* Visits the cells of one edge row by row: the part of the edge within each row. */
static void visit_edge(iccp_boundary_cells2 *cells, uint32_t edge, bool fill)
{
    const double *a = cells->vertices + 2 * (size_t)cells->ends[2 * (size_t)edge];
    const double *b = cells->vertices + 2 * (size_t)cells->ends[2 * (size_t)edge + 1];
    if (a[1] > b[1]) {
        const double *swap = a;
        a = b;
        b = swap;
    }
    const size_t j_last = cell_of(b[1] + SLACK, cells->ny);
    const double slope = b[1] > a[1] ? (b[0] - a[0]) / (b[1] - a[1]) : 0;
    for (size_t j = cell_of(a[1] - SLACK, cells->ny); j <= j_last; ++j) {
        double x0 = a[0], x1 = b[0];
        if ((double)j > a[1] && b[1] > a[1])
            x0 = a[0] + ((double)j - a[1]) * slope;
        if ((double)(j + 1) < b[1] && b[1] > a[1])
            x1 = a[0] + ((double)(j + 1) - a[1]) * slope;
        const size_t i_last = cell_of(iccp_max(x0, x1) + SLACK, cells->nx);
        for (size_t i = cell_of(iccp_min(x0, x1) - SLACK, cells->nx); i <= i_last; ++i) {
            const size_t cell = i + cells->nx * j;
            if (fill)
                cells->edges[--cells->first[cell]] = edge;
            else
                ++cells->first[cell];
        }
    }
}

static icc_status list_edges(iccp_boundary_cells2 *cells, size_t n_edges)
{
    const size_t n_cells = cells->nx * cells->ny;
    for (size_t e = 0; e < n_edges; ++e)
        visit_edge(cells, (uint32_t)e, false);
    for (size_t c = 1; c <= n_cells; ++c)
        cells->first[c] += cells->first[c - 1];
    cells->edges = iccp_alloc(&cells->memory, cells->first[n_cells], sizeof *cells->edges);
    if (cells->edges == NULL)
        return ICC_ERR_MEMORY;
    for (size_t e = n_edges; e-- > 0;)
        visit_edge(cells, (uint32_t)e, true);
    return ICC_OK;
}

icc_status iccp_boundary_cells2_create(iccp_boundary_cells2 *cells, const icc_domain *domain,
                                       const icc_grid *grid, const iccp_env *env)
{
    *cells = (iccp_boundary_cells2){.memory = env->memory, .ends = domain->facets};
    cells->nx = grid->shape[0] - 1;
    cells->ny = grid->shape[1] - 1;
    cells->vertices = iccp_alloc(&cells->memory, domain->n_vertices, 2 * sizeof(double));
    cells->first = iccp_alloc_zero(&cells->memory, cells->nx * cells->ny + 1, sizeof(size_t));
    if (cells->vertices == NULL || cells->first == NULL) {
        iccp_boundary_cells2_free(cells);
        return ICC_ERR_MEMORY;
    }
    for (size_t v = 0; v < domain->n_vertices; ++v)
        for (size_t k = 0; k < 2; ++k)
            cells->vertices[2 * v + k] =
                (domain->vertices[2 * v + k] - grid->origin[k]) / grid->spacing;
    const icc_status status = list_edges(cells, domain->n_facets);
    if (status != ICC_OK)
        iccp_boundary_cells2_free(cells);
    return status;
}

void iccp_boundary_cells2_free(iccp_boundary_cells2 *cells)
{
    iccp_free(&cells->memory, cells->vertices);
    iccp_free(&cells->memory, cells->first);
    iccp_free(&cells->memory, cells->edges);
    memset(cells, 0, sizeof *cells);
}

static double cross(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static double clamp01(double x)
{
    return x > 0 ? (x < 1 ? x : 1) : 0;
}

/* Returns true if b lies between a and c, all three on one line. */
static bool between(const double a[2], const double b[2], const double c[2])
{
    return (a[0] - b[0]) * (c[0] - b[0]) <= 0 && (a[1] - b[1]) * (c[1] - b[1]) <= 0;
}

/* Handles an edge on the line of the step: the step begins on it, or meets its nearer end. */
static bool hit_collinear(const double p[2], const double q[2], const double a[2],
                          const double b[2], iccp_boundary_hit2 *hit)
{
    if (between(a, p, b)) {
        hit->share = 0;
        hit->along =
            clamp01(iccp_hypot(p[0] - a[0], p[1] - a[1]) / iccp_hypot(b[0] - a[0], b[1] - a[1]));
        return true;
    }
    const bool meets_a = between(p, a, q), meets_b = between(p, b, q);
    if (!meets_a && !meets_b)
        return false;
    const double length = iccp_hypot(q[0] - p[0], q[1] - p[1]);
    const double to_a = meets_a ? iccp_hypot(a[0] - p[0], a[1] - p[1]) : HUGE_VAL;
    const double to_b = meets_b ? iccp_hypot(b[0] - p[0], b[1] - p[1]) : HUGE_VAL;
    hit->along = to_a <= to_b ? 0 : 1;
    hit->share = length > 0 ? clamp01(iccp_min(to_a, to_b) / length) : 0;
    return true;
}

static bool hit_edge(const double p[2], const double q[2], const double a[2], const double b[2],
                     iccp_boundary_hit2 *hit)
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

bool iccp_boundary_cells2_first(const iccp_boundary_cells2 *cells, size_t i, size_t j,
                                const double p[2], const double q[2], iccp_boundary_hit2 *hit)
{
    const size_t cell = i + cells->nx * j;
    bool found = false;
    for (size_t k = cells->first[cell]; k < cells->first[cell + 1]; ++k) {
        const uint32_t edge = cells->edges[k];
        const double *a = cells->vertices + 2 * (size_t)cells->ends[2 * (size_t)edge];
        const double *b = cells->vertices + 2 * (size_t)cells->ends[2 * (size_t)edge + 1];
        iccp_boundary_hit2 candidate = {.facet = edge};
        if (hit_edge(p, q, a, b, &candidate) && (!found || candidate.share < hit->share)) {
            *hit = candidate;
            found = true;
        }
    }
    return found;
}

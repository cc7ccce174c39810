/* Finds compression and expansion edges. Based on: L. Huynh, Bijective Deformations in R^n via
 * Integral Curve Coordinates, thesis, 2013, chapter 5 and section 6.4.
 *
 * The apex of an edge in a triangle is the opposite corner. The gradient points to the edge if the
 * apex lies lower than the foot of its perpendicular on the edge. In the triangles of the grid that
 * foot is an end of the edge, or the middle of a diagonal. So signs of differences decide. */
#include "gradient/function/edges.h"

#include "math/expansion.h"

#include <assert.h>
#include <math.h>

/* One kind of edge at vertex (i, j): its ends and, for the triangle on each side, the apex and the
 * foot. Corners are steps along x and y. A foot is end 0, end 1 or the middle. */
typedef struct edge_kind {
    int end[2][2];
    int apex[2][2];
    int foot[2];
} edge_kind;
enum { MIDDLE = 2 };
static const edge_kind KINDS[3] = {
    {{{0, 0}, {1, 0}}, {{1, 1}, {0, -1}}, {1, 0}},
    {{{0, 0}, {0, 1}}, {{1, 1}, {-1, 0}}, {1, 0}},
    {{{0, 0}, {1, 1}}, {{1, 0}, {0, 1}}, {MIDDLE, MIDDLE}},
};

/* An edge of the grid: its ends, then its apexes, and the function at these. */
typedef struct edge {
    uint32_t vertex[4];
    double f[4];
    const int *foot; /* foot of the perpendicular on each side, as in edge_kind */
} edge;

/* Returns false if a corner lies outside the grid. */
static bool edge_at(edge *out, const icc_grid *grid, size_t i, size_t j, int kind)
{
    const edge_kind *shape = &KINDS[kind];
    for (int c = 0; c < 4; ++c) {
        const int *step = c < 2 ? shape->end[c] : shape->apex[c - 2];
        if ((i == 0 && step[0] < 0) || (j == 0 && step[1] < 0))
            return false;
        const size_t x = i + (size_t)step[0], y = j + (size_t)step[1];
        if (x >= grid->shape[0] || y >= grid->shape[1])
            return false;
        out->vertex[c] = (uint32_t)(x + y * grid->shape[0]);
    }
    out->foot = shape->foot;
    return true;
}

static bool is_tested(const icc_function *function, edge *e)
{
    const uint8_t *inside = function->tree->grid->inside;
    bool any_inside = false;
    iccp_function_local(function, 4, e->vertex, e->f);
    for (int c = 0; c < 4; ++c) {
        if (isnan(e->f[c]))
            return false;
        any_inside |= inside[e->vertex[c]];
    }
    return any_inside;
}

static int compare(double a, double b)
{
    return (a > b) - (a < b);
}

/* Returns the sign of (a + b) / 2 - c. A rounded sum never lies on the wrong side of a double. Only
 * if it equals that double, its rounding error decides. */
static int compare_mean(double a, double b, double c)
{
    double error;
    const double sum = iccp_two_sum(a, b, &error);
    const int sign = compare(sum, 2.0 * c);
    return sign != 0 ? sign : compare(error, 0.0);
}

/* Returns +1 if the gradient on that side points to the edge, -1 if it points away. */
static int towards(const edge *e, int side)
{
    const double a = e->f[0], b = e->f[1], apex = e->f[2 + side];
    if (e->foot[side] == MIDDLE)
        return compare_mean(a, b, apex);
    return compare(e->foot[side] == 0 ? a : b, apex);
}

/* Returns ICC_EDGE_* or 0. */
static int32_t classify_edge(const edge *e)
{
    const int first = towards(e, 0);
    if (first == 0 || first != towards(e, 1))
        return 0;
    return first > 0 ? ICC_EDGE_COMPRESSION : ICC_EDGE_EXPANSION;
}

iccp_edge_count iccp_function_edges(const icc_function *function, size_t capacity, uint32_t *edges,
                                    int32_t *kinds)
{
    const icc_grid *grid = function->tree->grid;
    assert(grid->dim == 2);
    iccp_edge_count count = {0};
    edge e;
    for (size_t j = 0; j < grid->shape[1]; ++j)
        for (size_t i = 0; i < grid->shape[0]; ++i)
            for (int kind = 0; kind < 3; ++kind) {
                if (!edge_at(&e, grid, i, j, kind) || !is_tested(function, &e))
                    continue;
                ++count.n_tested;
                const int32_t found = classify_edge(&e);
                if (found == 0)
                    continue;
                const size_t n = count.n_compression + count.n_expansion;
                if (n < capacity) {
                    edges[2 * n] = e.vertex[0];
                    edges[2 * n + 1] = e.vertex[1];
                    kinds[n] = found;
                }
                count.n_compression += found == ICC_EDGE_COMPRESSION;
                count.n_expansion += found == ICC_EDGE_EXPANSION;
            }
    return count;
}

void iccp_function_count_edges(const icc_function *function, size_t *n_tested,
                               size_t *n_compression, size_t *n_expansion)
{
    const iccp_edge_count count = iccp_function_edges(function, 0, NULL, NULL);
    *n_tested = count.n_tested;
    *n_compression = count.n_compression;
    *n_expansion = count.n_expansion;
}

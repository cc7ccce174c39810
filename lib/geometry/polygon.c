/* Puts the points and edges of a polygon into walking order. */
#include "geometry/polygon.h"

#include "base/error.h"

#include <stdbool.h>

static const uint32_t NONE = UINT32_MAX;

/* Finds the facet that starts at each vertex. */
static icc_status index_starts(uint32_t *start, size_t n, const uint32_t *facets, icc_error *err)
{
    for (size_t v = 0; v < n; ++v)
        start[v] = NONE;
    for (uint32_t f = 0; f < n; ++f) {
        for (size_t end = 0; end < 2; ++end)
            if (facets[2 * f + end] >= n)
                return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_FACET, f,
                                    "facet %lu names vertex %lu, but there are only %zu vertices",
                                    (unsigned long)f, (unsigned long)facets[2 * f + end], n);
        const uint32_t v = facets[2 * f];
        if (start[v] != NONE)
            return iccp_fail_at(
                err, ICC_ERR_BOUNDARY, ICC_ITEM_FACET, f,
                "facets %lu and %lu both start at vertex %lu; a boundary is one ring "
                "of facets in one direction",
                (unsigned long)start[v], (unsigned long)f, (unsigned long)v);
        start[v] = f;
    }
    return ICC_OK;
}

/* Walks from vertex 0 along the facets. No two start at the same vertex, so the polygon is one loop
 * if the walk first returns to vertex 0 after n facets. */
static icc_status walk(iccp_polygon *polygon, const uint32_t *start, const uint32_t *facets,
                       icc_error *err)
{
    uint32_t v = 0;
    for (size_t k = 0; k < polygon->n; ++k) {
        polygon->vertex[k] = v;
        polygon->facet[k] = start[v];
        v = facets[2 * start[v] + 1];
        if ((v == 0) != (k + 1 == polygon->n))
            return iccp_fail_at(
                err, ICC_ERR_BOUNDARY, ICC_ITEM_FACET, polygon->facet[k],
                "the facets are not one ring through all %zu vertices: %zu steps from "
                "vertex 0 lead to vertex %lu",
                polygon->n, k + 1, (unsigned long)v);
    }
    return ICC_OK;
}

/* Most polygons are in order: facet k leads from vertex k to the next one. */
static bool is_in_order(size_t n, const uint32_t *facets)
{
    uint32_t wrong = 0;
    for (uint32_t k = 0; k + 1 < n; ++k)
        wrong |= (facets[2 * k] ^ k) | (facets[2 * k + 1] ^ (k + 1));
    return wrong == 0 && facets[2 * n - 2] == n - 1 && facets[2 * n - 1] == 0;
}

static void copy_point(double *to, const double *from)
{
    to[0] = from[0];
    to[1] = from[1];
}

static icc_status order_facets(iccp_polygon *polygon, const double *vertices,
                               const uint32_t *facets, const iccp_memory *memory, icc_error *err)
{
    const size_t n = polygon->n;
    uint32_t *start = iccp_alloc(memory, n, sizeof *start);
    polygon->vertex = iccp_alloc(memory, n, sizeof *polygon->vertex);
    polygon->facet = iccp_alloc(memory, n, sizeof *polygon->facet);
    polygon->points = polygon->own = iccp_alloc(memory, n + 1, 2 * sizeof *polygon->own);
    icc_status status;
    if (start == NULL || polygon->vertex == NULL || polygon->facet == NULL || polygon->own == NULL)
        status = iccp_fail_memory(err);
    else
        status = index_starts(start, n, facets, err);
    if (status == ICC_OK)
        status = walk(polygon, start, facets, err);
    iccp_free(memory, start);
    if (status != ICC_OK)
        return status;
    for (size_t k = 0; k < n; ++k)
        copy_point(polygon->own + 2 * k, vertices + 2 * (size_t)polygon->vertex[k]);
    copy_point(polygon->own + 2 * n, polygon->own);
    return ICC_OK;
}

icc_status iccp_polygon_create(iccp_polygon *polygon, size_t n, const double *vertices,
                               const uint32_t *facets, const iccp_memory *memory, icc_error *err)
{
    *polygon = (iccp_polygon){.n = n, .points = vertices};
    icc_status status = ICC_OK;
    if (facets != NULL && !is_in_order(n, facets))
        status = order_facets(polygon, vertices, facets, memory, err);
    if (status != ICC_OK)
        iccp_polygon_free(polygon, memory);
    return status;
}

void iccp_polygon_free(iccp_polygon *polygon, const iccp_memory *memory)
{
    iccp_free(memory, polygon->own);
    iccp_free(memory, polygon->facet);
    iccp_free(memory, polygon->vertex);
    *polygon = (iccp_polygon){0};
}

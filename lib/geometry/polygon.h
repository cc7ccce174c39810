/* A polygon as points and edges in the order in which one meets them walking round it, by position
 * k = 0 .. n - 1. The 2-D files of this folder work on positions; the caller's numbers of vertices
 * and facets come back where results leave the folder. */
#ifndef ICCP_POLYGON_H
#define ICCP_POLYGON_H

#include "base/env.h"

#include <stdint.h>

typedef struct iccp_polygon {
    size_t n;
    const double *points; /* n + 1 local points; the last is the first again: edge k joins k and
                             k + 1 */
    double *own;          /* the same, or NULL: they are borrowed */
    uint32_t *vertex;     /* n: the caller's number of point k; or NULL: k */
    uint32_t *facet;      /* n: the caller's number of edge k; or NULL: k */
} iccp_polygon;

/* Orders n facets over n vertices (NULL: from each to the next), starting with vertex 0. `vertices`
 * holds n points and the first once more; where the facets take them in their order the polygon
 * borrows them. ICC_ERR_BOUNDARY when the facets are not one closed polygon in one direction. */
icc_status iccp_polygon_create(iccp_polygon *polygon, size_t n, const double *vertices,
                               const uint32_t *facets, const iccp_memory *memory, icc_error *err);

/* Accepts a polygon that is all zero. */
void iccp_polygon_free(iccp_polygon *polygon, const iccp_memory *memory);

static inline uint32_t iccp_polygon_vertex(const iccp_polygon *polygon, uint32_t k)
{
    return polygon->vertex != NULL ? polygon->vertex[k] : k;
}

static inline uint32_t iccp_polygon_facet(const iccp_polygon *polygon, uint32_t k)
{
    return polygon->facet != NULL ? polygon->facet[k] : k;
}

static inline uint32_t iccp_polygon_before(const iccp_polygon *polygon, uint32_t k)
{
    return k > 0 ? k - 1 : (uint32_t)polygon->n - 1;
}

#endif

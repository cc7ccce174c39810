/* A polygon as points and edges in walking order, by position k = 0 .. n - 1. The 2-D files of this
 * folder work with positions. Results that leave the folder use the caller's numbers of vertices
 * and facets. */
#ifndef ICCP_POLYGON_H
#define ICCP_POLYGON_H

#include "base/env.h"

#include <stdint.h>

typedef struct iccp_polygon {
    size_t n;
    /* There are n + 1 local points; the last repeats the first; edge k joins k and k + 1 */
    const double *points;
    double *own;      /* the same array if the polygon owns it; NULL: borrowed */
    uint32_t *vertex; /* n: the caller's number of point k; NULL: k */
    uint32_t *facet;  /* n: the caller's number of edge k; NULL: k */
} iccp_polygon;

/* Puts n facets over n vertices into walking order, starting with vertex 0. NULL facets lead from
 * each vertex to the next. `vertices` holds n points and repeats the first. If the facets use them
 * in their order, the polygon borrows them. Returns ICC_ERR_BOUNDARY if the facets are not one
 * closed polygon in one direction. */
icc_status iccp_polygon_create(iccp_polygon *polygon, size_t n, const double *vertices,
                               const uint32_t *facets, const iccp_memory *memory, icc_error *err);

/* Accepts a polygon of all zeros. */
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

/* The polygon as a walk over the grid meets it: for every grid cell, the edges that pass through
 * it. So a walk tests a few edges in each cell, not the whole boundary ("while point inside
 * boundary" in Algorithm 5). */
#ifndef ICCP_FENCE_H
#define ICCP_FENCE_H

#include "grid/lattice.h"

typedef struct iccp_fence {
    iccp_memory memory;
    size_t nx, ny;        /* cells along the axes */
    double *vertices;     /* the domain's, in lattice coordinates */
    const uint32_t *ends; /* the domain's facets; borrowed */
    size_t *first;        /* nx * ny + 1: where a cell's edges begin in `edges` */
    uint32_t *edges;
} iccp_fence;

/* Where a step hits the fence. */
typedef struct iccp_fence_hit {
    uint32_t facet;
    double share; /* of the step, in [0,1] */
    double along; /* of the facet from its first to its second vertex, in [0,1] */
} iccp_fence_hit;

/* O(n + cells + edge pieces) time and memory. */
icc_status iccp_fence_create(iccp_fence *fence, const icc_domain *domain, const icc_grid *grid,
                             const iccp_env *env);
void iccp_fence_free(iccp_fence *fence);

/* The first edge that the step from p to q within cell (i, j) meets; touching counts. The decision
 * is exact for the rounded vertices. False when there is none. */
bool iccp_fence_first(const iccp_fence *fence, size_t i, size_t j, const double p[2],
                      const double q[2], iccp_fence_hit *hit);

#endif

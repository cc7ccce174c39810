/* Tests whether directed edges are the boundary of a plane region on their left. */
#ifndef ICCP_EDGES_BOUND_H
#define ICCP_EDGES_BOUND_H

#include "base/env.h"

#include <stdbool.h>

/* Edges between points. Each point has as many edges that reach it as edges that leave it. Points
 * without edges do not count. */
typedef struct iccp_edges {
    size_t n_points, n;
    const uint32_t *ends; /* 2 n: edge e goes from point ends[2 e] to point ends[2 e + 1] */
} iccp_edges;

/* *bound becomes true if the edges meet only at common ends, no two ends coincide, and the edges
 * wind once around each place on their left and around no other. Exact. Boundaries may touch at
 * common ends. O(n log n + n_points). */
icc_status iccp_edges_bound(bool *bound, const iccp_edges *edges, const double *points,
                            const iccp_env *env);

#endif

/* The boundary of a triangle mesh as rings, and a check that they bound a plane region. */
#ifndef ICCP_OUTLINES_H
#define ICCP_OUTLINES_H

#include "geometry/sweep.h"

/* The boundary's vertices, ring by ring. Each ring repeats its first vertex at the end. */
typedef struct iccp_outlines {
    iccp_memory memory;
    size_t n, n_points;
    iccp_chain *ring;
    uint32_t *vertex;
} iccp_outlines;

/* Collects the rings. next[v] is the vertex after v along the boundary, with the inside on the
 * left, or UINT32_MAX; the call overwrites it. Returns ICC_ERR_BOUNDARY if a ring does not close or
 * there is none. */
icc_status iccp_outlines_create(iccp_outlines *outlines, size_t n_vertices, uint32_t *next,
                                const iccp_memory *memory);
void iccp_outlines_free(iccp_outlines *outlines);

/* Returns ICC_ERR_BOUNDARY unless the rings are simple, do not meet, and wind around every point
 * once, counter-clockwise, or not at all. `points` are the coordinates of all vertices. */
icc_status iccp_outlines_check(const iccp_outlines *outlines, const double *points,
                               const iccp_env *env, icc_error *err);

#endif

/* The boundary of a mesh of triangles as rings, and whether these bound a region of the plane. */
#ifndef ICCP_OUTLINES_H
#define ICCP_OUTLINES_H

#include "domain/sweep.h"

/* The boundary's vertices ring by ring, each with its first vertex once more. */
typedef struct iccp_outlines {
    iccp_memory memory;
    size_t n, n_points;
    iccp_chain *ring;
    uint32_t *vertex;
} iccp_outlines;

/* next[v]: the vertex behind v along the boundary, with the inside on the left, or UINT32_MAX; used
 * up. ICC_ERR_BOUNDARY when the rings do not close or there is none. */
icc_status iccp_outlines_create(iccp_outlines *outlines, size_t n_vertices, uint32_t *next,
                                const iccp_memory *memory);
void iccp_outlines_free(iccp_outlines *outlines);

/* ICC_ERR_BOUNDARY unless the rings are simple and apart, and go round every point once or not at
 * all, counter-clockwise. `points`: of all vertices. */
icc_status iccp_outlines_check(const iccp_outlines *outlines, const double *points,
                               const iccp_env *env, icc_error *err);

#endif

/* The boundary of a mesh in the plane or in space, of any shape: rings, or surfaces with or without
 * handles, beside and within one another. */
#ifndef ICCP_BOUNDARY_PARTS_H
#define ICCP_BOUNDARY_PARTS_H

#include "domain/outlines.h"
#include "domain/simplices.h"

/* By the caller's numbers of vertices. */
typedef struct iccp_boundary_parts {
    iccp_memory memory;
    size_t n_vertices, n_facets, n_parts;
    iccp_outlines outlines; /* in the plane */
    uint32_t *facets;       /* surface by surface, outwards */
    uint32_t *start;        /* n_parts + 1: the first facet of each surface */
} iccp_boundary_parts;

/* ICC_ERR_BOUNDARY where parts of the boundary share a vertex, or in space an edge. */
icc_status iccp_boundary_parts_create(iccp_boundary_parts *boundary, const iccp_simplices *mesh,
                                      size_t n_vertices, const iccp_env *env, icc_error *err);
void iccp_boundary_parts_free(iccp_boundary_parts *boundary);

/* ICC_ERR_BOUNDARY unless no part of the boundary meets itself or another one, and every point is
 * within the boundary, outwards, once or not at all. Then simplices that are all positive do not
 * overlap. Exact. `points`: local ones for all of the caller's vertices. */
icc_status iccp_boundary_parts_check(const iccp_boundary_parts *boundary, const double *points,
                                     const iccp_env *env, icc_error *err);

#endif

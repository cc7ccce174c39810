/* The boundary of a mesh in the plane or in space, of any shape: rings, or surfaces with or without
 * handles, beside and within one another. */
#ifndef ICCP_BOUNDARY_PARTS_H
#define ICCP_BOUNDARY_PARTS_H

#include "domain/outlines.h"
#include "geometry/simplices.h"

/* Vertices have the caller's numbers. */
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

/* Returns ICC_ERR_BOUNDARY if a part of the boundary meets itself or another part, or if the
 * boundary does not wind round every point once or not at all. If it passes, positive simplices do
 * not overlap. Exact. `points`: local coordinates of all of the caller's vertices. */
icc_status iccp_boundary_parts_check(const iccp_boundary_parts *boundary, const double *points,
                                     const iccp_env *env, icc_error *err);

#endif

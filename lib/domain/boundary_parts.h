/* The boundary of a mesh in the plane or in space, of any shape. It may consist of several rings,
 * or of several surfaces with or without handles, beside and within one another. */
#ifndef ICCP_BOUNDARY_PARTS_H
#define ICCP_BOUNDARY_PARTS_H

#include "domain/outlines.h"
#include "geometry/simplices.h"

/* The boundary's parts. Vertices have the caller's numbers. */
typedef struct iccp_boundary_parts {
    iccp_memory memory;
    size_t dim, n_vertices, n_facets;
    iccp_outlines outlines; /* in the plane; empty if rings share vertices */
    uint32_t *facets;       /* facing outwards */
    uint32_t *across;       /* in space: as in domain/complex.h */
} iccp_boundary_parts;

/* Collects the boundary's parts. Returns ICC_ERR_BOUNDARY if two parts share a vertex or an edge in
 * space. */
icc_status iccp_boundary_parts_create(iccp_boundary_parts *boundary, const iccp_simplices *mesh,
                                      size_t n_vertices, const iccp_env *env, icc_error *err);
void iccp_boundary_parts_free(iccp_boundary_parts *boundary);

/* Returns ICC_ERR_BOUNDARY if a part of the boundary meets itself or another part, except at common
 * vertices in the plane. Also returns it if the boundary does not wind around every point once or
 * not at all. If the check passes, positive simplices do not overlap. Exact. `points` are the local
 * coordinates of all of the caller's vertices. */
icc_status iccp_boundary_parts_check(const iccp_boundary_parts *boundary, const double *points,
                                     const iccp_env *env, icc_error *err);

#endif

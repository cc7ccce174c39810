/* A triangle mesh of a polygonal domain, whose edges cover the polygon.
 *
 * Boundary vertices come first, counter-clockwise, whatever the orientation of the domain. Boundary
 * edge k joins vertices k and k + 1. Corners are numbered as in mesh/trimesh.h: corner c is number
 * c % 3 of triangle c / 3. It faces the half-edge from the corner after it to the corner before
 * it. */
#ifndef ICCP_PLANAR_H
#define ICCP_PLANAR_H

#include "domain/domain.h"
#include "mesh/triangulate.h"
#include "mesh/trimesh.h"

typedef struct iccp_planar {
    iccp_memory memory;
    size_t n_vertices, n_boundary, n_triangles;
    double *points;      /* local, 2 n_vertices */
    uint32_t *triangles; /* 3 n_triangles, counter-clockwise */
    uint32_t *twins;     /* 3 n_triangles: the corner facing the same edge, or ICCP_NO_NEIGHBOUR */
    uint32_t *facet;     /* n_boundary: domain facet that contains boundary edge k */
    uint32_t *boundary_corner; /* n_boundary: the corner that faces boundary edge k */
    uint32_t *first;           /* n_facets: boundary edge that contains the facet's first vertex */
    uint32_t *pieces;          /* n_facets: number of boundary edges on the facet */
} iccp_planar;

/* Returns the lattice step for `cells` cells along the longest side of the bounding box. */
double iccp_planar_step(const icc_domain *domain, int32_t cells);

/* Computes into how many equal pieces each facet must be cut so that no boundary edge is longer
 * than a cell. Serves two domains with corresponding facets, or one if `b` is NULL. If that needs
 * more than cells^2 edges in all, longer edges are allowed. */
void iccp_planar_pieces(uint32_t *pieces, const icc_domain *a, const icc_domain *b, int32_t cells);

/* Meshes a domain. The facets are cut into pieces. Inner points are graded from the boundary's
 * spacing to the step (mesh/grading.h). The triangulation is constrained Delaunay, and edges
 * between two boundary vertices are cut at their middle. No triangle is degenerate or inverted,
 * exactly. Returns ICC_ERR_CERTIFICATE if sides are so close that rounded points on them touch. */
icc_status iccp_planar_create(iccp_planar *mesh, const icc_domain *domain, const uint32_t *pieces,
                              int32_t cells, const iccp_env *env, icc_error *err);
void iccp_planar_free(iccp_planar *mesh);

/* Makes a mesh whose boundary is cut into pieces and allocates the rest. The caller then fills in
 * n_inner points after those of the boundary, n_triangles triangles with their twins, and the
 * corners at the boundary. */
icc_status iccp_planar_begin(iccp_planar *mesh, const icc_domain *domain, const uint32_t *pieces,
                             size_t n_inner, size_t n_triangles, const iccp_env *env);

/* Fills in `boundary_corner` of a mesh whose boundary is complete. */
void iccp_planar_list_boundary(iccp_planar *mesh);

/* Converts a position on boundary edge k, as a share `lambda` of the edge, to a share of its facet;
 * and back. */
double iccp_planar_along(const iccp_planar *mesh, const icc_domain *domain, uint32_t k,
                         double lambda);
uint32_t iccp_planar_edge(const iccp_planar *mesh, const icc_domain *domain, uint32_t facet,
                          double along, double *lambda);

/* Returns the derivative of a facet's share with respect to the share of one of its boundary
 * edges. */
double iccp_planar_along_slope(const iccp_planar *mesh, const icc_domain *domain, uint32_t facet);

#endif

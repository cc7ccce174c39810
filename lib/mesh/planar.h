/* A triangle mesh of a polygonal domain whose edges cover the polygon.
 *
 * Boundary vertices come first, counter-clockwise, however the domain is wound: mesh edge k of the
 * boundary joins vertices k and k + 1. Corners are numbered as in mesh/trimesh.h: corner c is
 * number c % 3 of triangle c / 3 and faces the half-edge from the corner after it to the one
 * before. */
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
    uint32_t *facet;     /* n_boundary: the domain's facet that holds boundary edge k */
    uint32_t *boundary_corner; /* n_boundary: the corner that faces boundary edge k */
    uint32_t *first;           /* n_facets: the boundary edge that holds a facet's first vertex */
    uint32_t *pieces;          /* n_facets: boundary edges on a facet */
} iccp_planar;

/* The lattice step for a number of cells along the longest side of the bounding box. */
double iccp_planar_step(const icc_domain *domain, int32_t cells);

/* How finely two domains with corresponding facets must cut each facet so that no boundary edge of
 * either is longer than a cell; of one domain when `b` is NULL. The pieces of a facet are equal.
 * Where that takes more than cells^2 edges in all, longer ones are allowed. */
void iccp_planar_pieces(uint32_t *pieces, const icc_domain *a, const icc_domain *b, int32_t cells);

/* Meshes a domain: its facets cut into pieces, points inside that are graded from the boundary's
 * spacing to the step (mesh/grading.h), constrained Delaunay, and edges between two boundary
 * vertices cut at their middle. No triangle is degenerate or inverted, exactly. ICC_ERR_CERTIFICATE
 * when sides are so close that rounded points on them touch. */
icc_status iccp_planar_create(iccp_planar *mesh, const icc_domain *domain, const uint32_t *pieces,
                              int32_t cells, const iccp_env *env, icc_error *err);
void iccp_planar_free(iccp_planar *mesh);

/* A mesh with its boundary, cut into pieces, and room for what is still to be filled in: n_inner
 * points after those of the boundary, n_triangles triangles and their twins, and the corners at the
 * boundary. */
icc_status iccp_planar_begin(iccp_planar *mesh, const icc_domain *domain, const uint32_t *pieces,
                             size_t n_inner, size_t n_triangles, const iccp_env *env);

/* Fills in `boundary_corner` of a mesh whose boundary is as it should be. */
void iccp_planar_list_boundary(iccp_planar *mesh);

/* A point of boundary edge k, `lambda` of the way along it, as a share of its facet; and back. */
double iccp_planar_along(const iccp_planar *mesh, const icc_domain *domain, uint32_t k,
                         double lambda);
uint32_t iccp_planar_edge(const iccp_planar *mesh, const icc_domain *domain, uint32_t facet,
                          double along, double *lambda);

/* How the share of a facet changes with the share of one of its boundary edges. */
double iccp_planar_along_slope(const iccp_planar *mesh, const icc_domain *domain, uint32_t facet);

#endif

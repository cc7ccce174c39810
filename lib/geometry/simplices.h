/* A conforming mesh of simplices that fills a domain, with its neighbours, in any dimension from 2.
 *
 * A side of the mesh is a half-facet: a facet as seen from one simplex. Side (dim + 1) s + i
 * belongs to simplex s and lies opposite its corner i. An inner facet has two sides, a boundary
 * facet has one. `corners` uses the same numbers: corner i of simplex s is entry (dim + 1) s +
 * i. */
#ifndef ICCP_SIMPLICES_H
#define ICCP_SIMPLICES_H

#include "base/env.h"
#include "geometry/frame.h"

#include <stdbool.h>

/* Marks a side on the domain's boundary. The other bits are the number of the domain's facet. */
#define ICCP_ON_BOUNDARY 0x80000000u

/* A point of the mesh on a line of the domain, between vertices a and b of the line. */
typedef struct iccp_on_line {
    uint32_t point, a, b;
    double share; /* of the way from a to b */
} iccp_on_line;

typedef struct iccp_simplices {
    iccp_memory memory;
    size_t dim;
    size_t n_points;
    size_t n_boundary; /* the first points are the vertices of the domain, in its order */
    size_t n_simplices;
    size_t n_facets; /* number of facets of the domain */
    double *points;  /* dim each, in the domain's local coordinates */
    /* The caller's number of each point; ascending within the boundary, and beyond */
    uint32_t *given;
    uint32_t *corners; /* dim + 1 each, in the order for which iccp_orient() returns 1 */
    /* For each side: the same facet as a side of its other simplex, or ICCP_ON_BOUNDARY and the
     * domain's facet. */
    uint32_t *across;
    /* The next members belong to solids with features; otherwise they are NULL and 0. By simplex: 0
     * at the outer surface, else 1 and the place of its region among the regions. */
    uint32_t *region;
    /* The points that were put on lines, in the order of the lines' segments and along them. The
     * pieces between them are edges of the mesh. */
    iccp_on_line *on_line;
    size_t n_on_lines;
} iccp_simplices;

void iccp_simplices_free(iccp_simplices *mesh);

/* Copies a mesh without the caller's numbers. */
icc_status iccp_simplices_copy(iccp_simplices **out, const iccp_simplices *mesh,
                               const iccp_memory *memory);

static inline size_t iccp_simplex_of(const iccp_simplices *mesh, uint32_t side)
{
    return mesh->dim == 3 ? side / 4 : side / (uint32_t)(mesh->dim + 1);
}

static inline const double *iccp_corner_point(const iccp_simplices *mesh, size_t side)
{
    return mesh->points + mesh->dim * mesh->corners[side];
}

/* Names of a simplex and its facet: "tetrahedron" and "face" in 3-D. */
const char *iccp_simplices_name(size_t dim);
const char *iccp_simplices_facet(size_t dim);

/* ---- making a mesh from dim, n_points, points, n_simplices and corners, by any numbers ---- */

/* Returns ICC_ERR_BOUNDARY unless every corner is a point and no simplex contains a point twice. */
icc_status iccp_simplices_check_corners(const iccp_simplices *mesh, icc_error *err);

/* Exchanges two corners of each simplex that is not positive. Returns ICC_ERR_BOUNDARY if a simplex
 * is flat. */
icc_status iccp_simplices_orient(iccp_simplices *mesh, icc_error *err);

/* Fills in n_facets and `across` of an oriented mesh. If `facets` is not NULL, its n_facets facets,
 * of dim points each, must be those of the boundary. Otherwise boundary facets are numbered in the
 * order of their points. Returns ICC_ERR_BOUNDARY unless every facet has one or two simplices, and
 * two lie on opposite sides. */
icc_status iccp_simplices_join(iccp_simplices *mesh, size_t n_facets, const uint32_t *facets,
                               icc_error *err);

/* Lists the points of a side as seen from beyond it; for the boundary, from outside. */
void iccp_simplices_side(const iccp_simplices *mesh, size_t side, uint32_t *points);

/* Returns ICC_ERR_TOPOLOGY unless the simplices of a joined mesh are connected across facets and,
 * but in space, have Euler characteristic 1. Every point must belong to a simplex. */
icc_status iccp_simplices_check_shape(const iccp_simplices *mesh, icc_error *err);

#endif

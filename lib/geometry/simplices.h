/* A conforming mesh of simplices that fills a domain, with its neighbours, in any dimension from 2.
 *
 * A side of the mesh is a half-facet, a facet as seen from one simplex: side (dim + 1) s + i
 * belongs to simplex s and lies opposite its corner i. An inner facet has two sides, one of the
 * boundary has one. `corners` has the same numbers: corner i of simplex s is entry (dim + 1) s +
 * i. */
#ifndef ICCP_SIMPLICES_H
#define ICCP_SIMPLICES_H

#include "base/env.h"

#include <stdbool.h>

/* The mark of a side on the domain's boundary; the other bits are the number of the facet there. */
#define ICCP_ON_BOUNDARY 0x80000000u

typedef struct iccp_simplices {
    iccp_memory memory;
    size_t dim;
    size_t n_points;
    size_t n_boundary; /* the first ones are the vertices of the domain, in its order */
    size_t n_simplices;
    size_t n_facets;   /* of the domain */
    double *points;    /* dim each, in the domain's local coordinates */
    uint32_t *given;   /* of each point: the caller's number of it; ascending up to n_boundary, and
                          beyond */
    uint32_t *corners; /* dim + 1 each, so that iccp_orient() of them is 1 */
    uint32_t
        *across; /* of each side: the same side as seen from its other simplex, or ICCP_ON_BOUNDARY
                    and the domain's facet */
} iccp_simplices;

void iccp_simplices_free(iccp_simplices *mesh);

/* Without the caller's numbers. */
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

/* What a simplex and a facet of one are called: "tetrahedron" and "face" in 3-D. */
const char *iccp_simplices_name(size_t dim);
const char *iccp_simplices_facet(size_t dim);

/* ---- making one: dim, n_points, points, n_simplices and corners are given, by any numbers ---- */

/* ICC_ERR_BOUNDARY unless every corner is a point and no simplex has one twice. */
icc_status iccp_simplices_check_corners(const iccp_simplices *mesh, icc_error *err);

/* Exchanges two corners of those simplices that are not positive. ICC_ERR_BOUNDARY if one is
 * flat. */
icc_status iccp_simplices_orient(iccp_simplices *mesh, icc_error *err);

/* Fills in n_facets and `across` of a mesh that is oriented. When `facets` is not NULL, the
 * n_facets facets, dim points each, must be those of the boundary; otherwise these are numbered in
 * the order of their points. ICC_ERR_BOUNDARY unless every facet has one or two simplices, which
 * lie on opposite sides. */
icc_status iccp_simplices_join(iccp_simplices *mesh, size_t n_facets, const uint32_t *facets,
                               icc_error *err);

/* The points of a side, as seen from the other side of it: for the boundary, from outside. */
void iccp_simplices_side(const iccp_simplices *mesh, size_t side, uint32_t *points);

/* ICC_ERR_TOPOLOGY unless the simplices of a joined mesh are connected across facets and their
 * Euler characteristic is 1. Every point must belong to a simplex. */
icc_status iccp_simplices_check_shape(const iccp_simplices *mesh, icc_error *err);

#endif

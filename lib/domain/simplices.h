/* A conforming mesh of simplices that fills a domain, with its neighbours, in any dimension from 2.
 *
 * A side of the mesh is a facet as seen from one simplex: side (dim + 1) s + i belongs to simplex s and
 * lies opposite its corner i. */
#ifndef ICCP_SIMPLICES_H
#define ICCP_SIMPLICES_H

#include "base/env.h"

/* The mark of a side on the domain's boundary; the other bits are the number of the facet there. */
#define ICCP_RIM 0x80000000u

typedef struct iccp_simplices {
    iccp_memory memory;
    size_t dim;
    size_t n_points;
    size_t n_rim;       /* the first ones are the vertices of the domain, in its order */
    size_t n_simplices;
    size_t n_facets;    /* of the domain */
    double *points;     /* dim each, in the domain's local coordinates */
    uint32_t *corners;  /* dim + 1 each, so that iccp_orient() of them is 1 */
    uint32_t *across;   /* of each side: the same side as seen from its other simplex, or ICCP_RIM and the
                           domain's facet */
} iccp_simplices;

void iccp_simplices_free(iccp_simplices *mesh);

static inline size_t iccp_simplex_of(const iccp_simplices *mesh, uint32_t side)
{
    return side / (uint32_t)(mesh->dim + 1);
}

static inline const double *iccp_corner_point(const iccp_simplices *mesh, size_t side)
{
    return mesh->points + mesh->dim * mesh->corners[side];
}

#endif

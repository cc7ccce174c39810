/* Points of a surface, each beside the triangle of a coarser one that it is near to. */
#ifndef ICCP_COVERING_H
#define ICCP_COVERING_H

#include "geometry/facet_tree.h"
#include "match/surface/half_edges.h"

/* Corners of a triangle. */
typedef struct iccp_corners {
    const double *at[3];
} iccp_corners;

typedef struct iccp_covering {
    iccp_facet_tree given; /* the surface, its faces counter-clockwise from outside */
    const double *x;       /* borrowed: 3 n_points: points of the surface */
    double most2;          /* squared: how far they may be from the coarser one, and it from them */
    uint32_t *first;       /* by triangle: the first point beside it; or ICCP_NO_EDGE */
    uint32_t *next;        /* by point: the next one beside the same triangle */
} iccp_covering;

/* Puts each point beside the nearest triangle. False if there is no memory; to be freed in either
 * case. */
bool iccp_covering_create(iccp_covering *c, const iccp_half_edges *given, const double *x_given,
                          size_t n_points, const double *points, double most,
                          const iccp_facet_tree *coarse, const iccp_memory *memory);
void iccp_covering_free(iccp_covering *c, const iccp_memory *memory);

/* Whether triangles may take the place of others: each point beside these is near one of them, and
 * the middles of them and of their first sides are near the surface, which they face as its faces
 * there do. Sides that are new have to be the first of one. Points change their order. */
bool iccp_covering_allows(iccp_covering *c, size_t n_old, const uint32_t *old, size_t n,
                          const iccp_corners *triangles);

/* Puts what was beside the old triangles beside the nearest of n new ones, with these numbers. */
void iccp_covering_replace(iccp_covering *c, size_t n_old, const uint32_t *old, size_t n,
                           const iccp_corners *triangles, const uint32_t *numbers);

#endif

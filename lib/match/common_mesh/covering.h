/* Points of a surface, each assigned to a close triangle of a coarser surface. */
#ifndef ICCP_COVERING_H
#define ICCP_COVERING_H

#include "geometry/triangle_near.h"
#include "match/surface/half_edges.h"

/* The corners of a triangle. */
typedef struct iccp_corners {
    const double *at[3];
} iccp_corners;

typedef struct iccp_covering {
    iccp_facet_tree given; /* the surface, its faces counter-clockwise from outside */
    const double *x;       /* borrowed: 3 n_points: points of the surface */
    double most2;          /* the largest squared distance of a point from the coarser surface,
                              and back */
    uint32_t *first;       /* by triangle: its first point; or ICCP_NO_EDGE */
    uint32_t *next;        /* by point: the next point of the same triangle */
} iccp_covering;

/* Assigns each point to the nearest triangle. False if there is no memory. Free it in any case. */
bool iccp_covering_create(iccp_covering *c, const iccp_half_edges *given, const double *x_given,
                          size_t n_points, const double *points, double most,
                          const iccp_facet_tree *coarse, const iccp_memory *memory);
void iccp_covering_free(iccp_covering *c, const iccp_memory *memory);

/* Returns true if triangles may replace others. Each point of the old triangles must be close to a
 * new one. The middles of the new triangles and of their first sides must be close to the surface,
 * and face the same way. So each new side must be the first side of some triangle. The order of the
 * points changes. */
bool iccp_covering_allows(iccp_covering *c, size_t n_old, const uint32_t *old, size_t n,
                          const iccp_corners *triangles);

/* Assigns the points of the old triangles to the nearest of n new ones, which have these
 * numbers. */
void iccp_covering_replace(iccp_covering *c, size_t n_old, const uint32_t *old, size_t n,
                           const iccp_corners *triangles, const uint32_t *numbers);

#endif

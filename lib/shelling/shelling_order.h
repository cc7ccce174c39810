/* Orders of the simplices of a ball. Every leaf of the foliation passes simplices of ever smaller
 * rank.
 *
 * The simplices at the centre have rank 0. The others have ranks 1, 2, .. in the order in which
 * they can be added so that each union is a ball. This is a shelling that starts with the star of a
 * vertex.
 *
 * Let R be the set of corners of a simplex T that are opposite to the facets shared with
 * simplices of smaller rank. T may be added if and only if 1 <= |R| <= dim and the face with the
 * corners R is not yet part of the union. Source: see shelling_order.c. */
#ifndef ICCP_SHELLING_ORDER_H
#define ICCP_SHELLING_ORDER_H

#include "shelling/faces.h"

/* What determines an order. */
typedef struct iccp_order_priority {
    const iccp_simplices *mesh;
    const iccp_faces *faces; /* of the mesh */
    uint32_t centre;         /* a vertex inside */
    const double *flux;      /* of each side: it should run from greater to smaller rank */
    const double *potential; /* of each simplex: simplices with a small potential should get a small
                                rank */
    double beta;             /* weight of reversed flux against the potential */
    const double *bias;      /* added to the potential of each simplex in comparisons; or NULL */
} iccp_order_priority;

/* Adds simplices to the star of the centre, one by one. `rank` is by simplex. `n_left` counts
 * the simplices that could not be added, whose rank is UINT32_MAX. Returns ICC_OK,
 * ICC_ERR_MEMORY or ICC_ERR_CANCELLED. O(n log n). */
icc_status iccp_order_grow(const iccp_order_priority *priority, uint32_t *rank, size_t *n_left,
                           const iccp_env *env);

/* Works from the other end: takes simplices at the boundary away, one by one, so that a ball is
 * left each time. It ends when only the star of the centre remains. */
icc_status iccp_order_peel(const iccp_order_priority *priority, uint32_t *rank, size_t *n_left,
                           const iccp_env *env);

#endif

/* Orders of the simplices of a ball: every leaf of the foliation passes simplices of ever smaller
 * rank.
 *
 * The simplices at the centre have rank 0, the others 1, 2, ... in the order in which they can be
 * added so that the union is a ball every time: a shelling that starts with the star of a vertex.
 * Simplex T may be added iff 1 <= |R| <= dim, where R is the set of its corners opposite to the
 * facets shared with simplices of smaller rank, and the face with the corners R is not part of the
 * union yet. */
#ifndef ICCP_SHELLING_ORDER_H
#define ICCP_SHELLING_ORDER_H

#include "shelling/faces.h"

/* What an order is made from. */
typedef struct iccp_order_priority {
    const iccp_simplices *mesh;
    const iccp_faces *faces; /* of the mesh */
    uint32_t centre;         /* not on the boundary */
    const double *flux;      /* of each side: it shall run from greater to smaller rank */
    const double *potential; /* of each simplex: where it is small the rank shall be small */
    double beta;             /* how much reversed flux weighs against the potential */
    const double *bias;      /* added to the potential of each simplex in the comparison; or NULL */
} iccp_order_priority;

/* Adds simplices to the star of the centre, one by one. `rank` is of each simplex. `n_left` counts
 * those that could not be added; their rank is UINT32_MAX. ICC_OK, ICC_ERR_MEMORY or
 * ICC_ERR_CANCELLED. O(n log n). */
icc_status iccp_order_grow(const iccp_order_priority *priority, uint32_t *rank, size_t *n_left,
                           const iccp_env *env);

/* The same from the other end: takes simplices at the boundary away, one by one, as long as a ball
 * is left, until the star of the centre remains. */
icc_status iccp_order_peel(const iccp_order_priority *priority, uint32_t *rank, size_t *n_left,
                           const iccp_env *env);

#endif

/* Orders of the simplices of a ball: every leaf of the foliation passes simplices of ever smaller rank.
 *
 * The simplices at the centre have rank 0, the others 1, 2, ... in the order in which they can be added so
 * that the union is a ball every time: a shelling that starts with the star of a vertex. Simplex T may be
 * added iff 1 <= |R| <= dim, where R is the set of its corners opposite to the facets shared with
 * simplices of smaller rank, and the face with the corners R is not part of the union yet. */
#ifndef ICCP_ORDER_H
#define ICCP_ORDER_H

#include "domain/simplices.h"

typedef struct iccp_order_wish {
    const double *flux;      /* that shall run from greater to smaller rank: see shelling/reference.h */
    const double *potential; /* simplices where it is small shall have small rank */
    double beta;             /* how much reversed flux weighs against the potential */
    const double *bias;      /* added to the priority of each simplex, greater is later; or NULL */
} iccp_order_wish;

/* Adds simplices to the star of the centre, one by one. `n_left` tells how many could not be added; if
 * there are any, their rank is UINT32_MAX. ICC_OK, ICC_ERR_MEMORY or ICC_ERR_CANCELLED.
 * O(n log n). */
icc_status iccp_order_grow(const iccp_simplices *mesh, uint32_t centre, const iccp_order_wish *wish,
                           uint32_t *rank, size_t *n_left, const iccp_env *env);

/* The same from the other end: takes simplices with facets on the boundary away, one by one, as long as
 * a ball is left, until the star of the centre remains. Those that remain besides have rank 1 if
 * `n_left` is not 0. */
icc_status iccp_order_peel(const iccp_simplices *mesh, uint32_t centre, const iccp_order_wish *wish,
                           uint32_t *rank, size_t *n_left, const iccp_env *env);

#endif

/* The quadratic program of constrained bi-Laplace functions. It minimises 1/2 |A f|^2 among the f
 * with f_0 = 1, f_parent >= sigma f_child on the edges of the tree, and f >= leaf at the unknowns
 * without children. */
#ifndef ICCP_QP_H
#define ICCP_QP_H

#include "gradient/solver/energy.h"

#include <stdbool.h>

/* Inequality i < n - 1 belongs to the edge from unknown i + 1 to its parent. Inequality n - 1 + j
 * belongs to the unknown leaf_unknown[j]. */
typedef struct iccp_qp {
    const iccp_unknowns *unknowns;
    iccp_sparse a; /* see energy.h */
    double sigma;  /* 1 + eta */
    double leaf;
    size_t n_leaves;
    uint32_t *leaf_unknown; /* n_leaves: the unknowns without children, in rising order */
} iccp_qp;

icc_status iccp_qp_create(iccp_qp *qp, const iccp_unknowns *unknowns, int32_t function, double eta,
                          double leaf, const iccp_env *env);
void iccp_qp_free(iccp_qp *qp);

/* The number of edges and leaves. */
static inline size_t iccp_qp_inequalities(const iccp_qp *qp)
{
    return qp->unknowns->n - 1 + qp->n_leaves;
}

/* Returns the largest value that the inequalities require of the root. If it exceeds 1, there is no
 * solution. */
double iccp_qp_least_root(const iccp_qp *qp, double *work /* n */);

/* slack = G f, minus the bounds unless f is a direction. */
void iccp_qp_slacks(const iccp_qp *qp, const double *f, bool is_direction, double *slack);

/* out += G' y */
void iccp_qp_add_forces(const iccp_qp *qp, const double *y, double *out);

#endif

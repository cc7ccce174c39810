/* The quadratic program of qp.h on every other vertex of its grid along each axis. */
#ifndef ICCP_COARSE_QP_H
#define ICCP_COARSE_QP_H

#include "gradient/solver/qp.h"

typedef struct iccp_coarse_qp {
    iccp_memory memory;
    const iccp_qp *fine; /* borrowed */
    icc_tree *tree;      /* NULL: there is nothing to solve on */
    iccp_unknowns unknowns;
    iccp_qp qp;
    uint32_t *unknown_of; /* per coarse vertex: its unknown, or ICCP_NONE */
} iccp_coarse_qp;

/* The coarse vertices are those whose coordinates differ from the root's by even numbers, and they
 * are inside where the fine ones are. Their tree is grown anew, along the same axes. *useful: it
 * reaches about as much as it should; else nothing is left allocated. */
icc_status iccp_coarse_qp_create(iccp_coarse_qp *coarse, bool *useful, const iccp_qp *fine,
                                 int32_t function, const iccp_env *env);
void iccp_coarse_qp_free(iccp_coarse_qp *coarse);

/* Fine values from coarse ones: f, per unknown, is interpolated; multipliers, per inequality, are
 * means of those of the coarse edges next to them that have the same direction. */
icc_status iccp_coarse_qp_prolong(const iccp_coarse_qp *coarse, const double *coarse_f,
                                  const double *coarse_multiplier, double *f, double *multiplier,
                                  const iccp_env *env);

#endif

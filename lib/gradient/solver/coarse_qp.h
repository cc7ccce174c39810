/* The quadratic program of qp.h on every other vertex of its grid along each axis. */
#ifndef ICCP_COARSE_QP_H
#define ICCP_COARSE_QP_H

#include "gradient/solver/qp.h"

typedef struct iccp_coarse_qp {
    iccp_memory memory;
    const iccp_qp *fine; /* borrowed */
    icc_tree *tree;      /* NULL: there is no useful coarse grid */
    iccp_unknowns unknowns;
    iccp_qp qp;
    uint32_t *unknown_of; /* by coarse vertex: its unknown, or ICCP_NONE */
} iccp_coarse_qp;

/* Makes the coarse problem. Coarse vertices are those whose coordinates differ from the root's by
 * even numbers. They are inside where the fine ones are. Their tree grows again, along the same
 * axes. *useful is true if it reaches about as many as expected; otherwise nothing stays
 * allocated. */
icc_status iccp_coarse_qp_create(iccp_coarse_qp *coarse, bool *useful, const iccp_qp *fine,
                                 int32_t function, const iccp_env *env);
void iccp_coarse_qp_free(iccp_coarse_qp *coarse);

/* Computes fine values from coarse ones. f, per unknown, is interpolated. A multiplier, per
 * inequality, is the mean of those of nearby coarse edges with the same direction. */
icc_status iccp_coarse_qp_prolong(const iccp_coarse_qp *coarse, const double *coarse_f,
                                  const double *coarse_multiplier, double *f, double *multiplier,
                                  const iccp_env *env);

#endif

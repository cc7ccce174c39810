/* Bounded biharmonic weights. */
#ifndef ICCP_BIHARMONIC_H
#define ICCP_BIHARMONIC_H

#include "kernel/sampling/shape.h"

typedef struct iccp_biharmonic {
    const icc_shape *shape; /* in the plane */
    double spacing;         /* of edges on walls, in the caller's units */
    size_t n, n_handles;
    const double *nodes; /* 2 n, in the caller's coordinates */
    const bool *held;    /* by node: its weights are given, with sum 1 */
} iccp_biharmonic;

/* Computes n rows of n_handles weights, of which the held ones are given. status[i] becomes
 * ICC_ERR_SOLVER if all weights of a free node would be 0; they are equal then. `residual` is the
 * largest of iccp_bounded_solve(). Returns
 * - ICC_ERR_UNSUPPORTED if a node is in no region
 * - ICC_ERR_ARGUMENT if a region has no held node, and none on the walls inside it
 * - ICC_ERR_RESOLUTION or ICC_ERR_SOLVER, see region_mesh.h and bounded_program.h. */
icc_status iccp_biharmonic_solve(const iccp_biharmonic *problem, double *weights,
                                 icc_status *status, double *residual, const iccp_env *env,
                                 icc_error *err);

/* Sets negative weights to 0 and divides all m by their sum. If none is positive, they become
 * equal, and the result is ICC_ERR_SOLVER. */
icc_status iccp_share_out(size_t m, double *weights);

#endif

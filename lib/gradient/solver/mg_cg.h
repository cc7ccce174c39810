/* Conjugate gradients for the Laplacian on the vertices of a multigrid's finest level. */
#ifndef ICCP_MG_CG_H
#define ICCP_MG_CG_H

#include "gradient/solver/multigrid.h"

/* When an iteration ends: all three must hold. */
typedef struct iccp_mg_goal {
    double relative;      /* |residual| <= relative * |b|, in the Euclidean norm */
    double componentwise; /* each |residual| <= componentwise * 2 dim * max(x, floor * the largest
                             x) */
    double floor;
} iccp_mg_goal;

/* x: the guess, then the solution; r: b - L x of the guess, then that of the solution; both with
 * n_entries of level 0, 0 outside; |b| = `size`. Adds to *n_iterations. ICC_ERR_SOLVER when the
 * goal is out of reach. 4 bytes an entry while it runs: with x, r and the multigrid 32 bytes a
 * vertex of a large box, up to 60 where a shape is thin. */
icc_status iccp_mg_cg(iccp_multigrid *mg, double *x, double *r, double size,
                      const iccp_mg_goal *goal, size_t *n_iterations, const iccp_env *env);

#endif

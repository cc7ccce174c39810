/* Conjugate gradients for the Laplacian on the vertices of a multigrid's finest level. */
#ifndef ICCP_MG_CG_H
#define ICCP_MG_CG_H

#include "gradient/solver/multigrid.h"

/* Three conditions, all of which must hold at the end. */
typedef struct iccp_mg_goal {
    double relative;      /* |residual| <= relative * |b|, in the Euclidean norm */
    double componentwise; /* each |residual| <= componentwise * 2 dim * max(x, floor * the largest
                             x) */
    double floor;
} iccp_mg_goal;

/* Iterations without a smaller residual, after which the goal is out of reach. */
enum { ICCP_CG_PATIENCE = 60 };

/* Multiplications per entry of an iteration, with all levels. */
#define ICCP_CG_WORK 60.0

/* On entry x is a guess and r = b - L x its residual. On return they are the solution and its
 * residual. Both have n_entries of level 0 and are 0 outside; |b| = `size`. Adds to *n_iterations.
 * Returns ICC_ERR_SOLVER if the goal is out of reach. Needs 4 bytes per entry while it runs.
 * Together with x, r and the multigrid that is 32 bytes per vertex of a large box, and up to 60
 * where a shape is thin. */
icc_status iccp_mg_cg(iccp_multigrid *mg, double *x, double *r, double size,
                      const iccp_mg_goal *goal, size_t *n_iterations, const iccp_env *env);

#endif

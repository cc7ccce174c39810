/* Conjugate gradients for P'LP, the Laplacian with some vertices tied to others
 * (gradient/solver/tied.h). */
#ifndef ICCP_TIED_CG_H
#define ICCP_TIED_CG_H

#include "gradient/solver/mg_cg.h"

/* A vertex that is tied to another one. Both are positions on the multigrid's finest level. */
typedef struct iccp_tie {
    size_t member, top;
    double share;
} iccp_tie;

/* x, r, size, goal and n_iterations are as in iccp_mg_cg(). x and r are for the vertices that are
 * not tied to others; the rest of r is 0, and the rest of x is overwritten. The members of a top
 * are consecutive. Needs about 50 bytes per entry while it runs, including x, r and the
 * multigrid. */
icc_status iccp_tied_cg(iccp_multigrid *mg, size_t n_tied, const iccp_tie *tie, double *x,
                        double *r, double size, const iccp_mg_goal *goal, size_t *n_iterations,
                        const iccp_env *env);

/* y = P'LP x. x is given at the tops, and its other entries are filled in. y is 0 at the
 * members. */
void iccp_tied_apply(const iccp_mg_level *level, size_t n_tied, const iccp_tie *tie, double *x,
                     double *y);

/* Sums products, in an order that depends only on n. */
double iccp_mg_dot(size_t n, const double *a, const double *b);

#endif

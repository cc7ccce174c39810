/* The discrete Dirichlet problem with some unknowns tied to others.
 *
 * An unknown is tied to another one, its top, if its value is a fixed share of the top's. That is
 * so for a child whose inequality f_parent >= sigma f_child holds with equality. Chains of such
 * children share one top. The unknowns tied to a top are its members, and together they form a
 * cluster.
 *
 * The solution has the least Dirichlet energy among all functions with f = 1 at the root, 0 outside
 * and f_k = share_k f_top(k). The energy is the sum of (f_u - f_v)^2 over neighbours u, v. Let P be
 * the n by n_tops matrix of the shares and L the Laplacian (2 dim on the diagonal, -1 per
 * neighbour). Then P'LP x = 0 except in the row of the root, and x_root = 1. P'LP is a symmetric
 * M-matrix, so f > 0. Without ties this is Laplace's equation. */
#ifndef ICCP_TIED_H
#define ICCP_TIED_H

#include "gradient/solver/solution.h"
#include "gradient/solver/unknowns.h"
#include "math/scaled.h"

typedef struct iccp_ties {
    /* N: the unknown that each is tied to, or itself. top[k] <= k and top[top[k]] == top[k]; top[0]
     * == 0 */
    const uint32_t *top;
    const double *share; /* n: in (0, 1]; 1 if top[k] == k */
    /* N, or NULL: keeps the order of elimination of a solver by factorisation for the next call;
     * order[0] is ICCP_NONE before the first */
    uint32_t *order;
} iccp_ties;

/* A solver of this problem. f has n entries. On entry it is a normalised, positive guess. Only the
 * iterative solver uses it, but the fractions must not be NULL. On return f is the normalised
 * solution, positive everywhere. The solver adds its effort to `info` (work, n_inner,
 * seconds_*). */

/* Solves by factorisation (math/ldlt). Every entry is accurate to about 1e-12 of itself, however
 * small. If residuals show that some are not, returns ICC_ERR_SOLVER, and f is meaningless. */
icc_status iccp_tied_direct(const iccp_unknowns *unknowns, const iccp_ties *ties,
                            const iccp_scaled *f, iccp_solution *info, const iccp_env *env);

/* Solves by conjugate gradients with a multigrid preconditioner, in shells. Where f is small
 * compared with the known values, it is rescaled and solved for again. */
icc_status iccp_tied_iterative(const iccp_unknowns *unknowns, const iccp_ties *ties,
                               const iccp_scaled *f, iccp_solution *info, const iccp_env *env);

#endif

/* The discrete Dirichlet problem with some unknowns tied to others.
 *
 * An unknown is tied to another one, its top, when its value is not free but a fixed share of that
 * of the top: so it is for a child whose inequality f_parent >= sigma f_child holds with equality.
 * Chains of such children share one top. The unknowns tied to a top are its members; with it they
 * make up a cluster.
 *
 * Among all functions with f = 1 at the root, 0 outside and f_k = share_k f_top(k), the one with
 * the least Dirichlet energy, the sum of (f_u - f_v)^2 over neighbours u, v. With P the n by n_tops
 * matrix of the shares and L the Laplacian (2 dim on the diagonal, -1 per neighbour): P'LP x = 0
 * but for the row of the root, x_root = 1. P'LP is a symmetric M-matrix, so that f > 0. Without
 * ties this is Laplace's equation. */
#ifndef ICCP_TIED_H
#define ICCP_TIED_H

#include "gradient/solver/unknowns.h"
#include "math/scaled.h"

typedef struct iccp_ties {
    const uint32_t *top; /* n: the unknown that each is tied to, itself if to none. top[k] <= k and
                            top[top[k]] == top[k]; top[0] == 0 */
    const double *share; /* n: in (0, 1]; 1 where top[k] == k */
    uint32_t *order;     /* n, or NULL: where a solver by factorisation keeps its order of
                            elimination for the next call; order[0] is ICCP_NONE before the
                            first */
} iccp_ties;

/* A solver of this problem. f: n entries; a guess (normalised, positive) on entry, which only the
 * iterative one uses and NULL fractions are not allowed; the normalised solution on return,
 * positive everywhere. Adds what it did to `info` (work, n_inner, seconds_*). */

/* By factorisation (math/ldlt): every entry to about 1e-12 of itself, however small. ICC_ERR_SOLVER
 * when some are not, by their residuals: then f is meaningless. */
icc_status iccp_tied_direct(const iccp_unknowns *unknowns, const iccp_ties *ties,
                            const iccp_scaled *f, icc_function_info *info, const iccp_env *env);

/* By conjugate gradients with a multigrid preconditioner, in shells: where f has become small
 * compared with what is already known, it is rescaled and solved for anew. */
icc_status iccp_tied_iterative(const iccp_unknowns *unknowns, const iccp_ties *ties,
                               const iccp_scaled *f, icc_function_info *info, const iccp_env *env);

#endif

/* Solves sparse symmetric positive definite systems. The simplest way to use the factorisation of
 * math/ldlt.h. */
#ifndef ICCP_SPD_H
#define ICCP_SPD_H

#include "math/ldlt.h"

/* Orders, analyses and factorises. Returns ICC_ERR_SOLVER if the matrix is not positive definite.
 * On failure nothing stays allocated. */
icc_status iccp_spd_create(iccp_ldlt *factor, const iccp_symmetric *matrix, const iccp_env *env);

/* Solves for n_rhs right-hand sides at once. Entry i of column r is b[i * n_rhs + r] and is
 * replaced by the solution. */
icc_status iccp_spd_solve(const iccp_ldlt *factor, size_t n_rhs, double *b, const iccp_env *env);

#endif

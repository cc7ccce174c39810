/* Solving sparse symmetric positive definite systems, all in one. */
#ifndef ICCP_SPD_H
#define ICCP_SPD_H

#include "math/ldlt.h"

/* Orders, analyses and factorises. ICC_ERR_SOLVER when the matrix is not positive definite; on
 * failure nothing is left allocated. */
icc_status iccp_spd_create(iccp_ldlt *factor, const iccp_symmetric *matrix, const iccp_env *env);

/* Solves for n_rhs right-hand sides at once: entry i of column r at b[i * n_rhs + r], replaced
 * by the solution. */
icc_status iccp_spd_solve(const iccp_ldlt *factor, size_t n_rhs, double *b, const iccp_env *env);

#endif

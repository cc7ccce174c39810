/* Solving sparse symmetric positive definite systems, whatever the back end: a factorisation where
 * an ordering is available, preconditioned conjugate gradients elsewhere. */
#ifndef ICCP_SPD_H
#define ICCP_SPD_H

#include "math/ldlt.h"
#include "math/pcg.h"

#include <stdbool.h>

typedef struct iccp_spd {
    iccp_symmetric matrix; /* borrowed: must outlive the solver */
    bool direct;
    iccp_ldlt factor;
} iccp_spd;

/* Direct where iccp_ordering_available(), unless `iterative` asks otherwise. */
icc_status iccp_spd_create(iccp_spd *solver, const iccp_symmetric *matrix, bool iterative,
                           const iccp_env *env);
void iccp_spd_free(iccp_spd *solver);

/* Solves for n_rhs right-hand sides at once: entry i of column r at b[i * n_rhs + r], replaced
 * by the solution. ICC_ERR_SOLVER when the iteration does not converge. */
icc_status iccp_spd_solve(const iccp_spd *solver, size_t n_rhs, double *b, const iccp_env *env);

#endif

/* Minimises a quadratic form between 0 and 1, with some values given. */
#ifndef ICCP_BOUNDED_PROGRAM_H
#define ICCP_BOUNDED_PROGRAM_H

#include "base/env.h"
#include "math/symmetric.h"

#include <stdbool.h>

typedef struct iccp_bounded {
    const iccp_symmetric *matrix; /* positive definite without the held rows */
    const uint32_t *order;        /* all rows, in an order that keeps factors sparse */
    const bool *held;             /* by row: its value is given */
} iccp_bounded;

/* Minimises x'Qx among the x with given values at held rows, and values in [0, 1] elsewhere. On
 * entry x has the given values. On return `residual` is the largest step that is still possible for
 * one value: x minus the nearest number in [0, 1] to x - (Qx) / Q_ii. Returns ICC_ERR_SOLVER if the
 * matrix is not positive definite, or if the bounds that hold with equality are not found.
 *
 * Needs a factorisation for each round, of the values that are neither 0 nor 1. The number of
 * rounds grows with the number of rows across the shape; 7,000 rows in the plane need some 25. */
icc_status iccp_bounded_solve(const iccp_bounded *program, double *x, double *residual,
                              const iccp_env *env);

#endif

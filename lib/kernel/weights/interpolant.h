/* Interpolates weights from nodes to all points: a sum of kernels at the nodes and an affine
 * function with given values at the nodes (6.1 to 6.3). */
#ifndef ICCP_INTERPOLANT_H
#define ICCP_INTERPOLANT_H

#include "base/simd.h"
#include "kernel/weights/kernel_matrix.h"
#include "math/ldlt.h"

#include <stdbool.h>

/* The factorised matrix of the nodes, shared by all weights on the same nodes. */
typedef struct iccp_collocation iccp_collocation;

/* Makes and factorises the matrix. Returns ICC_ERR_SOLVER if it is not positive definite to working
 * precision. `points` are copied. */
icc_status iccp_collocation_create(iccp_collocation **out, size_t dim, size_t n,
                                   const double *points, const iccp_radial *radial, bool tail,
                                   const iccp_env *env, icc_error *err);
void iccp_collocation_free(iccp_collocation *collocation);

size_t iccp_collocation_entries(const iccp_collocation *collocation);
const iccp_symmetric *iccp_collocation_matrix(const iccp_collocation *collocation);
const iccp_radial *iccp_collocation_radial(const iccp_collocation *collocation);
/* Returns the least pivot divided by the greatest. */
double iccp_collocation_definiteness(const iccp_collocation *collocation);

/* Computes coefficients for n rows of m values: n + dim + 1 rows of m. The last dim + 1 belong to
 * the affine function, and are 0 without it. */
icc_status iccp_collocation_solve(const iccp_collocation *collocation, size_t m,
                                  const double *values, double *coefficients, const iccp_env *env);

/* Like iccp_collocation_solve(), for the columns in `which` (NULL: all). The other columns stay. */
icc_status iccp_collocation_solve_some(const iccp_collocation *collocation, size_t m,
                                       const double *values, const bool *which,
                                       double *coefficients, const iccp_env *env);

/* Computes m values at a point, and m * dim derivatives unless NULL. */
void iccp_collocation_evaluate(const iccp_collocation *collocation, size_t m,
                               const double *coefficients, const double *point, double *values,
                               double *gradients);

/* Like iccp_collocation_evaluate(), at an instruction level that the processor has. */
void iccp_collocation_evaluate_as(iccp_simd_level level, const iccp_collocation *collocation,
                                  size_t m, const double *coefficients, const double *point,
                                  double *values, double *gradients);

/* Z and (P'Z)^-1 of the affine function, see interpolant.c. Z has n rows of dim + 1, or is NULL
 * without it. The second function replaces x, dim + 1 numbers. */
size_t iccp_collocation_dim(const iccp_collocation *collocation);
const double *iccp_collocation_affine(const iccp_collocation *collocation);
void iccp_collocation_solve_affine(const iccp_collocation *collocation, double *x);

/* See iccp_ldlt_mark(). The first function returns the number of marks, the second marks for some
 * nodes. */
size_t iccp_collocation_marks(const iccp_collocation *collocation);
void iccp_collocation_mark(const iccp_collocation *collocation, size_t n, const uint32_t *nodes,
                           uint8_t *needed);

/* Lists the marked nodes in `nodes`, which has room for all, and returns their number. */
size_t iccp_collocation_marked(const iccp_collocation *collocation, const uint8_t *needed,
                               uint32_t *nodes);

/* Computes K^-1 b at marked nodes, for n rows of m that count as 0 at other nodes. `work` has the
 * same size. */
void iccp_collocation_invert(const iccp_collocation *collocation, const uint8_t *needed, size_t m,
                             double *b, double *work);

#endif

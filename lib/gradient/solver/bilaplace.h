/* Bi-Laplace functions: minimum of the sum of squared Laplacians. */
#ifndef ICCP_BILAPLACE_H
#define ICCP_BILAPLACE_H

#include "gradient/solver/solution.h"
#include "gradient/solver/unknowns.h"
#include "icc/stages.h"
#include "math/scaled.h"

/* Solves without inequalities. f has unknowns->n entries. On return they are normalised, and f is 1
 * at the root. The maximum may be elsewhere. Adds to `info` (work, n_inner, seconds_*) and sets
 * both residuals.
 *
 * ICC_FUNCTION_BILAPLACE: f = c L^-2 e_root, which is positive everywhere. With ICC_SOLVER_DIRECT
 * every value is accurate to about 1e-12 of itself, however small. With ICC_SOLVER_ITERATIVE the
 * rows of both Poisson systems hold to 1e-9 of their terms, or the result is ICC_ERR_SOLVER. That
 * suits shapes without values below about 1e-7.
 *
 * ICC_FUNCTION_CLAMPED is solved by factorisation for either solver. The function changes its sign.
 * The error, relative to the maximum, is about 1e-16 times the condition number of the Laplacian.
 * Smaller values, in long limbs, mean nothing. */
icc_status iccp_bilaplace(const iccp_unknowns *unknowns, int32_t function, int32_t solver,
                          const iccp_scaled *f, iccp_solution *info, const iccp_env *env);

/* Solves ICC_FUNCTION_BILAPLACE by the iterative solver, without the residuals: c L^-2 e_loaded,
 * which is 1 at the unknown `loaded`. */
icc_status iccp_bilaplace_iterative(const iccp_unknowns *unknowns, size_t loaded,
                                    const iccp_scaled *f, iccp_solution *info, const iccp_env *env);

/* Like iccp_bilaplace(), under f_parent >= (1 + eta) f_child along the edges of the tree and f >=
 * leaf at the unknowns without children. Fills in n_iterations (interior point method and active
 * set together), n_active and both residuals, and adds to the rest of `info`.
 *
 * residual_before is usually at most 1e-11 and at worst 1e-8. Otherwise the result is
 * ICC_ERR_SOLVER and a line in the log. Afterwards no edge is violated, in rounded arithmetic too.
 * A sweep from the leaves to the root raises values that are too low for the bounds. A sweep back
 * lowers values that are too high for their parents. Both change f by rounding errors and by about
 * residual_before. Bounds hold to about 1e-16 of themselves per generation. */
icc_status iccp_bilaplace_constrained(const iccp_unknowns *unknowns, int32_t function, double eta,
                                      double leaf, const iccp_scaled *f, iccp_solution *info,
                                      const iccp_env *env);

#endif

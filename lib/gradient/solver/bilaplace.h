/* Bi-Laplace functions: the least sum of squared Laplacians. */
#ifndef ICCP_BILAPLACE_H
#define ICCP_BILAPLACE_H

#include "gradient/solver/unknowns.h"
#include "icc/stages.h"
#include "math/scaled.h"

/* Without inequalities. f: unknowns->n entries, normalised on return; 1 at the root. The maximum
 * may be elsewhere. Adds to `info` (work, n_inner, seconds_*) and sets both residuals.
 *
 * ICC_FUNCTION_BILAPLACE: f = c L^-2 e_root, positive everywhere. With ICC_SOLVER_DIRECT every
 * value is right to about 1e-12 of itself, however small; with ICC_SOLVER_ITERATIVE the rows of
 * both Poisson systems hold to 1e-9 of their terms, or there is no result but ICC_ERR_SOLVER: it is
 * for shapes where no value is below 1e-7 or so. ICC_FUNCTION_CLAMPED, by factorisation whatever
 * the solver: changes its sign; the error is about 1e-16 times the condition of the Laplacian,
 * relative to the maximum: values below that, in long limbs, mean nothing. */
icc_status iccp_bilaplace(const iccp_unknowns *unknowns, int32_t function, int32_t solver,
                          const iccp_scaled *f, icc_function_info *info, const iccp_env *env);

/* ICC_FUNCTION_BILAPLACE by the iterative solver, without the residuals: c L^-2 e_loaded, which is
 * 1 at the unknown `loaded`. */
icc_status iccp_bilaplace_iterative(const iccp_unknowns *unknowns, size_t loaded,
                                    const iccp_scaled *f, icc_function_info *info,
                                    const iccp_env *env);

/* iccp_bilaplace() under f_parent >= (1 + eta) f_child along the edges of the tree and f >= leaf at
 * the unknowns without children. Fills in n_iterations (interior point method and active set
 * together), n_active and both residuals, and adds to the rest of `info`.
 *
 * residual_before is at most 1e-11 as a rule and 1e-8 at worst; else there is no result but
 * ICC_ERR_SOLVER and a line in the log. No edge is violated afterwards, in rounded arithmetic too:
 * a sweep from the leaves to the root raises what is too low for the bounds, and one back lowers
 * what is too high for its parent. Both change f by rounding errors and by what residual_before
 * says, and bounds hold to about 1e-16 of themselves per generation. */
icc_status iccp_bilaplace_constrained(const iccp_unknowns *unknowns, int32_t function, double eta,
                                      double leaf, const iccp_scaled *f, icc_function_info *info,
                                      const iccp_env *env);

#endif

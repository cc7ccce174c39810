/* The inequalities f_parent >= (1 + eta) f_child on the edges of the tree inside. */
#ifndef ICCP_INEQUALITIES_H
#define ICCP_INEQUALITIES_H

#include "gradient/solver/unknowns.h"
#include "math/scaled.h"

/* Counts the violated inequalities of a positive, normalised function: (1 + eta) * child > parent,
 * where the product is rounded once. */
size_t iccp_inequalities_violated(const iccp_unknowns *unknowns, double eta, const iccp_scaled *f);

/* Lowers children to f_parent / (1 + eta) where they are higher, parents first. Each falls by at
 * most the sum of the violations above it. Afterwards none is violated, in rounded arithmetic
 * too. */
void iccp_inequalities_sweep(const iccp_unknowns *unknowns, double eta, const iccp_scaled *f);

/* Returns how far the entries 1.. of f are from minimising an energy under the inequalities and, if
 * `leaf` is positive, under f >= leaf at the unknowns without children. The result is the largest
 * |min(slack, multiplier)|.
 *
 * `gradient` is that of the energy. The multipliers lambda of the edges follow from it by one sweep
 * from the leaves to the root: (1 + eta) lambda_k = (sum of those of k's children) - gradient_k. So
 * the Lagrange function is stationary for every f. A leaf with a bound has a second multiplier,
 * which leaves a choice. The sweep takes multipliers that are best for the result, or nearly so.
 * Either vector may have exponents NULL: plain doubles. `work` has room for 2 n doubles. */
double iccp_inequalities_residual(const iccp_unknowns *unknowns, double eta, double leaf,
                                  const iccp_scaled *f, const iccp_scaled *gradient, double *work);

/* Returns row k of the Laplacian times f, including f_0, in units of 2^exponent. f is positive. */
double iccp_laplacian_row(const iccp_unknowns *unknowns, const iccp_scaled *f, size_t k,
                          int32_t exponent);

#endif

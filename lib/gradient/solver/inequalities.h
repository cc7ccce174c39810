/* The inequalities f_parent >= (1 + eta) f_child on the edges of a tree inside. */
#ifndef ICCP_INEQUALITIES_H
#define ICCP_INEQUALITIES_H

#include "gradient/solver/unknowns.h"
#include "math/scaled.h"

/* Of a positive, normalised function: how many are violated, by (1 + eta) * child > parent, the
 * product rounded once. */
size_t iccp_inequalities_violated(const iccp_unknowns *unknowns, double eta, const iccp_scaled *f);

/* Lowers children, parents first, to f_parent / (1 + eta) where they are higher: by at most the sum
 * of the violations above them. None is violated afterwards, in rounded arithmetic too. */
void iccp_inequalities_sweep(const iccp_unknowns *unknowns, double eta, const iccp_scaled *f);

/* How far the entries 1.. of f are from minimising an energy under the inequalities and, if `leaf`
 * is positive, under f >= leaf at the unknowns without children: the largest |min(slack,
 * multiplier)|.
 *
 * gradient: that of the energy. The multipliers lambda of the edges follow from it by one sweep
 * from the leaves to the root, (1 + eta) lambda_k = sum of those of k's children - gradient_k, so
 * that the Lagrange function is stationary whatever f is. At a leaf with a bound there is one more
 * multiplier, and a choice: those are taken that are best for the result, or nearly so. Either
 * vector may have exponents NULL: plain doubles. `work`: room for 2 n doubles. */
double iccp_inequalities_residual(const iccp_unknowns *unknowns, double eta, double leaf,
                                  const iccp_scaled *f, const iccp_scaled *gradient, double *work);

/* Row k of the Laplacian times f, f_0 included, in units of 2^exponent. f is positive. */
double iccp_laplacian_row(const iccp_unknowns *unknowns, const iccp_scaled *f, size_t k,
                          int32_t exponent);

#endif

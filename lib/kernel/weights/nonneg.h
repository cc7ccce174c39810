/* The nearest point under a few linear equations without negative components: the fast way. */
#ifndef ICCP_NONNEG_H
#define ICCP_NONNEG_H

#include "kernel/weights/dual.h"

/* As iccp_dual_solve(). */
bool iccp_nonneg_solve(const iccp_nonneg *problem, double *x, double *work);

/* Lets x[j] be negative, at 1 / slope times the cost: that always has a solution. False when it was
 * not found to the last digits. */
bool iccp_nonneg_relax(const iccp_nonneg *problem, double slope, double *x);

#endif

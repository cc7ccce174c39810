/* The nearest point under a few linear equations without negative components: the fast method
 * (dual.h is reliable). */
#ifndef ICCP_NONNEG_H
#define ICCP_NONNEG_H

#include "kernel/weights/dual.h"

/* Like iccp_dual_solve(). */
bool iccp_nonneg_solve(const iccp_nonneg *problem, double *x, double *work);

/* Allows negative x[j] at 1 / slope times the cost, so there is always a solution. Returns false if
 * it was not found to the last digits. */
bool iccp_nonneg_relax(const iccp_nonneg *problem, double slope, double *x);

#endif

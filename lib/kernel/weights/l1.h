/* The least sum of absolute values under a few linear equations. */
#ifndef ICCP_L1_H
#define ICCP_L1_H

#include "kernel/weights/nonneg.h"

#include <stdint.h>

typedef struct iccp_l1 {
    size_t rows, m;
    const double *columns; /* as in iccp_nonneg; they span all rows */
    const uint32_t *start; /* `rows` independent columns */
    double total;          /* the sum of x, which the equations determine */
    double target[ICCP_ROWS];
} iccp_l1;

/* Returns the doubles of workspace. */
size_t iccp_l1_work(size_t m);

/* Minimises the sum of |x[j]| such that the sum of x[j] * column j is the target. Of several
 * solutions, x is the one with the least sum of squares. */
void iccp_l1_solve(const iccp_l1 *problem, double *x, double *work);

#endif

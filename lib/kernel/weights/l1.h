/* The least sum of absolute values under a few linear equations. */
#ifndef ICCP_L1_H
#define ICCP_L1_H

#include "kernel/weights/nonneg.h"

#include <stdint.h>

typedef struct iccp_l1 {
    size_t rows, m;
    const double *columns; /* as in iccp_nonneg; they span all rows */
    const uint32_t *start; /* `rows` independent columns */
    double total;          /* what the sum of x is, given by the equations */
    double target[ICCP_ROWS];
} iccp_l1;

/* Doubles of scratch memory. */
size_t iccp_l1_work(size_t m);

/* Minimises the sum of |x[j]| where the sum of x[j] * column j is the target; of several solutions
 * x is the one with the least sum of squares. */
void iccp_l1_solve(const iccp_l1 *problem, double *x, double *work);

#endif

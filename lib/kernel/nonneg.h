/* The nearest point under a few linear equations without negative components. */
#ifndef ICCP_NONNEG_H
#define ICCP_NONNEG_H

#include <stdbool.h>
#include <stddef.h>

/* Equations, fewer are filled up with zeros. */
enum { ICCP_ROWS = 4 };

/* Minimise |x - start|^2 where the sum of x[j] * column j is the target and no x[j] is negative. */
typedef struct iccp_nonneg {
    size_t m;
    const double *columns; /* ICCP_ROWS each, of length about 1 at most */
    double target[ICCP_ROWS];
    double total; /* the sum of all x that meet the equations, or HUGE_VAL where they leave it open: then there must
                     be a solution */
    double slope; /* 0; or positive, to let x[j] be negative at 1 / slope times the cost: this always has a
                     solution if the columns span all rows */
} iccp_nonneg;

/* `x` is the start and becomes the solution; it stays as it is when there is none, and false is returned. */
bool iccp_nonneg_solve(const iccp_nonneg *problem, double *x);

#endif

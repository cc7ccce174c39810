/* The nearest point under a few linear equations without negative components: the sure way. */
#ifndef ICCP_DUAL_H
#define ICCP_DUAL_H

#include <stdbool.h>
#include <stddef.h>

/* Equations; fewer are filled up with zeros. */
enum { ICCP_ROWS = 4 };

/* Minimises |x - start|^2 where the sum of x[j] * column j is the target and no x[j] is
 * negative. */
typedef struct iccp_nonneg {
    size_t m, rows; /* rows beyond these are 0 */
    /* m, ICCP_ROWS numbers each, of length 1 at most; they span all `rows`. */
    const double *columns;
    double target[ICCP_ROWS];
    double total; /* the sum of all x that meet the equations, or HUGE_VAL where they leave it open:
                     then there must be a solution */
} iccp_nonneg;

/* `x` is the start and becomes the solution. When there is none, false is returned and x stays as
 * it is. `work` has room for iccp_dual_work() doubles. */
size_t iccp_dual_work(size_t m);
bool iccp_dual_solve(const iccp_nonneg *problem, double *x, double *work);

#endif

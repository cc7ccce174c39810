/* The nearest point under a few linear equations without negative components: the reliable method
 * (nonneg.h is faster). */
#ifndef ICCP_DUAL_H
#define ICCP_DUAL_H

#include <stdbool.h>
#include <stddef.h>

/* Number of equations; fewer are filled up with zeros. */
enum { ICCP_ROWS = 4 };

/* Minimises |x - start|^2 such that the sum of x[j] * column j is the target and no x[j] is
 * negative. */
typedef struct iccp_nonneg {
    size_t m, rows; /* equations from `rows` on are 0 */
    /* m columns of ICCP_ROWS numbers, of length 1 at most. They span all `rows`. */
    const double *columns;
    double target[ICCP_ROWS];
    /* The sum of every x that satisfies the equations; HUGE_VAL if they do not determine it, and
     * then a solution must exist */
    double total;
} iccp_nonneg;

/* `x` is the start and becomes the solution. If there is none, returns false and leaves x. `work`
 * has room for iccp_dual_work() doubles. */
size_t iccp_dual_work(size_t m);
bool iccp_dual_solve(const iccp_nonneg *problem, double *x, double *work);

#endif

/* What Newton's method on a map may cost, counted in steps times simplices. No clock is read, so
 * that the same input gives the same bits; in the plane each takes about a microsecond. */
#ifndef ICCP_WORK_H
#define ICCP_WORK_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

typedef struct iccp_work {
    double left; /* HUGE_VAL: no limit */
    double spent;
} iccp_work;

static inline iccp_work iccp_work_unlimited(void)
{
    return (iccp_work){.left = HUGE_VAL};
}

/* Before a step on so many simplices: false, and nothing is taken, when that is more than is
 * left. */
static inline bool iccp_work_take(iccp_work *work, size_t n_simplices)
{
    if ((double)n_simplices > work->left)
        return false;
    work->left -= (double)n_simplices;
    work->spent += (double)n_simplices;
    return true;
}

#endif

/* What a map may cost, counted in steps of Newton's method times simplices; work of other kinds is
 * counted as so many of them. No clock is read, so that the same input gives the same bits; in the
 * plane each takes a quarter of a microsecond to half of one, in untangling too.
 *
 * All that makes a mesh map of the plane from its start comes out of one budget (map/plane/fit.c):
 * untangling; the crossings of an overlay, which have to be found and merged; steps on it; and
 * improvement. */
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

/* Whether there is enough left for a step on so many simplices. */
static inline bool iccp_work_fits(const iccp_work *work, size_t n_simplices)
{
    return (double)n_simplices <= work->left;
}

/* After work that was done anyway, be it more than was left. */
static inline void iccp_work_charge(iccp_work *work, double cost)
{
    work->left -= cost;
    work->spent += cost;
}

/* Before a step on so many simplices: false, and nothing is taken, when that is more than is
 * left. */
static inline bool iccp_work_take(iccp_work *work, size_t n_simplices)
{
    const bool fits = iccp_work_fits(work, n_simplices);
    if (fits)
        iccp_work_charge(work, (double)n_simplices);
    return fits;
}

#endif

/* The cost of a map, counted in Newton steps times simplices. Other kinds of work are converted to
 * this unit. No clock is read, so the same input gives the same bits. In the plane one unit takes
 * 0.25 to 0.5 microseconds, also in untangling.
 *
 * One budget pays for everything that makes a plane mesh map from its start (schedule.h). That
 * is untangling, finding and merging the crossings of an overlay, steps on the overlay, and
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

/* Returns true if enough is left for a step on this many simplices. */
static inline bool iccp_work_fits(const iccp_work *work, size_t n_simplices)
{
    return (double)n_simplices <= work->left;
}

/* Books work that was done anyway, even if it exceeds the budget. */
static inline void iccp_work_charge(iccp_work *work, double cost)
{
    work->left -= cost;
    work->spent += cost;
}

/* Books a step on this many simplices before it is done. Returns false and books nothing if too
 * little is left. */
static inline bool iccp_work_take(iccp_work *work, size_t n_simplices)
{
    const bool fits = iccp_work_fits(work, n_simplices);
    if (fits)
        iccp_work_charge(work, (double)n_simplices);
    return fits;
}

#endif

/* Searches for a better place of a point. */
#ifndef ICCP_PLACE_SEARCH_H
#define ICCP_PLACE_SEARCH_H

#include "fill/points.h"

typedef struct iccp_place {
    double x[3], worth;
} iccp_place;

typedef struct iccp_place_measure {
    /* Returns what a place is worth, or something that is not above `least`. */
    double (*worth)(void *context, const double *x, double least);
    void *context;
} iccp_place_measure;

/* Looks for a place that is worth more than `best`, and moves `best` there. Tries the middle of the
 * points around, half the way to it, and then 14 directions in shrinking steps. `nearest` is the
 * squared distance of the nearest point. */
void iccp_search_place(const iccp_points *points, const iccp_place_measure *by,
                       const double *middle, double nearest, iccp_place *best);

#endif

/* fmin() and fmax() without a function call. If both numbers are zeros, the result is the second on
 * every machine. If one is NaN, the result is the other. */
#ifndef ICCP_MINMAX_H
#define ICCP_MINMAX_H

#include <math.h>

static inline double iccp_min(double a, double b)
{
    return a < b || isnan(b) ? a : b;
}

static inline double iccp_max(double a, double b)
{
    return a > b || isnan(b) ? a : b;
}

#endif

/* fmin() and fmax() without a call, and with one answer on every machine where both are zeros: the
 * second. Of a number and NaN they give the number, too. */
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

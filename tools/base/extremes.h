/* fmin() and fmax() without a function call. If one number is NaN, the result is the other. */
#ifndef EXTREMES_H
#define EXTREMES_H

#include <math.h>

static inline double lesser(double a, double b)
{
    return a < b || isnan(b) ? a : b;
}

static inline double greater(double a, double b)
{
    return a > b || isnan(b) ? a : b;
}

#endif

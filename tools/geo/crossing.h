/* The place where two segments cross that exact signs have found to cross. */
#ifndef CROSSING_H
#define CROSSING_H

#include <math.h>
#include <stdbool.h>

/* True if point a comes before point b: by x, then by y. */
static inline bool point_before(const double a[2], const double b[2])
{
    return a[0] < b[0] || (!(b[0] < a[0]) && a[1] < b[1]);
}

static inline double point_distance(const double a[2], const double b[2])
{
    return hypot(b[0] - a[0], b[1] - a[1]);
}

/* The share of c d at which a b crosses it, 0 to 1. It is the same for b a. */
double crossing_share(const double a[2], const double b[2], const double c[2], const double d[2]);

#endif

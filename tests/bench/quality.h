/* How good a map in space is at a point, and quantiles of that. */
#ifndef BENCH_QUALITY_H
#define BENCH_QUALITY_H

#include <math.h>

static inline double determinant(const double *a)
{
    return a[0] * (a[4] * a[8] - a[5] * a[7]) - a[1] * (a[3] * a[8] - a[5] * a[6]) +
           a[2] * (a[3] * a[7] - a[4] * a[6]);
}

/* |J|^2 + |J^-1|^2 with J scaled to the volumes; HUGE_VAL when inverted. */
static inline double energy_of(const double *jacobian, double scale)
{
    double a[9], sum = 0, minors = 0;
    for (int k = 0; k < 9; ++k) {
        a[k] = jacobian[k] / scale;
        sum += a[k] * a[k];
    }
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const int r = 3 * ((i + 1) % 3), s = 3 * ((i + 2) % 3), c = (j + 1) % 3,
                      d = (j + 2) % 3;
            const double minor = a[r + c] * a[s + d] - a[r + d] * a[s + c];
            minors += minor * minor;
        }
    const double det = determinant(a);
    return det > 0 ? sum + minors / (det * det) : HUGE_VAL;
}

static inline int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

#endif

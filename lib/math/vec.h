/* Products and lengths of short vectors. Sums begin with the first coordinate, so results have the
 * same bits everywhere. */
#ifndef ICCP_VEC_H
#define ICCP_VEC_H

#include "base/compiler.h"

#include <math.h>
#include <stddef.h>

static ICCP_INLINE double iccp_vec_dot(size_t n, const double *a, const double *b)
{
    double sum = 0;
    for (size_t k = 0; k < n; ++k)
        sum += a[k] * b[k];
    return sum;
}

static ICCP_INLINE double iccp_vec_norm(size_t n, const double *a)
{
    return sqrt(iccp_vec_dot(n, a, a));
}

/* Squared distance. */
static ICCP_INLINE double iccp_vec_distance2(size_t n, const double *a, const double *b)
{
    double sum = 0;
    for (size_t k = 0; k < n; ++k)
        sum += (b[k] - a[k]) * (b[k] - a[k]);
    return sum;
}

static ICCP_INLINE double iccp_vec_distance(size_t n, const double *a, const double *b)
{
    return sqrt(iccp_vec_distance2(n, a, b));
}

/* c = a x b, in space. */
static ICCP_INLINE void iccp_vec_cross(const double *a, const double *b, double *c)
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

#endif

/* Evenly spread points of the unit cube, for estimates by sampling.
 *
 * Source: M. Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018. */
#ifndef ICCP_LOW_DISCREPANCY_H
#define ICCP_LOW_DISCREPANCY_H

#include "icc/base.h"

#include <math.h>
#include <stddef.h>

/* Coordinate k of point `index` in 1..ICC_MAX_DIM dimensions, by the sequence R_d: multiples of
 * the powers of 1/x, where x^(d + 1) = x + 1. Its point 0 is left out. It is the middle of the
 * cube, which is a special point of symmetric shapes. */
static inline double iccp_low_discrepancy(int32_t dim, int32_t k, size_t index)
{
    static const double FIRST[ICC_MAX_DIM] = {0.61803398874989485, 0.75487766624669276,
                                              0.81917251339616444, 0.85667488385450287,
                                              0.88127146163356959, 0.89865371262869929};
    double step = FIRST[dim - 1];
    for (int32_t i = 0; i < k; ++i)
        step *= FIRST[dim - 1];
    const double x = 0.5 + step * (double)(index + 1);
    return x - floor(x);
}

#endif

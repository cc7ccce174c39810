/* Directions in space: points of the sphere about the origin, and exact signs of three of them.
 *
 * Coordinates are multiples of 2^-51 of magnitude at most 1, that is, integers of 52 bits; so
 * lengths are 1 to within 2^-50. */
#ifndef ICCP_DIRECTION_H
#define ICCP_DIRECTION_H

#include "math/predicates.h"
#include "math/vec.h"

/* The direction nearest to a vector that is not 0. */
static inline void iccp_direction(double out[3], const double v[3])
{
    const double length = iccp_vec_norm(3, v);
    for (int k = 0; k < 3; ++k)
        out[k] = (v[k] / length + 3.0) - 3.0; /* between 2 and 4 doubles are 2^-51 apart */
}

/* The sign of a . (b x c): +1 when the three are counter-clockwise seen from outside and lie in one
 * open half of the sphere, so that they are the corners of a triangle there. */
static inline int iccp_direction_sign(const double a[3], const double b[3], const double c[3])
{
    static const double centre[3] = {0, 0, 0};
    return iccp_orient3d(b, a, c, centre);
}

#endif

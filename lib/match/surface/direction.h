/* Directions in space: points of the unit sphere, and exact signs of three of them.
 *
 * Coordinates are multiples of 2^-51 and at most 1, so they are integers of 52 bits. Lengths are 1
 * to within 2^-50. */
#ifndef ICCP_DIRECTION_H
#define ICCP_DIRECTION_H

#include "math/predicates.h"
#include "math/vec.h"

/* Computes the direction nearest to a vector that is not 0. */
static inline void iccp_direction(double out[3], const double v[3])
{
    const double length = iccp_vec_norm(3, v);
    for (int k = 0; k < 3; ++k)
        out[k] = (v[k] / length + 3.0) - 3.0; /* doubles between 2 and 4 are 2^-51 apart */
}

/* Two axes at right angles to a direction, up to rounding. With the direction, in this order, they
 * are right-handed. */
static inline void iccp_direction_axes(const double p[3], double axis[2][3])
{
    const double side[3] = {fabs(p[0]) < 0.7, fabs(p[0]) >= 0.7, 0};
    iccp_vec_cross(p, side, axis[0]);
    const double length = iccp_vec_norm(3, axis[0]);
    for (int k = 0; k < 3; ++k)
        axis[0][k] /= length;
    iccp_vec_cross(p, axis[0], axis[1]);
}

/* The sign of a . (b x c). It is +1 if the three are the corners of a triangle on the sphere:
 * counter-clockwise seen from outside, and in an open half of the sphere. */
static inline int iccp_direction_sign(const double a[3], const double b[3], const double c[3])
{
    static const double centre[3] = {0, 0, 0};
    return iccp_orient3d(b, a, c, centre);
}

#endif

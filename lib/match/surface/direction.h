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

/* Two more axes at right angles to a direction, to rounding; with it they are right-handed. */
static inline void iccp_direction_axes(const double p[3], double axis[2][3])
{
    const double side[3] = {fabs(p[0]) < 0.7, fabs(p[0]) >= 0.7, 0};
    iccp_vec_cross(p, side, axis[0]);
    const double length = iccp_vec_norm(3, axis[0]);
    for (int k = 0; k < 3; ++k)
        axis[0][k] /= length;
    iccp_vec_cross(p, axis[0], axis[1]);
}

/* The sign of a . (b x c): +1 when the three are counter-clockwise seen from outside and lie in one
 * open half of the sphere, so that they are the corners of a triangle there. */
static inline int iccp_direction_sign(const double a[3], const double b[3], const double c[3])
{
    static const double centre[3] = {0, 0, 0};
    return iccp_orient3d(b, a, c, centre);
}

#endif

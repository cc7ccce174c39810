/* Maps points of the sphere back to the surface that is drawn on it. */
#ifndef ICCP_DRAWN_PLACE_H
#define ICCP_DRAWN_PLACE_H

#include "base/minmax.h"
#include "math/vec.h"

/* a . (b x c) for directions close to one another, whose differences are exact. */
static inline double iccp_direction_det(const double a[3], const double b[3], const double c[3])
{
    const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    double normal[3];
    iccp_vec_cross(u, v, normal);
    return iccp_vec_dot(3, a, normal);
}

/* Finds the weights of a triangle's corners s at the point where the ray with direction p meets the
 * plane through them. The weights are not negative and their sum is 1. If p is outside the
 * triangle, the weights give a point on its boundary. This is how the faces of a surface are mapped
 * to the faces of its drawing: straight lines become great circles. */
static inline void iccp_drawn_weights(double weight[3], const double p[3], const double *const s[3])
{
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        weight[k] = iccp_max(0, iccp_direction_det(p, s[(k + 1) % 3], s[(k + 2) % 3]));
        sum += weight[k];
    }
    for (int k = 0; k < 3; ++k)
        weight[k] = sum > 0 ? weight[k] / sum : 1.0 / 3;
}

#endif

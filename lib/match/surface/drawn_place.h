/* From the sphere back to the surface that is drawn there. */
#ifndef ICCP_DRAWN_PLACE_H
#define ICCP_DRAWN_PLACE_H

#include "base/minmax.h"
#include "math/vec.h"

/* a . (b x c) for directions near each other, whose differences are exact. */
static inline double iccp_direction_det(const double a[3], const double b[3], const double c[3])
{
    const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    double normal[3];
    iccp_vec_cross(u, v, normal);
    return iccp_vec_dot(3, a, normal);
}

/* Weights, not negative, of sum 1, for the corners of a triangle of the sphere: where the ray with
 * direction p meets the plane through its three corners. Of one that p is not in, a place on its
 * boundary. The faces of a surface are mapped to those of its drawing so: straight lines to great
 * circles. */
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

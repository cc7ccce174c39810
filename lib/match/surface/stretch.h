/* Measures how much a triangle is stretched when it is mapped to another. */
#ifndef ICCP_STRETCH_H
#define ICCP_STRETCH_H

#include "match/surface/corner_angle.h"

/* The symmetric Dirichlet energy of the linear map of one triangle in space onto another. It is
 * (s^2 + t^2)(1 + 1 / (s t)^2) for the singular values s and t. It is 4 for an isometry, and at
 * most `most`. */
static inline double iccp_stretch_energy(const double *const from[3], const double *const to[3],
                                         double most)
{
    double e[2][3], g[2][3];
    for (int i = 0; i < 2; ++i)
        for (int k = 0; k < 3; ++k) {
            e[i][k] = from[i + 1][k] - from[0][k];
            g[i][k] = to[i + 1][k] - to[0][k];
        }
    const double aa = iccp_vec_dot(3, e[0], e[0]), ab = iccp_vec_dot(3, e[0], e[1]);
    const double bb = iccp_vec_dot(3, e[1], e[1]);
    const double pp = iccp_vec_dot(3, g[0], g[0]), pq = iccp_vec_dot(3, g[0], g[1]);
    const double qq = iccp_vec_dot(3, g[1], g[1]);
    const double before = aa * bb - ab * ab, after = pp * qq - pq * pq;
    if (!(before > 0 && after > 0))
        return most;
    const double energy = (aa * qq - 2 * ab * pq + bb * pp) * (1 / before + 1 / after);
    return energy < most ? energy : most;
}

/* The measures of a triangle that is scaled and then mapped to another. */
typedef struct iccp_stretch {
    double twice[2]; /* twice the area of each */
    double energy;   /* at most 1e8 */
} iccp_stretch;

static inline iccp_stretch iccp_stretch_of(const double *const from[3], const double *const to[3],
                                           double scale)
{
    double scaled[3][3], normal[3];
    iccp_stretch s;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            scaled[i][k] = scale * to[i][k];
    const double *const large[3] = {scaled[0], scaled[1], scaled[2]};
    iccp_triangle_normal(normal, from[0], from[1], from[2]);
    s.twice[0] = iccp_vec_norm(3, normal);
    iccp_triangle_normal(normal, large[0], large[1], large[2]);
    s.twice[1] = iccp_vec_norm(3, normal);
    s.energy = iccp_stretch_energy(from, large, 1e8);
    return s;
}

#endif

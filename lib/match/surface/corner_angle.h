/* Angles and normals of triangles in space. */
#ifndef ICCP_CORNER_ANGLE_H
#define ICCP_CORNER_ANGLE_H

#include "base/minmax.h"
#include "math/vec.h"

/* The normal of a triangle that replaces others stays within 60 degrees of the surface's. */
static const double iccp_least_cosine = 0.5;

/* Sets a normal whose length is twice the area. */
static inline void iccp_triangle_normal(double normal[3], const double *a, const double *b,
                                        const double *c)
{
    const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    iccp_vec_cross(u, v, normal);
}

/* The sine of a triangle's smallest angle. It is the height on the longest side, divided by the
 * longer of the other two sides. 0 if the triangle has no area. */
static inline double iccp_least_sine(const double *a, const double *b, const double *c)
{
    double normal[3];
    iccp_triangle_normal(normal, a, b, c);
    const double twice = iccp_vec_norm(3, normal);
    const double ab = iccp_vec_distance2(3, a, b), bc = iccp_vec_distance2(3, b, c);
    const double ca = iccp_vec_distance2(3, c, a);
    /* The smallest angle lies between the two sides with the largest product. */
    const double most = iccp_max(ab * bc, iccp_max(bc * ca, ca * ab));
    return most > 0 ? twice / sqrt(most) : 0;
}

#endif

/* Certifies that a drawing on the sphere is one-to-one. */
#ifndef ICCP_SPHERE_CERTIFICATE_H
#define ICCP_SPHERE_CERTIFICATE_H

#include "match/surface/half_edges.h"

typedef struct iccp_sphere_certificate {
    size_t n_faces; /* faces that are not positive */
    size_t n_stars; /* vertices whose neighbours do not turn around them exactly once; counted if
                       all faces are positive */
} iccp_sphere_certificate;

/* Exact. If both numbers are 0, the drawing is one-to-one and onto. It is then a covering of the
 * sphere, and the sphere has no covering but itself, because it is simply connected. Positive faces
 * alone are not enough: two vertices whose neighbours turn twice around them make a double cover.
 * O(n). */
iccp_sphere_certificate iccp_sphere_certify(const iccp_half_edges *m, const double *directions);

#endif

/* Whether a drawing on the sphere is one-to-one. */
#ifndef ICCP_SPHERE_CERTIFICATE_H
#define ICCP_SPHERE_CERTIFICATE_H

#include "match/surface/half_edges.h"

typedef struct iccp_sphere_certificate {
    size_t n_faces; /* that are not positive */
    size_t n_stars; /* vertices whose neighbours do not go round them once; counted where all faces
                       are positive */
} iccp_sphere_certificate;

/* Exact. If both numbers are 0 the drawing is one-to-one and onto: it is then a covering of the
 * sphere by a surface, and the sphere, which is simply connected, has none but itself. Positive
 * faces alone do not suffice: two vertices whose neighbours go round twice make a double cover.
 * O(n). */
iccp_sphere_certificate iccp_sphere_certify(const iccp_half_edges *m, const double *directions);

#endif

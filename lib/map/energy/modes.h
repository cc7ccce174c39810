/* The Hessian of an energy of a tetrahedron by the singular values of its map alone. */
#ifndef ICCP_MODES_H
#define ICCP_MODES_H

#include "map/energy/singular.h"

/* By J in the basis u[i] v[k]^T, without negative curvature: singular[i][k] for (i, i) and (k, k),
 * the others for (i, k) and itself, and (i, k) and (k, i). */
typedef struct iccp_modes {
    double singular[3][3], same[3][3], other[3][3];
} iccp_modes;

/* By the curvatures of the two modes of i != k, which are turned against each other in a flip, and
 * together in a twist. */
static inline void iccp_modes_set(iccp_modes *modes, int i, int k, double flip, double twist)
{
    modes->same[i][k] = 0.5 * (flip + twist);
    modes->other[i][k] = 0.5 * (flip - twist);
}

/* By the images of the corners, 12 by 12, times the element's volume. */
void iccp_modes_hessian(const double *element, const iccp_modes *modes, const iccp_singular *s,
                        double *hessian);

#endif

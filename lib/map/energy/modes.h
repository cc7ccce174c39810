/* The Hessian of a tetrahedron's energy, for energies that depend on the singular values of its map
 * alone. */
#ifndef ICCP_MODES_H
#define ICCP_MODES_H

#include "map/energy/singular.h"

/* The Hessian with respect to J in the basis u[i] v[k]^T, without negative curvature.
 * singular[i][k] is the entry for (i, i) and (k, k). The others are the entries for (i, k) with
 * itself and for (i, k) with (k, i). */
typedef struct iccp_modes {
    double singular[3][3], same[3][3], other[3][3];
} iccp_modes;

/* Sets the entries from the curvatures of the two modes of i != k. A flip turns the two in opposite
 * directions, a twist turns them together. */
static inline void iccp_modes_set(iccp_modes *modes, int i, int k, double flip, double twist)
{
    modes->same[i][k] = 0.5 * (flip + twist);
    modes->other[i][k] = 0.5 * (flip - twist);
}

/* Computes the Hessian with respect to the images of the corners, 12 by 12, times the element's
 * volume. */
void iccp_modes_hessian(const double *element, const iccp_modes *modes, const iccp_singular *s,
                        double *hessian);

#endif

/* Simplices that are exactly positive, but so flat that doubles find no area or volume in them, or
 * one that is negative. What is computed here is accurate to a few rounding errors however flat
 * they are, and takes a hundred times as long as in doubles. */
#ifndef ICCP_FLAT_SIMPLEX_H
#define ICCP_FLAT_SIMPLEX_H

#include "map/energy/jacobian.h"

/* Fills in an element. The corners must not lie in one line or plane. */
void iccp_flat_element(size_t dim, const double *const *corner, double *element);

/* Computes the Jacobian, row by row, of the map that takes corners to images. */
void iccp_flat_jacobian(size_t dim, const double *const *corner, const double *const *image,
                        double *jacobian);

/* Returns the symmetric Dirichlet energy, as iccp_dirichlet_energy() of the element with stretched
 * corners. Corners and images must be exactly positive. */
double iccp_flat_energy(size_t dim, const double *const *corner, double stretch,
                        const double *const *image);

#endif

/* The untangling energy of the linear map of one simplex in the plane or in space. */
#ifndef ICCP_UNTANGLING_H
#define ICCP_UNTANGLING_H

#include "map/energy/jacobian.h"

/* The energy is finite for every image and grows the more the image is inverted. A larger `epsilon`
 * makes it grow less. For an isometry it is the element's area or volume. */
double iccp_untangling_energy(size_t dim, const double *element, const double *const *image,
                              double epsilon);
void iccp_untangling_local(size_t dim, const double *element, const double *const *image,
                           double epsilon, iccp_local *local);

/* The share of the area or volume term. It is small, so that angles decide. */
extern const double iccp_untangling_share;

/* chi(det) = (det + sqrt(epsilon^2 + det^2)) / 2, which stands for the determinant. */
double iccp_untangling_chi(double epsilon, double det);

/* iccp_untangling_start() gives the first epsilon if `least` is the smallest determinant. The other
 * function gives the next epsilon, whose lower bound is smaller by the share `fall`. */
double iccp_untangling_start(double least);
double iccp_untangling_next(double epsilon, double least, double fall);

#endif

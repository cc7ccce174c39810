/* The symmetric Dirichlet energy of the linear map of one simplex in the plane or in space. */
#ifndef ICCP_DIRICHLET_H
#define ICCP_DIRICHLET_H

#include "map/jacobian.h"

#include <stdbool.h>

/* |J|^2 + |J^-1|^2 times the element's area or volume: 2 dim times it for an isometry, infinite
 * when the image is not positive. */
double iccp_dirichlet_energy(size_t dim, const double *element, const double *const *image);

/* With `majorise`, the Hessian is that of SLIM's quadratic model, which copes with a bad start;
 * otherwise the energy's own. The image must be positive. */
void iccp_dirichlet_local(size_t dim, const double *element, const double *const *image,
                          bool majorise, iccp_local *local);

#endif

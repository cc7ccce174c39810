/* Computes elements, and adds modes to the Hessian of one simplex. */
#include "map/energy/jacobian.h"

void iccp_element_create(size_t dim, const double *const *corner, double *element)
{
    if (dim == 2)
        iccp_element_fill(2, corner, element);
    else
        iccp_element_fill(3, corner, element);
}

/* Handles two columns at a time, which compilers turn into vector instructions. */
static ICCP_INLINE void add_mode(size_t dim, const double *element, const double *mode,
                                 double weight, double *hessian)
{
    const size_t n = dim * (dim + 1);
    double q[12];
    iccp_pull_back(dim, element, mode, 1, q);
    for (size_t c = 0; c < n; c += 2)
        for (size_t r = 0; r < n; ++r) {
            hessian[n * r + c] += weight * q[r] * q[c];
            hessian[n * r + c + 1] += weight * q[r] * q[c + 1];
        }
}

void iccp_add_mode(size_t dim, const double *element, const double *mode, double weight,
                   double *hessian)
{
    if (dim == 2)
        add_mode(2, element, mode, weight, hessian);
    else
        add_mode(3, element, mode, weight, hessian);
}

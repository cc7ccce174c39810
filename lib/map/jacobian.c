#include "map/jacobian.h"

/* By Cramer's rule: the gradients are the cofactors of the edges from corner 0 over their
 * determinant. */
static ICCP_INLINE void create(size_t dim, const double *const *corner, double *element)
{
    double edge[9], det = 0;
    double *gradient = element + 1;
    for (size_t i = 0; i < dim; ++i)
        for (size_t k = 0; k < dim; ++k)
            edge[dim * i + k] = corner[i + 1][k] - corner[0][k];
    iccp_cofactors(dim, edge, gradient + dim);
    for (size_t k = 0; k < dim; ++k)
        det += edge[k] * gradient[dim + k];
    element[0] = det / (dim == 2 ? 2 : 6);
    for (size_t k = 0; k < dim; ++k) {
        gradient[k] = 0;
        for (size_t i = 1; i <= dim; ++i) {
            gradient[dim * i + k] /= det;
            gradient[k] -= gradient[dim * i + k];
        }
    }
}

void iccp_element_create(size_t dim, const double *const *corner, double *element)
{
    if (dim == 2)
        create(2, corner, element);
    else
        create(3, corner, element);
}

/* Two columns at a time, which compilers turn into vector instructions. */
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

/* The linear map of one simplex in the plane or in space, where dim is 2 or 3. */
#ifndef ICCP_JACOBIAN_H
#define ICCP_JACOBIAN_H

#include "base/compiler.h"

#include <stddef.h>

/* The number of doubles in an element. An element describes a simplex before the map: its area or
 * volume, then the gradients of its dim + 1 barycentric coordinates. */
#define ICCP_ELEMENT(dim) (1 + (dim) * ((dim) + 1))
enum { ICCP_MAX_ELEMENT = ICCP_ELEMENT(3) };

/* The derivatives of one simplex's energy with respect to the images of its corners. These have n =
 * dim (dim + 1) coordinates, corner by corner. The Hessian, n by n, is symmetric and positive
 * semidefinite, because negative curvature is left out. */
typedef struct iccp_local {
    double gradient[12];
    double hessian[144];
} iccp_local;

/* Fills in an element. The corners must be positive: iccp_orient() of them is 1. */
void iccp_element_create(size_t dim, const double *const *corner, double *element);

/* Adds weight q q^T to a Hessian. Here q is the direction `mode` in the space of Jacobians, row by
 * row, translated to the images of the corners. */
void iccp_add_mode(size_t dim, const double *element, const double *mode, double weight,
                   double *hessian);

/* ---- parts of energies; a constant `dim` turns their loops into straight code ---- */

/* Computes the Jacobian, row by row, of the map that takes the corners to the images. Returns its
 * determinant. */
static ICCP_INLINE double iccp_element_jacobian(size_t dim, const double *element,
                                                const double *const *image, double *j)
{
    for (size_t r = 0; r < dim; ++r)
        for (size_t c = 0; c < dim; ++c) {
            const double *g = element + 1 + c;
            double sum = (image[1][r] - image[0][r]) * g[dim];
            for (size_t k = 2; k <= dim; ++k)
                sum += (image[k][r] - image[0][r]) * g[dim * k];
            j[dim * r + c] = sum;
        }
    if (dim == 2)
        return j[0] * j[3] - j[1] * j[2];
    return j[0] * (j[4] * j[8] - j[5] * j[7]) + j[1] * (j[5] * j[6] - j[3] * j[8]) +
           j[2] * (j[3] * j[7] - j[4] * j[6]);
}

/* |J|^2 */
static ICCP_INLINE double iccp_squared_norm(size_t dim, const double *j)
{
    if (dim == 2)
        return j[0] * j[0] + j[1] * j[1] + j[2] * j[2] + j[3] * j[3];
    return (j[0] * j[0] + j[1] * j[1] + j[2] * j[2]) + (j[3] * j[3] + j[4] * j[4] + j[5] * j[5]) +
           (j[6] * j[6] + j[7] * j[7] + j[8] * j[8]);
}

/* The derivative of the determinant, row by row. */
static ICCP_INLINE void iccp_cofactors(size_t dim, const double *j, double *cofactor)
{
    if (dim == 2) {
        cofactor[0] = j[3];
        cofactor[1] = -j[2];
        cofactor[2] = -j[1];
        cofactor[3] = j[0];
        return;
    }
    for (size_t r = 0; r < 3; ++r) {
        const double *a = j + 3 * ((r + 1) % 3), *b = j + 3 * ((r + 2) % 3);
        cofactor[3 * r] = a[1] * b[2] - a[2] * b[1];
        cofactor[3 * r + 1] = a[2] * b[0] - a[0] * b[2];
        cofactor[3 * r + 2] = a[0] * b[1] - a[1] * b[0];
    }
}

/* Fills in an element as iccp_element_create() does. Uses Cramer's rule: the gradients are the
 * cofactors of the edges from corner 0, divided by their determinant. */
static ICCP_INLINE void iccp_element_fill(size_t dim, const double *const *corner, double *element)
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

/* Translates a direction in the space of Jacobians, row by row, to the images of the corners. */
static ICCP_INLINE void iccp_pull_back(size_t dim, const double *element, const double *by_j,
                                       double factor, double *by_corner)
{
    for (size_t k = 0; k <= dim; ++k)
        for (size_t r = 0; r < dim; ++r) {
            const double *row = by_j + dim * r, *g = element + 1 + dim * k;
            double sum = row[0] * g[0];
            for (size_t c = 1; c < dim; ++c)
                sum += row[c] * g[c];
            by_corner[dim * k + r] = factor * sum;
        }
}

#endif

/* Energies of the linear map of one triangle, with derivatives by the images of its corners. */
#ifndef ICCP_DISTORTION_H
#define ICCP_DISTORTION_H

#include <stdbool.h>

/* A triangle of the source. */
typedef struct iccp_element {
    double area;
    double gradient[3][2]; /* of its barycentric coordinates */
} iccp_element;

/* x and y of the three corners in turn. */
typedef struct iccp_local {
    double gradient[6];
    double hessian[6][6]; /* symmetric, positive semidefinite: negative curvature is left out */
} iccp_local;

/* `a`, `b`, `c` counter-clockwise. */
void iccp_element_create(iccp_element *element, const double a[2], const double b[2],
                         const double c[2]);

/* The Jacobian, row by row, when the corners go to the three images. */
void iccp_element_jacobian(const iccp_element *element, const double *const image[3], double j[4]);

/* Symmetric Dirichlet energy |J|^2 + |J^-1|^2 times the area: 4 times it for an isometry, infinite
 * when the triangle is not positive. */
double iccp_dirichlet_energy(const iccp_element *element, const double *const image[3]);

/* With `majorise`, the Hessian is that of SLIM's quadratic model, which copes with a bad start; otherwise
 * the energy's own. The triangle must be positive. */
void iccp_dirichlet_local(const iccp_element *element, const double *const image[3], bool majorise,
                          iccp_local *local);

/* The untangling energy of Garanzha et al.: finite for every triangle, but the more a triangle is
 * inverted the higher; `epsilon` says how much is forgiven. Times the area. */
double iccp_untangle_energy(const iccp_element *element, const double *const image[3],
                            double epsilon);
void iccp_untangle_local(const iccp_element *element, const double *const image[3], double epsilon,
                         iccp_local *local);

/* chi(det) = (det + sqrt(epsilon^2 + det^2)) / 2, which stands for the determinant above. */
double iccp_untangle_chi(double epsilon, double det);

/* Epsilon to begin with, when `least` is the smallest determinant; and the next one, whose lower bound is
 * smaller by the share `fall`. */
double iccp_untangle_start(double least);
double iccp_untangle_next(double epsilon, double least, double fall);

#endif

/* The untangling energy of the linear map of one tetrahedron, with derivatives by the images of its
 * corners: what map/distortion.h has for triangles. */
#ifndef ICCP_TET_DISTORTION_H
#define ICCP_TET_DISTORTION_H

/* A tetrahedron of the source. */
typedef struct iccp_tet {
    double volume;
    double gradient[4][3]; /* of its barycentric coordinates */
} iccp_tet;

/* x, y and z of the four corners in turn. */
typedef struct iccp_tet_local {
    double gradient[12];
    double hessian[12][12]; /* symmetric, positive semidefinite: negative curvature is left out */
} iccp_tet_local;

/* iccp_orient3d() of the corners is 1. */
void iccp_tet_create(iccp_tet *tet, const double *const corner[4]);

/* The Jacobian, row by row, when the corners go to the four images, and its determinant. */
double iccp_tet_jacobian(const iccp_tet *tet, const double *const image[4], double j[9]);

/* Finite for every tetrahedron, but the more it is inverted the higher; `epsilon` says how much is
 * forgiven. The volume for an isometry. */
double iccp_tet_untangle_energy(const iccp_tet *tet, const double *const image[4], double epsilon);
void iccp_tet_untangle_local(const iccp_tet *tet, const double *const image[4], double epsilon,
                             iccp_tet_local *local);

#endif

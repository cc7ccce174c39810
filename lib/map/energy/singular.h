/* Signed singular values: J = sum of sigma[k] u[k] v[k]^T with rotations u and v. */
#ifndef ICCP_SINGULAR_H
#define ICCP_SINGULAR_H

#include <stddef.h>

/* sigma[0] >= sigma[1] >= |sigma[2]|, up to rounding. The arrays use `dim` entries. */
typedef struct iccp_singular {
    double sigma[3];
    double u[3][3], v[3][3];
} iccp_singular;

/* Decomposes a Jacobian that is given row by row. In the plane its determinant must be positive. */
void iccp_singular_find(size_t dim, const double *j, iccp_singular *s);

#endif

/* Singular values with signs: J = sum of sigma[k] u[k] v[k]^T with rotations u and v. */
#ifndef ICCP_SINGULAR_H
#define ICCP_SINGULAR_H

#include <stddef.h>

/* sigma[0] >= sigma[1] >= |sigma[2]|, up to rounding; `dim` of each. */
typedef struct iccp_singular {
    double sigma[3];
    double u[3][3], v[3][3];
} iccp_singular;

/* Of a Jacobian, row by row. In the plane its determinant must be positive. */
void iccp_singular_find(size_t dim, const double *j, iccp_singular *s);

#endif

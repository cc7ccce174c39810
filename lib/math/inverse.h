/* Inverses and normals of small matrices, row by row, of up to ICC_MAX_DIM + 1 rows. */
#ifndef ICCP_INVERSE_H
#define ICCP_INVERSE_H

#include <stdbool.h>
#include <stddef.h>

/* Inverts an n by n matrix and computes its determinant. Returns false if the determinant is 0 or
 * not finite; the inverse is then not written. */
bool iccp_invert(size_t n, const double *a, double *inverse, double *determinant);

/* Computes the vector that is orthogonal to the n - 1 rows of n numbers. Its product with a vector
 * x is the determinant of the matrix with x as its first row. */
void iccp_normal_of(size_t n, const double *rows, double *normal);

#endif

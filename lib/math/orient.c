/* Orientation of points in up to six dimensions. The infinitesimal shift, of one point only, is
 * from H. Edelsbrunner, E. P. Muecke, Simulation of Simplicity, ACM Transactions on Graphics 9,
 * 1990. */
#include "math/orient.h"

#include "base/compiler.h"
#include "math/predicates.h"

/* Error bound for n = 4..6, where all rows have length 1. Elimination with partial pivoting gives
 * the determinant of a matrix whose entries are off by at most n eps g. Entries grow by
 * g <= 2^(n - 1). By Hadamard's inequality the determinant is off by at most n^2.5 eps g, which is
 * 3.2e-13. The rest is for the lengths of the rows. */
static const double UNCERTAIN = 4e-13;

typedef double matrix[ICCP_ORIENT_MAX][ICCP_ORIENT_MAX];

/* Scales the rows to length 1. Returns the product of their former lengths, or 0. */
static ICCP_INLINE double read_rows(matrix a, size_t n, const double *const *points)
{
    double product = 1;
    for (size_t i = 0; i < n; ++i) {
        double sum = 0;
        for (size_t k = 0; k < n; ++k) {
            a[i][k] = points[i + 1][k] - points[0][k];
            sum += a[i][k] * a[i][k];
        }
        const double length = sqrt(sum);
        if (!(length > 0))
            return 0;
        product *= length;
        for (size_t k = 0; k < n; ++k)
            a[i][k] /= length;
    }
    return product;
}

/* Computes the determinant by Gaussian elimination with partial pivoting, which bounds the growth
 * of the entries as UNCERTAIN assumes. The rows have length 1, so scaling a row cannot change the
 * choice of the pivot. */
static ICCP_INLINE double eliminate(matrix a, size_t n)
{
    double det = 1;
    for (size_t i = 0; i < n; ++i) {
        size_t pivot = i;
        for (size_t j = i + 1; j < n; ++j)
            if (fabs(a[j][i]) > fabs(a[pivot][i]))
                pivot = j;
        if (!(fabs(a[pivot][i]) > 0))
            return 0;
        for (size_t k = i; pivot != i && k < n; ++k) {
            const double swap = a[i][k];
            a[i][k] = a[pivot][k];
            a[pivot][k] = swap;
        }
        det *= pivot != i ? -a[i][i] : a[i][i];
        for (size_t j = i + 1; j < n; ++j) {
            const double factor = a[j][i] / a[i][i];
            for (size_t k = i + 1; k < n; ++k)
                a[j][k] -= factor * a[i][k];
        }
    }
    return det;
}

static ICCP_INLINE double value(size_t n, const double *const *points)
{
    matrix a;
    const double lengths = read_rows(a, n, points);
    return lengths > 0 ? lengths * eliminate(a, n) : 0;
}

/* If the compiler knows n, it unrolls all loops. */
double iccp_orient_value(size_t n, const double *const *points)
{
    return n == 0 ? 1 : n == 3 ? value(3, points) : value(n, points);
}

int iccp_orient(size_t n, const double *const *p)
{
    switch (n) {
    case 0:
        return 1;
    case 1:
        return (p[1][0] > p[0][0]) - (p[1][0] < p[0][0]);
    case 2:
        return iccp_orient2d(p[0], p[1], p[2]);
    case 3:
        return iccp_orient3d(p[0], p[1], p[2], p[3]);
    default: {
        matrix a;
        if (!(read_rows(a, n, p) > 0))
            return 0;
        const double det = eliminate(a, n);
        return (det > UNCERTAIN) - (det < -UNCERTAIN);
    }
    }
}

/* The derivative of the determinant with respect to coordinate k of the last point. It is a
 * determinant of the other points without that coordinate. */
static int orient_without(size_t n, const double *const *points, size_t k)
{
    double shadow[ICCP_ORIENT_MAX][ICCP_ORIENT_MAX];
    const double *at[ICCP_ORIENT_MAX];
    for (size_t i = 0; i < n; ++i) {
        for (size_t j = 0; j + 1 < n; ++j)
            shadow[i][j] = points[i][j < k ? j : j + 1];
        at[i] = shadow[i];
    }
    const int sign = iccp_orient(n - 1, at);
    return (n - 1 + k) % 2 == 0 ? sign : -sign;
}

int iccp_orient_beside(size_t n, const double *const *points)
{
    int sign = iccp_orient(n, points);
    for (size_t k = 0; sign == 0 && k < n; ++k)
        sign = orient_without(n, points, k);
    return sign;
}

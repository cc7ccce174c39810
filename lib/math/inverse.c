/* Gaussian elimination with partial pivoting: G. H. Golub, C. F. Van Loan, Matrix Computations,
 * chapter 3. */
#include "math/inverse.h"

#include "icc/base.h"

#include <math.h>
#include <string.h>

typedef double matrix[ICC_MAX_DIM + 1][2 * (ICC_MAX_DIM + 1)];

static void exchange(size_t n, double *a, double *b)
{
    for (size_t k = 0; k < n; ++k) {
        const double kept = a[k];
        a[k] = b[k];
        b[k] = kept;
    }
}

/* Brings the first n columns of n rows to triangular form. Returns their determinant. */
static double eliminate(size_t n, size_t n_columns, matrix a)
{
    double determinant = 1;
    for (size_t i = 0; i < n; ++i) {
        size_t pivot = i;
        for (size_t j = i + 1; j < n; ++j)
            if (fabs(a[j][i]) > fabs(a[pivot][i]))
                pivot = j;
        if (!(fabs(a[pivot][i]) > 0))
            return 0;
        if (pivot != i) {
            exchange(n_columns, a[pivot], a[i]);
            determinant = -determinant;
        }
        determinant *= a[i][i];
        for (size_t j = i + 1; j < n; ++j) {
            const double factor = a[j][i] / a[i][i];
            for (size_t k = i; k < n_columns; ++k)
                a[j][k] -= factor * a[i][k];
        }
    }
    return determinant;
}

bool iccp_invert(size_t n, const double *a, double *inverse, double *determinant)
{
    matrix m = {{0}};
    for (size_t i = 0; i < n; ++i) {
        memcpy(m[i], a + n * i, n * sizeof *a);
        m[i][n + i] = 1;
    }
    *determinant = eliminate(n, 2 * n, m);
    if (!(fabs(*determinant) > 0 && fabs(*determinant) < HUGE_VAL))
        return false;
    for (size_t i = n; i-- > 0;)
        for (size_t c = 0; c < n; ++c) {
            double sum = m[i][n + c];
            for (size_t k = i + 1; k < n; ++k)
                sum -= m[i][k] * inverse[n * k + c];
            inverse[n * i + c] = sum / m[i][i];
        }
    return true;
}

void iccp_normal_of(size_t n, const double *rows, double *normal)
{
    for (size_t left_out = 0; left_out < n; ++left_out) {
        matrix m;
        for (size_t i = 0; i + 1 < n; ++i)
            for (size_t k = 0; k + 1 < n; ++k)
                m[i][k] = rows[n * i + (k < left_out ? k : k + 1)];
        const double minor = eliminate(n - 1, n - 1, m);
        normal[left_out] = left_out % 2 == 0 ? minor : -minor;
    }
}

/* The determinant of a small matrix, by elimination. */
#ifndef TESTS_DETERMINANT_H
#define TESTS_DETERMINANT_H

#include <icc/base.h>
#include <math.h>
#include <string.h>

static inline double determinant(int32_t dim, const double *matrix)
{
    double a[ICC_MAX_DIM * ICC_MAX_DIM], value = 1;
    memcpy(a, matrix, (size_t)(dim * dim) * sizeof *a);
    for (int32_t c = 0; c < dim; ++c) {
        int32_t pivot = c;
        for (int32_t i = c + 1; i < dim; ++i)
            pivot = fabs(a[i * dim + c]) > fabs(a[pivot * dim + c]) ? i : pivot;
        for (int32_t k = 0; k < dim && pivot != c; ++k) {
            const double swap = a[c * dim + k];
            a[c * dim + k] = a[pivot * dim + k];
            a[pivot * dim + k] = swap;
        }
        value *= pivot != c ? -a[c * dim + c] : a[c * dim + c];
        for (int32_t i = c + 1; i < dim; ++i) {
            const double factor = a[i * dim + c] / a[c * dim + c];
            for (int32_t k = 0; k < dim; ++k)
                a[i * dim + k] -= factor * a[c * dim + k];
        }
    }
    return value;
}

#endif

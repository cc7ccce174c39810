/* Eigenvectors of small symmetric matrices by C. G. J. Jacobi's rotations. */
#ifndef ICCP_JACOBI_H
#define ICCP_JACOBI_H

#include "base/compiler.h"

#include <math.h>
#include <stddef.h>

/* Computes the eigenvalues (on the diagonal of `a`) and the eigenvectors (the rows of `v`) of an n
 * by n matrix. Entries smaller than `share` of the diagonal's are ignored. With a constant n the
 * compiler unrolls the loops. */
static ICCP_INLINE void iccp_jacobi_diagonalise(size_t n, int sweeps, double share, double *a,
                                                double *v)
{
    for (size_t i = 0; i < n * n; ++i)
        v[i] = i % (n + 1) == 0;
    for (int sweep = 0; sweep < sweeps; ++sweep)
        for (size_t p = 0; p + 1 < n; ++p)
            for (size_t q = p + 1; q < n; ++q) {
                const double pp = a[n * p + p], pq = a[n * p + q], qq = a[n * q + q];
                if (fabs(pq) <= share * (fabs(pp) + fabs(qq)))
                    continue;
                const double theta = 0.5 * (qq - pp) / pq;
                const double t = copysign(1, theta) / (fabs(theta) + sqrt(theta * theta + 1));
                const double c = 1 / sqrt(t * t + 1), s = t * c;
                for (size_t i = 0; i < n; ++i) {
                    const double x = a[n * i + p], y = a[n * i + q];
                    a[n * i + p] = c * x - s * y;
                    a[n * i + q] = s * x + c * y;
                }
                for (size_t i = 0; i < n; ++i) {
                    const double x = a[n * p + i], y = a[n * q + i];
                    const double z = v[n * p + i], w = v[n * q + i];
                    a[n * p + i] = c * x - s * y;
                    a[n * q + i] = s * x + c * y;
                    v[n * p + i] = c * z - s * w;
                    v[n * q + i] = s * z + c * w;
                }
            }
}

#endif

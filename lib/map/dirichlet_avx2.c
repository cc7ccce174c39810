/* As dirichlet.c in the plane, operation by operation, for four triangles side by side: what is
 * chosen there by a branch is blended here. */
#include "map/dirichlet.h"

#include "base/simd.h"

#ifdef ICCP_HAS_SIMD

#define TARGET ICCP_AVX2

#include <immintrin.h>

enum { LANES = ICCP_DIRICHLET_LANES };

/* Lane l of every number is triangle l's. */
typedef struct triangles {
    __m256d element[ICCP_ELEMENT(2)], j[4];
    __m256d sigma[2], u[2][2], v[2][2];
    __m256d gradient[6], hessian[36];
} triangles;

#define ALL(x) _mm256_set1_pd(x)

/* Number i of each array. */
#define GATHER(array, i) _mm256_set_pd(array[3][i], array[2][i], array[1][i], array[0][i])

TARGET static ICCP_INLINE void take(triangles *t, const iccp_dirichlet_batch *batch)
{
    for (size_t i = 0; i < ICCP_ELEMENT(2); ++i)
        t->element[i] = GATHER(batch->element, i);
    for (size_t r = 0; r < 2; ++r) {
        const __m256d first = GATHER(batch->image[0], r);
        const __m256d x = GATHER(batch->image[1], r) - first;
        const __m256d y = GATHER(batch->image[2], r) - first;
        for (size_t c = 0; c < 2; ++c)
            t->j[2 * r + c] = x * t->element[3 + c] + y * t->element[5 + c];
    }
}

/* iccp_singular_find() */
TARGET static ICCP_INLINE void find_singular(triangles *t)
{
    const __m256d *j = t->j, sign = ALL(-0.0);
    const __m256d a = j[0] * j[0] + j[2] * j[2], d = j[1] * j[1] + j[3] * j[3];
    const __m256d q = j[0] * j[1] + j[2] * j[3], p = ALL(0.5) * (a - d);
    const __m256d r = _mm256_sqrt_pd(p * p + q * q);
    const __m256d large = _mm256_sqrt_pd(ALL(0.5) * (ALL(1) + _mm256_andnot_pd(sign, p) / r));
    const __m256d small = ALL(0.5) * q / (r * large);
    const __m256d swapped = _mm256_or_pd(large, _mm256_and_pd(sign, q));
    const __m256d is_negative = _mm256_cmp_pd(p, _mm256_setzero_pd(), _CMP_LT_OQ);
    const __m256d is_turned = _mm256_cmp_pd(r, _mm256_setzero_pd(), _CMP_GT_OQ);
    const __m256d cosine = _mm256_blendv_pd(large, _mm256_andnot_pd(sign, small), is_negative);
    const __m256d sine = _mm256_blendv_pd(small, swapped, is_negative);
    t->v[0][0] = t->v[1][1] = _mm256_blendv_pd(ALL(1), cosine, is_turned);
    t->v[0][1] = _mm256_and_pd(sine, is_turned);
    t->v[1][0] = -t->v[0][1];
    const __m256d x = j[0] * t->v[0][0] + j[1] * t->v[0][1];
    const __m256d y = j[2] * t->v[0][0] + j[3] * t->v[0][1];
    t->sigma[0] = _mm256_sqrt_pd(x * x + y * y);
    t->sigma[1] = (j[0] * j[3] - j[1] * j[2]) / t->sigma[0];
    t->u[0][0] = t->u[1][1] = x / t->sigma[0];
    t->u[0][1] = y / t->sigma[0];
    t->u[1][0] = -t->u[0][1];
}

/* iccp_pull_back() */
TARGET static ICCP_INLINE void pull_back(const triangles *t, const __m256d by_j[4],
                                         const __m256d *factor, __m256d by_corner[6])
{
    for (size_t k = 0; k < 3; ++k)
        for (size_t r = 0; r < 2; ++r)
            by_corner[2 * k + r] = *factor * (by_j[2 * r] * t->element[1 + 2 * k] +
                                              by_j[2 * r + 1] * t->element[2 + 2 * k]);
}

TARGET static ICCP_INLINE void set_gradient(triangles *t)
{
    __m256d by_j[4] = {0};
    for (size_t k = 0; k < 2; ++k) {
        const __m256d s = t->sigma[k], slope = ALL(2) * (s - ALL(1) / (s * s * s));
        for (size_t i = 0; i < 4; ++i)
            by_j[i] += slope * t->u[k][i / 2] * t->v[k][i % 2];
    }
    pull_back(t, by_j, &t->element[0], t->gradient);
}

/* iccp_add_mode() */
TARGET static ICCP_INLINE void add_mode(triangles *t, const __m256d mode[4], const __m256d *weight)
{
    const __m256d one = ALL(1);
    __m256d q[6];
    pull_back(t, mode, &one, q);
    for (size_t r = 0; r < 6; ++r)
        for (size_t c = 0; c < 6; ++c)
            t->hessian[6 * r + c] += *weight * q[r] * q[c];
}

/* A twist of negative curvature gets the weight 0. */
TARGET static ICCP_INLINE void add_newton_modes(triangles *t)
{
    const __m256d half = ALL(sqrt(0.5)), a = t->sigma[0], b = t->sigma[1], product = a * b;
    const __m256d cube = product * product * product;
    __m256d twist = ALL(2) - ALL(2) * (a * a - a * b + b * b) / cube, modes[4][4];
    const __m256d flip = ALL(2) + ALL(2) * (a * a + a * b + b * b) / cube;
    twist = _mm256_and_pd(twist, _mm256_cmp_pd(twist, _mm256_setzero_pd(), _CMP_GT_OQ));
    __m256d weight[4] = {{0}, {0}, t->element[0] * flip, t->element[0] * twist};
    for (size_t k = 0; k < 2; ++k) {
        const __m256d sigma2 = t->sigma[k] * t->sigma[k];
        weight[k] = t->element[0] * (ALL(2) + ALL(6) / (sigma2 * sigma2));
    }
    for (size_t i = 0; i < 4; ++i) {
        const size_t r = i / 2, c = i % 2;
        const __m256d there = half * t->u[0][r] * t->v[1][c], back = half * t->u[1][r] * t->v[0][c];
        modes[0][i] = t->u[0][r] * t->v[0][c];
        modes[1][i] = t->u[1][r] * t->v[1][c];
        modes[2][i] = there + back;
        modes[3][i] = there - back;
    }
    for (size_t k = 0; k < 4; ++k)
        add_mode(t, modes[k], &weight[k]);
}

TARGET static ICCP_INLINE void add_majorant(triangles *t)
{
    const __m256d *g = t->element + 1, twice = ALL(2) * t->element[0];
    __m256d m[4] = {0};
    for (size_t k = 0; k < 2; ++k) {
        const __m256d i = ALL(1) / t->sigma[k], weight = ALL(1) + i + i * i + i * i * i;
        for (size_t e = 0; e < 4; ++e)
            m[e] += weight * t->u[k][e / 2] * t->u[k][e % 2];
    }
    for (size_t a = 0; a < 3; ++a)
        for (size_t b = 0; b < 3; ++b) {
            const __m256d dot = (g[2 * a] * g[2 * b] + g[2 * a + 1] * g[2 * b + 1]) * twice;
            for (size_t e = 0; e < 4; ++e)
                t->hessian[6 * (2 * a + e / 2) + 2 * b + e % 2] += dot * m[e];
        }
}

/* Four numbers of each triangle to where they belong. */
TARGET static ICCP_INLINE void store(const __m256d x[4], double *const *to)
{
    const __m256d a = _mm256_unpacklo_pd(x[0], x[1]), b = _mm256_unpackhi_pd(x[0], x[1]);
    const __m256d c = _mm256_unpacklo_pd(x[2], x[3]), d = _mm256_unpackhi_pd(x[2], x[3]);
    _mm256_storeu_pd(to[0], _mm256_permute2f128_pd(a, c, 0x20));
    _mm256_storeu_pd(to[1], _mm256_permute2f128_pd(b, d, 0x20));
    _mm256_storeu_pd(to[2], _mm256_permute2f128_pd(a, c, 0x31));
    _mm256_storeu_pd(to[3], _mm256_permute2f128_pd(b, d, 0x31));
}

/* Of the six numbers of a gradient, the two in the middle are stored twice. */
TARGET static ICCP_INLINE void give(const triangles *t, iccp_local *local)
{
    for (size_t i = 0; i <= 2; i += 2) {
        double *const to[LANES] = {local[0].gradient + i, local[1].gradient + i,
                                   local[2].gradient + i, local[3].gradient + i};
        store(t->gradient + i, to);
    }
    for (size_t i = 0; i < 36; i += 4) {
        double *const to[LANES] = {local[0].hessian + i, local[1].hessian + i, local[2].hessian + i,
                                   local[3].hessian + i};
        store(t->hessian + i, to);
    }
}

TARGET void iccp_dirichlet_locals_avx2(const iccp_dirichlet_batch *batch, bool majorise,
                                       iccp_local *local)
{
    triangles t;
    take(&t, batch);
    find_singular(&t);
    set_gradient(&t);
    for (size_t i = 0; i < 36; ++i)
        t.hessian[i] = _mm256_setzero_pd();
    if (majorise)
        add_majorant(&t);
    else
        add_newton_modes(&t);
    give(&t, local);
}

#endif

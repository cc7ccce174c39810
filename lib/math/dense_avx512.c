/* The products of dense.h, with two strips of four rows in one register (compare dense.c). */
#include "math/dense.h"

#include "base/compiler.h"
#include "base/simd.h"

#ifdef ICCP_HAS_SIMD

#include <immintrin.h>
#include <stdbool.h>

enum { STRIP = 4, PAIRS = ICCP_STRIPS / 2 };

/* Column k of a pair of strips. The second strip may be missing. */
ICCP_AVX512 static ICCP_INLINE __m512d load_pair(const double *a, size_t stride, bool is_whole)
{
    const __m512d low = _mm512_zextpd256_pd512(_mm256_loadu_pd(a));
    return is_whole ? _mm512_insertf64x4(low, _mm256_loadu_pd(a + stride), 1) : low;
}

/* All sums stay in registers, at most 12 of 32. */
ICCP_AVX512 static ICCP_INLINE void multiply_tile(double *tile, size_t n_strips, size_t width,
                                                  const double *a, size_t stride, const double *b,
                                                  size_t depth)
{
    __m512d sum[PAIRS][ICCP_TILE];
    const size_t n_pairs = (n_strips + 1) / 2;
    for (size_t t = 0; t < n_pairs; ++t)
        for (size_t c = 0; c < width; ++c)
            sum[t][c] = _mm512_setzero_pd();
    for (size_t k = 0; k < depth; ++k) {
        __m512d rows[PAIRS];
        for (size_t t = 0; t < n_pairs; ++t)
            rows[t] = load_pair(a + 2 * t * stride + STRIP * k, stride, 2 * t + 1 < n_strips);
        for (size_t c = 0; c < width; ++c) {
            const __m512d entry = _mm512_set1_pd(b[width * k + c]);
            for (size_t t = 0; t < n_pairs; ++t)
                sum[t][c] = _mm512_add_pd(sum[t][c], _mm512_mul_pd(rows[t], entry));
        }
    }
    for (size_t t = 0; t < n_strips; ++t)
        for (size_t c = 0; c < width; ++c)
            _mm256_storeu_pd(tile + STRIP * (ICCP_TILE * t + c),
                             t % 2 == 0 ? _mm512_castpd512_pd256(sum[t / 2][c])
                                        : _mm512_extractf64x4_pd(sum[t / 2][c], 1));
}

ICCP_AVX512 static ICCP_INLINE void multiply_width(double *tile, size_t n_strips, size_t width,
                                                   const double *a, size_t stride, const double *b,
                                                   size_t depth)
{
    if (width == 6)
        multiply_tile(tile, n_strips, 6, a, stride, b, depth);
    else if (width == 4)
        multiply_tile(tile, n_strips, 4, a, stride, b, depth);
    else if (width == 2)
        multiply_tile(tile, n_strips, 2, a, stride, b, depth);
    else
        multiply_tile(tile, n_strips, 1, a, stride, b, depth);
}

ICCP_AVX512 void iccp_multiply_avx512(double *tile, size_t n_strips, size_t width, const double *a,
                                      size_t stride, const double *b, size_t depth)
{
    if (n_strips == 4)
        multiply_width(tile, 4, width, a, stride, b, depth);
    else if (n_strips == 3)
        multiply_width(tile, 3, width, a, stride, b, depth);
    else if (n_strips == 2)
        multiply_width(tile, 2, width, a, stride, b, depth);
    else
        multiply_width(tile, 1, width, a, stride, b, depth);
}

#endif

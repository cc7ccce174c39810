/* Computes the symmetric Dirichlet energy's derivatives for four triangles side by side, with
 * AVX2. */
#include "base/simd.h"

#ifdef ICCP_HAS_SIMD

#define TARGET ICCP_AVX2

enum { LANES = 4 };

#include "map/energy/dirichlet_lanes.h"

#include <immintrin.h>

TARGET static ICCP_INLINE void gather(const double *const *array, size_t i, reals *x)
{
    *x = _mm256_set_pd(array[3][i], array[2][i], array[1][i], array[0][i]);
}

TARGET static ICCP_INLINE void square_root(const reals *x, reals *root)
{
    *root = _mm256_sqrt_pd(*x);
}

TARGET static ICCP_INLINE void store(const reals x[4], double *const *to)
{
    const __m256d a = _mm256_unpacklo_pd(x[0], x[1]), b = _mm256_unpackhi_pd(x[0], x[1]);
    const __m256d c = _mm256_unpacklo_pd(x[2], x[3]), d = _mm256_unpackhi_pd(x[2], x[3]);
    _mm256_storeu_pd(to[0], _mm256_permute2f128_pd(a, c, 0x20));
    _mm256_storeu_pd(to[1], _mm256_permute2f128_pd(b, d, 0x20));
    _mm256_storeu_pd(to[2], _mm256_permute2f128_pd(a, c, 0x31));
    _mm256_storeu_pd(to[3], _mm256_permute2f128_pd(b, d, 0x31));
}

TARGET void iccp_dirichlet_locals_avx2(const iccp_dirichlet_batch *batch, bool majorise,
                                       iccp_local *local)
{
    set_locals(batch, 0, majorise, local);
}

#endif

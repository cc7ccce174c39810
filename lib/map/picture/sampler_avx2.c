/* Kernels for pictures with AVX2, two pixels at a time: see sampler_lanes.h. */
#include "map/picture/sampler_kernels.h"

#ifdef ICCP_HAS_SIMD

#define TARGET ICCP_AVX2
#define PIXELS 2

#include "map/picture/sampler_lanes.h"

#include <immintrin.h>

TARGET static ICCP_INLINE void line_up(const position *first, const position *step, positions *x)
{
    *x = (positions)_mm256_set_m128i((__m128i)(*first + *step), (__m128i)*first);
}

/* Makes a constant of two equal halves. */
#define TWICE(...) _mm256_setr_epi8(__VA_ARGS__, __VA_ARGS__)

TARGET static ICCP_INLINE void blend_rows(const sample s[PIXELS], const lanes *weights, lanes *left,
                                          lanes *right)
{
    const __m256i to_left = TWICE(0, -1, 8, -1, 1, -1, 9, -1, 2, -1, 10, -1, 3, -1, 11, -1);
    const __m256i to_right = TWICE(4, -1, 12, -1, 5, -1, 13, -1, 6, -1, 14, -1, 7, -1, 15, -1);
    const __m128i first = _mm_set_epi64x((int64_t)s[0].below, (int64_t)s[0].above);
    const __m128i second = _mm_set_epi64x((int64_t)s[1].below, (int64_t)s[1].above);
    const __m256i both = _mm256_set_m128i(second, first);
    *left = (lanes)_mm256_madd_epi16(_mm256_shuffle_epi8(both, to_left), (__m256i)*weights);
    *right = (lanes)_mm256_madd_epi16(_mm256_shuffle_epi8(both, to_right), (__m256i)*weights);
}

/* The double 2^52 + x has x as its lower half. */
TARGET static ICCP_INLINE void scale(const lanes *x, const double weights[PIXELS], floats *y)
{
    const __m256i upper = _mm256_set1_epi32(0x43300000);
    const reals weight = {weights[0], weights[0], weights[1], weights[1]};
    const reals low = (reals)_mm256_unpacklo_epi32((__m256i)*x, upper) - 0x1p52;
    const reals high = (reals)_mm256_unpackhi_epi32((__m256i)*x, upper) - 0x1p52;
    const __m256 all =
        _mm256_set_m128(_mm256_cvtpd_ps(high * weight), _mm256_cvtpd_ps(low * weight));
    *y = (floats)_mm256_permute4x64_epi64((__m256i)all, 0xd8);
}

TARGET static ICCP_INLINE void replace_opacity(lanes *x, const lanes *y)
{
    *x = (lanes)_mm256_blend_epi32((__m256i)*x, (__m256i)*y, 0x88);
}

TARGET static ICCP_INLINE void limit(floats *x)
{
    *x = _mm256_min_ps(_mm256_max_ps(*x, _mm256_setzero_ps()), _mm256_set1_ps(255));
}

TARGET static ICCP_INLINE void lanes_to_reals(const lanes *x, reals y[PIXELS])
{
    y[0] = _mm256_cvtepi32_pd(_mm256_castsi256_si128((__m256i)*x));
    y[1] = _mm256_cvtepi32_pd(_mm256_extracti128_si256((__m256i)*x, 1));
}

TARGET static ICCP_INLINE void to_reals(const channels4 *x, reals *y)
{
    *y = _mm256_cvtepi32_pd((__m128i)*x);
}

TARGET static ICCP_INLINE void to_floats(const reals x[PIXELS], floats *y)
{
    *y = _mm256_set_m128(_mm256_cvtpd_ps(x[1]), _mm256_cvtpd_ps(x[0]));
}

TARGET static ICCP_INLINE void reals_to_lanes(const reals x[PIXELS], lanes *y)
{
    *y = (lanes)_mm256_set_m128i(_mm256_cvttpd_epi32(x[1]), _mm256_cvttpd_epi32(x[0]));
}

TARGET static ICCP_INLINE void floats_to_lanes(const floats *x, lanes *y)
{
    *y = (lanes)_mm256_cvttps_epi32(*x);
}

TARGET static ICCP_INLINE void widen(uint64_t pair, channels8 *x)
{
    *x = (channels8)_mm256_cvtepu8_epi32(_mm_cvtsi64_si128((int64_t)pair));
}

TARGET static ICCP_INLINE void halves(const channels8 *x, channels4 *left, channels4 *right)
{
    *left = (channels4)_mm256_castsi256_si128((__m256i)*x);
    *right = (channels4)_mm256_extracti128_si256((__m256i)*x, 1);
}

TARGET static ICCP_INLINE void spread_first(lanes *x)
{
    *x = (lanes)_mm256_shuffle_epi32((__m256i)*x, 0x00);
}

TARGET static ICCP_INLINE void spread_third(lanes *x)
{
    *x = (lanes)_mm256_shuffle_epi8((__m256i)*x, _mm256_set1_epi16(0x0908));
}

TARGET static ICCP_INLINE void spread_last(lanes *x)
{
    *x = (lanes)_mm256_shuffle_epi32((__m256i)*x, 0xff);
}

TARGET static ICCP_INLINE void spread_last8(channels8 *x)
{
    spread_last(x);
}

TARGET static ICCP_INLINE void spread_last_real(reals *x)
{
    *x = _mm256_permute4x64_pd(*x, 0xff);
}

TARGET static ICCP_INLINE void put(const lanes *x, size_t n, int channels, uint8_t *to)
{
    const __m256i high = _mm256_set1_epi32(0x0f0b0703);
    const __m256i bytes = _mm256_shuffle_epi8((__m256i)*x, high);
    const int32_t first = _mm_cvtsi128_si32(_mm256_castsi256_si128(bytes));
    const int32_t second = _mm_cvtsi128_si32(_mm256_extracti128_si256(bytes, 1));
    memcpy(to, &first, (size_t)channels);
    if (n > 1)
        memcpy(to + channels, &second, (size_t)channels);
}

TARGET static ICCP_INLINE void take_sums(const iccp_gathered *pixels, size_t n, floats *sums)
{
    *sums = _mm256_set_m128(_mm_loadu_ps(pixels[n - 1].sums), _mm_loadu_ps(pixels[0].sums));
}

TARGET static ICCP_INLINE void add_sums(const floats *x, size_t k, float sums[4])
{
    const __m128 more = k == 0 ? _mm256_castps256_ps128(*x) : _mm256_extractf128_ps(*x, 1);
    _mm_storeu_ps(sums, _mm_loadu_ps(sums) + more);
}

TARGET static ICCP_INLINE void take_weights(const iccp_gathered *pixels, size_t n, floats *weights)
{
    *weights = _mm256_set_m128(_mm_set1_ps(pixels[n - 1].weight), _mm_set1_ps(pixels[0].weight));
}

const iccp_sampler_kernels *iccp_sampler_avx2(const icc_picture *p)
{
    return kernels_for(p);
}

#endif

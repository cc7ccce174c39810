/* Kernels for pictures with SSE 4.2, one pixel at a time: see sampler_lanes.h. */
#include "map/picture/sampler_kernels.h"

#ifdef ICCP_HAS_SIMD

#define TARGET ICCP_SSE42

#include "map/picture/sampler_lanes.h"

#include <immintrin.h>

TARGET static ICCP_INLINE void line_up(const position *first, const position *step, positions *x)
{
    (void)step;
    *x = *first;
}

TARGET static ICCP_INLINE void blend_rows(const sample s[PIXELS], const lanes *weights, lanes *left,
                                          lanes *right)
{
    const __m128i to_left = _mm_setr_epi8(0, -1, 8, -1, 1, -1, 9, -1, 2, -1, 10, -1, 3, -1, 11, -1);
    const __m128i to_right =
        _mm_setr_epi8(4, -1, 12, -1, 5, -1, 13, -1, 6, -1, 14, -1, 7, -1, 15, -1);
    const __m128i rows = _mm_set_epi64x((int64_t)s->below, (int64_t)s->above);
    *left = (lanes)_mm_madd_epi16(_mm_shuffle_epi8(rows, to_left), (__m128i)*weights);
    *right = (lanes)_mm_madd_epi16(_mm_shuffle_epi8(rows, to_right), (__m128i)*weights);
}

/* The double 2^52 + x has x as its lower half. */
TARGET static ICCP_INLINE void scale(const lanes *x, const double weights[PIXELS], floats *y)
{
    const __m128i upper = _mm_set1_epi32(0x43300000);
    const __m128d weight = _mm_set1_pd(weights[0]), zero = _mm_set1_pd(0x1p52);
    const __m128d low = (__m128d)_mm_unpacklo_epi32((__m128i)*x, upper) - zero;
    const __m128d high = (__m128d)_mm_unpackhi_epi32((__m128i)*x, upper) - zero;
    *y = _mm_movelh_ps(_mm_cvtpd_ps(low * weight), _mm_cvtpd_ps(high * weight));
}

TARGET static ICCP_INLINE void replace_opacity(lanes *x, const lanes *y)
{
    *x = (lanes)_mm_blend_epi16((__m128i)*x, (__m128i)*y, 0xc0);
}

TARGET static ICCP_INLINE void limit(floats *x)
{
    *x = _mm_min_ps(_mm_max_ps(*x, _mm_setzero_ps()), _mm_set1_ps(255));
}

/* Vectors of 32 bytes are put together from halves. */
TARGET static ICCP_INLINE void join_reals(__m128d low, __m128d high, reals *x)
{
    memcpy(x, &low, 16);
    memcpy((char *)x + 16, &high, 16);
}

TARGET static ICCP_INLINE void half_reals(const reals *x, __m128d *low, __m128d *high)
{
    memcpy(low, x, 16);
    memcpy(high, (const char *)x + 16, 16);
}

TARGET static ICCP_INLINE void to_reals(const channels4 *x, reals *y)
{
    join_reals(_mm_cvtepi32_pd((__m128i)*x), _mm_cvtepi32_pd(_mm_shuffle_epi32((__m128i)*x, 0xee)),
               y);
}

TARGET static ICCP_INLINE void lanes_to_reals(const lanes *x, reals y[PIXELS])
{
    to_reals(x, y);
}

TARGET static ICCP_INLINE void to_floats(const reals x[PIXELS], floats *y)
{
    __m128d low, high;
    half_reals(x, &low, &high);
    *y = _mm_movelh_ps(_mm_cvtpd_ps(low), _mm_cvtpd_ps(high));
}

TARGET static ICCP_INLINE void reals_to_lanes(const reals x[PIXELS], lanes *y)
{
    __m128d low, high;
    half_reals(x, &low, &high);
    *y = (lanes)_mm_unpacklo_epi64(_mm_cvttpd_epi32(low), _mm_cvttpd_epi32(high));
}

TARGET static ICCP_INLINE void floats_to_lanes(const floats *x, lanes *y)
{
    *y = (lanes)_mm_cvttps_epi32(*x);
}

TARGET static ICCP_INLINE void halves(const channels8 *x, channels4 *left, channels4 *right)
{
    memcpy(left, x, 16);
    memcpy(right, (const char *)x + 16, 16);
}

TARGET static ICCP_INLINE void join(const channels4 *left, const channels4 *right, channels8 *x)
{
    memcpy(x, left, 16);
    memcpy((char *)x + 16, right, 16);
}

TARGET static ICCP_INLINE void widen(uint64_t pair, channels8 *x)
{
    const channels4 left = (channels4)_mm_cvtepu8_epi32(_mm_cvtsi64_si128((int64_t)pair));
    const channels4 right = (channels4)_mm_cvtepu8_epi32(_mm_cvtsi64_si128((int64_t)(pair >> 32)));
    join(&left, &right, x);
}

TARGET static ICCP_INLINE void spread_first(lanes *x)
{
    *x = (lanes)_mm_shuffle_epi32((__m128i)*x, 0x00);
}

TARGET static ICCP_INLINE void spread_third(lanes *x)
{
    *x = (lanes)_mm_shuffle_epi8((__m128i)*x, _mm_set1_epi16(0x0908));
}

TARGET static ICCP_INLINE void spread_last(lanes *x)
{
    *x = (lanes)_mm_shuffle_epi32((__m128i)*x, 0xff);
}

TARGET static ICCP_INLINE void spread_last8(channels8 *x)
{
    channels4 left, right;
    halves(x, &left, &right);
    spread_last(&left);
    spread_last(&right);
    join(&left, &right, x);
}

TARGET static ICCP_INLINE void spread_last_real(reals *x)
{
    __m128d low, high;
    half_reals(x, &low, &high);
    high = _mm_unpackhi_pd(high, high);
    join_reals(high, high, x);
}

TARGET static ICCP_INLINE void put(const lanes *x, size_t n, int channels, uint8_t *to)
{
    const __m128i high = _mm_set1_epi32(0x0f0b0703);
    const int32_t bytes = _mm_cvtsi128_si32(_mm_shuffle_epi8((__m128i)*x, high));
    (void)n;
    memcpy(to, &bytes, (size_t)channels);
}

TARGET static ICCP_INLINE void take_sums(const iccp_gathered *pixels, size_t n, floats *sums)
{
    (void)n;
    *sums = _mm_loadu_ps(pixels->sums);
}

TARGET static ICCP_INLINE void add_sums(const floats *x, size_t k, float sums[4])
{
    (void)k;
    _mm_storeu_ps(sums, _mm_loadu_ps(sums) + *x);
}

TARGET static ICCP_INLINE void take_weights(const iccp_gathered *pixels, size_t n, floats *weights)
{
    (void)n;
    *weights = _mm_set1_ps(pixels->weight);
}

const iccp_sampler_kernels *iccp_sampler_sse(const icc_picture *p)
{
    return kernels_for(p);
}

#endif

/* Vector kernels for samples of one byte and three or four channels. The file that includes this
 * one names the processor (TARGET).
 *
 * Two neighbouring pixels of a row, 8 bytes, form one vector. So both columns are blended between
 * the rows at once, and then with each other, in integers below 2^32. If opacities differ, the sums
 * have up to 48 bits. Doubles hold them exactly, so the results have the same bits as integers. */
#ifndef ICCP_SAMPLER_LANES_H
#define ICCP_SAMPLER_LANES_H

#include "map/picture/sampler_kernels.h"

#include "base/compiler.h"

#include <immintrin.h>
#include <string.h>

/* Vectors are passed by pointer, because passing them by value depends on the processor. */
typedef uint32_t channels4 __attribute__((vector_size(16)));
typedef uint32_t channels8 __attribute__((vector_size(32))); /* of two pixels */
typedef double reals __attribute__((vector_size(32)));
typedef float floats __attribute__((vector_size(16)));

enum { BITS = ICCP_NARROW_BITS, OPACITY = 3 };

/* ---- vectors ---- */

#if WIDE

TARGET static ICCP_INLINE void widen(uint64_t pair, channels8 *x)
{
    *x = (channels8)_mm256_cvtepu8_epi32(_mm_cvtsi64_si128((int64_t)pair));
}

/* Copies the opacity of each pixel to all of its channels. */
TARGET static ICCP_INLINE void spread_opacity(const channels8 *x, channels8 *opacity)
{
    *opacity = (channels8)_mm256_shuffle_epi32((__m256i)*x, 0xff);
}

TARGET static ICCP_INLINE void halves(const channels8 *x, channels4 *left, channels4 *right)
{
    *left = (channels4)_mm256_castsi256_si128((__m256i)*x);
    *right = (channels4)_mm256_extracti128_si256((__m256i)*x, 1);
}

/* Converts signed integers. */
TARGET static ICCP_INLINE void to_reals(const channels4 *x, reals *y)
{
    *y = _mm256_cvtepi32_pd((__m128i)*x);
}

TARGET static ICCP_INLINE void to_floats(const reals *x, floats *y)
{
    *y = _mm256_cvtpd_ps(*x);
}

TARGET static ICCP_INLINE void to_integers(const reals *x, channels4 *y)
{
    *y = (channels4)_mm256_cvttpd_epi32(*x);
}

TARGET static ICCP_INLINE void spread_last(const reals *x, reals *last)
{
    *last = _mm256_permute4x64_pd(*x, 0xff);
}

#else

TARGET static ICCP_INLINE void join(channels4 left, channels4 right, channels8 *x)
{
    memcpy(x, &left, 16);
    memcpy((char *)x + 16, &right, 16);
}

TARGET static ICCP_INLINE void halves(const channels8 *x, channels4 *left, channels4 *right)
{
    memcpy(left, x, 16);
    memcpy(right, (const char *)x + 16, 16);
}

TARGET static ICCP_INLINE void widen(uint64_t pair, channels8 *x)
{
    join((channels4)_mm_cvtepu8_epi32(_mm_cvtsi64_si128((int64_t)pair)),
         (channels4)_mm_cvtepu8_epi32(_mm_cvtsi64_si128((int64_t)(pair >> 32))), x);
}

TARGET static ICCP_INLINE void spread_opacity(const channels8 *x, channels8 *opacity)
{
    channels4 left, right;
    halves(x, &left, &right);
    join((channels4)_mm_shuffle_epi32((__m128i)left, 0xff),
         (channels4)_mm_shuffle_epi32((__m128i)right, 0xff), opacity);
}

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

TARGET static ICCP_INLINE void to_floats(const reals *x, floats *y)
{
    __m128d low, high;
    half_reals(x, &low, &high);
    *y = _mm_movelh_ps(_mm_cvtpd_ps(low), _mm_cvtpd_ps(high));
}

TARGET static ICCP_INLINE void to_integers(const reals *x, channels4 *y)
{
    __m128d low, high;
    half_reals(x, &low, &high);
    *y = (channels4)_mm_unpacklo_epi64(_mm_cvttpd_epi32(low), _mm_cvttpd_epi32(high));
}

TARGET static ICCP_INLINE void spread_last(const reals *x, reals *last)
{
    __m128d low, high;
    half_reals(x, &low, &high);
    high = _mm_unpackhi_pd(high, high);
    join_reals(high, high, last);
}

#endif

/* ---- samples ---- */

/* The format that a kernel is compiled for; a constant. */
typedef struct format {
    int channels;
    bool alpha, opaque; /* opaque: all opacities are 255 */
} format;

/* A place on a walk. `right` and `down` are the fraction of the position times 2^32, of which the
 * upper BITS bits count. */
typedef struct place {
    const uint8_t *pixels;
    size_t stride;
    int64_t u, v, du, dv;
    channels4 right, du4;
    channels8 down, dv8;
} place;

/* Returns false if the walk reaches the last column or row. A position there belongs to the cell
 * before it, which only the portable kernels handle. */
static ICCP_INLINE bool is_plain(const icc_picture *p, const iccp_walk *w)
{
    const int64_t half = (int64_t)1 << (31 - BITS), n = (int64_t)w->n - 1;
    const int64_t columns = (int64_t)(p->width - 1) * ((int64_t)1 << 32) - half;
    const int64_t rows = (int64_t)(p->height - 1) * ((int64_t)1 << 32) - half;
    return w->u < columns && w->u + n * w->du < columns && w->v < rows && w->v + n * w->dv < rows;
}

TARGET static ICCP_INLINE void begin(place *x, const icc_picture *p, const iccp_walk *w)
{
    const int64_t half = (int64_t)1 << (31 - BITS);
    x->pixels = p->pixels;
    x->stride = p->stride;
    x->u = w->u + half;
    x->v = w->v + half;
    x->du = w->du;
    x->dv = w->dv;
    x->right = (channels4){0} + (uint32_t)x->u;
    x->down = (channels8){0} + (uint32_t)x->v;
    x->du4 = (channels4){0} + (uint32_t)x->du;
    x->dv8 = (channels8){0} + (uint32_t)x->dv;
}

TARGET static ICCP_INLINE void advance(place *x)
{
    x->u += x->du;
    x->v += x->dv;
    x->right += x->du4;
    x->down += x->dv8;
}

/* Loads two pixels of a row. With three channels, the fourth byte has no meaning. */
static ICCP_INLINE uint64_t load_pair(const uint8_t *left, format f)
{
    uint64_t pair;
    uint32_t first, second;
    if (f.channels == 4) {
        memcpy(&pair, left, 8);
        return pair;
    }
    memcpy(&first, left, 4);
    memcpy(&second, left + 2, 4);
    return first | (uint64_t)(second >> 8) << 32;
}

/* The four pixels around a place, each with four bytes. */
typedef struct sample {
    uint64_t above, below;
} sample;

/* The rows of the target follow each other, so the source's pixels for the next rows are
 * prefetched. This suits maps that turn the picture by less than 90 degrees. */
enum { AHEAD = 6 };

static ICCP_INLINE sample load(const place *x, format f)
{
    const size_t column = (size_t)(x->u >> 32), row = (size_t)(x->v >> 32);
    const uint8_t *first = x->pixels + row * x->stride + column * (size_t)f.channels;
    ICCP_PREFETCH((const void *)((uintptr_t)first + AHEAD * x->stride));
    return (sample){load_pair(first, f), load_pair(first + x->stride, f)};
}

static ICCP_INLINE bool same_opacity(const sample *s)
{
    const uint64_t swapped = s->above << 32 | s->above >> 32;
    return (((s->above ^ s->below) | (s->above ^ swapped)) & UINT64_C(0xff000000ff000000)) == 0;
}

TARGET static ICCP_INLINE void plain_sums(const place *x, const sample *s, channels4 *sums)
{
    channels8 above, below;
    channels4 left, right;
    widen(s->above, &above);
    widen(s->below, &below);
    const channels8 columns = (above << BITS) + (x->down >> (32 - BITS)) * (below - above);
    halves(&columns, &left, &right);
    *sums = (left << BITS) + (x->right >> (32 - BITS)) * (right - left);
}

/* Multiplies the channels of two pixels by their weights, and puts the weights last. */
TARGET static ICCP_INLINE void weigh(uint64_t pair, reals *left, reals *right)
{
    const channels8 colours = {~0U, ~0U, ~0U, 0, ~0U, ~0U, ~0U, 0}, one = {0, 0, 0, 1, 0, 0, 0, 1};
    channels8 x, opacity;
    channels4 a, b;
    widen(pair, &x);
    spread_opacity(&x, &opacity);
    x = ((x & colours) | one) * ((opacity << ICCP_NARROW_FLOOR) + 1);
    halves(&x, &a, &b);
    to_reals(&a, left);
    to_reals(&b, right);
}

TARGET static ICCP_INLINE void weighted_sums(const place *x, const sample *s, reals *sums)
{
    const channels4 share_right = x->right >> (32 - BITS);
    const channels8 share_down = x->down >> (32 - BITS);
    channels4 share, same;
    reals a, b, c, d, right, down;
    weigh(s->above, &a, &b);
    weigh(s->below, &c, &d);
    halves(&share_down, &share, &same);
    to_reals(&share, &down);
    to_reals(&share_right, &right);
    const reals left_of = (1 << BITS) - right, above = (1 << BITS) - down;
    *sums = left_of * (above * a + down * c) + right * (above * b + down * d);
}

/* Converts unsigned integers exactly. */
TARGET static ICCP_INLINE void unsigned_to_reals(const channels4 *x, reals *y)
{
    const channels4 moved = *x ^ 1U << 31;
    to_reals(&moved, y);
    *y += 0x1p31;
}

/* With equal opacities, the weighted sums are the plain sums times the weight. */
TARGET static ICCP_INLINE void find_sums(const place *x, const sample *s, format f, reals *sums)
{
    const channels4 colours = {~0U, ~0U, ~0U, 0}, whole = {0, 0, 0, 1U << 24};
    channels4 plain;
    if (f.alpha && !f.opaque && !same_opacity(s)) {
        weighted_sums(x, s, sums);
        return;
    }
    plain_sums(x, s, &plain);
    if (f.alpha)
        plain = (plain & colours) | whole;
    unsigned_to_reals(&plain, sums);
    if (f.opaque)
        *sums *= (255 << ICCP_NARROW_FLOOR) + 1.0;
    else if (f.alpha) {
        const channels4 weight =
            (channels4){0} + ((uint32_t)(s->above >> 56) << ICCP_NARROW_FLOOR | 1);
        reals w;
        to_reals(&weight, &w);
        *sums *= w;
    }
}

/* ---- kernels ---- */

/* Stores the lowest bytes. */
TARGET static ICCP_INLINE void put(const channels4 *x, format f, uint8_t *to)
{
    const __m128i order =
        _mm_setr_epi8(0, 4, 8, 12, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1);
    const int32_t bytes = _mm_cvtsi128_si32(_mm_shuffle_epi8((__m128i)*x, order));
    memcpy(to, &bytes, (size_t)f.channels);
}

/* Rounds quotients correctly. Weights have 41 bits and means 8, so a quotient that is not an
 * integer is farther from every integer than its rounding error. */
TARGET static ICCP_INLINE void put_weighted(const reals *sums, format f, uint8_t *to)
{
    typedef int64_t mask __attribute__((vector_size(32)));
    const mask colours = {-1, -1, -1, 0};
    reals weight, x;
    channels4 bytes;
    spread_last(sums, &weight);
    const reals mean = (*sums + 0.5 * weight) / weight, opacity = (*sums - 0x1p24) * 0x1p-32 + 0.5;
    x = (reals)(((mask)mean & colours) | ((mask)opacity & ~colours));
    to_integers(&x, &bytes);
    put(&bytes, f, to);
}

TARGET static ICCP_INLINE void paint_one(const place *x, const sample *s, format f, uint8_t *to)
{
    if (f.alpha && !f.opaque && !same_opacity(s)) {
        reals sums;
        weighted_sums(x, s, &sums);
        put_weighted(&sums, f, to);
    } else {
        channels4 sums;
        plain_sums(x, s, &sums);
        sums = (sums + (1U << (2 * BITS - 1))) >> (2 * BITS);
        put(&sums, f, to);
    }
}

TARGET static ICCP_INLINE void paint(const icc_picture *source, format f, const iccp_walk *w,
                                     uint8_t *to)
{
    place x;
    if (!is_plain(source, w)) {
        iccp_sampler_portable(source)->paint(source, w, to);
        return;
    }
    begin(&x, source, w);
    for (size_t n = w->n; n > 0; --n, to += f.channels) {
        const sample s = load(&x, f);
        paint_one(&x, &s, f, to);
        advance(&x);
    }
}

TARGET static ICCP_INLINE void add(iccp_gathered *to, const reals *exact, float weight)
{
    floats sums, more;
    memcpy(&sums, to->sums, sizeof sums);
    to_floats(exact, &more);
    sums += weight * more;
    memcpy(to->sums, &sums, sizeof sums);
    to->weight += weight;
}

TARGET static ICCP_INLINE void gather(const icc_picture *source, format f, const iccp_walk *w,
                                      float weight, size_t phase, size_t per_pixel,
                                      iccp_gathered *pixels)
{
    place x;
    if (!is_plain(source, w)) {
        iccp_sampler_portable(source)->gather(source, w, weight, phase, per_pixel, pixels);
        return;
    }
    begin(&x, source, w);
    for (size_t n = w->n; n > 0; --n) {
        reals sums;
        const sample s = load(&x, f);
        find_sums(&x, &s, f, &sums);
        add(pixels, &sums, weight);
        advance(&x);
        if (++phase == per_pixel) {
            phase = 0;
            ++pixels;
        }
    }
}

TARGET static ICCP_INLINE void store_one(const iccp_gathered *gathered, format f, uint8_t *to)
{
    const float whole = gathered->weight * 0x1p24F;
    floats x;
    memcpy(&x, gathered->sums, sizeof x);
    if (f.alpha) {
        const float weight = x[OPACITY];
        x /= (floats){weight, weight, weight, whole};
        x[OPACITY] = (x[OPACITY] - 1) * 0x1p-8F;
        x = _mm_max_ps(x, _mm_setzero_ps());
    } else
        x /= whole;
    x = _mm_min_ps(x, _mm_set1_ps(255)) + 0.5F;
    const channels4 colours = (channels4)_mm_cvttps_epi32(x);
    put(&colours, f, to);
}

TARGET static ICCP_INLINE void store(const iccp_gathered *gathered, size_t n, format f, uint8_t *to)
{
    for (; n > 0; --n, ++gathered, to += f.channels)
        store_one(gathered, f, to);
}

#define KERNELS(name, channels, alpha, opaque)                                                     \
    TARGET static void paint_##name(const icc_picture *source, const iccp_walk *w, uint8_t *to)    \
    {                                                                                              \
        paint(source, (format){channels, alpha, opaque}, w, to);                                   \
    }                                                                                              \
    TARGET static void gather_##name(const icc_picture *source, const iccp_walk *w, float weight,  \
                                     size_t phase, size_t per_pixel, iccp_gathered *pixels)        \
    {                                                                                              \
        gather(source, (format){channels, alpha, opaque}, w, weight, phase, per_pixel, pixels);    \
    }                                                                                              \
    TARGET static void store_##name(const iccp_gathered *gathered, size_t n, uint8_t *to)          \
    {                                                                                              \
        store(gathered, n, (format){channels, alpha, opaque}, to);                                 \
    }                                                                                              \
    static const iccp_sampler_kernels name = {paint_##name, gather_##name, store_##name};

KERNELS(rgb, 3, false, false)
KERNELS(rgbx, 4, false, false)
KERNELS(rgba, 4, true, false)
KERNELS(opaque, 4, true, true)

/* Returns true if all opacities are 255, which makes sampling much simpler. In most pictures that
 * are not opaque the search ends at once. */
TARGET static bool is_opaque(const icc_picture *p)
{
    bool all = true;
    for (int32_t j = 0; j < p->height && all; ++j) {
        const uint8_t *row = (const uint8_t *)p->pixels + (size_t)j * p->stride;
        uint32_t common = ~0U;
        for (int32_t i = 0; i < p->width; ++i) {
            uint32_t pixel;
            memcpy(&pixel, row + 4 * (size_t)i, sizeof pixel);
            common &= pixel;
        }
        all = common >> 24 == 255;
    }
    return all;
}

TARGET static const iccp_sampler_kernels *kernels_for(const icc_picture *p)
{
    if (p->bytes > 1 || p->channels < 3 || (p->channels == 3 && p->alpha))
        return NULL;
    if (p->channels == 3)
        return &rgb;
    return !p->alpha ? &rgbx : is_opaque(p) ? &opaque : &rgba;
}

#endif

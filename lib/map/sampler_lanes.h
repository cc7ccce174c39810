/* The kernels for one byte a sample and three or four channels, side by side in vectors: what
 * includes this file says for which processor (TARGET).
 *
 * Two neighbouring pixels of a row, 8 bytes, are one vector; so both columns are blended between
 * the rows at once, and then with each other, in integers below 2^32. With opacities that differ
 * the sums have up to 48 bits, and doubles hold them exactly: the bits are those of the integers. */
#ifndef ICCP_SAMPLER_LANES_H
#define ICCP_SAMPLER_LANES_H

#include "map/sampler_kernels.h"

#include "base/compiler.h"

#include <immintrin.h>
#include <string.h>

/* Vectors are handed on by pointer: how they would be passed depends on the processor. */
typedef uint32_t channels4 __attribute__((vector_size(16)));
typedef uint32_t channels8 __attribute__((vector_size(32))); /* of two pixels */
typedef double reals __attribute__((vector_size(32)));
typedef float floats __attribute__((vector_size(16)));
typedef uint64_t positions __attribute__((vector_size(32)));

enum { BITS = ICCP_NARROW_BITS, LANES = 4, OPACITY = 3 };

/* ---- positions ---- */

/* The next samples of a walk: the pixels up and left of them, and how far they are from those. */
typedef struct cells {
    uint64_t column[LANES], row[LANES], right[LANES], down[LANES];
} cells;

/* The last row and column count as the far side of the cells before them. */
TARGET static ICCP_INLINE void find_along(const positions *u, uint64_t last, uint64_t *index,
                                          uint64_t *share)
{
    const positions whole = *u >> 32;
    const positions i = whole + (positions)(whole > last); /* by one at most */
    const positions rest = (*u - (i << 32)) >> (32 - BITS);
    memcpy(index, &i, sizeof i);
    memcpy(share, &rest, sizeof rest);
}

/* A walk, LANES samples at a time. */
typedef struct stride4 {
    positions u, v, du, dv;
    uint64_t last_column, last_row;
} stride4;

TARGET static ICCP_INLINE void begin(stride4 *s, const icc_picture *p, const iccp_walk *w)
{
    const int64_t half = (int64_t)1 << (31 - BITS);
    const int64_t u = w->u + half, v = w->v + half, du = w->du, dv = w->dv;
    s->u = (positions){(uint64_t)u, (uint64_t)(u + du), (uint64_t)(u + 2 * du),
                       (uint64_t)(u + 3 * du)};
    s->v = (positions){(uint64_t)v, (uint64_t)(v + dv), (uint64_t)(v + 2 * dv),
                       (uint64_t)(v + 3 * dv)};
    s->du = (positions){0} + (uint64_t)(4 * du);
    s->dv = (positions){0} + (uint64_t)(4 * dv);
    s->last_column = (uint64_t)(p->width - 2);
    s->last_row = p->height > 1 ? (uint64_t)(p->height - 2) : 0;
}

TARGET static ICCP_INLINE void find_cells(stride4 *s, cells *c)
{
    find_along(&s->u, s->last_column, c->column, c->right);
    find_along(&s->v, s->last_row, c->row, c->down);
    s->u += s->du;
    s->v += s->dv;
}

/* ---- vectors ---- */

#if WIDE

TARGET static ICCP_INLINE void widen(uint64_t pair, channels8 *x)
{
    *x = (channels8)_mm256_cvtepu8_epi32(_mm_cvtsi64_si128((int64_t)pair));
}

/* The opacity of each pixel for all of its channels. */
TARGET static ICCP_INLINE void spread_opacity(const channels8 *x, channels8 *opacity)
{
    *opacity = (channels8)_mm256_shuffle_epi32((__m256i)*x, 0xff);
}

TARGET static ICCP_INLINE void halves(const channels8 *x, channels4 *left, channels4 *right)
{
    *left = (channels4)_mm256_castsi256_si128((__m256i)*x);
    *right = (channels4)_mm256_extracti128_si256((__m256i)*x, 1);
}

/* Of signed numbers. */
TARGET static ICCP_INLINE void to_reals(const channels4 *x, reals *y)
{
    *y = _mm256_cvtepi32_pd((__m128i)*x);
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

TARGET static ICCP_INLINE void to_reals(const channels4 *x, reals *y)
{
    const __m128d low = _mm_cvtepi32_pd((__m128i)*x);
    const __m128d high = _mm_cvtepi32_pd(_mm_shuffle_epi32((__m128i)*x, 0xee));
    memcpy(y, &low, 16);
    memcpy((char *)y + 16, &high, 16);
}

#endif

/* ---- samples ---- */

/* What a kernel is compiled for. */
typedef struct format {
    int channels;
    bool alpha;
} format;

/* What does not change along a walk. */
typedef struct plane {
    const uint8_t *pixels;
    size_t stride, down;
} plane;

static ICCP_INLINE plane make_plane(const icc_picture *p)
{
    return (plane){p->pixels, p->stride, p->height > 1 ? p->stride : 0};
}

/* The four pixels round a position, each with four bytes, and the shares of the farther ones. */
typedef struct sample {
    uint64_t above, below;
    uint32_t right, down;
} sample;

/* Two pixels of a row. */
static ICCP_INLINE uint64_t load_pair(const uint8_t *left, format f)
{
    uint64_t both;
    uint32_t first, second;
    if (f.channels == 4) {
        memcpy(&both, left, 8);
        return both;
    }
    memcpy(&first, left, 4);
    memcpy(&second, left + 2, 4);
    return (first & 0xffffff) | (uint64_t)(second >> 8) << 32;
}

static ICCP_INLINE sample load(plane p, format f, const cells *c, size_t k)
{
    const uint8_t *first = p.pixels + c->row[k] * p.stride + c->column[k] * (size_t)f.channels;
    return (sample){load_pair(first, f), load_pair(first + p.down, f), (uint32_t)c->right[k],
                    (uint32_t)c->down[k]};
}

static ICCP_INLINE bool same_opacity(const sample *s)
{
    const uint64_t swapped = s->above << 32 | s->above >> 32;
    return (((s->above ^ s->below) | (s->above ^ swapped)) & UINT64_C(0xff000000ff000000)) == 0;
}

TARGET static ICCP_INLINE void plain_sums(const sample *s, channels4 *sums)
{
    channels8 above, below;
    channels4 left, right;
    widen(s->above, &above);
    widen(s->below, &below);
    const channels8 columns = (above << BITS) + s->down * (below - above);
    halves(&columns, &left, &right);
    *sums = (left << BITS) + s->right * (right - left);
}

/* Two pixels' channels times their weights, and the weights last. */
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

TARGET static ICCP_INLINE void weighted_sums(const sample *s, reals *sums)
{
    const double right = s->right, down = s->down;
    reals a, b, c, d;
    weigh(s->above, &a, &b);
    weigh(s->below, &c, &d);
    const reals first = (4096 - down) * a + down * c, second = (4096 - down) * b + down * d;
    *sums = (4096 - right) * first + right * second;
}

/* Equal opacities weight nothing: weighted sums are plain ones times the weight. */
TARGET static ICCP_INLINE void find_sums(const sample *s, format f, reals *sums)
{
    channels4 plain;
    if (f.alpha && !same_opacity(s)) {
        weighted_sums(s, sums);
        return;
    }
    plain_sums(s, &plain);
    plain ^= 1U << 31;
    to_reals(&plain, sums);
    *sums += 0x1p31;
    if (f.alpha) {
        const reals colours = {1, 1, 1, 0}, whole = {0, 0, 0, 0x1p24};
        const double opacity = (double)(s->above >> 56);
        *sums = (*sums * colours + whole) * (256 * opacity + 1);
    }
}

/* ---- kernels ---- */

/* The lowest bytes. */
TARGET static ICCP_INLINE void put(const channels4 *x, format f, uint8_t *to)
{
    const __m128i order =
        _mm_setr_epi8(0, 4, 8, 12, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1);
    const int32_t bytes = _mm_cvtsi128_si32(_mm_shuffle_epi8((__m128i)*x, order));
    memcpy(to, &bytes, (size_t)f.channels);
}

TARGET static ICCP_INLINE void put_weighted(const reals *sums, format f, uint8_t *to)
{
    const double weight = (*sums)[OPACITY];
    reals x = (*sums + 0.5 * weight) / weight;
    x[OPACITY] = (weight - 0x1p24) * 0x1p-32 + 0.5;
    const channels4 colours = (channels4) __builtin_convertvector(x, __v4si);
    put(&colours, f, to);
}

TARGET static ICCP_INLINE void paint_one(const sample *s, format f, uint8_t *to)
{
    if (f.alpha && !same_opacity(s)) {
        reals sums;
        weighted_sums(s, &sums);
        put_weighted(&sums, f, to);
    } else {
        channels4 sums;
        plain_sums(s, &sums);
        sums = (sums + (1U << (2 * BITS - 1))) >> (2 * BITS);
        put(&sums, f, to);
    }
}

TARGET static ICCP_INLINE void paint(const icc_picture *source, format f, const iccp_walk *w,
                                     uint8_t *to)
{
    const plane p = make_plane(source);
    stride4 along;
    cells c;
    begin(&along, source, w);
    for (size_t n = w->n; n > 0; n -= n < LANES ? n : LANES) {
        find_cells(&along, &c);
        for (size_t k = 0; k < LANES && k < n; ++k, to += f.channels) {
            const sample s = load(p, f, &c, k);
            paint_one(&s, f, to);
        }
    }
}

TARGET static ICCP_INLINE void add(iccp_gathered *to, const sample *s, format f, float weight)
{
    reals exact;
    floats sums;
    find_sums(s, f, &exact);
    memcpy(&sums, to->sums, sizeof sums);
    sums += weight * __builtin_convertvector(exact, floats);
    memcpy(to->sums, &sums, sizeof sums);
    to->weight += weight;
}

TARGET static ICCP_INLINE void gather(const icc_picture *source, format f, const iccp_walk *w,
                                      float weight, size_t phase, size_t per_pixel,
                                      iccp_gathered *pixels)
{
    const plane p = make_plane(source);
    stride4 along;
    cells c;
    begin(&along, source, w);
    for (size_t n = w->n; n > 0; n -= n < LANES ? n : LANES) {
        find_cells(&along, &c);
        for (size_t k = 0; k < LANES && k < n; ++k) {
            const sample s = load(p, f, &c, k);
            add(pixels, &s, f, weight);
            if (++phase == per_pixel) {
                phase = 0;
                ++pixels;
            }
        }
    }
}

TARGET static ICCP_INLINE void store(const iccp_gathered *gathered, format f, uint8_t *to)
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

#define KERNELS(name, channels, alpha)                                                             \
    TARGET static void paint_##name(const icc_picture *source, const iccp_walk *w, uint8_t *to)    \
    {                                                                                              \
        paint(source, (format){channels, alpha}, w, to);                                           \
    }                                                                                              \
    TARGET static void gather_##name(const icc_picture *source, const iccp_walk *w, float weight,  \
                                     size_t phase, size_t per_pixel, iccp_gathered *pixels)        \
    {                                                                                              \
        gather(source, (format){channels, alpha}, w, weight, phase, per_pixel, pixels);            \
    }                                                                                              \
    TARGET static void store_##name(const iccp_gathered *gathered, uint8_t *to)                    \
    {                                                                                              \
        store(gathered, (format){channels, alpha}, to);                                            \
    }                                                                                              \
    static const iccp_sampler_kernels name = {paint_##name, gather_##name, store_##name};

KERNELS(rgb, 3, false)
KERNELS(rgbx, 4, false)
KERNELS(rgba, 4, true)

/* The two columns of a cell are loaded at once. */
static const iccp_sampler_kernels *kernels_for(const icc_picture *p)
{
    if (p->bytes > 1 || p->channels < 3 || p->width < 2 || (p->channels == 3 && p->alpha))
        return NULL;
    return p->channels == 3 ? &rgb : p->alpha ? &rgba : &rgbx;
}

#endif

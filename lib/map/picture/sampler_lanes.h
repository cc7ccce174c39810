/* Vector kernels for samples of one byte and three or four channels.
 *
 * PIXELS pixels of the target are sampled side by side: a vector has four channels of each. The
 * four source pixels of a sample are blended in integers below 2^32, first the rows, in both
 * columns, and then the columns. If opacities differ, the sums have up to 48 bits. Doubles hold
 * them exactly, so the results have the same bits as integers.
 *
 * The file that includes this one names the processor (TARGET), and PIXELS if it is not 1. It also
 * defines the functions that are declared under "vectors". */
#ifndef ICCP_SAMPLER_LANES_H
#define ICCP_SAMPLER_LANES_H

#include "map/picture/sampler_kernels.h"

#include "base/compiler.h"

#include <string.h>

#ifndef PIXELS
#define PIXELS 1
#endif

/* Vectors are passed by pointer, because passing them by value depends on the processor. */
typedef uint32_t lanes __attribute__((vector_size(16 * PIXELS)));
typedef uint16_t shorts __attribute__((vector_size(16 * PIXELS)));
typedef uint64_t positions __attribute__((vector_size(16 * PIXELS))); /* u and v of each pixel */
typedef uint64_t position __attribute__((vector_size(16)));
typedef float floats __attribute__((vector_size(16 * PIXELS)));
typedef uint32_t channels4 __attribute__((vector_size(16)));
typedef uint32_t channels8 __attribute__((vector_size(32))); /* of two pixels of the source */
typedef double reals __attribute__((vector_size(32)));       /* of one pixel */

enum { BITS = ICCP_NARROW_BITS };

/* The four source pixels around a place: in each row a left one and a right one of four bytes. */
typedef struct sample {
    uint64_t above, below;
} sample;

/* ---- vectors ---- */

/* Sets pixel k to first + k * step. */
TARGET static ICCP_INLINE void line_up(const position *first, const position *step, positions *x);

/* Copy a channel of each pixel to all channels; spread_third() also to the upper halves. */
TARGET static ICCP_INLINE void spread_first(lanes *x);
TARGET static ICCP_INLINE void spread_third(lanes *x);
TARGET static ICCP_INLINE void spread_last(lanes *x);
TARGET static ICCP_INLINE void spread_last8(channels8 *x);
TARGET static ICCP_INLINE void spread_last_real(reals *x);

/* Blends the rows of each sample. A weight is that of the row above, plus 2^16 times that of the
 * row below. */
TARGET static ICCP_INLINE void blend_rows(const sample s[PIXELS], const lanes *weights, lanes *left,
                                          lanes *right);
/* Puts the opacities of y in the place of those of x. */
TARGET static ICCP_INLINE void replace_opacity(lanes *x, const lanes *y);
TARGET static ICCP_INLINE void widen(uint64_t pair, channels8 *x);
TARGET static ICCP_INLINE void halves(const channels8 *x, channels4 *left, channels4 *right);
/* Puts numbers below 0 to 0, and those above 255 to 255. */
TARGET static ICCP_INLINE void limit(floats *x);

/* Multiplies unsigned integers by a weight for each pixel. The result is rounded only once. */
TARGET static ICCP_INLINE void scale(const lanes *x, const double weights[PIXELS], floats *y);

/* Convert signed integers. */
TARGET static ICCP_INLINE void lanes_to_reals(const lanes *x, reals y[PIXELS]);
TARGET static ICCP_INLINE void to_reals(const channels4 *x, reals *y);

/* Convert to the nearest floats, or to integers without the fraction. */
TARGET static ICCP_INLINE void to_floats(const reals x[PIXELS], floats *y);
TARGET static ICCP_INLINE void reals_to_lanes(const reals x[PIXELS], lanes *y);
TARGET static ICCP_INLINE void floats_to_lanes(const floats *x, lanes *y);

/* Stores the highest bytes of all channels of n pixels. */
TARGET static ICCP_INLINE void put(const lanes *x, size_t n, int channels, uint8_t *to);
/* Adds the numbers of pixel k to the sums. */
TARGET static ICCP_INLINE void add_sums(const floats *x, size_t k, float sums[4]);
/* Read the sums and the weights of n pixels. */
TARGET static ICCP_INLINE void take_sums(const iccp_gathered *pixels, size_t n, floats *sums);
TARGET static ICCP_INLINE void take_weights(const iccp_gathered *pixels, size_t n, floats *weights);

/* ---- samples ---- */

/* The format that a kernel is compiled for; a constant. */
typedef struct format {
    int channels;
    bool alpha, opaque; /* opaque: all opacities are 255 */
} format;

/* The places of PIXELS neighbouring samples on a walk, in units of 2^-32 pixels. */
typedef struct places {
    const uint8_t *pixels;
    size_t stride;
    int64_t u, v, du, dv; /* of the first sample, and to the next one */
    positions all;        /* only the fractions count */
    positions advance;
} places;

/* Returns false if the walk reaches the last column or row. A position there belongs to the cell
 * before it, which only the portable kernels handle. */
static ICCP_INLINE bool is_plain(const icc_picture *p, const iccp_walk *w)
{
    const int64_t half = (int64_t)1 << (31 - BITS), n = (int64_t)w->n - 1;
    const int64_t columns = (int64_t)(p->width - 1) * ((int64_t)1 << 32) - half;
    const int64_t rows = (int64_t)(p->height - 1) * ((int64_t)1 << 32) - half;
    return w->u < columns && w->u + n * w->du < columns && w->v < rows && w->v + n * w->dv < rows;
}

/* The rows of the target follow each other, so the source's pixels for the next rows are
 * prefetched. This suits maps that turn the picture by less than 90 degrees. */
enum { AHEAD = 6 };

TARGET static ICCP_INLINE void begin(places *x, const icc_picture *p, const iccp_walk *w)
{
    const int64_t half = (int64_t)1 << (31 - BITS);
    x->pixels = p->pixels;
    x->stride = p->stride;
    x->u = w->u + half;
    x->v = w->v + half;
    x->du = w->du;
    x->dv = w->dv;
    const position first = {(uint64_t)x->u, (uint64_t)x->v}, none = {0};
    const position step = {(uint64_t)x->du, (uint64_t)x->dv}, all_steps = PIXELS * step;
    line_up(&first, &step, &x->all);
    line_up(&all_steps, &none, &x->advance);
}

TARGET static ICCP_INLINE void advance(places *x)
{
    x->u += PIXELS * x->du;
    x->v += PIXELS * x->dv;
    x->all += x->advance;
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

static ICCP_INLINE const uint8_t *pixel_at(const places *x, int64_t k, format f)
{
    const size_t column = (size_t)((x->u + k * x->du) >> 32);
    const size_t row = (size_t)((x->v + k * x->dv) >> 32);
    return x->pixels + row * x->stride + column * (size_t)f.channels;
}

/* Loads n samples, and the first one in place of the others. */
static ICCP_INLINE void load(const places *x, size_t n, format f, sample s[PIXELS])
{
    ICCP_PREFETCH((const void *)((uintptr_t)pixel_at(x, 0, f) + AHEAD * x->stride));
    for (size_t k = 0; k < PIXELS; ++k) {
        const uint8_t *above = pixel_at(x, k < n ? (int64_t)k : 0, f);
        s[k] = (sample){load_pair(above, f), load_pair(above + x->stride, f)};
    }
}

/* Returns true if the four source pixels of each sample have the same opacity. */
static ICCP_INLINE bool same_opacity(const sample s[PIXELS])
{
    uint64_t differ = 0;
    for (int k = 0; k < PIXELS; ++k)
        differ |= (s[k].above ^ s[k].below) | (s[k].above ^ (s[k].above << 32 | s[k].above >> 32));
    return (differ & UINT64_C(0xff000000ff000000)) == 0;
}

/* Finds the shares of the right column and of the row below, times 2^BITS, in all channels. The
 * upper halves of the latter have the share, too. */
TARGET static ICCP_INLINE void find_shares(const places *x, lanes *right, lanes *below)
{
    *right = *below = (lanes)x->all >> (32 - BITS);
    spread_first(right);
    spread_third(below);
}

TARGET static ICCP_INLINE void plain_sums(const places *x, const sample s[PIXELS], lanes *sums)
{
    lanes share_right, share_below, left, right;
    find_shares(x, &share_right, &share_below);
    /* the row above: 2^BITS - share; the row below: the share */
    const lanes signs = (lanes){0} + 0x1ffff, whole = (lanes){0} + (1 << BITS);
    const lanes weights = (lanes)((shorts)share_below * (shorts)signs + (shorts)whole);
    blend_rows(s, &weights, &left, &right);
    *sums = (left << BITS) + share_right * (right - left);
}

/* Multiplies the channels of two pixels by their weights, and puts the weights last. */
TARGET static ICCP_INLINE void weigh(uint64_t pair, reals *left, reals *right)
{
    const channels8 colours = {~0U, ~0U, ~0U, 0, ~0U, ~0U, ~0U, 0}, one = {0, 0, 0, 1, 0, 0, 0, 1};
    channels8 x, opacity;
    channels4 a, b;
    widen(pair, &x);
    opacity = x;
    spread_last8(&opacity);
    x = ((x & colours) | one) * ((opacity << ICCP_NARROW_FLOOR) + 1);
    halves(&x, &a, &b);
    to_reals(&a, left);
    to_reals(&b, right);
}

TARGET static ICCP_INLINE void weighted_sums(const places *x, const sample s[PIXELS],
                                             reals sums[PIXELS])
{
    lanes share_right, share_below;
    reals right[PIXELS], below[PIXELS], a, b, c, d;
    find_shares(x, &share_right, &share_below);
    lanes_to_reals(&share_right, right);
    share_below &= (1 << BITS) - 1;
    lanes_to_reals(&share_below, below);
    for (int k = 0; k < PIXELS; ++k) {
        const reals left = (1 << BITS) - right[k], above = (1 << BITS) - below[k];
        weigh(s[k].above, &a, &b);
        weigh(s[k].below, &c, &d);
        sums[k] = left * (above * a + below[k] * c) + right[k] * (above * b + below[k] * d);
    }
}

/* Finds the sums that are gathered. With equal opacities, the weighted sums are the plain sums
 * times the weight. */
TARGET static ICCP_INLINE void find_sums(const places *x, const sample s[PIXELS], format f,
                                         floats *sums)
{
    const lanes whole = (lanes){0} + (1U << (2 * BITS));
    lanes plain;
    reals weighted[PIXELS];
    double weights[PIXELS];
    if (f.alpha && !f.opaque && !same_opacity(s)) {
        weighted_sums(x, s, weighted);
        to_floats(weighted, sums);
        return;
    }
    plain_sums(x, s, &plain);
    if (f.alpha)
        replace_opacity(&plain, &whole);
    for (int k = 0; k < PIXELS; ++k) {
        const uint32_t opacity = f.opaque ? 255 : (uint32_t)(s[k].above >> 56);
        weights[k] = f.alpha ? (int32_t)(opacity << ICCP_NARROW_FLOOR | 1) : 1;
    }
    scale(&plain, weights, sums);
}

/* ---- kernels ---- */

/* Rounds quotients correctly. Weights have 41 bits and means 8, so a quotient that is not an
 * integer is farther from every integer than its rounding error. */
TARGET static ICCP_INLINE void put_weighted(const reals sums[PIXELS], size_t n, format f,
                                            uint8_t *to)
{
    typedef int64_t mask __attribute__((vector_size(32)));
    const mask colours = {-1, -1, -1, 0};
    reals x[PIXELS];
    lanes bytes;
    for (int k = 0; k < PIXELS; ++k) {
        reals weight = sums[k];
        spread_last_real(&weight);
        const reals mean = (sums[k] + 0.5 * weight) / weight;
        const reals opacity = (sums[k] - 0x1p24) * 0x1p-32 + 0.5;
        x[k] = (reals)(((mask)mean & colours) | ((mask)opacity & ~colours));
    }
    reals_to_lanes(x, &bytes);
    bytes <<= 24;
    put(&bytes, n, f.channels, to);
}

TARGET static ICCP_INLINE void paint_places(const places *x, size_t n, format f, uint8_t *to)
{
    sample s[PIXELS];
    load(x, n, f, s);
    if (f.alpha && !f.opaque && !same_opacity(s)) {
        reals sums[PIXELS];
        weighted_sums(x, s, sums);
        put_weighted(sums, n, f, to);
    } else {
        lanes sums;
        plain_sums(x, s, &sums);
        sums += 1U << (2 * BITS - 1); /* of the 32 bits, the highest 8 are the result */
        put(&sums, n, f.channels, to);
    }
}

TARGET static ICCP_INLINE void paint(const icc_picture *source, format f, const iccp_walk *w,
                                     uint8_t *to)
{
    places x;
    size_t n = w->n;
    if (!is_plain(source, w)) {
        iccp_sampler_portable(source)->paint(source, w, to);
        return;
    }
    begin(&x, source, w);
    for (; n >= PIXELS; n -= PIXELS, to += PIXELS * f.channels) {
        paint_places(&x, PIXELS, f, to);
        advance(&x);
    }
    if (n > 0)
        paint_places(&x, n, f, to);
}

/* Adds n samples to their pixels. */
TARGET static ICCP_INLINE void add(const places *x, size_t n, format f, float weight, size_t *phase,
                                   size_t per_pixel, iccp_gathered **pixel)
{
    sample s[PIXELS];
    floats more;
    load(x, n, f, s);
    find_sums(x, s, f, &more);
    more *= weight;
    for (size_t k = 0; k < n; ++k) {
        add_sums(&more, k, (*pixel)->sums);
        (*pixel)->weight += weight;
        const bool last = ++*phase == per_pixel;
        *pixel += last;
        *phase = last ? 0 : *phase;
    }
}

TARGET static ICCP_INLINE void gather(const icc_picture *source, format f, const iccp_walk *w,
                                      float weight, size_t phase, size_t per_pixel,
                                      iccp_gathered *pixels)
{
    places x;
    size_t n = w->n;
    if (!is_plain(source, w)) {
        iccp_sampler_portable(source)->gather(source, w, weight, phase, per_pixel, pixels);
        return;
    }
    begin(&x, source, w);
    for (; n >= PIXELS; n -= PIXELS) {
        add(&x, PIXELS, f, weight, &phase, per_pixel, &pixels);
        advance(&x);
    }
    if (n > 0)
        add(&x, n, f, weight, &phase, per_pixel, &pixels);
}

/* Writes the means of n pixels. */
TARGET static ICCP_INLINE void store_some(const iccp_gathered *pixels, size_t n, format f,
                                          uint8_t *to)
{
    floats x, whole;
    lanes weight, bytes;
    take_sums(pixels, n, &x);
    take_weights(pixels, n, &whole);
    whole *= 0x1p24F;
    weight = (lanes)whole;
    if (f.alpha) {
        weight = (lanes)x;
        spread_last(&weight);
        replace_opacity(&weight, (const lanes *)&whole);
    }
    x /= (floats)weight;
    if (f.alpha) {
        const floats opacity = (x - 1) * 0x1p-8F;
        bytes = (lanes)x;
        replace_opacity(&bytes, (const lanes *)&opacity);
        x = (floats)bytes;
    }
    limit(&x);
    x += 0.5F;
    floats_to_lanes(&x, &bytes);
    bytes <<= 24;
    put(&bytes, n, f.channels, to);
}

TARGET static ICCP_INLINE void store(const iccp_gathered *pixels, size_t n, format f, uint8_t *to)
{
    for (; n >= PIXELS; n -= PIXELS, pixels += PIXELS, to += PIXELS * f.channels)
        store_some(pixels, PIXELS, f, to);
    if (n > 0)
        store_some(pixels, n, f, to);
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

/* Samples pictures of every format in plain C: interpolates, gathers and stores.
 *
 * Bilinear interpolation is done in integers, so a position on a pixel's centre gives its colour
 * exactly.
 *
 * With opacity, the mean of colours gives an opacity a the weight 2^s a + 1. Then transparent
 * pixels hardly bleed into others, by 1 in 2^s a, and fully transparent ones still keep their
 * colour. The largest sums are 2^48 for samples of one byte, and just under 2^64 for two. */
#include "map/picture/sampler_kernels.h"

#include "base/compiler.h"

#include <string.h>

/* The format that a kernel is compiled for; a constant. */
typedef struct format {
    int channels;
    bool wide, alpha;
} format;

static ICCP_INLINE int position_bits(format f)
{
    return f.wide ? ICCP_WIDE_BITS : ICCP_NARROW_BITS;
}

static ICCP_INLINE int floor_bits(format f)
{
    return f.wide ? ICCP_WIDE_FLOOR : ICCP_NARROW_FLOOR;
}

/* The four pixels around a position. `first` is the upper left one; `right` and `down` are
 * distances in memory. The shares tell how far the position is from the first pixel. */
typedef struct cell {
    const uint8_t *first;
    size_t right, down;
    uint64_t share_right, share_down;
} cell;

/* Sums over the four pixels, times 4^bits, channel by channel. */
typedef struct sums {
    uint64_t of[4];
} sums;

/* Constants of a walk. */
typedef struct plane {
    const uint8_t *pixels;
    size_t stride, right, down;
    int64_t last_column, last_row;
} plane;

/* Positions in the last row or column belong to the cells before them. */
static ICCP_INLINE plane make_plane(const icc_picture *p, format f)
{
    const bool wide = p->width > 1, high = p->height > 1;
    return (plane){p->pixels,
                   p->stride,
                   wide ? (size_t)(f.channels << f.wide) : 0,
                   high ? p->stride : 0,
                   wide ? p->width - 2 : 0,
                   high ? p->height - 2 : 0};
}

static ICCP_INLINE cell find_cell(const plane *p, format f, int64_t u, int64_t v)
{
    const int bits = position_bits(f);
    u += (int64_t)1 << (31 - bits);
    v += (int64_t)1 << (31 - bits);
    int64_t i = u >> 32, j = v >> 32;
    i = i < p->last_column ? i : p->last_column;
    j = j < p->last_row ? j : p->last_row;
    const size_t pixel = (size_t)(f.channels << f.wide);
    return (cell){p->pixels + (size_t)j * p->stride + (size_t)i * pixel, p->right, p->down,
                  (uint64_t)(u - i * ((int64_t)1 << 32)) >> (32 - bits),
                  (uint64_t)(v - j * ((int64_t)1 << 32)) >> (32 - bits)};
}

/* Blends four samples. The differences may wrap around, but the result is right. */
static ICCP_INLINE uint64_t blend(const cell *c, int bits, uint64_t s00, uint64_t s10, uint64_t s01,
                                  uint64_t s11)
{
    const uint64_t top = (s00 << bits) + c->share_right * (s10 - s00);
    const uint64_t bottom = (s01 << bits) + c->share_right * (s11 - s01);
    return (top << bits) + c->share_down * (bottom - top);
}

static ICCP_INLINE uint64_t sample(const uint8_t *pixel, int channel, bool wide)
{
    if (!wide)
        return pixel[channel];
    uint16_t value;
    memcpy(&value, pixel + 2 * channel, sizeof value);
    return value;
}

static ICCP_INLINE void plain_sum(const cell *c, format f, int channel, sums *s)
{
    const uint8_t *p = c->first, *q = p + c->down;
    if (channel < f.channels)
        s->of[channel] = blend(c, position_bits(f), sample(p, channel, f.wide),
                               sample(p + c->right, channel, f.wide), sample(q, channel, f.wide),
                               sample(q + c->right, channel, f.wide));
}

/* Packs two samples of one byte into one number. Their sums stay below 2^32. */
static ICCP_INLINE uint64_t pair(const uint8_t *pixel, int channel)
{
    return pixel[channel] | (uint64_t)pixel[channel + 1] << 32;
}

static ICCP_INLINE void plain_sum_pair(const cell *c, format f, int channel, sums *s)
{
    const uint8_t *p = c->first, *q = p + c->down;
    if (f.wide || channel + 1 >= f.channels) {
        plain_sum(c, f, channel, s);
        plain_sum(c, f, channel + 1, s);
        return;
    }
    const uint64_t blended =
        blend(c, position_bits(f), pair(p, channel), pair(p + c->right, channel), pair(q, channel),
              pair(q + c->right, channel));
    s->of[channel] = blended & UINT32_MAX;
    s->of[channel + 1] = blended >> 32;
}

static ICCP_INLINE sums plain_sums(const cell *c, format f)
{
    sums s = {{0}};
    plain_sum_pair(c, f, 0, &s);
    plain_sum_pair(c, f, 2, &s);
    return s;
}

/* The weight of one of the four pixels: 2^s a + 1. */
static ICCP_INLINE uint64_t weight_of(const uint8_t *pixel, format f)
{
    return (sample(pixel, f.channels - 1, f.wide) << floor_bits(f)) + 1;
}

static ICCP_INLINE bool same_opacity(const cell *c, format f)
{
    const int last = f.channels - 1;
    const uint8_t *p = c->first, *q = p + c->down;
    const uint64_t opacity = sample(p, last, f.wide);
    return sample(p + c->right, last, f.wide) == opacity && sample(q, last, f.wide) == opacity &&
           sample(q + c->right, last, f.wide) == opacity;
}

static ICCP_INLINE void weighted_sum(const cell *c, format f, int channel, sums *s)
{
    const uint8_t *p = c->first, *q = p + c->down;
    if (channel < f.channels - 1)
        s->of[channel] = blend(c, position_bits(f), weight_of(p, f) * sample(p, channel, f.wide),
                               weight_of(p + c->right, f) * sample(p + c->right, channel, f.wide),
                               weight_of(q, f) * sample(q, channel, f.wide),
                               weight_of(q + c->right, f) * sample(q + c->right, channel, f.wide));
}

/* The sums of the weighted colours, then the sum of the weights. */
static ICCP_INLINE sums weighted_sums(const cell *c, format f)
{
    const uint8_t *p = c->first, *q = p + c->down;
    sums s = {{0}};
    weighted_sum(c, f, 0, &s);
    weighted_sum(c, f, 1, &s);
    weighted_sum(c, f, 2, &s);
    s.of[f.channels - 1] = blend(c, position_bits(f), weight_of(p, f), weight_of(p + c->right, f),
                                 weight_of(q, f), weight_of(q + c->right, f));
    return s;
}

/* With equal opacities, the weighted sums are exactly the plain sums times the weight. */
static ICCP_INLINE sums evenly_weighted_sums(const cell *c, format f)
{
    sums s = plain_sums(c, f);
    const uint64_t weight = weight_of(c->first, f);
    for (int channel = 0; channel < f.channels - 1; ++channel)
        s.of[channel] *= weight;
    s.of[f.channels - 1] = weight << 2 * position_bits(f);
    return s;
}

static ICCP_INLINE void put(uint8_t *to, format f, int channel, uint64_t value)
{
    const uint16_t two = (uint16_t)value;
    if (channel < f.channels && f.wide)
        memcpy(to + 2 * channel, &two, sizeof two);
    else if (channel < f.channels)
        to[channel] = (uint8_t)value;
}

static ICCP_INLINE void put_plain(uint8_t *to, format f, const sums *s)
{
    const int bits = 2 * position_bits(f);
    const uint64_t half = (uint64_t)1 << (bits - 1);
    put(to, f, 0, (s->of[0] + half) >> bits);
    put(to, f, 1, (s->of[1] + half) >> bits);
    put(to, f, 2, (s->of[2] + half) >> bits);
    put(to, f, 3, (s->of[3] + half) >> bits);
}

static ICCP_INLINE void put_weighted(uint8_t *to, format f, const sums *s)
{
    const int bits = 2 * position_bits(f), last = f.channels - 1;
    const uint64_t one = (uint64_t)1 << bits, weight = s->of[last];
    for (int channel = 0; channel < last; ++channel)
        put(to, f, channel, (s->of[channel] + weight / 2) / weight);
    put(to, f, last, (((weight - one) >> floor_bits(f)) + one / 2) >> bits);
}

static ICCP_INLINE void paint_one(const cell *c, format f, uint8_t *to)
{
    if (!f.alpha || same_opacity(c, f)) {
        const sums s = plain_sums(c, f);
        put_plain(to, f, &s);
    } else {
        const sums s = weighted_sums(c, f);
        put_weighted(to, f, &s);
    }
}

static ICCP_INLINE void paint(const icc_picture *picture, format f, iccp_walk w, uint8_t *to)
{
    const plane p = make_plane(picture, f);
    for (; w.n > 0; --w.n, w.u += w.du, w.v += w.dv, to += f.channels << f.wide) {
        const cell c = find_cell(&p, f, w.u, w.v);
        paint_one(&c, f, to);
    }
}

/* Sums below 2^63 are converted as signed numbers, which is faster. */
static ICCP_INLINE void add(iccp_gathered *to, format f, int channel, const sums *s, float weight)
{
    if (channel < f.channels)
        to->sums[channel] +=
            weight * (f.alpha && f.wide ? (float)s->of[channel] : (float)(int64_t)s->of[channel]);
}

static ICCP_INLINE void gather(const icc_picture *picture, format f, iccp_walk w, float weight,
                               size_t phase, size_t per_pixel, iccp_gathered *pixels)
{
    const plane p = make_plane(picture, f);
    for (; w.n > 0; --w.n, w.u += w.du, w.v += w.dv) {
        const cell c = find_cell(&p, f, w.u, w.v);
        const sums s = !f.alpha              ? plain_sums(&c, f)
                       : same_opacity(&c, f) ? evenly_weighted_sums(&c, f)
                                             : weighted_sums(&c, f);
        add(pixels, f, 0, &s, weight);
        add(pixels, f, 1, &s, weight);
        add(pixels, f, 2, &s, weight);
        add(pixels, f, 3, &s, weight);
        pixels->weight += weight;
        if (++phase == per_pixel) {
            phase = 0;
            ++pixels;
        }
    }
}

static ICCP_INLINE uint64_t rounded(float value, float largest)
{
    return (uint64_t)((value < largest ? value : largest) + 0.5F);
}

static ICCP_INLINE void store_one(const iccp_gathered *gathered, format f, uint8_t *to)
{
    const float largest = f.wide ? 65535 : 255;
    const float whole = gathered->weight * (float)((uint64_t)1 << (2 * position_bits(f)));
    const float weight = f.alpha ? gathered->sums[f.channels - 1] : whole;
    const int n_colours = f.channels - f.alpha;
    for (int channel = 0; channel < n_colours; ++channel)
        put(to, f, channel, rounded(gathered->sums[channel] / weight, largest));
    const float opacity = (weight / whole - 1) / (float)(1 << floor_bits(f));
    if (f.alpha)
        put(to, f, n_colours, rounded(opacity > 0 ? opacity : 0, largest));
}

static ICCP_INLINE void store(const iccp_gathered *gathered, size_t n, format f, uint8_t *to)
{
    for (; n > 0; --n, ++gathered, to += f.channels << f.wide)
        store_one(gathered, f, to);
}

/* One set of kernels for each format. Everything above is inlined into it with a constant
 * format. */
#define KERNELS(name, channels, wide, alpha)                                                       \
    static void paint_##name(const icc_picture *source, const iccp_walk *w, uint8_t *to)           \
    {                                                                                              \
        paint(source, (format){channels, wide, alpha}, *w, to);                                    \
    }                                                                                              \
    static void gather_##name(const icc_picture *source, const iccp_walk *w, float weight,         \
                              size_t phase, size_t per_pixel, iccp_gathered *pixels)               \
    {                                                                                              \
        gather(source, (format){channels, wide, alpha}, *w, weight, phase, per_pixel, pixels);     \
    }                                                                                              \
    static void store_##name(const iccp_gathered *gathered, size_t n, uint8_t *to)                 \
    {                                                                                              \
        store(gathered, n, (format){channels, wide, alpha}, to);                                   \
    }                                                                                              \
    static const iccp_sampler_kernels name = {paint_##name, gather_##name, store_##name};

KERNELS(narrow1, 1, false, false)
KERNELS(narrow2, 2, false, false)
KERNELS(narrow2a, 2, false, true)
KERNELS(narrow3, 3, false, false)
KERNELS(narrow3a, 3, false, true)
KERNELS(narrow4, 4, false, false)
KERNELS(narrow4a, 4, false, true)
KERNELS(wide1, 1, true, false)
KERNELS(wide2, 2, true, false)
KERNELS(wide2a, 2, true, true)
KERNELS(wide3, 3, true, false)
KERNELS(wide3a, 3, true, true)
KERNELS(wide4, 4, true, false)
KERNELS(wide4a, 4, true, true)

const iccp_sampler_kernels *iccp_sampler_portable(const icc_picture *p)
{
    static const iccp_sampler_kernels *const all[2][2][4] = {
        {{&narrow1, &narrow2, &narrow3, &narrow4}, {NULL, &narrow2a, &narrow3a, &narrow4a}},
        {{&wide1, &wide2, &wide3, &wide4}, {NULL, &wide2a, &wide3a, &wide4a}}};
    return all[p->bytes - 1][p->alpha][p->channels - 1];
}

/* Bilinear interpolation in integers, so that a position on a pixel's centre gives its colour exactly.
 *
 * With opacity, colours are averaged with the weight 2^s a + 1 of an opacity a: what is transparent does
 * not bleed into what is not (by 1 in 2^s a), and yet the colour of what is all transparent survives.
 * The largest sums are 2^48 for one byte a sample, and just under 2^64 for two. */
#include "map/sampler.h"

#include <string.h>

enum {
    NARROW_BITS = 12, /* of a position between two centres, for samples of one byte */
    WIDE_BITS = 14,
    NARROW_FLOOR = 8, /* s above */
    WIDE_FLOOR = 4
};

static const double ONE = 4294967296.0; /* of a walk's positions */

/* What a kernel is compiled for. */
typedef struct format {
    int channels;
    bool wide, alpha;
} format;

static inline int position_bits(format f)
{
    return f.wide ? WIDE_BITS : NARROW_BITS;
}

static inline int floor_bits(format f)
{
    return f.wide ? WIDE_FLOOR : NARROW_FLOOR;
}

/* The four pixels round a position, and how far it is from the first. */
typedef struct cell {
    const uint8_t *at[4];
    uint64_t right, down;
} cell;

/* Sums over the four pixels, times 4^bits. Of colours the weighted ones where there is opacity, and then
 * the weights last. */
typedef struct sums {
    uint64_t of[4];
} sums;

/* The last row and column count as the far side of the cells before them. */
static inline cell find_cell(const icc_picture *p, format f, int64_t u, int64_t v)
{
    const int bits = position_bits(f);
    const int64_t half = (int64_t)1 << (31 - bits);
    const int64_t last_column = p->width > 1 ? p->width - 2 : 0;
    const int64_t last_row = p->height > 1 ? p->height - 2 : 0;
    int64_t i = (u + half) >> 32, j = (v + half) >> 32;
    i = i < last_column ? i : last_column;
    j = j < last_row ? j : last_row;
    const size_t pixel = (size_t)(f.channels << f.wide);
    const size_t right = p->width > 1 ? pixel : 0, down = p->height > 1 ? p->stride : 0;
    const uint8_t *first = (const uint8_t *)p->pixels + (size_t)j * p->stride + (size_t)i * pixel;
    return (cell){{first, first + right, first + down, first + down + right},
                  (uint64_t)((u + half - i * ((int64_t)1 << 32)) >> (32 - bits)),
                  (uint64_t)((v + half - j * ((int64_t)1 << 32)) >> (32 - bits))};
}

static inline uint64_t sample(const uint8_t *pixel, int channel, bool wide)
{
    if (!wide)
        return pixel[channel];
    uint16_t value;
    memcpy(&value, pixel + 2 * channel, sizeof value);
    return value;
}

/* Differences may wrap, the result does not. */
static inline uint64_t blend(const uint64_t s[4], const cell *c, int bits)
{
    const uint64_t top = (s[0] << bits) + c->right * (s[1] - s[0]);
    const uint64_t bottom = (s[2] << bits) + c->right * (s[3] - s[2]);
    return (top << bits) + c->down * (bottom - top);
}

static inline uint64_t plain_sum(const cell *c, format f, int channel)
{
    uint64_t s[4];
    for (int k = 0; k < 4; ++k)
        s[k] = sample(c->at[k], channel, f.wide);
    return blend(s, c, position_bits(f));
}

static inline sums weighted_sums(const cell *c, format f)
{
    uint64_t weight[4], s[4];
    sums result = {{0}};
    for (int k = 0; k < 4; ++k)
        weight[k] = (sample(c->at[k], f.channels - 1, f.wide) << floor_bits(f)) + 1;
    for (int channel = 0; channel < f.channels - 1; ++channel) {
        for (int k = 0; k < 4; ++k)
            s[k] = weight[k] * sample(c->at[k], channel, f.wide);
        result.of[channel] = blend(s, c, position_bits(f));
    }
    result.of[f.channels - 1] = blend(weight, c, position_bits(f));
    return result;
}

static inline void put(uint8_t *to, int channel, bool wide, uint64_t value)
{
    const uint16_t two = (uint16_t)value;
    if (wide)
        memcpy(to + 2 * channel, &two, sizeof two);
    else
        to[channel] = (uint8_t)value;
}

/* Equal opacities weight nothing: the result is the same to the last bit. */
static inline bool same_opacity(const cell *c, format f)
{
    const uint64_t first = sample(c->at[0], f.channels - 1, f.wide);
    bool same = true;
    for (int k = 1; k < 4; ++k)
        same = same && sample(c->at[k], f.channels - 1, f.wide) == first;
    return same;
}

static inline void paint_one(const cell *c, format f, uint8_t *to)
{
    const int bits = 2 * position_bits(f);
    const uint64_t half = (uint64_t)1 << (bits - 1);
    if (!f.alpha || same_opacity(c, f)) {
        for (int channel = 0; channel < f.channels; ++channel)
            put(to, channel, f.wide, (plain_sum(c, f, channel) + half) >> bits);
        return;
    }
    const sums s = weighted_sums(c, f);
    const uint64_t weight = s.of[f.channels - 1];
    for (int channel = 0; channel < f.channels - 1; ++channel)
        put(to, channel, f.wide, (s.of[channel] + weight / 2) / weight);
    const uint64_t opacity = (weight - (half << 1)) >> floor_bits(f);
    put(to, f.channels - 1, f.wide, (opacity + half) >> bits);
}

static inline void paint(const icc_picture *p, format f, iccp_walk w, uint8_t *to)
{
    for (; w.n > 0; --w.n, w.u += w.du, w.v += w.dv, to += f.channels << f.wide) {
        const cell c = find_cell(p, f, w.u, w.v);
        paint_one(&c, f, to);
    }
}

static inline void gather_one(const cell *c, format f, float weight, iccp_gathered *to)
{
    if (f.alpha) {
        const sums s = weighted_sums(c, f);
        for (int channel = 0; channel < f.channels; ++channel)
            to->sums[channel] += weight * (float)s.of[channel];
    } else
        for (int channel = 0; channel < f.channels; ++channel)
            to->sums[channel] += weight * (float)(int64_t)plain_sum(c, f, channel);
    to->weight += weight;
}

static inline void gather(const icc_picture *p, format f, iccp_walk w, float weight, size_t phase,
                          size_t per_pixel, iccp_gathered *pixels)
{
    for (; w.n > 0; --w.n, w.u += w.du, w.v += w.dv) {
        const cell c = find_cell(p, f, w.u, w.v);
        gather_one(&c, f, weight, pixels);
        if (++phase == per_pixel) {
            phase = 0;
            ++pixels;
        }
    }
}

/* One kernel for every format: the compiler sees constants. */
#define WITH_FORMAT(picture, CALL)                                                                 \
    switch ((picture)->channels * 4 + ((picture)->bytes == 2) * 2 + (picture)->alpha) {            \
        FORMAT(1, false, false, CALL)                                                              \
        FORMAT(1, true, false, CALL)                                                               \
        FORMAT(2, false, false, CALL)                                                              \
        FORMAT(2, false, true, CALL)                                                               \
        FORMAT(2, true, false, CALL)                                                               \
        FORMAT(2, true, true, CALL)                                                                \
        FORMAT(3, false, false, CALL)                                                              \
        FORMAT(3, false, true, CALL)                                                               \
        FORMAT(3, true, false, CALL)                                                               \
        FORMAT(3, true, true, CALL)                                                                \
        FORMAT(4, false, false, CALL)                                                              \
        FORMAT(4, false, true, CALL)                                                               \
        FORMAT(4, true, false, CALL)                                                               \
        FORMAT(4, true, true, CALL)                                                                \
    }
#define FORMAT(channels, wide, alpha, CALL)                                                        \
    case (channels) * 4 + (wide) * 2 + (alpha):                                                    \
        CALL(((format){channels, wide, alpha}));                                                   \
        break;

static void paint_walk(const icc_picture *source, const iccp_walk *walk, uint8_t *to)
{
#define PAINT(f) paint(source, f, *walk, to)
    WITH_FORMAT(source, PAINT)
#undef PAINT
}

static void gather_walk(const icc_picture *source, const iccp_walk *walk, float weight,
                        size_t phase, size_t per_pixel, iccp_gathered *pixels)
{
#define GATHER(f) gather(source, f, *walk, weight, phase, per_pixel, pixels)
    WITH_FORMAT(source, GATHER)
#undef GATHER
}

/* ---- lines ---- */

/* The end of a rounded walk is checked, not that of the line. */
bool iccp_walk_inside(iccp_walk *walk, const icc_picture *picture, const iccp_line *line)
{
    const double right = picture->width - 1, bottom = picture->height - 1;
    const double steps = (double)(line->n - 1);
    const double u = line->u + steps * line->du, v = line->v + steps * line->dv;
    if (!(line->u >= 0 && line->u <= right && u >= 0 && u <= right && line->v >= 0 &&
          line->v <= bottom && v >= 0 && v <= bottom))
        return false;
    /* A step of a single sample may be anything. */
    const double scale = line->n > 1 ? ONE : 0;
    *walk = (iccp_walk){(int64_t)(line->u * ONE), (int64_t)(line->v * ONE),
                        scale > 0 ? (int64_t)(line->du * scale) : 0,
                        scale > 0 ? (int64_t)(line->dv * scale) : 0, line->n};
    const int64_t n = (int64_t)line->n - 1;
    const int64_t last_u = walk->u + n * walk->du, last_v = walk->v + n * walk->dv;
    return last_u >= 0 && last_u <= (int64_t)(right * ONE) && last_v >= 0 &&
           last_v <= (int64_t)(bottom * ONE);
}

/* Not a number counts as 0. */
static int64_t clamped(double x, int32_t n)
{
    const double last = n - 1;
    return !(x > 0) ? 0 : (int64_t)((x < last ? x : last) * ONE);
}

iccp_walk iccp_walk_clamped(const icc_picture *picture, const iccp_line *line, size_t k)
{
    const double u = line->u + (double)k * line->du, v = line->v + (double)k * line->dv;
    return (iccp_walk){clamped(u, picture->width), clamped(v, picture->height), 0, 0, 1};
}

void iccp_sampler_paint(const icc_picture *source, const iccp_line *line, uint8_t *to)
{
    iccp_walk walk;
    const size_t pixel = (size_t)(source->channels * source->bytes);
    if (iccp_walk_inside(&walk, source, line)) {
        paint_walk(source, &walk, to);
        return;
    }
    for (size_t k = 0; k < line->n; ++k) {
        walk = iccp_walk_clamped(source, line, k);
        paint_walk(source, &walk, to + k * pixel);
    }
}

void iccp_sampler_gather(const icc_picture *source, const iccp_line *line, float weight,
                         size_t phase, size_t per_pixel, iccp_gathered *pixels)
{
    iccp_walk walk;
    if (iccp_walk_inside(&walk, source, line)) {
        gather_walk(source, &walk, weight, phase, per_pixel, pixels);
        return;
    }
    for (size_t k = 0; k < line->n; ++k) {
        walk = iccp_walk_clamped(source, line, k);
        gather_walk(source, &walk, weight, (phase + k) % per_pixel, per_pixel,
                    pixels + (phase + k) / per_pixel);
    }
}

static uint64_t rounded(float value, float largest)
{
    return (uint64_t)((value < largest ? value : largest) + 0.5F);
}

void iccp_sampler_store(const icc_picture *source, const iccp_gathered *gathered, uint8_t *to)
{
    const format f = {source->channels, source->bytes == 2, source->alpha != 0};
    const float largest = f.wide ? 65535 : 255;
    const float whole = gathered->weight * (float)((uint64_t)1 << (2 * position_bits(f)));
    const float weight = f.alpha ? gathered->sums[f.channels - 1] : whole;
    const int n_colours = f.channels - f.alpha;
    for (int channel = 0; channel < n_colours; ++channel)
        put(to, channel, f.wide, rounded(gathered->sums[channel] / weight, largest));
    const float opacity = (weight / whole - 1) / (float)(1 << floor_bits(f));
    if (f.alpha)
        put(to, n_colours, f.wide, rounded(opacity > 0 ? opacity : 0, largest));
}

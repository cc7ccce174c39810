/* Bilinear samples of pictures along straight lines. */
#ifndef ICCP_SAMPLER_H
#define ICCP_SAMPLER_H

#include "icc/icc.h"

#include <stdbool.h>

/* Positions in a picture, in pixels from the centre of the first one, times 2^32. All n lie inside the
 * rectangle of the pixels' centres. */
typedef struct iccp_walk {
    int64_t u, v, du, dv;
    size_t n;
} iccp_walk;

/* A line of positions before they are known to lie inside; see iccp_walk_inside(). */
typedef struct iccp_line {
    double u, v, du, dv;
    size_t n;
} iccp_line;

/* What is gathered for one pixel of the target: see iccp_sampler_gather(). */
typedef struct iccp_gathered {
    float sums[4];
    float weight;
    bool owned; /* for the caller: whether the mean shall be written */
} iccp_gathered;

/* Whether all of a line lies inside; if so it becomes a walk. */
bool iccp_walk_inside(iccp_walk *walk, const icc_picture *picture, const iccp_line *line);

/* Position k of a line, clamped to the inside: a walk of one step. */
iccp_walk iccp_walk_clamped(const icc_picture *picture, const iccp_line *line, size_t k);

/* Writes the samples to consecutive pixels, which have the source's format. Positions are rounded to
 * 2^-12 pixels (2^-14 with two bytes); from there on results are exact but for one rounding. */
void iccp_sampler_paint(const icc_picture *source, const iccp_line *line, uint8_t *to);

/* Adds the samples, `weight` each, to pixels[(phase + k) / per_pixel]. */
void iccp_sampler_gather(const icc_picture *source, const iccp_line *line, float weight,
                         size_t phase, size_t per_pixel, iccp_gathered *pixels);

/* Writes the mean of what has been gathered; weight must be positive. */
void iccp_sampler_store(const icc_picture *source, const iccp_gathered *gathered, uint8_t *to);

#endif

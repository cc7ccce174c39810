/* Bilinear samples of pictures along straight lines. */
#ifndef ICCP_SAMPLER_H
#define ICCP_SAMPLER_H

#include "base/simd.h"
#include "icc/icc.h"

/* n positions in a picture, in pixels from the centre of the first one. Beyond the rectangle of the
 * pixels' centres the nearest place on it counts. */
typedef struct iccp_line {
    double u, v, du, dv;
    size_t n;
} iccp_line;

/* What is gathered for one pixel of the target: see iccp_sampler_gather(). */
typedef struct iccp_gathered {
    float sums[4];
    float weight;
} iccp_gathered;

typedef struct iccp_sampler_kernels iccp_sampler_kernels;

typedef struct iccp_sampler {
    const icc_picture *source;
    const iccp_sampler_kernels *kernels; /* for its format, the fastest of this processor */
} iccp_sampler;

void iccp_sampler_init(iccp_sampler *sampler, const icc_picture *source);

/* At a level that the processor has. */
void iccp_sampler_init_as(iccp_simd_level level, iccp_sampler *sampler, const icc_picture *source);

/* Writes the samples to consecutive pixels, which have the source's format. Positions are rounded
 * to 2^-12 pixels (2^-14 with two bytes); from there on results are exact but for one rounding. */
void iccp_sampler_paint(const iccp_sampler *sampler, const iccp_line *line, uint8_t *to);

/* Adds the samples, `weight` each, to pixels[(phase + k) / per_pixel]. */
void iccp_sampler_gather(const iccp_sampler *sampler, const iccp_line *line, float weight,
                         size_t phase, size_t per_pixel, iccp_gathered *pixels);

/* Writes the means of what has been gathered to n pixels; weights must be positive. */
void iccp_sampler_store(const iccp_sampler *sampler, const iccp_gathered *gathered, size_t n,
                        uint8_t *to);

#endif

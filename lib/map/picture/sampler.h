/* Bilinear samples of pictures along straight lines.
 *
 * Words of this folder
 * - source, target: the picture that is read and the picture that is painted.
 * - place: a position in the source, in pixels. The files say from where it is counted.
 * - origin: the source point of a target point, that is its image under the inverse map.
 * - line: equally spaced positions in the source (iccp_line). walk: the same in fixed point.
 * - kernel: code that samples along a walk, compiled for one format and one processor.
 * - blend: to interpolate four pixels (sampler_portable.c; sampler_lanes.h, the same in vectors).
 * - gather: to add samples to pixels, and to store their means later.
 * - run: the samples that a triangle has in one row.
 *
 * Invariants
 * - All kernels give the same bits, whatever the processor.
 * - Every pixel's centre lies in exactly one triangle, so no pixel is painted twice.
 * - Pixels close to the boundary are decided exactly, after the others (boundary_pixels.h).
 *
 * Ways
 * - Colours and a mesh map: triangle by triangle (warp.c, scan.h).
 * - Any other map, or values: pixel by pixel (warp_points.c, picture_values.h).
 * - One sample, by processor: sampler_portable.c, or sampler_sse.c, sampler_avx2.c and
 *   sampler_wasm.c from sampler_lanes.h. sampler.c chooses; sampler_kernels.h says what a kernel
 *   provides.
 *
 * Begin with warp.c for the picture, and with sampler_portable.c for one sample. */
#ifndef ICCP_SAMPLER_H
#define ICCP_SAMPLER_H

#include "base/simd.h"
#include "icc/icc.h"

/* n positions in a picture, in pixels from the centre of the first pixel. A position outside the
 * rectangle of the pixels' centres stands for the nearest place on it. */
typedef struct iccp_line {
    double u, v, du, dv;
    size_t n;
} iccp_line;

/* The sum of the samples of one pixel of the target: see iccp_sampler_gather(). */
typedef struct iccp_gathered {
    float sums[4];
    float weight;
} iccp_gathered;

typedef struct iccp_sampler_kernels iccp_sampler_kernels;

typedef struct iccp_sampler {
    const icc_picture *source;
    const iccp_sampler_kernels *kernels; /* the fastest ones for the picture's format on this
                                            processor */
} iccp_sampler;

void iccp_sampler_init(iccp_sampler *sampler, const icc_picture *source);

/* Chooses kernels of a given level, which the processor must have. WebAssembly's vectors have no
 * level. */
void iccp_sampler_init_as(iccp_simd_level level, iccp_sampler *sampler, const icc_picture *source);

/* Writes the samples to consecutive pixels, which have the source's format. Positions are rounded
 * to 2^-12 pixels, or 2^-14 if samples have two bytes. Apart from that, a result has only one
 * rounding. */
void iccp_sampler_paint(const iccp_sampler *sampler, const iccp_line *line, uint8_t *to);

/* Adds the samples with this weight: sample k to pixels[(phase + k) / per_pixel]. */
void iccp_sampler_gather(const iccp_sampler *sampler, const iccp_line *line, float weight,
                         size_t phase, size_t per_pixel, iccp_gathered *pixels);

/* Writes the means of the gathered samples to n pixels. Their weights must be positive. */
void iccp_sampler_store(const iccp_sampler *sampler, const iccp_gathered *gathered, size_t n,
                        uint8_t *to);

#endif

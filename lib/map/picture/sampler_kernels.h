/* Kernels that sample a picture along a walk: see map/picture/sampler.h. All implementations give
 * the same bits. */
#ifndef ICCP_SAMPLER_KERNELS_H
#define ICCP_SAMPLER_KERNELS_H

#include "map/picture/sampler.h"

#include <stdbool.h>

enum {
    ICCP_NARROW_BITS = 12, /* fraction bits of a position, for samples of one byte */
    ICCP_WIDE_BITS = 14,
    ICCP_NARROW_FLOOR = 8, /* an opacity a has the weight 2^(this) a + 1 */
    ICCP_WIDE_FLOOR = 4
};

/* Positions times 2^32. All n lie inside the rectangle of the pixels' centres. */
typedef struct iccp_walk {
    int64_t u, v, du, dv;
    size_t n;
} iccp_walk;

/* The kernels for one format of pictures. */
struct iccp_sampler_kernels {
    void (*paint)(const icc_picture *source, const iccp_walk *w, uint8_t *to);
    void (*gather)(const icc_picture *source, const iccp_walk *w, float weight, size_t phase,
                   size_t per_pixel, iccp_gathered *pixels);
    void (*store)(const iccp_gathered *gathered, size_t n, uint8_t *to);
};

const iccp_sampler_kernels *iccp_sampler_portable(const icc_picture *p);

/* Kernels for vector instructions. NULL for formats that have none. */
const iccp_sampler_kernels *iccp_sampler_sse(const icc_picture *p);
const iccp_sampler_kernels *iccp_sampler_avx2(const icc_picture *p);
const iccp_sampler_kernels *iccp_sampler_wasm(const icc_picture *p);

#endif

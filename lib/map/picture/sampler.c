/* Converts lines to walks in fixed point. The kernels for the picture's format and this processor
 * then sample along them. */
#include "map/picture/sampler_kernels.h"

static const double ONE = 4294967296.0; /* one pixel in a walk's positions */

/* ---- choice ---- */

void iccp_sampler_init_as(iccp_simd_level level, iccp_sampler *sampler, const icc_picture *source)
{
    const iccp_sampler_kernels *lanes = NULL;
#ifdef ICCP_HAS_SIMD
    if (level >= ICCP_SIMD_AVX2)
        lanes = iccp_sampler_avx2(source);
    else if (level == ICCP_SIMD_SSE42)
        lanes = iccp_sampler_sse(source);
#endif
    (void)level;
    *sampler = (iccp_sampler){source, lanes != NULL ? lanes : iccp_sampler_portable(source)};
}

void iccp_sampler_init(iccp_sampler *sampler, const icc_picture *source)
{
    iccp_sampler_init_as(iccp_simd(), sampler, source);
#ifdef ICCP_HAS_WASM_SIMD
    const iccp_sampler_kernels *lanes = iccp_sampler_wasm(source);
    if (lanes != NULL)
        sampler->kernels = lanes;
#endif
}

/* ---- lines ---- */

/* Makes a walk and checks that it stays inside. It checks the end of the rounded walk, because the
 * rounded steps may end elsewhere than the line. */
static bool walk_inside(iccp_walk *w, const icc_picture *picture, const iccp_line *line)
{
    const double right = picture->width - 1, bottom = picture->height - 1;
    const double steps = (double)(line->n - 1);
    const double u = line->u + steps * line->du, v = line->v + steps * line->dv;
    if (!(line->u >= 0 && line->u <= right && u >= 0 && u <= right && line->v >= 0 &&
          line->v <= bottom && v >= 0 && v <= bottom))
        return false;
    /* With a single sample the step is not used, and it may have any value. */
    const bool moves = line->n > 1;
    *w = (iccp_walk){(int64_t)(line->u * ONE), (int64_t)(line->v * ONE),
                     moves ? (int64_t)(line->du * ONE) : 0, moves ? (int64_t)(line->dv * ONE) : 0,
                     line->n};
    const int64_t n = (int64_t)line->n - 1;
    const int64_t last_u = w->u + n * w->du, last_v = w->v + n * w->dv;
    return last_u >= 0 && last_u <= (int64_t)(right * ONE) && last_v >= 0 &&
           last_v <= (int64_t)(bottom * ONE);
}

/* Clamps a position to n pixels. A NaN counts as 0. */
static int64_t clamped(double x, int32_t n)
{
    const double last = n - 1;
    return !(x > 0) ? 0 : (int64_t)((x < last ? x : last) * ONE);
}

static iccp_walk walk_clamped(const icc_picture *picture, const iccp_line *line, size_t k)
{
    const double u = line->u + (double)k * line->du, v = line->v + (double)k * line->dv;
    return (iccp_walk){clamped(u, picture->width), clamped(v, picture->height), 0, 0, 1};
}

void iccp_sampler_paint(const iccp_sampler *sampler, const iccp_line *line, uint8_t *to)
{
    iccp_walk w;
    const size_t pixel = (size_t)(sampler->source->channels * sampler->source->bytes);
    if (walk_inside(&w, sampler->source, line)) {
        sampler->kernels->paint(sampler->source, &w, to);
        return;
    }
    for (size_t k = 0; k < line->n; ++k) {
        w = walk_clamped(sampler->source, line, k);
        sampler->kernels->paint(sampler->source, &w, to + k * pixel);
    }
}

void iccp_sampler_gather(const iccp_sampler *sampler, const iccp_line *line, float weight,
                         size_t phase, size_t per_pixel, iccp_gathered *pixels)
{
    iccp_walk w;
    if (walk_inside(&w, sampler->source, line)) {
        sampler->kernels->gather(sampler->source, &w, weight, phase, per_pixel, pixels);
        return;
    }
    for (size_t k = 0; k < line->n; ++k) {
        w = walk_clamped(sampler->source, line, k);
        sampler->kernels->gather(sampler->source, &w, weight, (phase + k) % per_pixel, per_pixel,
                                 pixels + (phase + k) / per_pixel);
    }
}

void iccp_sampler_store(const iccp_sampler *sampler, const iccp_gathered *gathered, size_t n,
                        uint8_t *to)
{
    sampler->kernels->store(gathered, n, to);
}

/* Kernels for pictures with WebAssembly's vectors, one pixel at a time: see sampler_lanes.h. */
#include "map/picture/sampler_kernels.h"

#ifdef ICCP_HAS_WASM_SIMD

#define TARGET

#include "map/picture/sampler_lanes.h"

#include <wasm_simd128.h>

TARGET static ICCP_INLINE void line_up(const position *first, const position *step, positions *x)
{
    (void)step;
    *x = *first;
}

TARGET static ICCP_INLINE void blend_rows(const sample s[PIXELS], const lanes *weights, lanes *left,
                                          lanes *right)
{
    const v128_t zero = wasm_i64x2_const(0, 0);
    const v128_t rows = wasm_i64x2_make((int64_t)s->above, (int64_t)s->below);
    const v128_t lefts =
        wasm_i8x16_shuffle(rows, zero, 0, 16, 8, 16, 1, 16, 9, 16, 2, 16, 10, 16, 3, 16, 11, 16);
    const v128_t rights =
        wasm_i8x16_shuffle(rows, zero, 4, 16, 12, 16, 5, 16, 13, 16, 6, 16, 14, 16, 7, 16, 15, 16);
    *left = (lanes)wasm_i32x4_dot_i16x8(lefts, (v128_t)*weights);
    *right = (lanes)wasm_i32x4_dot_i16x8(rights, (v128_t)*weights);
}

/* Vectors of 32 bytes are put together from halves. */
TARGET static ICCP_INLINE void join(v128_t left, v128_t right, void *x)
{
    memcpy(x, &left, 16);
    memcpy((char *)x + 16, &right, 16);
}

TARGET static ICCP_INLINE void part(const void *x, v128_t *left, v128_t *right)
{
    memcpy(left, x, 16);
    memcpy(right, (const char *)x + 16, 16);
}

/* The double 2^52 + x has x as its lower half. */
TARGET static ICCP_INLINE void scale(const lanes *x, const double weights[PIXELS], floats *y)
{
    const v128_t upper = wasm_i32x4_splat(0x43300000), zero = wasm_f64x2_splat(0x1p52);
    const v128_t weight = wasm_f64x2_splat(weights[0]);
    const v128_t low = wasm_i32x4_shuffle((v128_t)*x, upper, 0, 4, 1, 5);
    const v128_t high = wasm_i32x4_shuffle((v128_t)*x, upper, 2, 6, 3, 7);
    reals all;
    join(wasm_f64x2_mul(wasm_f64x2_sub(low, zero), weight),
         wasm_f64x2_mul(wasm_f64x2_sub(high, zero), weight), &all);
    to_floats(&all, y);
}

TARGET static ICCP_INLINE void replace_opacity(lanes *x, const lanes *y)
{
    *x = (lanes)wasm_i32x4_shuffle((v128_t)*x, (v128_t)*y, 0, 1, 2, 7);
}

TARGET static ICCP_INLINE void limit(floats *x)
{
    const v128_t positive = wasm_f32x4_pmax(wasm_f32x4_splat(0), (v128_t)*x);
    *x = (floats)wasm_f32x4_pmin(wasm_f32x4_splat(255), positive);
}

TARGET static ICCP_INLINE void to_reals(const channels4 *x, reals *y)
{
    join(wasm_f64x2_convert_low_i32x4((v128_t)*x),
         wasm_f64x2_convert_low_i32x4(wasm_i32x4_shuffle((v128_t)*x, (v128_t)*x, 2, 3, 2, 3)), y);
}

TARGET static ICCP_INLINE void lanes_to_reals(const lanes *x, reals y[PIXELS])
{
    to_reals(x, y);
}

TARGET static ICCP_INLINE void to_floats(const reals x[PIXELS], floats *y)
{
    v128_t low, high;
    part(x, &low, &high);
    *y = (floats)wasm_i32x4_shuffle(wasm_f32x4_demote_f64x2_zero(low),
                                    wasm_f32x4_demote_f64x2_zero(high), 0, 1, 4, 5);
}

TARGET static ICCP_INLINE void reals_to_lanes(const reals x[PIXELS], lanes *y)
{
    v128_t low, high;
    part(x, &low, &high);
    *y = (lanes)wasm_i32x4_shuffle(wasm_i32x4_trunc_sat_f64x2_zero(low),
                                   wasm_i32x4_trunc_sat_f64x2_zero(high), 0, 1, 4, 5);
}

TARGET static ICCP_INLINE void floats_to_lanes(const floats *x, lanes *y)
{
    *y = (lanes)wasm_i32x4_trunc_sat_f32x4((v128_t)*x);
}

TARGET static ICCP_INLINE void halves(const channels8 *x, channels4 *left, channels4 *right)
{
    part(x, (v128_t *)left, (v128_t *)right);
}

TARGET static ICCP_INLINE void widen(uint64_t pair, channels8 *x)
{
    const v128_t wide = wasm_u16x8_extend_low_u8x16(wasm_i64x2_make((int64_t)pair, 0));
    join(wasm_u32x4_extend_low_u16x8(wide), wasm_u32x4_extend_high_u16x8(wide), x);
}

TARGET static ICCP_INLINE void spread_first(lanes *x)
{
    *x = (lanes)wasm_i32x4_shuffle((v128_t)*x, (v128_t)*x, 0, 0, 0, 0);
}

TARGET static ICCP_INLINE void spread_third(lanes *x)
{
    *x = (lanes)wasm_i16x8_shuffle((v128_t)*x, (v128_t)*x, 4, 4, 4, 4, 4, 4, 4, 4);
}

TARGET static ICCP_INLINE void spread_last(lanes *x)
{
    *x = (lanes)wasm_i32x4_shuffle((v128_t)*x, (v128_t)*x, 3, 3, 3, 3);
}

TARGET static ICCP_INLINE void spread_last8(channels8 *x)
{
    v128_t left, right;
    part(x, &left, &right);
    join(wasm_i32x4_shuffle(left, left, 3, 3, 3, 3), wasm_i32x4_shuffle(right, right, 3, 3, 3, 3),
         x);
}

TARGET static ICCP_INLINE void spread_last_real(reals *x)
{
    *x = (reals){0} + (*x)[3];
}

TARGET static ICCP_INLINE void put(const lanes *x, size_t n, int channels, uint8_t *to)
{
    const v128_t bytes = wasm_i8x16_shuffle((v128_t)*x, (v128_t)*x, 3, 7, 11, 15, 3, 7, 11, 15, 3,
                                            7, 11, 15, 3, 7, 11, 15);
    const int32_t all = wasm_i32x4_extract_lane(bytes, 0);
    (void)n;
    memcpy(to, &all, (size_t)channels);
}

TARGET static ICCP_INLINE void add_sums(const floats *x, size_t k, float sums[4])
{
    (void)k;
    wasm_v128_store(sums, wasm_f32x4_add(wasm_v128_load(sums), (v128_t)*x));
}

TARGET static ICCP_INLINE void take_sums(const iccp_gathered *pixels, size_t n, floats *sums)
{
    (void)n;
    *sums = (floats)wasm_v128_load(pixels->sums);
}

TARGET static ICCP_INLINE void take_weights(const iccp_gathered *pixels, size_t n, floats *weights)
{
    (void)n;
    *weights = (floats)wasm_f32x4_splat(pixels->weight);
}

/* The pictures of pages have opacity. Kernels for others would only make the module larger. */
const iccp_sampler_kernels *iccp_sampler_wasm(const icc_picture *p)
{
    return p->alpha ? kernels_for(p) : NULL;
}

#endif

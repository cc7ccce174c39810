/* Register-blocked products. The sums of a tile stay in registers while two streams of numbers
 * pass. Based on K. Goto, R. van de Geijn, Anatomy of high-performance matrix multiplication, ACM
 * Trans. Math. Software 34, 2008, sections 5 and 6. */
#include "math/dense.h"

#include "base/compiler.h"

#include <string.h>

enum { STRIP = 4 };

/* With a constant width the loops over rows and columns are unrolled and run in vector
 * registers. */
static ICCP_INLINE void multiply_strip(double *tile, size_t width, const double *a, const double *b,
                                       size_t depth)
{
    double sum[ICCP_TILE][STRIP] = {{0}};
    for (size_t k = 0; k < depth; ++k)
        for (size_t c = 0; c < width; ++c)
            for (size_t r = 0; r < STRIP; ++r)
                sum[c][r] += a[STRIP * k + r] * b[width * k + c];
    for (size_t c = 0; c < width; ++c)
        for (size_t r = 0; r < STRIP; ++r)
            tile[STRIP * c + r] = sum[c][r];
}

static void multiply_portable(double *tile, size_t n_strips, size_t width, const double *a,
                              size_t stride, const double *b, size_t depth)
{
    for (size_t t = 0; t < n_strips; ++t, a += stride, tile += ICCP_TILE * STRIP)
        if (width == 6)
            multiply_strip(tile, 6, a, b, depth);
        else if (width == 4)
            multiply_strip(tile, 4, a, b, depth);
        else if (width == 2)
            multiply_strip(tile, 2, a, b, depth);
        else
            multiply_strip(tile, 1, a, b, depth);
}

static void divide_portable(double *strip, size_t n_strips, size_t stride, size_t width,
                            const double *pivot, const double *scaled)
{
    for (size_t t = 0; t < n_strips; ++t, strip += stride)
        for (size_t c = 0; c < width; ++c) {
            double *column = strip + STRIP * c;
            for (size_t k = 0; k < c; ++k)
                for (size_t r = 0; r < STRIP; ++r)
                    column[r] -= strip[STRIP * k + r] * scaled[ICCP_SQUARE * k + c];
            for (size_t r = 0; r < STRIP; ++r)
                column[r] /= pivot[c];
        }
}

static void subtract_portable(double *value, size_t low, size_t stride, const uint32_t *column,
                              size_t width, const double *tile)
{
    for (size_t c = 0; c < width; ++c, tile += STRIP) {
        double *here = value + STRIP * column[c] + low, *next = value + STRIP * column[c] + stride;
        for (size_t r = 0; r < STRIP - low; ++r)
            here[r] -= tile[r];
        for (size_t r = 0; r < low; ++r)
            next[r] -= tile[STRIP - low + r];
    }
}

static void spread_portable(double *x, size_t width, const double *a, const double *y, size_t depth)
{
    const double *const y1 = y + width, *const y2 = y1 + width, *const y3 = y2 + width;
    for (size_t k = 0; k < depth; ++k, a += STRIP, x += width)
        for (size_t s = 0; s < width; ++s)
            x[s] -= (a[0] * y[s] + a[1] * y1[s]) + (a[2] * y2[s] + a[3] * y3[s]);
}

/* ---- four rows at once, in one register of AVX2 or two of WebAssembly ---- */

#if defined(ICCP_HAS_SIMD)
#define TARGET ICCP_AVX2
#elif defined(ICCP_HAS_WASM_SIMD)
#define TARGET
#endif

#ifdef TARGET

typedef double four __attribute__((vector_size(32)));
typedef double two __attribute__((vector_size(16)));

TARGET static ICCP_INLINE void load(const double *from, four *x)
{
    memcpy(x, from, sizeof *x);
}

TARGET static ICCP_INLINE void divide_four(double *to, const double *pivot, four *x)
{
    *x /= *pivot;
    memcpy(to, x, sizeof *x);
}

/* Each column has a variable, because compilers would keep an array of them in memory. */
TARGET static ICCP_INLINE void divide_strip(double *strip, size_t width, const double *pivot,
                                            const double *scaled)
{
    const double *second = scaled + ICCP_SQUARE, *third = second + ICCP_SQUARE;
    double *const to[ICCP_SQUARE] = {strip, strip + STRIP, strip + 2 * STRIP, strip + 3 * STRIP};
    four a, b, c, d;
    load(to[0], &a);
    divide_four(to[0], pivot, &a);
    if (width < 2)
        return;
    load(to[1], &b);
    b -= a * scaled[1];
    divide_four(to[1], pivot + 1, &b);
    if (width < 3)
        return;
    load(to[2], &c);
    c -= a * scaled[2];
    c -= b * second[2];
    divide_four(to[2], pivot + 2, &c);
    if (width < 4)
        return;
    load(to[3], &d);
    d -= a * scaled[3];
    d -= b * second[3];
    d -= c * third[3];
    divide_four(to[3], pivot + 3, &d);
}

TARGET static void divide_fours(double *strip, size_t n_strips, size_t stride, size_t width,
                                const double *pivot, const double *scaled)
{
    for (size_t t = 0; t < n_strips; ++t, strip += stride)
        divide_strip(strip, width, pivot, scaled);
}

TARGET static ICCP_INLINE void subtract_four(double *to, const double *from)
{
    four x, y;
    load(to, &x);
    load(from, &y);
    x -= y;
    memcpy(to, &x, sizeof x);
}

TARGET static ICCP_INLINE void subtract_two(double *to, const double *from)
{
    two x, y;
    memcpy(&x, to, sizeof x);
    memcpy(&y, from, sizeof y);
    x -= y;
    memcpy(to, &x, sizeof x);
}

/* Writes only the intended rows, because other rows may belong to another thread. */
TARGET static void subtract_fours(double *value, size_t low, size_t stride, const uint32_t *column,
                                  size_t width, const double *tile)
{
    for (size_t c = 0; c < width; ++c, tile += STRIP) {
        double *here = value + STRIP * column[c], *next = here + stride;
        if (low == 0) {
            subtract_four(here, tile);
        } else if (low == 1) {
            here[1] -= tile[0];
            subtract_two(here + 2, tile + 1);
            next[0] -= tile[3];
        } else if (low == 2) {
            subtract_two(here + 2, tile);
            subtract_two(next, tile + 2);
        } else {
            here[3] -= tile[0];
            subtract_two(next, tile + 1);
            next[2] -= tile[3];
        }
    }
}

TARGET static void spread_four(double *x, const double *a, const double *y, size_t depth)
{
    four row[STRIP], term[STRIP], sum;
    for (size_t r = 0; r < STRIP; ++r)
        load(y + 4 * r, &row[r]);
    for (size_t k = 0; k < depth; ++k, a += STRIP, x += 4) {
        for (size_t r = 0; r < STRIP; ++r)
            term[r] = a[r] * row[r];
        load(x, &sum);
        sum -= (term[0] + term[1]) + (term[2] + term[3]);
        memcpy(x, &sum, sizeof sum);
    }
}

static void spread_one(double *x, const double *a, const double *y, size_t depth);

TARGET static void spread_fours(double *x, size_t width, const double *a, const double *y,
                                size_t depth)
{
    if (width == 4)
        spread_four(x, a, y, depth);
    else
        spread_one(x, a, y, depth);
}

#endif

#ifdef ICCP_HAS_SIMD

#include <immintrin.h>

ICCP_AVX2 static ICCP_INLINE void multiply_tile(double *tile, size_t n_strips, size_t width,
                                                const double *a, size_t stride, const double *b,
                                                size_t depth)
{
    __m256d sum[2][ICCP_TILE];
    for (size_t t = 0; t < n_strips; ++t)
        for (size_t c = 0; c < width; ++c)
            sum[t][c] = _mm256_setzero_pd();
    for (size_t k = 0; k < depth; ++k) {
        __m256d rows[2];
        for (size_t t = 0; t < n_strips; ++t)
            rows[t] = _mm256_loadu_pd(a + t * stride + STRIP * k);
        for (size_t c = 0; c < width; ++c) {
            const __m256d entry = _mm256_broadcast_sd(b + width * k + c);
            for (size_t t = 0; t < n_strips; ++t)
                sum[t][c] = _mm256_add_pd(sum[t][c], _mm256_mul_pd(rows[t], entry));
        }
    }
    for (size_t t = 0; t < n_strips; ++t)
        for (size_t c = 0; c < width; ++c)
            _mm256_storeu_pd(tile + STRIP * (ICCP_TILE * t + c), sum[t][c]);
}

ICCP_AVX2 static ICCP_INLINE void multiply_width(double *tile, size_t n_strips, size_t width,
                                                 const double *a, size_t stride, const double *b,
                                                 size_t depth)
{
    if (width == 6)
        multiply_tile(tile, n_strips, 6, a, stride, b, depth);
    else if (width == 4)
        multiply_tile(tile, n_strips, 4, a, stride, b, depth);
    else if (width == 2)
        multiply_tile(tile, n_strips, 2, a, stride, b, depth);
    else
        multiply_tile(tile, n_strips, 1, a, stride, b, depth);
}

ICCP_AVX2 static void multiply_avx2(double *tile, size_t n_strips, size_t width, const double *a,
                                    size_t stride, const double *b, size_t depth)
{
    for (; n_strips > 1; n_strips -= 2, a += 2 * stride, tile += 2 * ICCP_TILE * STRIP)
        multiply_width(tile, 2, width, a, stride, b, depth);
    if (n_strips == 1)
        multiply_width(tile, 1, width, a, stride, b, depth);
}

/* Four columns at a time. The products of each column are added within pairs of lanes. */
ICCP_AVX2 static void spread_one(double *x, const double *a, const double *y, size_t depth)
{
    const __m256d rows = _mm256_loadu_pd(y);
    size_t k = 0;
    for (; k + 4 <= depth; k += 4, a += 4 * STRIP) {
        const __m256d p0 = _mm256_mul_pd(_mm256_loadu_pd(a), rows);
        const __m256d p1 = _mm256_mul_pd(_mm256_loadu_pd(a + STRIP), rows);
        const __m256d p2 = _mm256_mul_pd(_mm256_loadu_pd(a + 2 * STRIP), rows);
        const __m256d p3 = _mm256_mul_pd(_mm256_loadu_pd(a + 3 * STRIP), rows);
        const __m256d p01 = _mm256_hadd_pd(p0, p1), p23 = _mm256_hadd_pd(p2, p3);
        const __m256d sum = _mm256_add_pd(_mm256_permute2f128_pd(p01, p23, 0x20),
                                          _mm256_permute2f128_pd(p01, p23, 0x31));
        _mm256_storeu_pd(x + k, _mm256_sub_pd(_mm256_loadu_pd(x + k), sum));
    }
    for (; k < depth; ++k, a += STRIP)
        x[k] -= (a[0] * y[0] + a[1] * y[1]) + (a[2] * y[2] + a[3] * y[3]);
}

#endif

#ifdef ICCP_HAS_WASM_SIMD

#include <wasm_simd128.h>

/* Two columns at a time. */
static void spread_one(double *x, const double *a, const double *y, size_t depth)
{
    const v128_t y01 = wasm_v128_load(y), y23 = wasm_v128_load(y + 2);
    size_t k = 0;
    for (; k + 2 <= depth; k += 2, a += 2 * STRIP) {
        const v128_t p01 = wasm_f64x2_mul(wasm_v128_load(a), y01);
        const v128_t p23 = wasm_f64x2_mul(wasm_v128_load(a + 2), y23);
        const v128_t q01 = wasm_f64x2_mul(wasm_v128_load(a + 4), y01);
        const v128_t q23 = wasm_f64x2_mul(wasm_v128_load(a + 6), y23);
        const v128_t low =
            wasm_f64x2_add(wasm_i64x2_shuffle(p01, q01, 0, 2), wasm_i64x2_shuffle(p01, q01, 1, 3));
        const v128_t high =
            wasm_f64x2_add(wasm_i64x2_shuffle(p23, q23, 0, 2), wasm_i64x2_shuffle(p23, q23, 1, 3));
        wasm_v128_store(x + k, wasm_f64x2_sub(wasm_v128_load(x + k), wasm_f64x2_add(low, high)));
    }
    if (k < depth)
        x[k] -= (a[0] * y[0] + a[1] * y[1]) + (a[2] * y[2] + a[3] * y[3]);
}

#endif

iccp_dense iccp_dense_as(iccp_simd_level level)
{
    iccp_dense dense = {multiply_portable, divide_portable, subtract_portable, spread_portable};
#ifdef ICCP_HAS_SIMD
    if (level >= ICCP_SIMD_AVX2)
        dense = (iccp_dense){multiply_avx2, divide_fours, subtract_fours, spread_fours};
    if (level >= ICCP_SIMD_AVX512)
        dense.multiply = iccp_multiply_avx512;
#endif
#ifdef ICCP_HAS_WASM_SIMD
    dense = (iccp_dense){multiply_portable, divide_fours, subtract_fours, spread_fours};
#endif
    (void)level;
    return dense;
}

iccp_dense iccp_dense_choose(void)
{
    return iccp_dense_as(iccp_simd());
}

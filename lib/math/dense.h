/* Products and quotients of dense strips of rows (math/supernodes.h). They are the inner loops of
 * the factorisation and of solves. */
#ifndef ICCP_DENSE_H
#define ICCP_DENSE_H

#include "base/simd.h"

#include <stddef.h>
#include <stdint.h>

/* Columns of a tile; columns that iccp_divide handles at once; strips that are multiplied at
 * once. */
enum { ICCP_TILE = 6, ICCP_SQUARE = 4, ICCP_STRIPS = 4 };

/* Computes tile[24 t + 4 c + r] = the sum of a[t * stride + 4 k + r] * b[width * k + c] over k <
 * depth, in this order. Here t < n_strips (at most ICCP_STRIPS), c < width (1, 2, 4 or 6) and r <
 * 4. */
typedef void (*iccp_multiply)(double *tile, size_t n_strips, size_t width, const double *a,
                              size_t stride, const double *b, size_t depth);

static inline size_t iccp_strips_at_once(size_t left)
{
    return left < ICCP_STRIPS ? left : ICCP_STRIPS;
}

/* Solves x L' D = strip for x in place. There are `width` columns, at most 4, of n_strips strips.
 * scaled[4 k + c] = d_k L(c, k). */
typedef void (*iccp_divide)(double *strip, size_t n_strips, size_t stride, size_t width,
                            const double *pivot, const double *scaled);

/* Subtracts one strip of a tile from four consecutive rows, in `width` columns at value + 4 *
 * column[c]. The rows begin at row `low` of a strip and continue at the top of the next one, which
 * is `stride` further on. No other rows are written. */
typedef void (*iccp_subtract)(double *value, size_t low, size_t stride, const uint32_t *column,
                              size_t width, const double *tile);

/* Adds to the columns of a system what the rows of a strip contribute: x[width * k + s] -= (p0 +
 * p1) + (p2 + p3), with pr = a[4 k + r] * y[width * r + s], for k < depth and s < width (1 or
 * 4). */
typedef void (*iccp_spread)(double *x, size_t width, const double *a, const double *y,
                            size_t depth);

/* One implementation of these functions. All of them give the same bits, because lanes are rows and
 * no products are fused with sums. */
typedef struct iccp_dense {
    iccp_multiply multiply;
    iccp_divide divide;
    iccp_subtract subtract;
    iccp_spread spread;
} iccp_dense;

/* For processors with AVX-512F (base/simd.h). */
void iccp_multiply_avx512(double *tile, size_t n_strips, size_t width, const double *a,
                          size_t stride, const double *b, size_t depth);

/* Returns the implementation for processors of this level. ICCP_SIMD_NONE works on every
 * machine. */
iccp_dense iccp_dense_as(iccp_simd_level level);

/* Returns the fastest implementation for this machine. */
iccp_dense iccp_dense_choose(void);

#endif

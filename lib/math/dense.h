/* Products of dense strips of rows (math/supernodes.h), the inner loop of the factorisation. */
#ifndef ICCP_DENSE_H
#define ICCP_DENSE_H

#include <stddef.h>

/* Columns of a tile. */
enum { ICCP_TILE = 4 };

/* tile[16 t + 4 c + r] = the sum over k < depth, in this order, of
 * a[t * stride + 4 k + r] * b[width * k + c], for strips t < n_strips (1 or 2), c < width (1, 2 or
 * 4) and r < 4. The same bits from every implementation: lanes are rows, and nothing is
 *    contracted. */
typedef void (*iccp_multiply)(double *tile, size_t n_strips, size_t width, const double *a,
                              size_t stride, const double *b, size_t depth);

void iccp_multiply_portable(double *tile, size_t n_strips, size_t width, const double *a,
                            size_t stride, const double *b, size_t depth);

/* The fastest one on this machine. */
iccp_multiply iccp_multiply_choose(void);

#endif

/* Solids made of the cells of a regular lattice in any dimension, such as the voxels of a picture.
 * Cell (i_0, i_1, ..) covers [i_0, i_0 + 1] x [i_1, i_1 + 1] x ..
 *
 * Every cell is cut in two along each axis. A vertex of the cut lattice is given in halves: an odd
 * coordinate is the middle of a cell, an even one the wall between two. The vertices so stand for
 * the corners, edges, .. and cells of the mask: each is the middle of one of them. */
#ifndef ICCP_MASK_H
#define ICCP_MASK_H

#include "base/env.h"

#include <stdbool.h>

/* Most vertices of the lattice that a mask is cut into, with two layers around it: as for a
 * grid. */
#define ICCP_MAX_LATTICE ((size_t)1 << 28)

typedef struct iccp_mask {
    iccp_memory memory;
    int32_t dim;
    size_t shape[ICC_MAX_DIM];  /* cells along each axis */
    size_t stride[ICC_MAX_DIM]; /* in `cells`, which has one more cell at both ends of each axis */
    size_t n_padded;            /* cells of `cells` */
    uint8_t *cells;             /* 1 in the solid, 0 elsewhere */
} iccp_mask;

/* Copies a mask, the first axis fastest; the shape has no zeros. ICC_ERR_RESOLUTION if its grid
 * would have too many vertices. */
icc_status iccp_mask_create(iccp_mask **out, int32_t dim, const size_t *shape, const uint8_t *cells,
                            const iccp_env *env, icc_error *err);

/* NULL is a no-op. */
void iccp_mask_free(iccp_mask *mask);

/* The coordinates of a cell given by its position in `cells`; its index in the caller's mask. Both
 * mean little for the cells that were added around it. */
int64_t iccp_mask_coordinates(const iccp_mask *mask, size_t cell, int64_t *coordinates);

/* The cells around a vertex of the cut lattice, 0 <= at[k] <= 2 shape[k]: two along each axis where
 * its coordinate is even, one where it is odd. Bit b tells about the cell at the upper end of those
 * of the `n_axes` even axes whose bits are set in b. */
uint64_t iccp_mask_block(const iccp_mask *mask, const size_t *at, int *n_axes);

/* All bits that a block may have. */
static inline uint64_t iccp_mask_full(int n_axes)
{
    return n_axes == ICC_MAX_DIM ? UINT64_MAX : ((uint64_t)1 << (1 << n_axes)) - 1;
}

/* The position in `cells` of one of the cells around a vertex, by its bit in the block. */
size_t iccp_mask_cell(const iccp_mask *mask, const size_t *at, int bit);

/* Goes on to the next vertex of the cut lattice, the first axis fastest; false at the end, when
 * `at` is back at the first one. */
bool iccp_mask_next(const iccp_mask *mask, size_t *at);

#endif

/* Solids made of the cells of a regular lattice in any dimension, such as the voxels of a picture.
 * Cell (i_0, i_1, ..) covers [i_0, i_0 + 1] x [i_1, i_1 + 1] x ..
 *
 * Every cell is cut in two along each axis. Coordinates of the cut lattice count half cells: an odd
 * coordinate is the middle of a cell, an even one the wall between two cells. So each vertex of the
 * cut lattice is the middle of one corner, edge, .. or cell of the mask, and stands for it. */
#ifndef ICCP_MASK_H
#define ICCP_MASK_H

#include "base/env.h"

#include <stdbool.h>

/* Most vertices of the lattice that a mask is cut into, with two layers around it. The limit is
 * that of a grid. */
#define ICCP_MAX_LATTICE ((size_t)1 << 28)

typedef struct iccp_mask {
    iccp_memory memory;
    int32_t dim;
    size_t shape[ICC_MAX_DIM]; /* cells along each axis */
    /* Strides in `cells`, which has one extra cell at both ends of each axis */
    size_t stride[ICC_MAX_DIM];
    size_t n_padded; /* number of cells in `cells` */
    uint8_t *cells;  /* 1 inside the solid, 0 outside */
} iccp_mask;

/* Copies a mask, first axis fastest. The shape has no zeros. Returns ICC_ERR_RESOLUTION if its grid
 * would have too many vertices. */
icc_status iccp_mask_create(iccp_mask **out, int32_t dim, const size_t *shape, const uint8_t *cells,
                            const iccp_env *env, icc_error *err);

/* NULL does nothing. */
void iccp_mask_free(iccp_mask *mask);

/* Writes the coordinates of a cell that is given by its position in `cells`. Returns its index in
 * the caller's mask. Neither is meaningful for the extra cells around the mask. */
int64_t iccp_mask_coordinates(const iccp_mask *mask, size_t cell, int64_t *coordinates);

/* Returns the cells around a vertex of the cut lattice as bits, 0 <= at[k] <= 2 shape[k]. There are
 * two cells along each axis with an even coordinate, and one along each other axis. Bit b is for
 * the cell at the upper end of those of the `n_axes` even axes whose bits are set in b. */
uint64_t iccp_mask_block(const iccp_mask *mask, const size_t *at, int *n_axes);

/* Returns a block with all its bits set. */
static inline uint64_t iccp_mask_full(int n_axes)
{
    return n_axes == ICC_MAX_DIM ? UINT64_MAX : ((uint64_t)1 << (1 << n_axes)) - 1;
}

/* Returns the position in `cells` of the cell around a vertex that a bit of the block stands
 * for. */
size_t iccp_mask_cell(const iccp_mask *mask, const size_t *at, int bit);

/* Advances `at` to the next vertex of the cut lattice, first axis fastest. Returns false at the
 * end, when `at` is back at the first vertex. */
bool iccp_mask_next(const iccp_mask *mask, size_t *at);

#endif

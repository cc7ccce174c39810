/* One grid of the multigrid method: the inside vertices, stored row by row.
 *
 * A row is a line of vertices along axis 0. It is kept as two halves, the vertices with even and
 * those with odd x, so that vertices of one colour are contiguous. Entry k of half h is the vertex
 * x = 2 k + h. Only a window of each row is stored. It holds the row's own vertices and those next
 * to vertices of adjacent rows. Entries outside the shape are stored, too, and stay 0. Coordinates
 * in the bounding box start at 1. Layer 0 and the layer after the last are outside. */
#ifndef ICCP_MG_LEVEL_H
#define ICCP_MG_LEVEL_H

#include "gradient/grid/lattice.h"
#include "gradient/solver/mg_kernel.h"

/* Consecutive inside vertices in a half: entries [begin, end). */
typedef struct iccp_mg_run {
    uint32_t begin, end;
} iccp_mg_run;

typedef struct iccp_mg_row {
    ptrdiff_t base[2]; /* entry k of half h is base[h] + k in the arrays */
    /* Where the runs of each half begin; they end where the next row's begin */
    uint32_t run[2];
    uint32_t first, last; /* first and last x of the window; first > last: empty */
    uint32_t parity;      /* of the sum of the row's coordinates */
} iccp_mg_row;

typedef struct iccp_mg_level {
    int32_t dim;
    uint32_t extent[ICC_MAX_DIM]; /* coordinates of inside vertices are in 1..extent */
    uint32_t corner[ICC_MAX_DIM]; /* on the finest level: the grid's coordinates of layer 1 */
    size_t stride[ICC_MAX_DIM];   /* in rows, for axes 1 and up; 0 for axis 0 */
    size_t n_rows, n_slabs;       /* a slab: the rows with the same last coordinate */
    size_t n_entries, n_inside;
    iccp_mg_row *row; /* n_rows + 1; the last one only ends the runs */
    iccp_mg_run *run;
    uint8_t *inside; /* n_entries; exists only while levels are made */
    /* 2 n_rows: first and last x of a vertex inside here or, on a coarse level, next to one on the
     * finer level; exists only while levels are made */
    uint32_t *range;
    float *inverse; /* n_entries: 1 / diagonal; NULL on the finest level, where it is 1 / (2
                        dim) */
    float *x, *b;   /* n_entries each */
    const iccp_mg_kernels *kernels;
} iccp_mg_level;

/* Makes the finest level from a list of vertices, each at most once. `position` receives where each
 * is stored, and may be the list itself. */
icc_status iccp_mg_level_fine(iccp_mg_level *level, const icc_grid *grid, size_t n,
                              const uint32_t *vertex, uint32_t *position, const iccp_env *env);

/* Makes a level of every other vertex of `fine`. Distances to the outside are measured on `finest`,
 * which is 2^depth times as fine as the new one. If no vertex is inside, nothing is allocated. */
icc_status iccp_mg_level_coarse(iccp_mg_level *level, const iccp_mg_level *fine,
                                const iccp_mg_level *finest, int32_t depth, const iccp_env *env);

/* Steps of making a level, for mg_level.c and mg_coarse.c. They make the rows of a box with empty
 * ranges, then windows from the ranges, then runs from the inside vertices. */
icc_status iccp_mg_make_rows(iccp_mg_level *level, const iccp_memory *memory);
icc_status iccp_mg_make_windows(iccp_mg_level *level, const iccp_memory *memory);
icc_status iccp_mg_make_runs(iccp_mg_level *level, const iccp_memory *memory);

static inline void iccp_mg_widen(uint32_t *range, uint32_t first, uint32_t last)
{
    if (first < range[0])
        range[0] = first;
    if (last > range[1])
        range[1] = last;
}

void iccp_mg_level_drop_scaffold(iccp_mg_level *level, const iccp_memory *memory);
void iccp_mg_level_free(iccp_mg_level *level, const iccp_memory *memory);

/* Returns where a vertex is stored. */
static inline size_t iccp_mg_position(const iccp_mg_level *level, size_t row, uint32_t x)
{
    return (size_t)(level->row[row].base[x & 1] + (ptrdiff_t)(x >> 1));
}

static inline const iccp_mg_run *iccp_mg_runs(const iccp_mg_level *level, size_t row, int half,
                                              const iccp_mg_run **end)
{
    const iccp_mg_row *r = level->row + row;
    *end = level->run + (half ? r[1].run[0] : r->run[1]);
    return level->run + r->run[half];
}

/* Returns where entry k of a half is stored, and where its neighbours are. Neighbours along axis 0
 * are in the other half. */
static inline size_t iccp_mg_near(const iccp_mg_level *level, size_t row, int half, uint32_t k,
                                  size_t near[2 * ICC_MAX_DIM])
{
    const iccp_mg_row *r = level->row + row;
    const ptrdiff_t other = r->base[1 - half] + (ptrdiff_t)k;
    near[0] = (size_t)(other - (half == 0));
    near[1] = (size_t)(other + (half == 1));
    for (int32_t a = 1; a < level->dim; ++a) {
        near[2 * a] = (size_t)(r[-(ptrdiff_t)level->stride[a]].base[half] + (ptrdiff_t)k);
        near[2 * a + 1] = (size_t)(r[level->stride[a]].base[half] + (ptrdiff_t)k);
    }
    return (size_t)(r->base[half] + (ptrdiff_t)k);
}

/* Like iccp_mg_near(), with pointers into an array of floats. */
static inline size_t iccp_mg_near_in(const iccp_mg_level *level, size_t row, int half, uint32_t k,
                                     const float *x, const float *near[2 * ICC_MAX_DIM])
{
    size_t offset[2 * ICC_MAX_DIM];
    const size_t at = iccp_mg_near(level, row, half, k, offset);
    for (int32_t j = 0; j < 2 * level->dim; ++j)
        near[j] = x + offset[j];
    return at;
}

#endif

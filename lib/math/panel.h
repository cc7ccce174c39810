/* A panel of a sparse factor: dense rows in strips, see math/supernodes.h. Entry (i, k), row i and
 * column k counted within the panel, is at value[iccp_panel_row(panel, i) + ICCP_STRIP * k]. */
#ifndef ICCP_PANEL_H
#define ICCP_PANEL_H

#include "base/threads.h"
#include "math/dense.h"
#include "math/supernodes.h"

#include <stdbool.h>

typedef struct iccp_panel {
    size_t columns, rows;
    double *value; /* `rows`, padded to strips, times `columns` */
    double *pivot; /* of its columns */
} iccp_panel;

static inline size_t iccp_panel_row(const iccp_panel *panel, size_t i)
{
    return (i - i % ICCP_STRIP) * panel->columns + i % ICCP_STRIP;
}

/* The panel of supernode s of a factor with these values and pivots. */
static inline iccp_panel iccp_panel_of(const iccp_supernodes *nodes, size_t s, double *value,
                                       double *pivot)
{
    const size_t columns = iccp_supernodes_columns(nodes, s);
    return (iccp_panel){columns, columns + iccp_supernodes_below(nodes, s),
                        value + nodes->first_value[s], pivot + nodes->column[s]};
}

/* Columns of one block of a panel, and columns that another panel updates at once. */
enum { ICCP_BLOCK = 32, ICCP_AT_ONCE = 6 * ICCP_TILE };

/* How far a factorisation is, in multiplications. */
typedef struct iccp_labour {
    const iccp_env *env;
    iccp_env quiet; /* the same without progress, for the loops inside */
    double done, reported, all;
} iccp_labour;

/* Adds to what is done, and reports it now and then. */
icc_status iccp_labour_add(iccp_labour *labour, double multiplications);

/* Runs chunk() over the strips [begin, end) of a product, `cost` multiplications each, on all
 * threads where that pays. Strips are written independently: the bits do not depend on the
 * threads. */
icc_status iccp_labour_strips(iccp_labour *labour, size_t begin, size_t end, double cost,
                              iccp_chunk chunk, void *argument);

/* packed = rows [begin, end) of columns [first, last) of L D, for iccp_multiply: by groups of
 * ICCP_TILE rows, the last of them as narrow as it may be. At most ICCP_AT_ONCE rows. */
void iccp_panel_pack(double *packed, const iccp_panel *panel, size_t begin, size_t end,
                     size_t first, size_t last);

/* The width of the group that begins `left` rows before the end. */
static inline size_t iccp_panel_width(size_t left)
{
    return left > 4 ? ICCP_TILE : left > 2 ? 4 : left;
}

/* Factorises a panel that has got the updates of all other panels: L D L^T of its square, and its
 * other rows divided by it. sign: of each pivot, or NULL when all are positive. packed: room for
 * ICCP_AT_ONCE times the columns. ICC_ERR_SOLVER when a pivot has not its sign. */
icc_status iccp_panel_factorise(const iccp_panel *panel, const int8_t *sign,
                                const iccp_dense *dense, double *packed, iccp_labour *labour);

#endif

/* A panel of a sparse factor: dense rows in strips (math/supernodes.h). Entry (i, k), with row and
 * column counted within the panel, is value[iccp_panel_row(panel, i) + ICCP_STRIP * k]. */
#ifndef ICCP_PANEL_H
#define ICCP_PANEL_H

#include "base/threads.h"
#include "math/dense.h"
#include "math/supernodes.h"

#include <stdbool.h>

typedef struct iccp_panel {
    size_t columns, rows;
    double *value; /* `rows`, rounded up to whole strips, times `columns` */
    double *pivot; /* pivots of its columns */
} iccp_panel;

static inline size_t iccp_panel_row(const iccp_panel *panel, size_t i)
{
    return (i - i % ICCP_STRIP) * panel->columns + i % ICCP_STRIP;
}

/* Returns the panel of supernode s in a factor with these values and pivots. */
static inline iccp_panel iccp_panel_of(const iccp_supernodes *nodes, size_t s, double *value,
                                       double *pivot)
{
    const size_t columns = iccp_supernodes_columns(nodes, s);
    return (iccp_panel){columns, columns + iccp_supernodes_below(nodes, s),
                        value + nodes->first_value[s], pivot + nodes->column[s]};
}

/* Columns of one block of a panel, and columns that another panel updates at once. */
enum { ICCP_BLOCK = 32, ICCP_AT_ONCE = 6 * ICCP_TILE };

/* Progress of a factorisation, in multiplications. */
typedef struct iccp_labour {
    const iccp_env *env;
    iccp_env quiet; /* the environment without progress, for the inner loops */
    double done, reported, all;
} iccp_labour;

/* Adds finished multiplications, and reports progress from time to time. */
icc_status iccp_labour_add(iccp_labour *labour, double multiplications);

/* Runs chunk() over the strips [begin, end) of a product, with `cost` multiplications each. Uses
 * all threads if that pays. Strips are written independently, so the bits do not depend on the
 * threads. */
icc_status iccp_labour_strips(iccp_labour *labour, size_t begin, size_t end, double cost,
                              iccp_chunk chunk, void *argument);

/* Writes rows [begin, end) of columns [first, last) of L D to `packed`, in the layout of
 * iccp_multiply. Groups have ICCP_TILE rows, and the last group is as narrow as possible. There are
 * at most ICCP_AT_ONCE rows. */
void iccp_panel_pack(double *packed, const iccp_panel *panel, size_t begin, size_t end,
                     size_t first, size_t last);

/* Returns the width of the group that begins `left` rows before the end. */
static inline size_t iccp_panel_width(size_t left)
{
    return left > 4 ? ICCP_TILE : left > 2 ? 4 : left;
}

/* Factorises a panel that has received the updates of all other panels. Computes L D L^T of its
 * square and divides its other rows by it. `sign` has the sign of each pivot, or is NULL if all are
 * positive. `packed` has room for ICCP_AT_ONCE times the columns. Returns ICC_ERR_SOLVER if a pivot
 * has the wrong sign. */
icc_status iccp_panel_factorise(const iccp_panel *panel, const int8_t *sign,
                                const iccp_dense *dense, double *packed, iccp_labour *labour);

#endif

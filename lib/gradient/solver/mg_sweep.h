/* The V-cycle's operations on one slab of a level. Red vertices are those whose coordinates have an
 * even sum. They include all vertices that are also on the coarse level. */
#ifndef ICCP_MG_SWEEP_H
#define ICCP_MG_SWEEP_H

#include "gradient/solver/mg_level.h"

enum { ICCP_RED = 0, ICCP_BLACK = 1 };

/* Workspace for assembling rows, 4 longer than the longest row. `constant` is filled with 1 /
 * diagonal of the finest level. */
typedef struct iccp_mg_scratch {
    float *even, *odd, *line, *constant;
} iccp_mg_scratch;

/* x = b / diagonal for red. */
void iccp_mg_start(const iccp_mg_level *level, const iccp_mg_scratch *scratch, size_t slab);

/* Gauss-Seidel for one colour: x = (b + sum of the neighbours) / diagonal. */
void iccp_mg_relax(const iccp_mg_level *level, const iccp_mg_scratch *scratch, size_t slab,
                   int colour);

/* x = residual for red, after iccp_mg_start() for red and iccp_mg_relax() for black. */
void iccp_mg_residual(const iccp_mg_level *level, size_t slab);

/* Computes b of a slab of the coarse level from the residuals that iccp_mg_residual() left in the
 * three adjacent slabs of the fine level. */
void iccp_mg_restrict(const iccp_mg_level *coarse, const iccp_mg_level *fine,
                      const iccp_mg_scratch *scratch, size_t slab);

/* For red: x becomes the result of iccp_mg_start() plus the coarse correction. */
void iccp_mg_prolong(const iccp_mg_level *fine, const iccp_mg_level *coarse,
                     const iccp_mg_scratch *scratch, size_t slab);

#endif

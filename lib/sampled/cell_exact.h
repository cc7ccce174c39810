/* The Bernstein coefficients of a cell's determinant by exact sums (math/expansion.h). */
#ifndef ICCP_CELL_EXACT_H
#define ICCP_CELL_EXACT_H

#include "base/env.h"
#include "sampled/cell.h"

/* Room for exact sums. Of one length are an edge's component (3), the product of two (18), the
 * difference of two products (36), a product of three (216) and a determinant (648). A coefficient
 * has at most 8 determinants. */
typedef struct iccp_cell_work iccp_cell_work;

iccp_cell_work *iccp_cell_work_create(const iccp_memory *memory);

/* Computes all coefficients to a few units in the last place, with exact signs. Returns false if
 * numbers are so large or small that products would lose bits. */
bool iccp_cell_bound_exactly(iccp_cell_bounds *out, const iccp_cell *cell, iccp_cell_work *work);

#endif

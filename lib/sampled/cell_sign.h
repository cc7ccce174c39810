/* The sign of the Jacobian determinant in a cell. */
#ifndef ICCP_CELL_SIGN_H
#define ICCP_CELL_SIGN_H

#include "sampled/cell_exact.h"

/* Returns 0 if the determinant is positive everywhere in the cell, else ICC_CELL_FOLDED or
 * ICC_CELL_UNDECIDED. Lowers `least` to the determinants at the corners. `work` is made when it is
 * first needed; the caller frees it. Sets `failed` if there is no memory. */
int32_t iccp_cell_sign(const iccp_cell *cell, double *least, iccp_cell_work **work,
                       const iccp_memory *memory, bool *failed);

#endif

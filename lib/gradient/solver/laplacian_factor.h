/* The factorised Laplacian of all unknowns, including the root's. */
#ifndef ICCP_LAPLACIAN_FACTOR_H
#define ICCP_LAPLACIAN_FACTOR_H

#include "gradient/solver/solution.h"
#include "gradient/solver/unknowns.h"
#include "icc/stages.h"
#include "math/ldlt.h"

typedef struct iccp_laplacian_factor {
    iccp_memory memory;
    iccp_symmetric matrix; /* borrows the next four arrays */
    size_t *first;
    uint32_t *column;
    double *value, *diagonal;
    iccp_ldlt factor;
} iccp_laplacian_factor;

/* Eliminates in the order of nested dissection. Adds to `info` (work, seconds_*). On failure
 * nothing stays allocated. */
icc_status iccp_laplacian_factorise(iccp_laplacian_factor *l, const iccp_unknowns *unknowns,
                                    iccp_solution *info, const iccp_env *env);

/* Accepts a factor that was freed, or that has only its memories. */
void iccp_laplacian_factor_free(iccp_laplacian_factor *l);

#endif

/* Sparse LDL^T factorisation of a symmetric positive definite matrix. */
#ifndef ICCP_LDLT_H
#define ICCP_LDLT_H

#include "base/env.h"
#include "math/scaled.h"
#include "math/symmetric.h"

typedef struct iccp_ldlt {
    iccp_memory memory;
    size_t n;
    uint32_t *order;    /* the row that is eliminated k-th */
    uint32_t *position; /* when a row is eliminated */
    uint32_t *parent;   /* in the elimination tree, eliminated numbering */
    size_t *first;      /* n + 1: where the columns of L begin */
    uint32_t *row;      /* rows below the diagonal, in eliminated numbering */
    double *value;
    double *pivot;      /* D */
} iccp_ldlt;

/* Orders and analyses a matrix by its pattern alone, and makes room for the factor. Rows come in groups
 * of `block` with the same pattern; the groups are ordered. Accepts what was never analysed or freed. */
icc_status iccp_ldlt_analyse(iccp_ldlt *factor, const iccp_symmetric *matrix, size_t block,
                             const iccp_env *env);

/* Factorises a matrix with the analysed pattern. ICC_ERR_SOLVER when a pivot is not positive: the
 * matrix is not positive definite to working precision. Cost: proportional to the sum of the squared
 * column counts of L. */
icc_status iccp_ldlt_factorise(iccp_ldlt *factor, const iccp_symmetric *matrix,
                               const iccp_env *env);
void iccp_ldlt_free(iccp_ldlt *factor);

/* Solves for n_rhs right sides at once: entry i of side r at b[i * n_rhs + r], replaced by the
 * solution. `work` has room for n * n_rhs doubles. */
void iccp_ldlt_solve(const iccp_ldlt *factor, size_t n_rhs, double *b, double *work);

/* The same for one right side of normalised numbers, without under- or overflow. `work` has room for
 * n of them. The solution of an M-matrix with a right side that is not negative is right to the last
 * few digits in every component, since nothing cancels. */
void iccp_ldlt_solve_scaled(const iccp_ldlt *factor, const iccp_scaled *b, const iccp_scaled *work);

#endif

/* Weighted Gram matrices B'WB of a sparse matrix: the normal equations of least squares. */
#ifndef ICCP_GRAM_H
#define ICCP_GRAM_H

#include "base/env.h"
#include "math/symmetric.h"

/* A sparse matrix, stored row by row. A row contains no column twice. */
typedef struct iccp_sparse {
    iccp_memory memory;
    size_t n_rows, n_columns;
    size_t *first;    /* n_rows + 1: where the rows begin in the two arrays below */
    uint32_t *column; /* of each entry */
    double *value;
} iccp_sparse;

typedef struct iccp_gram {
    iccp_memory memory;
    iccp_symmetric matrix; /* borrows the next four arrays */
    size_t *first;         /* n_columns + 1: as in iccp_symmetric */
    uint32_t *column;      /* column of each off-diagonal entry */
    double *value;         /* its value */
    double *diagonal;      /* n_columns values */
    size_t *row_first;     /* n_columns + 1: where each column of B begins in `row` */
    uint32_t *row;         /* row of B of each entry, column by column */
    double *row_value;
    double *sum; /* n_columns: the row of the Gram matrix that is being computed */
} iccp_gram;

/* Allocates a matrix. The caller then writes `first`, `column` and `value`. Columns < 2^32 - 1. */
icc_status iccp_sparse_create(iccp_sparse *b, size_t n_rows, size_t n_columns, size_t n_entries,
                              const iccp_env *env);
void iccp_sparse_free(iccp_sparse *b);

/* out = B x - minus. NULL for `minus` is 0, and `out` may be `minus`. */
void iccp_sparse_apply(const iccp_sparse *b, const double *x, const double *minus, double *out);

/* out += B' y */
void iccp_sparse_apply_transpose(const iccp_sparse *b, const double *y, double *out);

/* Finds the pattern, which does not depend on the weights. Leaves the values unset. O(sum of
 * squared row lengths). */
icc_status iccp_gram_create(iccp_gram *gram, const iccp_sparse *b, const iccp_env *env);
void iccp_gram_free(iccp_gram *gram);

/* Computes the values for one weight per row of B. NULL: all weights are 1. */
void iccp_gram_fill(iccp_gram *gram, const iccp_sparse *b, const double *weight);

#endif

/* Weighted Gram matrices B'WB of a sparse matrix: the normal equations of least squares. */
#ifndef ICCP_GRAM_H
#define ICCP_GRAM_H

#include "base/env.h"
#include "math/symmetric.h"

/* A sparse matrix, row by row; no column twice in a row. */
typedef struct iccp_sparse {
    iccp_memory memory;
    size_t n_rows, n_columns;
    size_t *first;    /* n_rows + 1: where the rows begin in the two arrays below */
    uint32_t *column; /* of each entry */
    double *value;
} iccp_sparse;

typedef struct iccp_gram {
    iccp_memory memory;
    iccp_symmetric matrix; /* borrows the four arrays below */
    size_t *first;         /* n_columns + 1: as in iccp_symmetric, */
    uint32_t *column;      /* by entry off the diagonal, */
    double *value;         /* by the same, */
    double *diagonal;      /* and n_columns */
    size_t *row_first;     /* n_columns + 1, B by columns: where the entries of each begin */
    uint32_t *row;         /* of each of these entries: its row of B */
    double *row_value;
    double *sum; /* n_columns: a row of the Gram matrix in the making */
} iccp_gram;

/* Room for a matrix; `first`, `column` and `value` are for the caller to write. Columns < 2^32
 * - 1. */
icc_status iccp_sparse_create(iccp_sparse *b, size_t n_rows, size_t n_columns, size_t n_entries,
                              const iccp_env *env);
void iccp_sparse_free(iccp_sparse *b);

/* out = B x - minus, where NULL is 0; out may be `minus`. */
void iccp_sparse_apply(const iccp_sparse *b, const double *x, const double *minus, double *out);

/* out += B' y */
void iccp_sparse_apply_transpose(const iccp_sparse *b, const double *y, double *out);

/* Finds the pattern, which the weights do not change. The values are left unset. O(sum of squared
 * row lengths). */
icc_status iccp_gram_create(iccp_gram *gram, const iccp_sparse *b, const iccp_env *env);
void iccp_gram_free(iccp_gram *gram);

/* Computes the values for one weight per row of B; NULL: all 1. */
void iccp_gram_fill(iccp_gram *gram, const iccp_sparse *b, const double *weight);

#endif

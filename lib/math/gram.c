/* Weighted Gram matrices, computed row by row. Source: F. Gustavson, Two fast algorithms for sparse
 * matrices: multiplication and permuted transposition, ACM Trans. Math. Software 4, 1978. */
#include "math/gram.h"

#include <stdbool.h>

#define NONE UINT32_MAX

/* Columns between two calls of the progress callback. */
enum { COLUMNS_PER_REPORT = 1 << 16 };

icc_status iccp_sparse_create(iccp_sparse *b, size_t n_rows, size_t n_columns, size_t n_entries,
                              const iccp_env *env)
{
    *b = (iccp_sparse){.memory = env->memory, .n_rows = n_rows, .n_columns = n_columns};
    b->first = iccp_alloc(&b->memory, n_rows + 1, sizeof *b->first);
    b->column = iccp_alloc(&b->memory, n_entries, sizeof *b->column);
    b->value = iccp_alloc(&b->memory, n_entries, sizeof *b->value);
    if (b->first != NULL && b->column != NULL && b->value != NULL)
        return ICC_OK;
    iccp_sparse_free(b);
    return ICC_ERR_MEMORY;
}

void iccp_sparse_free(iccp_sparse *b)
{
    iccp_free(&b->memory, b->first);
    iccp_free(&b->memory, b->column);
    iccp_free(&b->memory, b->value);
    b->first = NULL;
    b->column = NULL;
    b->value = NULL;
}

void iccp_sparse_apply(const iccp_sparse *b, const double *x, const double *minus, double *out)
{
    for (size_t i = 0; i < b->n_rows; ++i) {
        double sum = minus != NULL ? -minus[i] : 0.0;
        for (size_t p = b->first[i]; p < b->first[i + 1]; ++p)
            sum += b->value[p] * x[b->column[p]];
        out[i] = sum;
    }
}

void iccp_sparse_apply_transpose(const iccp_sparse *b, const double *y, double *out)
{
    for (size_t i = 0; i < b->n_rows; ++i)
        for (size_t p = b->first[i]; p < b->first[i + 1]; ++p)
            out[b->column[p]] += b->value[p] * y[i];
}

static void transpose(iccp_gram *g, const iccp_sparse *b)
{
    const size_t n = b->n_columns;
    for (size_t j = 0; j <= n; ++j)
        g->row_first[j] = 0;
    for (size_t p = 0; p < b->first[b->n_rows]; ++p)
        ++g->row_first[b->column[p] + 1];
    for (size_t j = 0; j < n; ++j)
        g->row_first[j + 1] += g->row_first[j];
    /* Filling moves the beginning of each column to its end, where the next column begins. */
    for (size_t i = 0; i < b->n_rows; ++i)
        for (size_t p = b->first[i]; p < b->first[i + 1]; ++p) {
            const size_t q = g->row_first[b->column[p]]++;
            g->row[q] = (uint32_t)i;
            g->row_value[q] = b->value[p];
        }
    for (size_t j = n; j > 0; --j)
        g->row_first[j] = g->row_first[j - 1];
    g->row_first[0] = 0;
}

/* Writes the pattern of row j to `column` and returns its length. */
static size_t find_row(const iccp_gram *g, const iccp_sparse *b, uint32_t j, uint32_t *mark,
                       uint32_t *column)
{
    size_t length = 0;
    mark[j] = j;
    for (size_t q = g->row_first[j]; q < g->row_first[j + 1]; ++q)
        for (size_t p = b->first[g->row[q]]; p < b->first[g->row[q] + 1]; ++p) {
            const uint32_t k = b->column[p];
            if (mark[k] == j)
                continue;
            mark[k] = j;
            column[length++] = k;
        }
    return length;
}

/* Makes room for row j, whatever its pattern is. At first there is none. */
static icc_status make_room(iccp_gram *g, const iccp_sparse *b, uint32_t j, size_t *room)
{
    size_t most = 0;
    for (size_t q = g->row_first[j]; q < g->row_first[j + 1]; ++q)
        most += b->first[g->row[q] + 1] - b->first[g->row[q]];
    most = g->first[j] + (most < b->n_columns ? most : b->n_columns);
    if (g->column != NULL && most <= *room)
        return ICC_OK;
    *room = most + most / 2 + b->first[b->n_rows];
    return iccp_enlarge(&g->memory, &g->column, g->first[j], *room, sizeof *g->column)
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

static icc_status find_rows(iccp_gram *g, const iccp_sparse *b, uint32_t *mark, const iccp_env *env)
{
    const size_t n = b->n_columns;
    icc_status status = ICC_OK;
    size_t room = 0;
    for (uint32_t j = 0; j < n; ++j)
        mark[j] = NONE;
    g->first[0] = 0;
    for (uint32_t j = 0; j < n && status == ICC_OK; ++j) {
        if (j % COLUMNS_PER_REPORT == 0)
            status = iccp_progress(env, "solve", (double)j / (double)n);
        if (status == ICC_OK)
            status = make_room(g, b, j, &room);
        if (status == ICC_OK)
            g->first[j + 1] = g->first[j] + find_row(g, b, j, mark, g->column + g->first[j]);
    }
    return status;
}

icc_status iccp_gram_create(iccp_gram *gram, const iccp_sparse *b, const iccp_env *env)
{
    const size_t n = b->n_columns, n_entries = b->first[b->n_rows];
    *gram = (iccp_gram){.memory = env->memory};
    gram->first = iccp_alloc(&env->memory, n + 1, sizeof *gram->first);
    gram->diagonal = iccp_alloc(&env->memory, n, sizeof *gram->diagonal);
    gram->sum = iccp_alloc_zero(&env->memory, n, sizeof *gram->sum);
    gram->row_first = iccp_alloc(&env->memory, n + 1, sizeof *gram->row_first);
    gram->row = iccp_alloc(&env->memory, n_entries, sizeof *gram->row);
    gram->row_value = iccp_alloc(&env->memory, n_entries, sizeof *gram->row_value);
    uint32_t *mark = iccp_alloc(&env->memory, n, sizeof *mark);
    icc_status status = ICC_ERR_MEMORY;
    if (gram->first != NULL && gram->diagonal != NULL && gram->sum != NULL &&
        gram->row_first != NULL && gram->row != NULL && gram->row_value != NULL && mark != NULL) {
        transpose(gram, b);
        status = find_rows(gram, b, mark, env);
    }
    if (status == ICC_OK) {
        gram->value = iccp_alloc(&env->memory, gram->first[n], sizeof *gram->value);
        status = gram->value != NULL ? ICC_OK : ICC_ERR_MEMORY;
    }
    iccp_free(&env->memory, mark);
    if (status != ICC_OK)
        iccp_gram_free(gram);
    else
        gram->matrix = (iccp_symmetric){n, gram->first, gram->column, gram->value, gram->diagonal};
    return status;
}

void iccp_gram_free(iccp_gram *gram)
{
    iccp_free(&gram->memory, gram->first);
    iccp_free(&gram->memory, gram->column);
    iccp_free(&gram->memory, gram->value);
    iccp_free(&gram->memory, gram->diagonal);
    iccp_free(&gram->memory, gram->row_first);
    iccp_free(&gram->memory, gram->row);
    iccp_free(&gram->memory, gram->row_value);
    iccp_free(&gram->memory, gram->sum);
    *gram = (iccp_gram){.memory = gram->memory};
}

void iccp_gram_fill(iccp_gram *gram, const iccp_sparse *b, const double *weight)
{
    double *sum = gram->sum; /* zero between rows */
    for (size_t j = 0; j < b->n_columns; ++j) {
        for (size_t q = gram->row_first[j]; q < gram->row_first[j + 1]; ++q) {
            const size_t i = gram->row[q];
            const double scale = gram->row_value[q] * (weight != NULL ? weight[i] : 1.0);
            for (size_t p = b->first[i]; p < b->first[i + 1]; ++p)
                sum[b->column[p]] += scale * b->value[p];
        }
        gram->diagonal[j] = sum[j];
        sum[j] = 0;
        for (size_t p = gram->first[j]; p < gram->first[j + 1]; ++p) {
            gram->value[p] = sum[gram->column[p]];
            sum[gram->column[p]] = 0;
        }
    }
}

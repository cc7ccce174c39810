/* Up-looking factorisation, row by row of L, after T. Davis, Direct Methods for Sparse Linear
 * Systems, 2006, sections 4.1-4.3 and 4.7: elimination tree, row patterns by walks in it, sparse
 * triangular solves. */
#include "math/ldlt.h"

#include "math/ordering.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#define NONE UINT32_MAX

/* Rows between looks at the progress callback. */
enum { ROWS_PER_REPORT = 1024 };

/* Work space of one pass over the rows. */
typedef struct elimination {
    const iccp_symmetric *matrix;
    uint32_t *mark;    /* last row whose pattern contains the column */
    uint32_t *pattern; /* of the current row, from its end */
    double *y;         /* the current row, dense */
    size_t *used;      /* entries of each column so far */
} elimination;

/* The pattern of row k of L: what is reached from the entries of row k of the matrix by going up the
 * elimination tree. Written to pattern[top..n) with descendants before ancestors; returns top. */
static size_t row_pattern(const iccp_ldlt *l, elimination *e, uint32_t k, bool build_tree)
{
    const iccp_symmetric *m = e->matrix;
    const uint32_t row = l->order[k];
    size_t top = l->n;
    e->mark[k] = k;
    for (size_t p = m->first[row]; p < m->first[row + 1]; ++p) {
        size_t length = 0;
        for (uint32_t i = l->position[m->column[p]]; i < k && e->mark[i] != k; i = l->parent[i]) {
            if (build_tree && l->parent[i] == NONE)
                l->parent[i] = k;
            e->pattern[length++] = i;
            e->mark[i] = k;
        }
        while (length > 0)
            e->pattern[--top] = e->pattern[--length];
    }
    return top;
}

/* The groups of rows as a matrix of their own, without values: entries in the first row of each. */
static icc_status order_groups(iccp_ldlt *l, const iccp_symmetric *m, size_t block,
                               const iccp_env *env)
{
    const size_t n = m->n / block;
    size_t *first = iccp_alloc(&env->memory, n + 1, sizeof *first);
    uint32_t *column = iccp_alloc(&env->memory, m->first[m->n], sizeof *column);
    icc_status status = first != NULL && column != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        size_t n_entries = 0;
        for (size_t i = 0; i < n; ++i) {
            first[i] = n_entries;
            for (size_t p = m->first[block * i]; p < m->first[block * i + 1]; ++p)
                if (m->column[p] % block == 0)
                    column[n_entries++] = (uint32_t)(m->column[p] / block);
        }
        first[n] = n_entries;
        const iccp_symmetric groups = {n, first, column, NULL, NULL};
        status = iccp_ordering(&groups, l->order, env);
    }
    for (size_t k = n; status == ICC_OK && k-- > 0;)
        for (size_t d = block; d-- > 0;)
            l->order[block * k + d] = (uint32_t)(block * l->order[k] + d);
    iccp_free(&env->memory, first);
    iccp_free(&env->memory, column);
    return status;
}

/* Builds the elimination tree and counts the entries of each column of L. */
static icc_status count_entries(iccp_ldlt *l, elimination *e)
{
    size_t *count = l->first;
    memset(count, 0, (l->n + 1) * sizeof *count);
    for (size_t k = 0; k < l->n; ++k)
        l->parent[k] = e->mark[k] = NONE;
    for (uint32_t k = 0; k < l->n; ++k)
        for (size_t p = row_pattern(l, e, k, true); p < l->n; ++p)
            ++count[e->pattern[p] + 1];
    for (size_t k = 0; k < l->n; ++k)
        count[k + 1] += count[k];
    l->row = iccp_alloc(&l->memory, count[l->n], sizeof *l->row);
    l->value = iccp_alloc(&l->memory, count[l->n], sizeof *l->value);
    return l->row != NULL && l->value != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

icc_status iccp_ldlt_analyse(iccp_ldlt *factor, const iccp_symmetric *matrix, size_t block,
                             const iccp_env *env)
{
    iccp_ldlt *l = factor;
    const size_t n = matrix->n;
    *l = (iccp_ldlt){.memory = env->memory, .n = n};
    l->order = iccp_alloc(&l->memory, n, sizeof *l->order);
    l->position = iccp_alloc(&l->memory, n, sizeof *l->position);
    l->parent = iccp_alloc(&l->memory, n, sizeof *l->parent);
    l->first = iccp_alloc(&l->memory, n + 1, sizeof *l->first);
    l->pivot = iccp_alloc(&l->memory, n, sizeof *l->pivot);
    elimination e = {.matrix = matrix};
    e.mark = iccp_alloc(&env->memory, n, sizeof *e.mark);
    e.pattern = iccp_alloc(&env->memory, n, sizeof *e.pattern);
    icc_status status = ICC_ERR_MEMORY;
    if (l->order != NULL && l->position != NULL && l->parent != NULL && l->first != NULL &&
        l->pivot != NULL && e.mark != NULL && e.pattern != NULL)
        status = order_groups(l, matrix, block, env);
    if (status == ICC_OK) {
        for (uint32_t k = 0; k < n; ++k)
            l->position[l->order[k]] = k;
        status = count_entries(l, &e);
    }
    iccp_free(&env->memory, e.mark);
    iccp_free(&env->memory, e.pattern);
    if (status != ICC_OK)
        iccp_ldlt_free(l);
    return status;
}

/* Row k of L solves L(0..k) D l = row k of the matrix. Returns the pivot. */
static double eliminate_row(iccp_ldlt *l, elimination *e, uint32_t k)
{
    const iccp_symmetric *m = e->matrix;
    const uint32_t row = l->order[k];
    size_t p = row_pattern(l, e, k, false);
    for (size_t q = m->first[row]; q < m->first[row + 1]; ++q)
        if (l->position[m->column[q]] < k)
            e->y[l->position[m->column[q]]] += m->value[q];
    double pivot = m->diagonal[row];
    for (; p < l->n; ++p) {
        const uint32_t i = e->pattern[p];
        const double y = e->y[i], entry = y / l->pivot[i];
        const size_t end = l->first[i] + e->used[i];
        e->y[i] = 0;
        for (size_t q = l->first[i]; q < end; ++q)
            e->y[l->row[q]] -= l->value[q] * y;
        pivot -= entry * y;
        l->row[end] = k;
        l->value[end] = entry;
        ++e->used[i];
    }
    return pivot;
}

static icc_status eliminate(iccp_ldlt *l, elimination *e, const iccp_env *env)
{
    for (size_t k = 0; k < l->n; ++k) {
        e->mark[k] = NONE;
        e->y[k] = 0;
        e->used[k] = 0;
    }
    for (uint32_t k = 0; k < l->n; ++k) {
        if (k % ROWS_PER_REPORT == 0) {
            const icc_status status = iccp_progress(env, "factorise", (double)k / (double)l->n);
            if (status != ICC_OK)
                return status;
        }
        l->pivot[k] = eliminate_row(l, e, k);
        if (!(l->pivot[k] > 0 && isfinite(l->pivot[k])))
            return ICC_ERR_SOLVER;
    }
    return ICC_OK;
}

icc_status iccp_ldlt_factorise(iccp_ldlt *factor, const iccp_symmetric *matrix,
                               const iccp_env *env)
{
    const size_t n = factor->n;
    elimination e = {.matrix = matrix};
    e.mark = iccp_alloc(&env->memory, n, sizeof *e.mark);
    e.pattern = iccp_alloc(&env->memory, n, sizeof *e.pattern);
    e.y = iccp_alloc(&env->memory, n, sizeof *e.y);
    e.used = iccp_alloc(&env->memory, n, sizeof *e.used);
    icc_status status = ICC_ERR_MEMORY;
    if (e.mark != NULL && e.pattern != NULL && e.y != NULL && e.used != NULL)
        status = eliminate(factor, &e, env);
    iccp_free(&env->memory, e.mark);
    iccp_free(&env->memory, e.pattern);
    iccp_free(&env->memory, e.y);
    iccp_free(&env->memory, e.used);
    return status;
}

void iccp_ldlt_free(iccp_ldlt *factor)
{
    iccp_free(&factor->memory, factor->order);
    iccp_free(&factor->memory, factor->position);
    iccp_free(&factor->memory, factor->parent);
    iccp_free(&factor->memory, factor->first);
    iccp_free(&factor->memory, factor->row);
    iccp_free(&factor->memory, factor->value);
    iccp_free(&factor->memory, factor->pivot);
    *factor = (iccp_ldlt){.memory = factor->memory};
}

void iccp_ldlt_solve(const iccp_ldlt *factor, size_t n_rhs, double *b, double *work)
{
    const size_t n = factor->n;
    for (size_t k = 0; k < n; ++k)
        memcpy(work + k * n_rhs, b + factor->order[k] * n_rhs, n_rhs * sizeof *work);
    for (size_t k = 0; k < n; ++k)
        for (size_t p = factor->first[k]; p < factor->first[k + 1]; ++p)
            for (size_t r = 0; r < n_rhs; ++r)
                work[factor->row[p] * n_rhs + r] -= factor->value[p] * work[k * n_rhs + r];
    for (size_t k = n; k-- > 0;) {
        for (size_t r = 0; r < n_rhs; ++r)
            work[k * n_rhs + r] /= factor->pivot[k];
        for (size_t p = factor->first[k]; p < factor->first[k + 1]; ++p)
            for (size_t r = 0; r < n_rhs; ++r)
                work[k * n_rhs + r] -= factor->value[p] * work[factor->row[p] * n_rhs + r];
    }
    for (size_t k = 0; k < n; ++k)
        memcpy(b + factor->order[k] * n_rhs, work + k * n_rhs, n_rhs * sizeof *work);
}

/* Analysis: everything about a factor that the pattern of the matrix determines. Source: T. Davis,
 * Direct Methods for Sparse Linear Systems, 2006, chapter 4 and section 7.1. */
#include "math/ldlt.h"

#include "base/budget.h"
#include "math/ordering.h"

#include <string.h>

/* Writes the pattern of the groups of rows, taken from the first row of each group. */
static void fill_groups(size_t *first, uint32_t *column, const iccp_symmetric *m, size_t block)
{
    const size_t n = m->n / block;
    size_t n_entries = 0;
    for (size_t i = 0; i < n; ++i) {
        first[i] = n_entries;
        for (size_t p = m->first[block * i]; p < m->first[block * i + 1]; ++p)
            if (m->column[p] % block == 0 && m->column[p] / block != i)
                column[n_entries++] = (uint32_t)(m->column[p] / block);
    }
    first[n] = n_entries;
}

static icc_status allocate(iccp_ldlt *l, size_t n, const iccp_env *env)
{
    *l = (iccp_ldlt){.memory = env->memory, .n = n};
    l->order = iccp_alloc(&l->memory, n, sizeof *l->order);
    l->position = iccp_alloc(&l->memory, n, sizeof *l->position);
    return l->order != NULL && l->position != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

/* The first column of a group has as many entries as the group has rows below. Each further column
 * has one entry less. */
static void predict(iccp_ldlt *l, const uint32_t *count, size_t block)
{
    for (size_t j = 0; j < l->n; ++j) {
        const size_t below = block * count[j / block] - j % block - 1;
        l->n_entries += below;
        l->work += (double)below * ((double)below + 3) / 2;
    }
}

/* Replaces the numbers of n groups by those of their rows, in place. */
static void expand(uint32_t *number, size_t n, size_t block)
{
    for (size_t k = n; k-- > 0;)
        for (size_t d = block; d-- > 0;)
            number[block * k + d] = (uint32_t)(block * number[k] + d);
}

/* Generous estimate for the vectors and the matrix that accompany a factor. */
static const double BYTES_PER_ROW = 200;

/* The analysis after ordering, all in groups. */
static icc_status analyse(iccp_ldlt *l, const iccp_symmetric *groups, size_t block,
                          const iccp_env *env)
{
    uint32_t *parent = iccp_alloc(&env->memory, groups->n, sizeof *parent);
    uint32_t *count = iccp_alloc(&env->memory, groups->n, sizeof *count);
    const iccp_etree tree = {groups, l->order, l->position, parent};
    icc_status status = parent != NULL && count != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = iccp_etree_build(&tree, env);
    if (status == ICC_OK)
        status = iccp_etree_count(&tree, count, env);
    if (status == ICC_OK)
        status = iccp_supernodes_create(&l->nodes, &tree, block, count, env);
    if (status == ICC_OK) {
        expand(l->order, groups->n, block);
        expand(l->position, groups->n, block);
        predict(l, count, block);
        status = iccp_budget_borrow(env, iccp_ldlt_bytes(l) + BYTES_PER_ROW * (double)l->n);
    }
    iccp_free(&env->memory, parent);
    iccp_free(&env->memory, count);
    return status;
}

static icc_status order_and_analyse(iccp_ldlt *l, const iccp_symmetric *groups, size_t block,
                                    const iccp_env *env)
{
    const icc_status status = iccp_ordering(groups, l->order, env);
    return status == ICC_OK ? analyse(l, groups, block, env) : status;
}

/* Makes a matrix of the groups, without values, and analyses it. */
static icc_status analyse_groups(iccp_ldlt *l, const iccp_symmetric *m, size_t block,
                                 const iccp_env *env)
{
    const size_t n = m->n / block;
    size_t *first = iccp_alloc(&env->memory, n + 1, sizeof *first);
    uint32_t *column = iccp_alloc(&env->memory, m->first[m->n] / block, sizeof *column);
    icc_status status = ICC_ERR_MEMORY;
    if (first != NULL && column != NULL) {
        const iccp_symmetric groups = {n, first, column, NULL, NULL};
        fill_groups(first, column, m, block);
        status = order_and_analyse(l, &groups, block, env);
    }
    iccp_free(&env->memory, first);
    iccp_free(&env->memory, column);
    return status;
}

icc_status iccp_ldlt_analyse(iccp_ldlt *factor, const iccp_symmetric *matrix, size_t block,
                             const iccp_env *env)
{
    icc_status status = allocate(factor, matrix->n, env);
    if (status == ICC_OK)
        status = block > 1 ? analyse_groups(factor, matrix, block, env)
                           : order_and_analyse(factor, matrix, 1, env);
    if (status != ICC_OK)
        iccp_ldlt_free(factor);
    return status;
}

icc_status iccp_ldlt_analyse_ordered(iccp_ldlt *factor, const iccp_symmetric *matrix,
                                     const uint32_t *order, const iccp_env *env)
{
    icc_status status = allocate(factor, matrix->n, env);
    if (status == ICC_OK) {
        memcpy(factor->order, order, matrix->n * sizeof *order);
        status = analyse(factor, matrix, 1, env);
    }
    if (status != ICC_OK)
        iccp_ldlt_free(factor);
    return status;
}

double iccp_ldlt_bytes(const iccp_ldlt *factor)
{
    const size_t n_values = factor->nodes.first_value[factor->nodes.n];
    return (double)sizeof(double) * ((double)n_values + (double)factor->n);
}

void iccp_ldlt_share(iccp_ldlt *factor, const iccp_ldlt *analysed, const iccp_memory *memory)
{
    *factor = *analysed;
    factor->memory = *memory;
    factor->value = factor->pivot = NULL;
    factor->large = factor->small = (iccp_subtrees){0};
    factor->borrows = true;
}

void iccp_ldlt_free(iccp_ldlt *factor)
{
    iccp_free(&factor->memory, factor->value);
    iccp_free(&factor->memory, factor->pivot);
    iccp_subtrees_free(&factor->large, &factor->memory);
    iccp_subtrees_free(&factor->small, &factor->memory);
    if (!factor->borrows) {
        iccp_free(&factor->memory, factor->order);
        iccp_free(&factor->memory, factor->position);
        iccp_supernodes_free(&factor->nodes, &factor->memory);
    }
    *factor = (iccp_ldlt){.memory = factor->memory};
}

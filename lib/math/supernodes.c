/* Relaxed supernodes. Source: C. Ashcraft, R. Grimes, The influence of relaxed supernode partitions
 * on the multifrontal method, ACM Trans. Math. Software 15, 1989. Their rows are found like the row
 * subtrees of T. Davis, Direct Methods for Sparse Linear Systems, 2006, section 4.3, with
 * supernodes in place of columns. */
#include "math/supernodes.h"

#include <stdbool.h>
#include <string.h>

#define NONE ICCP_NO_PARENT

/* Number of entries on and below the diagonal of a panel. */
static double room_of(double columns, double below)
{
    return columns * (columns + 1) / 2 + columns * below;
}

/* Merging helps narrow panels most. Other shares of zeros were hardly better or worse on the shapes
 * of tests/bench/bench_spd.c. */
static bool is_worth_merging(double columns, double zeros, double room)
{
    const double share = columns <= 4 ? 0.7 : columns <= 16 ? 0.5 : columns <= 48 ? 0.1 : 0.05;
    return zeros <= share * room;
}

/* Number of entries in the columns of a group whose first column has `count` rows of groups. */
static double entries_of(uint32_t count, size_t block)
{
    return (double)block * ((double)block * count - ((double)block - 1) / 2);
}

/* Goes through the groups of columns and keeps the supernodes found so far on a stack. A new
 * supernode merges with the children before it while that pays. entries[s] is the number of entries
 * of the factor in supernode s. */
static void partition(iccp_supernodes *nodes, const iccp_etree *t, size_t block,
                      const uint32_t *count, double *entries)
{
    const size_t n = t->matrix->n;
    for (uint32_t begin = 0, end; begin < n; begin = end) {
        uint32_t first = begin;
        double sum = entries_of(count[begin], block);
        for (end = begin + 1;
             end < n && t->parent[end - 1] == end && count[end - 1] == count[end] + 1;)
            sum += entries_of(count[end++], block);
        for (; nodes->n > 0 && t->parent[first - 1] < end; --nodes->n) {
            const uint32_t joint = nodes->column[nodes->n - 1];
            const double columns = (double)block * (end - joint);
            const double all = sum + entries[nodes->n - 1];
            const double room = room_of(columns, (double)block * (count[end - 1] - 1));
            if (!is_worth_merging(columns, room - all, room))
                break;
            first = joint;
            sum = all;
        }
        entries[nodes->n] = sum;
        nodes->column[nodes->n++] = first;
    }
    nodes->column[nodes->n] = (uint32_t)n;
}

/* Numbers the rows and values of all supernodes. The last group of a supernode has the fewest rows,
 * and all columns share them. So the number of rows below a panel is the count of that group
 * without itself. Returns false if there are more values than can be addressed, which happens soon
 * with 32 bits. */
static bool lay_out_panels(iccp_supernodes *nodes, const iccp_etree *t, size_t block,
                           const uint32_t *count)
{
    size_t n_rows = 0, n_values = 0;
    double size = 0;
    for (uint32_t s = 0; s < nodes->n; ++s) {
        const uint32_t end = nodes->column[s + 1];
        const size_t columns = iccp_supernodes_columns(nodes, s);
        const size_t rows = columns + block * (count[end / block - 1] - 1);
        for (uint32_t j = nodes->column[s]; j < end; ++j)
            nodes->owner[j] = s;
        nodes->first_row[s] = n_rows;
        nodes->first_value[s] = n_values;
        n_rows += rows - columns;
        n_values += (rows + ICCP_STRIP - 1) / ICCP_STRIP * ICCP_STRIP * columns;
        size += sizeof(double) * (double)(rows + ICCP_STRIP) * (double)columns;
        nodes->most_columns = columns > nodes->most_columns ? columns : nodes->most_columns;
        nodes->most_rows = rows > nodes->most_rows ? rows : nodes->most_rows;
    }
    nodes->first_row[nodes->n] = n_rows;
    nodes->first_value[nodes->n] = n_values;
    for (size_t s = 0; s < nodes->n; ++s) {
        const uint32_t above = t->parent[nodes->column[s + 1] / block - 1];
        nodes->parent[s] = above == NONE ? NONE : nodes->owner[block * above];
    }
    return size < (double)SIZE_MAX;
}

/* Finds the rows of each supernode. Group i reaches the supernodes of its entries and their
 * ancestors, up to its own supernode. */
static icc_status list_rows(iccp_supernodes *nodes, const iccp_etree *t, size_t block,
                            uint32_t *mark, size_t *end, const iccp_env *env)
{
    const iccp_symmetric *m = t->matrix;
    icc_status status = ICC_OK;
    for (size_t s = 0; s < nodes->n; ++s) {
        mark[s] = NONE;
        end[s] = nodes->first_row[s];
    }
    for (uint32_t i = 0; i < m->n && status == ICC_OK; ++i) {
        const uint32_t row = t->order[i], own = nodes->owner[block * i];
        status = iccp_etree_progress(t, ICCP_PASS_ROWS, i, env);
        for (size_t p = m->first[row]; p < m->first[row + 1]; ++p) {
            if (t->position[m->column[p]] >= i)
                continue;
            uint32_t s = nodes->owner[block * t->position[m->column[p]]];
            for (; s != own && mark[s] != i; s = nodes->parent[s]) {
                mark[s] = i;
                for (size_t d = 0; d < block; ++d)
                    nodes->row[end[s]++] = (uint32_t)(block * i + d);
            }
        }
    }
    return status;
}

static icc_status find_rows(iccp_supernodes *nodes, const iccp_etree *t, size_t block,
                            const iccp_env *env)
{
    uint32_t *mark = iccp_alloc(&env->memory, nodes->n, sizeof *mark);
    size_t *end = iccp_alloc(&env->memory, nodes->n, sizeof *end);
    nodes->row = iccp_alloc(&env->memory, nodes->first_row[nodes->n], sizeof *nodes->row);
    icc_status status = ICC_ERR_MEMORY;
    if (mark != NULL && end != NULL && nodes->row != NULL)
        status = list_rows(nodes, t, block, mark, end, env);
    iccp_free(&env->memory, mark);
    iccp_free(&env->memory, end);
    return status;
}

static icc_status find_partition(iccp_supernodes *nodes, const iccp_etree *t, size_t block,
                                 const uint32_t *count, const iccp_env *env)
{
    const size_t n = t->matrix->n;
    uint32_t *column = iccp_alloc(&env->memory, n + 1, sizeof *column);
    double *entries = iccp_alloc(&env->memory, n, sizeof *entries);
    if (column != NULL && entries != NULL) {
        nodes->column = column;
        partition(nodes, t, block, count, entries);
        nodes->column = iccp_alloc(&env->memory, nodes->n + 1, sizeof *column);
        for (size_t s = 0; nodes->column != NULL && s <= nodes->n; ++s)
            nodes->column[s] = (uint32_t)block * column[s];
    }
    iccp_free(&env->memory, column);
    iccp_free(&env->memory, entries);
    return nodes->column != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

icc_status iccp_supernodes_create(iccp_supernodes *nodes, const iccp_etree *tree, size_t block,
                                  const uint32_t *count, const iccp_env *env)
{
    *nodes = (iccp_supernodes){0};
    icc_status status = find_partition(nodes, tree, block, count, env);
    if (status == ICC_OK) {
        nodes->owner = iccp_alloc(&env->memory, block * tree->matrix->n, sizeof *nodes->owner);
        nodes->parent = iccp_alloc(&env->memory, nodes->n, sizeof *nodes->parent);
        nodes->first_row = iccp_alloc(&env->memory, nodes->n + 1, sizeof *nodes->first_row);
        nodes->first_value = iccp_alloc(&env->memory, nodes->n + 1, sizeof *nodes->first_value);
        if (nodes->owner == NULL || nodes->parent == NULL || nodes->first_row == NULL ||
            nodes->first_value == NULL || !lay_out_panels(nodes, tree, block, count))
            status = ICC_ERR_MEMORY;
    }
    if (status == ICC_OK)
        status = find_rows(nodes, tree, block, env);
    if (status != ICC_OK)
        iccp_supernodes_free(nodes, &env->memory);
    return status;
}

void iccp_supernodes_free(iccp_supernodes *nodes, const iccp_memory *memory)
{
    iccp_free(memory, nodes->column);
    iccp_free(memory, nodes->owner);
    iccp_free(memory, nodes->parent);
    iccp_free(memory, nodes->first_row);
    iccp_free(memory, nodes->row);
    iccp_free(memory, nodes->first_value);
    *nodes = (iccp_supernodes){0};
}

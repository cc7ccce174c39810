#include "shelling/stiffness.h"

#include "shelling/element.h"

#include <math.h>

#define NONE UINT32_MAX

/* The gradients: a row for each component in each simplex, times the root of its volume. */
static void fill_gradients(iccp_sparse *b, const iccp_simplices *mesh)
{
    const size_t dim = mesh->dim, n_corners = dim + 1;
    double gradient[(ICC_MAX_DIM + 1) * ICC_MAX_DIM];
    size_t end = 0;
    b->first[0] = 0;
    for (size_t t = 0; t < mesh->n_simplices; ++t) {
        const double root = sqrt(iccp_element_gradients(mesh, t, gradient));
        for (size_t k = 0; k < dim; ++k) {
            for (size_t i = 0; i < n_corners; ++i) {
                b->column[end] = mesh->corners[n_corners * t + i];
                b->value[end++] = root * gradient[dim * i + k];
            }
            b->first[dim * t + k + 1] = end;
        }
    }
}

icc_status iccp_stiffness_create(iccp_gram *gram, const iccp_simplices *mesh, const iccp_env *env)
{
    const size_t n_rows = mesh->dim * mesh->n_simplices;
    iccp_sparse b;
    icc_status status =
        iccp_sparse_create(&b, n_rows, mesh->n_points, (mesh->dim + 1) * n_rows, env);
    if (status != ICC_OK)
        return status;
    fill_gradients(&b, mesh);
    status = iccp_gram_create(gram, &b, env);
    if (status == ICC_OK)
        iccp_gram_fill(gram, &b, NULL);
    iccp_sparse_free(&b);
    return status;
}

static size_t count_entries(const iccp_gram *gram, const uint32_t *row, size_t *n_rows)
{
    size_t n_entries = 0;
    *n_rows = 0;
    for (size_t i = 0; i < gram->matrix.n; ++i) {
        *n_rows += row[i] != NONE;
        for (size_t p = gram->first[i]; p < gram->first[i + 1] && row[i] != NONE; ++p)
            n_entries += row[gram->column[p]] != NONE;
    }
    return n_entries;
}

/* Two passes over the rows that are kept: count, then fill. */
icc_status iccp_stiffness_restrict(iccp_gram *part, const iccp_gram *gram, const uint32_t *row,
                                   const iccp_env *env)
{
    size_t n, end = 0;
    const size_t n_entries = count_entries(gram, row, &n);
    *part = (iccp_gram){.memory = env->memory};
    part->first = iccp_alloc(&env->memory, n + 1, sizeof *part->first);
    part->column = iccp_alloc(&env->memory, n_entries, sizeof *part->column);
    part->value = iccp_alloc(&env->memory, n_entries, sizeof *part->value);
    part->diagonal = iccp_alloc(&env->memory, n, sizeof *part->diagonal);
    if (part->first == NULL || part->column == NULL || part->value == NULL ||
        part->diagonal == NULL) {
        iccp_gram_free(part);
        return ICC_ERR_MEMORY;
    }
    part->first[0] = 0;
    for (size_t i = 0; i < gram->matrix.n; ++i) {
        if (row[i] == NONE)
            continue;
        for (size_t p = gram->first[i]; p < gram->first[i + 1]; ++p)
            if (row[gram->column[p]] != NONE) {
                part->column[end] = row[gram->column[p]];
                part->value[end++] = gram->value[p];
            }
        part->diagonal[row[i]] = gram->diagonal[i];
        part->first[row[i] + 1] = end;
    }
    part->matrix = (iccp_symmetric){n, part->first, part->column, part->value, part->diagonal};
    return ICC_OK;
}

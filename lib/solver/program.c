#include "solver/program.h"

#include <math.h>

static icc_status find_leaves(iccp_program *p, const iccp_env *env)
{
    const iccp_rows *rows = p->rows;
    uint8_t *has_child = iccp_alloc_zero(&env->memory, rows->n, sizeof *has_child);
    if (has_child == NULL)
        return ICC_ERR_MEMORY;
    p->n_leaves = rows->n - 1;
    for (size_t k = 1; k < rows->n; ++k)
        if (!has_child[rows->parent[k]]) {
            has_child[rows->parent[k]] = 1;
            p->n_leaves -= rows->parent[k] != 0;
        }
    p->leaf_row = iccp_alloc(&env->memory, p->n_leaves, sizeof *p->leaf_row);
    size_t j = 0;
    for (uint32_t k = 1; p->leaf_row != NULL && k < rows->n; ++k)
        if (!has_child[k])
            p->leaf_row[j++] = k;
    iccp_free(&env->memory, has_child);
    return p->leaf_row != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

icc_status iccp_program_create(iccp_program *program, const iccp_rows *rows, int32_t function,
                               double eta, double leaf, const iccp_env *env)
{
    *program = (iccp_program){.rows = rows, .sigma = 1 + eta, .leaf = leaf};
    icc_status status = iccp_energy_create(&program->a, rows, function, env);
    if (status == ICC_OK)
        status = find_leaves(program, env);
    if (status != ICC_OK)
        iccp_program_free(program);
    return status;
}

void iccp_program_free(iccp_program *program)
{
    iccp_free(&program->a.memory, program->leaf_row);
    program->leaf_row = NULL;
    iccp_sparse_free(&program->a);
}

double iccp_program_least_root(const iccp_program *program, double *work)
{
    const iccp_rows *rows = program->rows;
    for (size_t k = 0; k < rows->n; ++k)
        work[k] = program->leaf;
    for (size_t k = rows->n; k-- > 1;)
        work[rows->parent[k]] = fmax(work[rows->parent[k]], program->sigma * work[k]);
    return work[0];
}

void iccp_program_slacks(const iccp_program *program, const double *f, bool is_direction,
                         double *slack)
{
    const iccp_rows *rows = program->rows;
    const double bound = is_direction ? 0.0 : program->leaf;
    for (size_t k = 1; k < rows->n; ++k)
        slack[k - 1] = f[rows->parent[k]] - program->sigma * f[k];
    for (size_t j = 0; j < program->n_leaves; ++j)
        slack[rows->n - 1 + j] = f[program->leaf_row[j]] - bound;
}

void iccp_program_add_forces(const iccp_program *program, const double *y, double *out)
{
    const iccp_rows *rows = program->rows;
    for (size_t k = 1; k < rows->n; ++k) {
        out[rows->parent[k]] += y[k - 1];
        out[k] -= program->sigma * y[k - 1];
    }
    for (size_t j = 0; j < program->n_leaves; ++j)
        out[program->leaf_row[j]] += y[rows->n - 1 + j];
}

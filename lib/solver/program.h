/* The quadratic program of constrained bi-Laplace: 1/2 |A f|^2 is to be least among the f with f_0
 * = 1, f_parent >= sigma f_child on the edges of the tree and f >= leaf at the rows without
 * children. */
#ifndef ICCP_PROGRAM_H
#define ICCP_PROGRAM_H

#include "solver/energy.h"

#include <stdbool.h>

/* Inequality i < n - 1 belongs to the edge from row i + 1 to its parent, n - 1 + j to row
 * leaf_row[j]. */
typedef struct iccp_program {
    const iccp_rows *rows;
    iccp_sparse a; /* see energy.h */
    double sigma;  /* 1 + eta */
    double leaf;
    size_t n_leaves;
    uint32_t *leaf_row;
} iccp_program;

icc_status iccp_program_create(iccp_program *program, const iccp_rows *rows, int32_t function,
                               double eta, double leaf, const iccp_env *env);
void iccp_program_free(iccp_program *program);

/* Edges and leaves. */
static inline size_t iccp_program_inequalities(const iccp_program *program)
{
    return program->rows->n - 1 + program->n_leaves;
}

/* The largest value that the inequalities ask of the root: more than 1, and there is no
 * solution. */
double iccp_program_least_root(const iccp_program *program, double *work /* n */);

/* slack = G f, less the bounds unless f is a direction. */
void iccp_program_slacks(const iccp_program *program, const double *f, bool is_direction,
                         double *slack);

/* out += G' y */
void iccp_program_add_forces(const iccp_program *program, const double *y, double *out);

#endif

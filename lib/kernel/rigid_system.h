/* The system of a rigid part: see rigid.c. */
#ifndef ICCP_RIGID_SYSTEM_H
#define ICCP_RIGID_SYSTEM_H

#include "kernel/interpolant.h"
#include "kernel/weights.h"
#include "math/gram.h"

/* Unknown are the coefficients of the area's kernels, n of them, then a multiplier for each node
 * that is held. */
typedef struct iccp_rigid {
    iccp_memory memory;
    const iccp_nodes *nodes;
    const iccp_collocation *collocation;
    const iccp_symmetric *kernel; /* the values between all nodes */
    size_t n_part, n, n_held;
    uint32_t *area;     /* n nodes: the part, then those that it reaches */
    uint32_t *number;   /* of each node: its place in the area, or UINT32_MAX */
    uint32_t *held;     /* n_held nodes: those held, with a node of the area in reach */
    double *weight;     /* of each derivative: row dim * a + axis for node a of the area */
    iccp_sparse slopes; /* from coefficients to derivatives: dim rows a node of the area */
    iccp_gram gram;     /* the matrix of 5.16 */
    double scale;       /* its greatest diagonal entry; the system is divided by it */
    size_t *first;      /* the arrays of the system */
    uint32_t *column;
    double *value, *diagonal;
    int8_t *sign;
    iccp_symmetric matrix;
    double pivot; /* what has been added to its diagonal, or taken from it */
    iccp_ldlt factor;
} iccp_rigid;

/* The part's derivatives count by their rigidity (NULL: 1), those around it by a tenth of its
 * mean. */
icc_status iccp_rigid_create(iccp_rigid *rigid, const iccp_nodes *nodes,
                             const iccp_collocation *collocation, size_t n_part,
                             const uint32_t *part, const double *rigidity, const bool *held,
                             const iccp_env *env);
void iccp_rigid_free(iccp_rigid *rigid);

/* Coefficients with the given negative derivatives of the energy (over `scale`) as right sides, m
 * of them, such that the values at held nodes are 0. `left` and `work`: as many rows of m as the
 * system has. */
void iccp_rigid_solve(const iccp_rigid *rigid, size_t m, const double *right, double *x,
                      double *left, double *work);

#endif

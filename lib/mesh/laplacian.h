/* The graph Laplacian of a mesh with positive edge weights, for functions given on the boundary. */
#ifndef ICCP_LAPLACIAN_H
#define ICCP_LAPLACIAN_H

#include "math/symmetric.h"
#include "mesh/planar.h"

/* Row i of the matrix stands for mesh vertex n_boundary + i. */
typedef struct iccp_laplacian {
    iccp_memory memory;
    iccp_symmetric matrix;
    size_t *first; /* what the matrix borrows */
    uint32_t *column;
    double *value, *diagonal;
    size_t *boundary_first;    /* n + 1: where a row's edges to the boundary begin */
    uint32_t *boundary_vertex; /* of each such edge: its boundary vertex */
    double *boundary_weight;   /* and its weight */
} iccp_laplacian;

/* Cotangent weights, kept within positive bounds. Edges at the vertex `left_out`
 * (ICCP_NO_NEIGHBOUR: none) are left out; its own row is that of the identity. */
icc_status iccp_laplacian_create(iccp_laplacian *laplacian, const iccp_planar *mesh,
                                 uint32_t left_out, const iccp_env *env);
void iccp_laplacian_free(iccp_laplacian *laplacian);

#endif

/* The graph Laplacian of a mesh with positive edge weights, for functions with given boundary
 * values. */
#ifndef ICCP_LAPLACIAN_H
#define ICCP_LAPLACIAN_H

#include "math/symmetric.h"
#include "mesh/planar.h"

/* Row i of the matrix belongs to mesh vertex n_boundary + i. */
typedef struct iccp_laplacian {
    iccp_memory memory;
    iccp_symmetric matrix;
    size_t *first; /* arrays that the matrix borrows */
    uint32_t *column;
    double *value, *diagonal;
    size_t *boundary_first;    /* n + 1: where each row's edges to the boundary begin */
    uint32_t *boundary_vertex; /* boundary vertex of each such edge */
    double *boundary_weight;   /* weight of each such edge */
} iccp_laplacian;

/* Largest weight of an edge. For comparison: an equilateral mesh has weights of 0.58. */
#define ICCP_MOST_WEIGHT 50.0

/* Returns half the cotangent of the angle at `p` of the triangle p, a, b. It is finite if the
 * triangle is as thin as a line. */
double iccp_half_cotangent(const double *p, const double *a, const double *b);

/* Makes the Laplacian with cotangent weights, limited to positive bounds. Edges at the vertex
 * `left_out` are omitted, and its row is that of the identity. ICCP_NO_NEIGHBOUR leaves out no
 * vertex. */
icc_status iccp_laplacian_create(iccp_laplacian *laplacian, const iccp_planar *mesh,
                                 uint32_t left_out, const iccp_env *env);
void iccp_laplacian_free(iccp_laplacian *laplacian);

#endif

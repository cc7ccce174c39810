/* The Hessian of a rigid part's program; see rigid.c. */
#ifndef ICCP_RIGID_HESSIAN_H
#define ICCP_RIGID_HESSIAN_H

#include "kernel/pose/rigid_slopes.h"
#include "math/dense.h"
#include "math/ldlt.h"

/* E'CE, a matrix of the free nodes that is the same for each handle. */
typedef struct iccp_hessian {
    iccp_memory memory;
    iccp_slopes map;     /* E */
    const double *count; /* C: weight of each place's derivatives; borrowed */
    double *forces;      /* map.n_rows rows of m */
    /* The matrix, four rows at a time, column after column; NULL if products with E are cheaper */
    double *strips;
    double *columns; /* workspace for it: some columns of n_free rows */
    iccp_dense kernels;
    iccp_ldlt inverse; /* see rigid_hessian.c; has no values if it would cost too much */
    uint8_t *needed;   /* parts of it that are used */
} iccp_hessian;

/* Like iccp_slopes_create(). In addition it needs a row of m for each derivative, a factor for the
 * inverse, and possibly the square of n_free. */
icc_status iccp_hessian_create(iccp_hessian *hessian, const iccp_nodes *nodes,
                               const iccp_collocation *collocation, size_t n_places,
                               const uint32_t *places, const double *count, size_t n_free,
                               const uint32_t *free, const iccp_env *env);
void iccp_hessian_free(iccp_hessian *hessian);

/* Multiplies n_free rows of m by the Hessian. */
void iccp_hessian_apply(const iccp_hessian *hessian, const double *weights, double *product);

/* Multiplies n_free rows of m by the approximate inverse, which is symmetric and positive definite.
 * Copies them if the inverse would cost too much. */
void iccp_hessian_divide(const iccp_hessian *hessian, const double *side, double *weights);

/* Multiplies derivatives, n_rows rows of m, by E'C. Also replaces them by C times themselves. */
void iccp_hessian_gather(const iccp_hessian *hessian, double *derivatives, double *weights);

#endif

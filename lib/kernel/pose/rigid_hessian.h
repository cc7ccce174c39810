/* The Hessian of a rigid part's program: see rigid.c. */
#ifndef ICCP_RIGID_HESSIAN_H
#define ICCP_RIGID_HESSIAN_H

#include "kernel/pose/rigid_slopes.h"
#include "math/dense.h"
#include "math/ldlt.h"

/* E'CE, the same for each handle: a matrix of the free nodes. */
typedef struct iccp_hessian {
    iccp_memory memory;
    iccp_slopes map;     /* E */
    const double *count; /* C: of each place, how much its derivatives count; borrowed */
    double *forces;      /* map.n_rows rows of m */
    double *strips;  /* the matrix, four rows at a time, column after column; NULL where products
                            with E are cheaper */
    double *columns; /* scratch beside it: some columns of n_free rows */
    iccp_dense kernels;
    iccp_ldlt inverse; /* see rigid_hessian.c; no values where it would cost too much */
    uint8_t *needed;   /* what of it is read */
} iccp_hessian;

/* As iccp_slopes_create(). Memory: beside what that takes a row of m for each derivative, a factor
 * for the inverse, and where it pays the square of n_free. */
icc_status iccp_hessian_create(iccp_hessian *hessian, const iccp_nodes *nodes,
                               const iccp_collocation *collocation, size_t n_places,
                               const uint32_t *places, const double *count, size_t n_free,
                               const uint32_t *free, const iccp_env *env);
void iccp_hessian_free(iccp_hessian *hessian);

/* The product with n_free rows of m. */
void iccp_hessian_apply(const iccp_hessian *hessian, const double *weights, double *product);

/* Nearly the inverse's product with n_free rows of m, or these where that would cost too much:
 * symmetric and positive definite. */
void iccp_hessian_divide(const iccp_hessian *hessian, const double *side, double *weights);

/* E'C times derivatives, n_rows rows of m, which are replaced by C times themselves. */
void iccp_hessian_gather(const iccp_hessian *hessian, double *derivatives, double *weights);

#endif

/* The derivatives of the interpolant at some nodes, as a linear function of the weights at others:
 * see rigid.c. */
#ifndef ICCP_RIGID_SLOPES_H
#define ICCP_RIGID_SLOPES_H

#include "kernel/weights/interpolant.h"
#include "kernel/weights/weights.h"
#include "math/gram.h"

typedef struct iccp_slopes {
    iccp_memory memory;
    const iccp_collocation *collocation; /* all but the memory is borrowed down to `free` */
    size_t m;                            /* handles: columns of weights and of derivatives */
    size_t n_free;
    const uint32_t *free; /* the nodes whose weights count */
    size_t n_rows;        /* derivatives: dim for each place */
    iccp_sparse kernel;   /* from coefficients of all nodes to derivatives, and in the rows after
                             these to values: at the free nodes, then at others near */
    double *affine;       /* (dim + 1) numbers a row, for the affine function; NULL without */
    uint8_t *needed;      /* what of the factor concerns these nodes */
    size_t n_marked;
    uint32_t *marked;   /* the nodes that this is about; room for all */
    double *all, *work; /* m numbers for each of all nodes */
} iccp_slopes;

/* Derivatives at `places`, in local coordinates: row dim * k + axis for place k. Memory: two rows
 * of m for each of all nodes, beside what the places take. */
icc_status iccp_slopes_create(iccp_slopes *slopes, const iccp_nodes *nodes,
                              const iccp_collocation *collocation, size_t n_places,
                              const uint32_t *places, size_t n_free, const uint32_t *free,
                              const iccp_env *env);
void iccp_slopes_free(iccp_slopes *slopes);

/* The derivatives that weights at the free nodes have, n_free rows of m, all others being 0. */
void iccp_slopes_apply(const iccp_slopes *slopes, const double *weights, double *derivatives);

/* The transposed function: n_free rows of m from a row for each derivative. */
void iccp_slopes_transpose(const iccp_slopes *slopes, const double *derivatives, double *weights);

/* Rows of the kernel from `begin` on times `all`, to `to`, m numbers a row. Where `to` is NULL, all
 * becomes their transpose times `from`. */
void iccp_slopes_multiply(const iccp_slopes *slopes, size_t begin, size_t n_rows,
                          const double *from, double *to);

#endif

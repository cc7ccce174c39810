/* The derivatives of the interpolant at some nodes, as a linear function of the weights at others;
 * see rigid.c. */
#ifndef ICCP_RIGID_SLOPES_H
#define ICCP_RIGID_SLOPES_H

#include "kernel/weights/interpolant.h"
#include "kernel/weights/weights.h"
#include "math/gram.h"

typedef struct iccp_slopes {
    iccp_memory memory;
    const iccp_collocation *collocation; /* borrowed down to `free`, except the memory */
    /* Number of handles: columns of weights and of derivatives */
    size_t m;
    size_t n_free;
    const uint32_t *free; /* nodes whose weights count */
    size_t n_rows;        /* number of derivatives: dim per place */
    /* Maps coefficients of all nodes to derivatives. The rows after these map them to values at the
     * free nodes, then at other nodes nearby. */
    iccp_sparse kernel;
    /* Dim + 1 numbers per row, for the affine function; NULL if there is none */
    double *affine;
    uint8_t *needed; /* parts of the factor that concern these nodes */
    size_t n_marked;
    uint32_t *marked;   /* these nodes; has room for all nodes */
    double *all, *work; /* m numbers for each of all nodes */
} iccp_slopes;

/* Prepares the derivatives at `places`, in local coordinates: row dim * k + axis is for place k.
 * Needs two rows of m for each of all nodes, besides the memory for the places. */
icc_status iccp_slopes_create(iccp_slopes *slopes, const iccp_nodes *nodes,
                              const iccp_collocation *collocation, size_t n_places,
                              const uint32_t *places, size_t n_free, const uint32_t *free,
                              const iccp_env *env);
void iccp_slopes_free(iccp_slopes *slopes);

/* Computes the derivatives from weights at the free nodes, n_free rows of m. All other weights are
 * 0. */
void iccp_slopes_apply(const iccp_slopes *slopes, const double *weights, double *derivatives);

/* The transposed map: computes n_free rows of m from one row per derivative. */
void iccp_slopes_transpose(const iccp_slopes *slopes, const double *derivatives, double *weights);

/* Multiplies rows of the kernel, from `begin` on, by `all`, and writes m numbers per row to `to`.
 * If `to` is NULL, `all` becomes the product of their transpose with `from`. */
void iccp_slopes_multiply(const iccp_slopes *slopes, size_t begin, size_t n_rows,
                          const double *from, double *to);

#endif

/* The inner loops of multigrid and conjugate gradients over the vertices of one run, which are
 * contiguous in every array. near[j][i] is neighbour j of vertex i. All implementations give the
 * same bits. */
#ifndef ICCP_MG_KERNEL_H
#define ICCP_MG_KERNEL_H

#include "base/compiler.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Sums have this many interleaved parts, whatever the width of the machine's vectors. */
enum { ICCP_MG_LANES = 8 };

/* Dot products with the preconditioned residual z. */
typedef struct iccp_mg_upward {
    double rz[ICCP_MG_LANES], zaz[ICCP_MG_LANES];
} iccp_mg_upward;

typedef struct iccp_mg_downward {
    double rr[ICCP_MG_LANES];     /* sum of r^2 */
    double peak[ICCP_MG_LANES];   /* the largest x */
    double excess[ICCP_MG_LANES]; /* the largest |r| - bound * max(x, least) */
} iccp_mg_downward;

/* A step of conjugate gradients: x += alpha p, r -= alpha A p, b = r. */
typedef struct iccp_mg_step {
    double *restrict x, *restrict r;
    float *restrict b;
    const float *p;
    double alpha, bound, least;
} iccp_mg_step;

typedef struct iccp_mg_kernels {
    /* x = inverse * (b + sum of the neighbours) */
    void (*relax)(float *restrict x, const float *b, const float *inverse, const float *const *near,
                  size_t n, int32_t n_near);
    /* x = sum of the neighbours */
    void (*add)(float *restrict x, const float *const *near, size_t n, int32_t n_near);
    /* p = z + beta p */
    void (*redirect)(float *restrict p, const float *z, float beta, size_t n);
    void (*measure)(const float *z, const double *r, const float *const *near, size_t n,
                    int32_t n_near, iccp_mg_upward *up);
    void (*advance)(const iccp_mg_step *step, const float *const *near, size_t n, int32_t n_near,
                    iccp_mg_downward *down);
} iccp_mg_kernels;

/* Returns the fastest kernels for this machine, or those that every machine can run. */
const iccp_mg_kernels *iccp_mg_kernels_choose(int32_t n_near, bool portable);

#endif

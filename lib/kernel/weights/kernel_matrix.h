/* The kernel function, and the matrix of its values between nodes. */
#ifndef ICCP_KERNEL_MATRIX_H
#define ICCP_KERNEL_MATRIX_H

#include "icc/kernel.h"
#include "kernel/sampling/cells.h"
#include "math/elementary.h"
#include "math/symmetric.h"

#include <math.h>

/* Nodes that a thread takes at a time. */
enum { ICCP_NODES_A_TASK = 256 };

/* A radial function of finite reach, of kind `ICC_KERNEL_*`. Its value at 0 is 1. */
typedef struct iccp_radial {
    int32_t kind;
    double sigma, reach;
} iccp_radial;

/* Makes a radial function. `cutoff` is in sigma, for the Gaussian. */
iccp_radial iccp_radial_make(int32_t kind, double sigma, double cutoff);

/* The value at a squared distance below the squared reach, and the derivative with respect to that
 * square. For gradients: k(|x - y|^2) has the derivative 2 k' (x - y). */
static inline double iccp_radial_value(const iccp_radial *radial, double distance2)
{
    if (radial->kind == ICC_KERNEL_GAUSS)
        return iccp_exp(-0.5 * distance2 / (radial->sigma * radial->sigma));
    const double r = sqrt(distance2) / radial->reach, s = (1 - r) * (1 - r);
    return s * s * (4 * r + 1);
}

static inline double iccp_radial_slope(const iccp_radial *radial, double distance2)
{
    if (radial->kind == ICC_KERNEL_GAUSS) {
        const double variance = radial->sigma * radial->sigma;
        return -0.5 / variance * iccp_exp(-0.5 * distance2 / variance);
    }
    const double s = 1 - sqrt(distance2) / radial->reach;
    return -10 * s * s * s / (radial->reach * radial->reach);
}

typedef struct iccp_kernel_matrix {
    iccp_memory memory;
    iccp_symmetric matrix; /* borrows the next four arrays */
    size_t *first;
    uint32_t *column;
    double *value, *diagonal;
} iccp_kernel_matrix;

/* Computes the values between all points of the cells that are nearer than the reach. Returns
 * ICC_ERR_SOLVER if so many are near each other that the matrix would be almost full. */
icc_status iccp_kernel_matrix_create(iccp_kernel_matrix *out, const iccp_cells *cells,
                                     const iccp_radial *radial, const iccp_env *env,
                                     icc_error *err);
void iccp_kernel_matrix_free(iccp_kernel_matrix *matrix);

#endif

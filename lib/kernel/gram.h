/* The kernel function, and the matrix of its values between nodes. */
#ifndef ICCP_GRAM_KERNEL_H
#define ICCP_GRAM_KERNEL_H

#include "kernel/cells.h"
#include "math/symmetric.h"

/* A radial function of finite reach: `ICC_KERNEL_*`. Its value at 0 is 1. */
typedef struct iccp_radial {
    int32_t kind;
    double sigma, reach;
} iccp_radial;

/* The value at a squared distance below the squared reach, and the derivative by that square (for
 * gradients: k(|x - y|^2) has the derivative 2 k' (x - y)). */
double iccp_radial_value(const iccp_radial *radial, double distance2);
double iccp_radial_slope(const iccp_radial *radial, double distance2);

#endif

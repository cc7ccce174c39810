/* Samples of a shape. */
#ifndef ICCP_SAMPLING_H
#define ICCP_SAMPLING_H

#include "kernel/shape.h"

struct icc_sampling {
    iccp_memory memory;
    atomic_size_t references;
    icc_shape *shape;
    double *points;         /* dim each, the caller's coordinates: edge samples first */
    icc_sampling_info info; /* but for `size` */
};

icc_sampling *iccp_sampling_retain(const icc_sampling *sampling);
void iccp_sampling_release(icc_sampling *sampling);

#endif

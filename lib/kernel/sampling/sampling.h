/* Samples of a shape. */
#ifndef ICCP_SAMPLING_H
#define ICCP_SAMPLING_H

#include "kernel/sampling/shape.h"

struct icc_sampling {
    iccp_memory memory;
    atomic_size_t references;
    icc_shape *shape;
    /* n_samples * dim, the caller's coordinates: edge samples first, but for a grid and
     * caller-supplied points, which keep their order. */
    double *points;
    icc_sampling_info info; /* but for `size` */
};

/* See icc_sampling_create(). Options have been read, and checked but for what depends on the
 * shape. */
icc_status iccp_sampling_create(icc_sampling **out, const icc_shape *shape,
                                const icc_sampling_options *options, const iccp_env *env,
                                icc_error *err);

/* Makes the object from samples in the caller's coordinates: checks them, and completes the info,
 * of which kind and spacing (0: their mean spacing) are set. ICC_ERR_RESOLUTION if some region has
 * no sample inside, unless they are the caller's own; then ICC_ERR_OUTSIDE if one is not in the
 * shape. */
icc_status iccp_sampling_finish(icc_sampling **out, const icc_shape *shape, size_t n,
                                const double *points, const icc_sampling_info *info,
                                const iccp_env *env, icc_error *err);

/* See icc_sampling_create_from_points(). The points are finite. */
icc_status iccp_sampling_create_from_points(icc_sampling **out, const icc_shape *shape, size_t n,
                                            const double *points, const iccp_env *env,
                                            icc_error *err);
icc_sampling *iccp_sampling_retain(const icc_sampling *sampling);
void iccp_sampling_release(icc_sampling *sampling);

#endif

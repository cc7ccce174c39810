/* Samples of a shape.
 *
 * Words of this folder, which prepares kernel coordinates. Begin with shape.h, then this
 * file. "Thesis" is Sakaridis, Kernel Coordinates (ETH Zurich 2016).
 * - shape: regions, which are domains, with walls between them, and curves (shape.h).
 * - wall: a facet of a region's boundary. Curves consist of segments.
 * - spot: a point with its region, wall and clearance (shape.h).
 * - clearance: the distance of the nearest wall.
 * - see: a sees b if what is at b may spread to a. This is not symmetric.
 * - sample: a point at which the kernels are centred. Edge samples lie on walls and curves.
 * - spacing: the wanted distance between neighbouring samples.
 * - sigma: the width of the kernel that suits a sampling (spectrum.h).
 * - held: a sample that stays where it is when blue noise is relaxed (blue_noise.h).
 *
 * Ways: sampling_create.c makes samples on a grid (lattice_filter.h) or as blue noise
 * (blue_noise.h). Those on walls and curves: boundary_samples.h, on surfaces surface_samples.c.
 * visibility.c finds spots and what they see, along curves by segment_graph.h. point_list.h and
 * cells.h find neighbours. sampling.c checks the caller's samples; sampling_file.h and shape_file.h
 * have bytes.
 *
 * Invariants: a seed always gives the same samples. Every sample lies in the shape, or within the
 * margin that the caller sets. */
#ifndef ICCP_SAMPLING_H
#define ICCP_SAMPLING_H

#include "kernel/sampling/shape.h"

struct icc_sampling {
    iccp_memory memory;
    atomic_size_t references;
    icc_shape *shape;
    /* n_samples * dim, in the caller's coordinates. Edge samples come first, except on a grid and
     * for the caller's own points, which keep their order. */
    double *points;
    icc_sampling_info info; /* except `size` */
};

/* See icc_sampling_create(). Options have been read, and checked except for what depends on the
 * shape. */
icc_status iccp_sampling_create(icc_sampling **out, const icc_shape *shape,
                                const icc_sampling_options *options, const iccp_env *env,
                                icc_error *err);

/* Makes the object from samples in the caller's coordinates. Checks them and completes the info,
 * whose kind and spacing are set (0: their mean spacing). Returns ICC_ERR_RESOLUTION if a region
 * has no sample inside. For the caller's own samples, returns ICC_ERR_OUTSIDE instead if one is not
 * in the shape. */
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

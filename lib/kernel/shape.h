/* What is to be deformed: regions with walls between them, and curves. All points are the caller's. */
#ifndef ICCP_SHAPE_H
#define ICCP_SHAPE_H

#include "domain/domain.h"
#include "icc/kernel.h"

#define ICCP_NOWHERE UINT32_MAX

struct icc_shape {
    iccp_memory memory;
    atomic_size_t references;
    size_t dim, n_regions, n_vertices, n_segments;
    icc_domain **regions;
    double *vertices;
    uint32_t *segments;
    double lower[3], upper[3]; /* box around everything */
};

/* See icc_shape_create(); arguments have been checked for NULL and dim. */
icc_status iccp_shape_create(icc_shape **out, int32_t dim, size_t n_regions,
                             const icc_domain *const *regions, size_t n_vertices,
                             const double *vertices, size_t n_segments, const uint32_t *segments,
                             const iccp_env *env, icc_error *err);
icc_shape *iccp_shape_retain(const icc_shape *shape);
void iccp_shape_release(icc_shape *shape);

/* The innermost region that a point is in, its boundary included; ICCP_NOWHERE outside all. */
uint32_t iccp_shape_region(const icc_shape *shape, const double *point);

/* Whether a point is in the shape: in a region or, within 1e-9 of the box, on a curve. */
bool iccp_shape_holds(const icc_shape *shape, const double *point);

/* Whether the segment between two points meets no wall but at its ends. Two points of a curve outside all regions
 * see each other if they lie on one segment or on two that meet. */
bool iccp_shape_sees(const icc_shape *shape, const double *a, const double *b);

#endif

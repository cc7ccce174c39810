/* Constrained Delaunay triangulation of a simple polygon with points inside. */
#ifndef ICCP_TRIANGULATE_H
#define ICCP_TRIANGULATE_H

#include "base/env.h"
#include "icc/stages.h"

/* See icc_triangulate(); the points are local (domain/frame.h), their non-zero magnitudes in
 * [2^-200, 2^200]. */
icc_status iccp_triangulate(size_t n_boundary, size_t n_points, const double *points,
                            uint32_t *triangles, const iccp_env *env, icc_error *err);

#endif

/* Linear blend skinning, and transforms of handles. */
#ifndef ICCP_POSE_H
#define ICCP_POSE_H

#include "kernel/weights/binding.h"

/* See icc_binding_pose(). */
icc_status iccp_binding_pose(const icc_binding *binding, const double *transforms, double *images,
                             double *jacobians, const iccp_env *env);

/* See icc_pose_reset() and the functions after it. */
void iccp_pose_reset(size_t dim, size_t n_handles, double *transforms);
void iccp_pose_move(size_t dim, double *transform, const double *offset);
void iccp_pose_turn(size_t dim, double *transform, const double *handle, const double *axis,
                    double angle);

#endif

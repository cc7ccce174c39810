/* Linear blend skinning, and transforms of handles.
 *
 * Words of this folder. Begin with this file; for rigid parts, with rigid.c.
 * - pose: one affine transform for each handle. The image of a point is their mean by the point's
 *   weights.
 * - rest pose: all transforms are the identity.
 * - rigid part: nodes whose weights change as little as possible in space, so that the part keeps
 *   its form.
 * - program: the quadratic program that finds the weights of a rigid part (rigid_program.h).
 * - places: the part's nodes and the free nodes near them. Free nodes may change their weights;
 *   held ones keep them.
 * - slopes: derivatives of the weights at the places, linear in the weights of the free nodes
 *   (rigid_slopes.h).
 * - face: the set of weights that are 0 at present.
 *
 * Ways: pose.c poses points. Rigid parts: rigid_program.h sets up, rigid.c minimises,
 * rigid_hessian.h computes the matrix.
 *
 * Invariants: a pose computes no weights, and a rigid part changes weights but no poses. All
 * results have the same bits for every number of threads. */
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

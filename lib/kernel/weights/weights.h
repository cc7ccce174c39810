/* Weights at single nodes: initial weights, and their optimisation. Arrays of weights are sorted by
 * node, n_handles each.
 *
 * Words of this folder. Begin with this file, then handle_weights.h, which has the object.
 * Numbers in parentheses are equations of Sakaridis, Kernel Coordinates (ETH Zurich 2016), "the
 * thesis".
 * - handle: a point that the caller moves. Each handle has a weight at every point.
 * - node: a point at which weights are stored: handles first, then nodes on lines, then samples
 *   (node_set.h).
 * - reproduce: weights reproduce a point if the handles' combination by them is that point.
 * - kernel, reach: a radial function around each node, and the distance beyond which it is 0
 *   (kernel_matrix.h).
 * - interpolant, coefficients, collocation: kernels plus an affine function that have given values
 *   at the nodes (interpolant.h).
 * - edge, line: a segment between two handles; a segment that must stay straight (rigid_parts.h).
 * - held, free: nodes that keep their weights, and the others.
 * - binding: weights of the caller's points, ready for posing (binding.h).
 *
 * Ways
 * - Start: initial_weights.c. Weights of one point: handles.c, by method nonneg.h (QP; dual.h where
 *   that fails) or l1.h. Lines: straight_lines.c; rigid parts: kernel/pose/rigid.c.
 * - Biharmonic weights, of all nodes at once: kernel/biharmonic/biharmonic.h.
 * - All nodes, and the interpolant: handle_weights.c. Edits: weights_edit.c. Values at points and
 *   their quality: weights_report.c. Bytes: binding_file.c.
 *
 * Invariants: optimised weights sum to 1 and, except biharmonic ones, reproduce their point, up to
 * rounding. With method QP they are not negative unless a status tells otherwise. */
#ifndef ICCP_WEIGHTS_H
#define ICCP_WEIGHTS_H

#include "kernel/sampling/shape.h"
#include "kernel/weights/kernel_matrix.h"

/* Nodes: the handles first, then those on lines, then samples. Points are in local coordinates,
 * like those of the interpolant. */
typedef struct iccp_nodes {
    size_t dim, n, n_handles;
    const double *points; /* dim each, local */
    const double *given;  /* the same points in the caller's coordinates */
    const icc_shape *shape;
    const uint32_t *edge; /* by node: the edge between handles that it lies on, or UINT32_MAX */
    const double *share;  /* and its position on that edge, as a share */
} iccp_nodes;

/* Computes (4.10), with p a tenth of the longest side of the handles' box, as in the thesis'
 * example. At the handles, weights are 1 and 0. */
void iccp_initial_inverse(const iccp_nodes *nodes, double *weights);

/* Diffusion by Markov steps. Each node takes the mean of its neighbours and itself, weighted by the
 * kernel, whose values between nodes are in `matrix`. This is (4.11) to (4.13), but rows sum to 1,
 * because the printed constant diverges on irregular samples. Handles keep the values that they
 * have in `weights`, and so do nodes on edges if `edges`. The others start from there. With
 * `visible`, only neighbours that see each other take part. */
icc_status iccp_diffuse(const iccp_nodes *nodes, const iccp_symmetric *matrix, int32_t steps,
                        bool edges, bool visible, double *weights, const iccp_env *env);

/* The constraints that handles set for the weights of a point. The rows of A are ones and the
 * handles' coordinates (dim + 1 by m). The object also holds what depends only on A. */
typedef struct iccp_handles iccp_handles;

/* Returns ICC_ERR_ARGUMENT if the handles lie in a plane (2-D: on a line), because they cannot
 * reproduce points then. */
icc_status iccp_handles_create(iccp_handles **out, size_t dim, size_t m, const double *points,
                               const iccp_env *env, icc_error *err);
void iccp_handles_free(iccp_handles *handles);

/* Removes from a change of m weights, one for each handle, whatever would alter sums or
 * reproduction. Unless `bounded` is NULL, also removes changes where these m weights are not
 * positive. */
void iccp_handles_project(const iccp_handles *handles, const double *bounded, double *change);

/* Returns the doubles of workspace that iccp_optimise() needs. */
size_t iccp_optimise_work(const iccp_handles *handles);

/* Replaces the weights of one point by those of the method (`ICC_WEIGHTS_*`). Returns ICC_OK, or
 * ICC_ERR_SOLVER if every solution has negative weights and QP was relaxed. Biharmonic weights are
 * not found point by point, so they are only made to sum to 1, see iccp_share_out(). */
icc_status iccp_optimise(const iccp_handles *handles, int32_t method, const double *point,
                         double *weights, double *work);

#endif

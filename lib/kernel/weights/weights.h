/* Weights at single nodes: where they start from and what is optimised. All arrays of weights are
 * node after node, n_handles each. */
#ifndef ICCP_WEIGHTS_H
#define ICCP_WEIGHTS_H

#include "kernel/sampling/shape.h"
#include "kernel/weights/kernel_matrix.h"

/* Nodes: the handles first, then those on lines, then samples. Points are in local coordinates,
 * which the interpolant works in, too; the shape knows the caller's. */
typedef struct iccp_nodes {
    size_t dim, n, n_handles;
    const double *points; /* dim each */
    const double *given;  /* the same in the caller's coordinates */
    const icc_shape *shape;
    const uint32_t *edge; /* of each node: the edge between handles that it lies on, or
                             UINT32_MAX */
    const double *share;  /* and how far along it that is */
} iccp_nodes;

/* (4.10), with p a tenth of the longest side of the handles' box, as in the thesis' example. At the
 * handles 1 and 0. */
void iccp_initial_inverse(const iccp_nodes *nodes, double *weights);

/* Diffusion by Markov steps: each node takes the mean of its neighbours, weighted by the kernel
 * (`matrix` has its values between nodes), itself included (4.11 to 4.13, with rows that sum to 1:
 * the printed constant diverges on irregular samples). Handles are held, and nodes on edges if
 * `edges`, at the values that they have in `weights`; the others start from there. `visible`: only
 * neighbours that see each other take part. */
icc_status iccp_diffuse(const iccp_nodes *nodes, const iccp_symmetric *matrix, int32_t steps,
                        bool edges, bool visible, double *weights, const iccp_env *env);

/* Handles as the weights of one point are constrained by them: rows of A are the handles'
 * coordinates and ones (dim + 1 by m), with what is needed again and again. */
typedef struct iccp_handles iccp_handles;

/* ICC_ERR_ARGUMENT when the handles lie in a plane (2-D: on a line): they cannot reproduce
 * points. */
icc_status iccp_handles_create(iccp_handles **out, size_t dim, size_t m, const double *points,
                               const iccp_env *env, icc_error *err);
void iccp_handles_free(iccp_handles *handles);

/* Takes from m numbers, one for each handle, what would change sums or reproduction as a change of
 * weights; and, unless `bounded` is NULL, where these m weights are not positive. */
void iccp_handles_project(const iccp_handles *handles, const double *bounded, double *change);

/* Doubles of scratch memory that iccp_optimise() needs. */
size_t iccp_optimise_work(const iccp_handles *handles);

/* Replaces the weights of one point by those that the method (`ICC_WEIGHTS_*`) makes of them.
 * ICC_OK, or ICC_ERR_SOLVER when there are none without negative ones and QP was relaxed. */
icc_status iccp_optimise(const iccp_handles *handles, int32_t method, const double *point,
                         double *weights, double *work);

#endif

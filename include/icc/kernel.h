/**
 * @file icc/kernel.h
 * @brief Kernel coordinates: smooth blending weights for handles, without a mesh.
 *
 *     icc_shape (filled regions and curves, in 2-D or 3-D)
 *       -> icc_sampling (points spread over it)
 *         -> icc_weights (handles, and a weight of every handle at every sample)
 *           -> icc_binding (weights at caller-supplied points, kept for repeated poses)
 *
 * The weights are optimised at each sample on its own: they sum to 1 and reproduce the sample from
 * the handles' positions. Between the samples they are interpolated by a sum of kernels. A pose is
 * an affine transform per handle; a point goes to the weighted mean of its images under these
 * transforms (linear blend skinning).
 *
 * Nothing here is certified to be one-to-one, and weights between samples can be slightly negative:
 * icc_weights_get_report() measures how much. For maps that are one-to-one see icc/map.h.
 *
 * Objects are immutable: painting, rigid parts and other methods make new objects, which share what
 * has not changed. The rules of icc/icc.h apply: `*out` is NULL on failure, `env` and `err` may be
 * NULL, zero in an option means the default.
 *
 * Source: Sakaridis, Kernel Coordinates (ETH Zurich 2016); equation numbers are that thesis'.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ICC_KERNEL_H
#define ICC_KERNEL_H

#include <icc/map.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------- shape */

/** What is to be deformed: filled regions and curves. */
typedef struct icc_shape icc_shape;

/**
 * Makes a shape from regions and curves, which may be mixed.
 *
 * Regions are domains. Their boundaries must not meet, which is checked exactly. One may lie within
 * another: the boundaries are walls between them. A point belongs to the innermost region around
 * it; a point on a boundary belongs to what that boundary encloses. So a star in a square is a star
 * and its surroundings. Curves are segments between vertices; they may lie anywhere, and are not
 * walls. Weights spread across a boundary only outward, from what it encloses to what surrounds it:
 * so they do not take a short cut through the surroundings from one limb to another.
 * A sheet in space is given by curves: the edges of its triangles, about as long as the spacing of
 * the samples will be.
 *
 * @param[out] out   the shape; owned by the caller. It keeps the regions alive.
 * @param dim        2 or 3
 * @param n_regions  regions; 0 for curves alone
 * @param regions    n_regions domains of dimension `dim`
 * @param n_vertices vertices of the curves
 * @param vertices   n_vertices * dim coordinates
 * @param n_segments segments of the curves
 * @param segments   n_segments * 2 vertex indices
 * @param env        may be NULL
 * @param err        may be NULL; `index` is the region, vertex or segment at fault
 * @return ::ICC_OK, ::ICC_ERR_ARGUMENT (no region and no segment, a vertex that is not finite or
 *         not there, a segment without length), ::ICC_ERR_MEMORY, ::ICC_ERR_BOUNDARY (boundaries
 *         meet), ::ICC_ERR_VERSION, ::ICC_ERR_CANCELLED
 */
ICC_API icc_status icc_shape_create(icc_shape **out, int32_t dim, size_t n_regions,
                                    const icc_domain *const *regions, size_t n_vertices,
                                    const double *vertices, size_t n_segments,
                                    const uint32_t *segments, const icc_env *env, icc_error *err);

/** Frees a shape. */
ICC_API void icc_shape_free(icc_shape *shape);

/* ---------------------------------------------------------------- sampling */

/** Points spread over a shape. */
typedef struct icc_sampling icc_sampling;

/** How samples are spread. */
enum {
    ICC_SAMPLING_GRID = 1,  /**< a regular grid from the lower corner of the regions' box, the first
                                 axis fastest */
    ICC_SAMPLING_BLUE = 2,  /**< blue noise: random but evenly spaced, also on boundaries and
                                 curves */
    ICC_SAMPLING_POINTS = 3 /**< the caller's points: icc_sampling_create_from_points() only */
};

/** Options of icc_sampling_create(). */
typedef struct icc_sampling_options {
    size_t size;         /**< set by the caller: `sizeof(icc_sampling_options)` */
    int32_t kind;        /**< `ICC_SAMPLING_*`; 0: blue */
    int32_t steps;       /**< blue: steps of relaxation (inverse mean shift); 0: 60; -1: none */
    double spacing;      /**< T, the distance of neighbours; 0: 1/100 of the longest side, in 3-D
                              1/20, where half the spacing costs 60 times as much */
    double margin;       /**< grid: how far it extends beyond the regions, in spacings; 0: not at
                              all */
    uint64_t seed;       /**< blue: of the random numbers; equal seeds give equal samplings */
    size_t n_fixed;      /**< points that must be samples */
    const double *fixed; /**< n_fixed * dim coordinates, or NULL. Blue only. */
} icc_sampling_options;

/** What icc_sampling_get_info() reports. */
typedef struct icc_sampling_info {
    size_t size;      /**< set by the caller: `sizeof(icc_sampling_info)` */
    int32_t dim;      /**< dimension */
    int32_t kind;     /**< `ICC_SAMPLING_*` */
    size_t n_samples; /**< samples */
    size_t n_edge;    /**< samples on boundaries and curves; with blue noise these come first */
    double spacing;   /**< T as requested; for caller-supplied points the mean distance of nearest
                           neighbours */
    double nearest;   /**< the least distance of two samples, over T */
    double sigma;     /**< suggested width of the kernel: from the samples' spectrum (figure 6.10);
                           3 T / pi for a grid (3.28) and for caller-supplied points */
} icc_sampling_info;

/**
 * Spreads samples over a shape. No sample ends up on the wrong side of a wall.
 *
 * Blue noise: boundaries and curves get fixed samples about T apart, at their ends, forks and
 * corners first. The others start from a jittered lattice and are relaxed (6.4), no nearer to a
 * boundary than 0.4 T. Fixed points stay where they are; samples on boundaries make room for them.
 *
 * @param[out] out the sampling; owned by the caller. It keeps the shape alive.
 * @param shape    the shape
 * @param options  may be NULL
 * @param env      may be NULL
 * @param err      may be NULL
 * @return ::ICC_OK, ::ICC_ERR_RESOLUTION (no sample lies inside some region, which `err` names, or
 *         there would be more than 2^24), ::ICC_ERR_OUTSIDE (a fixed point is in no region),
 *         ::ICC_ERR_ARGUMENT (a grid for curves alone, a fixed point that is not finite, ...),
 *         ::ICC_ERR_MEMORY, ::ICC_ERR_VERSION, ::ICC_ERR_CANCELLED
 *
 * Cost: O(steps * n) time and O(n) memory: 10,000 samples take less than a second.
 */
ICC_API icc_status icc_sampling_create(icc_sampling **out, const icc_shape *shape,
                                       const icc_sampling_options *options, const icc_env *env,
                                       icc_error *err);

/**
 * Makes a sampling from caller-supplied points, which keep their order. The suggested width follows
 * from their mean spacing.
 *
 * @return ::ICC_OK, ::ICC_ERR_OUTSIDE (a point, given by `index`, lies in no region and on no
 *         curve), ::ICC_ERR_ARGUMENT (not finite, or two points are the same), ::ICC_ERR_MEMORY
 */
ICC_API icc_status icc_sampling_create_from_points(icc_sampling **out, const icc_shape *shape,
                                                   size_t n, const double *points,
                                                   const icc_env *env, icc_error *err);

/** Frees a sampling. */
ICC_API void icc_sampling_free(icc_sampling *sampling);

/** Fills in `info`, whose `size` the caller has set. ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_sampling_get_info(const icc_sampling *sampling, icc_sampling_info *info);

/** Copies the samples: room for n_samples * dim doubles. ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_sampling_get_points(const icc_sampling *sampling, double *points);

/**
 * Writes a sampling and its shape to memory. Call it twice: with capacity 0 for the number of
 * bytes, then with a buffer of that size. The format (docs/reference/formats.md) is
 * versioned, the same on every machine, and has a checksum.
 *
 * @param sampling      the sampling
 * @param capacity      bytes that `data` has room for
 * @param[out] data     NULL when capacity is 0
 * @param[out] n_bytes  bytes that are needed, also beyond `capacity`: nothing useful is written
 *                      then
 */
ICC_API icc_status icc_sampling_save(const icc_sampling *sampling, size_t capacity, void *data,
                                     size_t *n_bytes);

/** Reads a sampling back, bit for bit. ::ICC_ERR_FORMAT for anything that icc_sampling_save() did
 *  not write, ::ICC_ERR_VERSION for what a later version wrote; any bytes are safe to pass. */
ICC_API icc_status icc_sampling_load(icc_sampling **out, size_t n_bytes, const void *data,
                                     const icc_env *env, icc_error *err);

/* ----------------------------------------------------------------- weights */

/** Handles, and the weight of each handle everywhere in a shape. */
typedef struct icc_weights icc_weights;

/** The kernel that is summed up. */
enum {
    ICC_KERNEL_WENDLAND = 1, /**< Wendland's C2 function of radius 3 sigma: smooth, and positive
                                  definite at any width */
    ICC_KERNEL_GAUSS = 2     /**< the thesis's kernel: exp(-d^2 / (2 sigma^2)), cut off at `cutoff`
                                  sigma, where it jumps; not always positive definite */
};

/** Where the weights start from. */
enum {
    ICC_INITIAL_HEAT = 1,    /**< diffusion of an impulse at each handle (4.11, 4.12) */
    ICC_INITIAL_EDGES = 2,   /**< diffusion, with weights that are linear along the edges held (4.7,
                                  4.13) */
    ICC_INITIAL_INVERSE = 3, /**< inverse squared distance to the handles (4.10), p a tenth of their
                                  extent */
    ICC_INITIAL_GIVEN = 4    /**< the caller's */
};

/** What is minimised at each sample, on the conditions that weights sum to 1 and reproduce the
 *  sample. */
enum {
    ICC_WEIGHTS_QP = 1,       /**< least change of the initial weights, none negative (4.1) */
    ICC_WEIGHTS_EQUALITY = 2, /**< least change, of any sign (4.2 to 4.6) */
    ICC_WEIGHTS_L1 = 3        /**< least sum of absolute changes (4.8); of several solutions the one
                                   with the least sum of squared changes */
};

/**
 * A segment along which weights are linear: what lies on it stays straight (5.6). It has nodes at
 * both ends and between them, one spacing apart or a little less; nodes beside it follow it, nearer
 * ones more closely. For the best spacing, make the sampling with these places as fixed points.
 *
 * An end may be a handle, or an end of an earlier line. Lines should not cross: where a line comes
 * near an earlier one, or a handle, the earlier line or the handle prevails. The weights of a
 * parallel line follow from those of the other line and can be negative; nodes beside it keep
 * theirs, so between its nodes such a line is straight only to a few hundredths.
 */
typedef struct icc_line {
    double from[3];   /**< one end, in the shape; at least half a spacing away from the other */
    double to[3];     /**< the other */
    int32_t parallel; /**< 0, or k to stay parallel to line k - 1, an earlier one (5.11). It must be
                           parallel to 1e-9 of its length, and `to` must be neither a handle nor on
                           an earlier line */
} icc_line;

/** Options of icc_weights_create(). */
typedef struct icc_weights_options {
    size_t size;           /**< set by the caller: `sizeof(icc_weights_options)` */
    int32_t kernel;        /**< `ICC_KERNEL_*`; 0: Wendland */
    int32_t initial;       /**< `ICC_INITIAL_*`; 0: edges if there are any, else heat */
    int32_t method;        /**< `ICC_WEIGHTS_*`; 0: QP */
    int32_t steps;         /**< of diffusion; 0: 5 */
    int32_t affine_tail;   /**< an affine function added to the kernels, which makes sums and
                                reproduction exact between the samples: 0 or 1 with, -1 without (as
                                in the thesis) */
    int32_t within_shape;  /**< 0 or 1: diffusion only between samples that see each other inside
                                the shape; -1: through walls, too (as in the thesis) */
    double sigma;          /**< width of the kernel; 0: icc_sampling_info::sigma */
    double cutoff;         /**< Gauss: in sigma; 0: 5 */
    size_t n_edges;        /**< edges between handles */
    const uint32_t *edges; /**< n_edges * 2 handle indices, or NULL */
    size_t n_lines;        /**< lines to keep straight */
    const icc_line *lines; /**< or NULL */
    const double *initial_weights; /**< n_samples * n_handles, sample after sample; for initial
                                        given */
} icc_weights_options;

/** What icc_weights_get_info() reports. */
typedef struct icc_weights_info {
    size_t size;         /**< set by the caller: `sizeof(icc_weights_info)` */
    int32_t dim;         /**< dimension */
    int32_t kernel;      /**< `ICC_KERNEL_*` */
    int32_t initial;     /**< `ICC_INITIAL_*` */
    int32_t method;      /**< `ICC_WEIGHTS_*` */
    size_t n_handles;    /**< handles */
    size_t n_nodes;      /**< places that carry weights: first the handles, then places on lines,
                                 then the samples, except those within half a spacing of a handle or
                                 a line's node */
    size_t n_infeasible; /**< QP: nodes that no non-negative weights reproduce (outside the
                                 handles' convex hull): QP is relaxed there, the sums still hold */
    size_t n_entries;    /**< kernel values of the matrix, diagonal included, one triangle */
    double sigma;        /**< width of the kernel */
    double definiteness; /**< how far the matrix is from losing positive definiteness: its least
                                 pivot over the greatest */
    double residual;     /**< of icc_weights_stiffen(), if that made these weights: how far they
                                 are from its program's optimality conditions, as the step that is
                                 still possible down the energy's projected gradient, over the one
                                 at the start; else 0 */
} icc_weights_info;

/** How long each step of making weights took, in seconds: what icc_weights_get_timings() fills in.
 *  Weights that were made from others have the steps that were done again; the other members are
 *  those of the weights before. */
typedef struct icc_weights_timings {
    size_t size;     /**< set by the caller: `sizeof(icc_weights_timings)` */
    double factor;   /**< placing the nodes, and the factorisation */
    double initial;  /**< the initial weights */
    double optimise; /**< the optimisation */
} icc_weights_timings;

/**
 * Makes weights for handles.
 *
 * @param[out] out   the weights; owned by the caller. They keep the sampling alive.
 * @param sampling   the samples
 * @param n_handles  handles, at least dim + 1
 * @param handles    n_handles * dim coordinates, in the shape, not all in one plane (2-D: line)
 * @param options    may be NULL
 * @param env        may be NULL
 * @param err        may be NULL; `index` is the handle, edge or line at fault
 * @return ::ICC_OK; ::ICC_ERR_OUTSIDE (a handle or line outside the shape); ::ICC_ERR_ARGUMENT (two
 *         handles at one place, handles that cannot reproduce points, weights that are not finite,
 *         ...); ::ICC_ERR_SOLVER (sigma is too large for a positive definite matrix);
 *         ::ICC_ERR_MEMORY, ::ICC_ERR_VERSION, ::ICC_ERR_CANCELLED
 *
 * Cost with n nodes, m handles and k neighbours within the kernel's reach: O(steps n k m) for
 * diffusion, O(n m) for the weights, and a sparse factorisation, O(n^1.5) in 2-D.
 */
ICC_API icc_status icc_weights_create(icc_weights **out, const icc_sampling *sampling,
                                      size_t n_handles, const double *handles,
                                      const icc_weights_options *options, const icc_env *env,
                                      icc_error *err);

/** Frees weights. */
ICC_API void icc_weights_free(icc_weights *weights);

/** Fills in `info`, whose `size` the caller has set. ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_weights_get_info(const icc_weights *weights, icc_weights_info *info);

/** Fills in `timings`, whose `size` the caller has set. ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_weights_get_timings(const icc_weights *weights,
                                           icc_weights_timings *timings);

/**
 * Copies the nodes.
 *
 * @param weights      the weights
 * @param[out] points  n_nodes * dim coordinates, or NULL
 * @param[out] initial n_nodes * n_handles initial weights, or NULL
 * @param[out] values  n_nodes * n_handles weights, or NULL
 * @param[out] status  n_nodes statuses: ::ICC_OK, or ::ICC_ERR_SOLVER where QP was relaxed; or NULL
 */
ICC_API icc_status icc_weights_get_nodes(const icc_weights *weights, double *points,
                                         double *initial, double *values, icc_status *status);

/**
 * Paints: adds amount * brush to the weight of one handle at the nodes around a place, and
 * optimises them again from there. The brush falls smoothly from 1 at the centre to 0 at the
 * radius. Handles, nodes on lines and nodes on edges that are held stay as they are.
 *
 * @param[out] out new weights at the same nodes; owned by the caller. The old ones do not
 *                 change.
 * @param weights  the weights to change
 * @param handle   whose weight
 * @param centre   dim coordinates
 * @param radius   positive
 * @param amount   positive or negative
 * @param env      may be NULL
 * @param err      may be NULL
 *
 * Cost: one optimisation for each node within the radius, and one solution with the existing
 * factor.
 */
ICC_API icc_status icc_weights_paint(icc_weights **out, const icc_weights *weights, size_t handle,
                                     const double *centre, double radius, double amount,
                                     const icc_env *env, icc_error *err);

/**
 * The same with given weights: at node nodes[i] they start from values[i * n_handles ...] and
 * are optimised again. No node may be named twice.
 */
ICC_API icc_status icc_weights_repaint(icc_weights **out, const icc_weights *weights, size_t n,
                                       const uint32_t *nodes, const double *values,
                                       const icc_env *env, icc_error *err);

/** The same nodes and initial weights with another method (`ICC_WEIGHTS_*`): painting and
 *  stiffening are lost, as in the thesis (6.3.1). */
ICC_API icc_status icc_weights_with_method(icc_weights **out, const icc_weights *weights,
                                           int32_t method, const icc_env *env, icc_error *err);

/**
 * Makes weights vary as little as possible over a part of the shape, so that it moves as if it were
 * rigid (5.12 to 5.35, with the sign of 5.35a corrected). One quadratic program for the weights at
 * the part's nodes and at those around it, within the kernel's reach: least is half the sum of
 * squared derivatives at the part's nodes, weighted by `rigidity`, and of a tenth (times the mean
 * rigidity) of those of the change around it. Sums and reproduction hold; handles, nodes on edges
 * and on lines, and all nodes further away keep their weights; with QP no weight becomes negative
 * at a node where none was. That is all that is asked, and the weights are the best that it leaves:
 * the residual of the optimality conditions is at most 1e-8 (icc_weights_info::residual), the
 * program's value within 1e-6 of its least.
 *
 * @param[out] out  new weights; owned by the caller
 * @param weights   the weights to change
 * @param n         nodes of the part
 * @param nodes     their indices
 * @param rigidity  n positive numbers, how much each node matters; NULL: all equal
 * @param energy    half the weighted sum of squared derivatives at the part's nodes, before and
 *                  after; or NULL
 * @param env       may be NULL
 * @param err       may be NULL
 * @return ::ICC_OK; ::ICC_ERR_ARGUMENT (a node that is not there or named twice, a rigidity that is
 *         not positive); ::ICC_ERR_SOLVER (not solved within the limit of steps); ::ICC_ERR_MEMORY,
 *         ::ICC_ERR_CANCELLED
 *
 * Cost: some hundred steps, more for longer parts, each a product with a matrix of these nodes or,
 * where that is large, two solves with the part of the factor that they need. Memory: nine numbers
 * for each of their weights, two for each of all weights; for the matrix at most sixteen for each
 * pair of nodes within the kernel's reach.
 */
ICC_API icc_status icc_weights_stiffen(icc_weights **out, const icc_weights *weights, size_t n,
                                       const uint32_t *nodes, const double *rigidity,
                                       double energy[2], const icc_env *env, icc_error *err);

/**
 * Evaluates weights at points. Returns ::ICC_OK even if every point failed: see `status` and
 * `n_failed`.
 *
 * @param weights        the weights
 * @param n              number of points
 * @param points         n * dim coordinates. Any finite point has weights; far from all nodes they
 *                       are those of the affine tail, or 0 without.
 * @param[out] values    n * n_handles weights
 * @param[out] gradients n * n_handles * dim derivatives, or NULL (3.44)
 * @param[out] status    n statuses: ::ICC_OK, ::ICC_ERR_ARGUMENT (not finite; its values are NaN);
 *                       or NULL
 * @param[out] n_failed  how many points have no weights, or NULL
 * @param env            may be NULL
 */
ICC_API icc_status icc_weights_evaluate(const icc_weights *weights, size_t n, const double *points,
                                        double *values, double *gradients, icc_status *status,
                                        size_t *n_failed, const icc_env *env);

/**
 * The dual function of a node (3.2): the interpolant that is 1 there and 0 at all other nodes.
 * Weights are the sum of these functions, each times the weights at its node. With the affine tail
 * they sum to 1 and reproduce points.
 *
 * @param weights     any weights on the nodes: only nodes, kernel and tail count
 * @param node        which, as in icc_weights_get_nodes()
 * @param n           number of points
 * @param points      n * dim coordinates
 * @param[out] values n numbers
 * @param env         may be NULL
 * @param err         may be NULL
 * @return ::ICC_OK; ::ICC_ERR_ARGUMENT (no such node, a point that is not finite);
 *         ::ICC_ERR_MEMORY, ::ICC_ERR_CANCELLED
 *
 * Cost: one solution with the existing factor, and an evaluation for each point.
 */
ICC_API icc_status icc_weights_get_dual(const icc_weights *weights, size_t node, size_t n,
                                        const double *points, double *values, const icc_env *env,
                                        icc_error *err);

/** How good weights are, measured at caller-supplied points. */
typedef struct icc_weights_report {
    size_t size;              /**< set by the caller: `sizeof(icc_weights_report)` */
    size_t n_infeasible;      /**< see icc_weights_info::n_infeasible */
    size_t n_negative;        /**< points where a weight is below -1e-9 */
    double unity;             /**< the greatest deviation of the sum of weights from 1 */
    double reproduction;      /**< the greatest distance of a point from the weighted mean of the
                                   handles */
    double reproduction_mean; /**< the mean of these */
    double lagrange;          /**< the greatest deviation from 1 and 0 at the handles */
    double linearity;         /**< the greatest deviation from linear weights along the edges */
    double least_weight;      /**< the least weight */
    double definiteness;      /**< see icc_weights_info::definiteness */
} icc_weights_report;

/** Measures the weights at n points (n * dim coordinates). The report's `size` is set by the
 *  caller. */
ICC_API icc_status icc_weights_get_report(const icc_weights *weights, size_t n,
                                          const double *points, icc_weights_report *report,
                                          const icc_env *env, icc_error *err);

/* ----------------------------------------------------------------- binding */

/** Points with their weights, and derivatives if requested: for repeated poses. */
typedef struct icc_binding icc_binding;

/**
 * Binds points to handles.
 *
 * @param[out] out    the binding; owned by the caller. It does not need the weights any more.
 * @param weights     the weights
 * @param n           number of points
 * @param points      n * dim coordinates, finite
 * @param derivatives 1: poses have Jacobians, which takes dim * n_handles more doubles a point
 * @param env         may be NULL
 * @param err         may be NULL
 */
ICC_API icc_status icc_binding_create(icc_binding **out, const icc_weights *weights, size_t n,
                                      const double *points, int32_t derivatives, const icc_env *env,
                                      icc_error *err);

/** Frees a binding. */
ICC_API void icc_binding_free(icc_binding *binding);

/** The binding's numbers: points, handles, dimension; each may be NULL. */
ICC_API icc_status icc_binding_get_counts(const icc_binding *binding, size_t *n_points,
                                          size_t *n_handles, int32_t *dim);

/** Copies the handles' positions, n_handles * dim, and the weights, n_points * n_handles; each may
 *  be NULL. */
ICC_API icc_status icc_binding_get_weights(const icc_binding *binding, double *handles,
                                           double *weights);

/**
 * Poses the points: x -> sum of w_j(x) (A_j x + b_j) (3.37), computed as x + sum of w_j(x) (A_j x
 * + b_j - x): the same where weights sum to 1, and the rest pose is exact.
 *
 * @param binding        the binding
 * @param transforms     n_handles * dim * (dim + 1): per handle the rows of (A | b)
 * @param[out] images    n * dim coordinates
 * @param[out] jacobians n * dim * dim derivatives of the images by the points, or NULL; unless
 *                       NULL, the binding must have derivatives
 * @param env            may be NULL
 * @return ::ICC_OK, ::ICC_ERR_ARGUMENT (a transform is not finite), ::ICC_ERR_UNSUPPORTED (no
 *         derivatives), ...
 */
ICC_API icc_status icc_binding_pose(const icc_binding *binding, const double *transforms,
                                    double *images, double *jacobians, const icc_env *env);

/** As icc_sampling_save(). */
ICC_API icc_status icc_binding_save(const icc_binding *binding, size_t capacity, void *data,
                                    size_t *n_bytes);

/** As icc_sampling_load(). */
ICC_API icc_status icc_binding_load(icc_binding **out, size_t n_bytes, const void *data,
                                    const icc_env *env, icc_error *err);

/* ------------------------------------------------------------------- poses */

/** Writes the rest pose, n_handles identities, to `transforms` (see icc_binding_pose()). */
ICC_API icc_status icc_pose_reset(int32_t dim, size_t n_handles, double *transforms);

/** Moves one handle: adds `offset`, dim numbers, to its transform. */
ICC_API icc_status icc_pose_move(int32_t dim, double *transform, const double *offset);

/**
 * Rotates a handle about the place its transform has taken it to.
 *
 * @param dim       2 or 3
 * @param transform the handle's, dim * (dim + 1) numbers
 * @param handle    the handle's position at rest, dim coordinates
 * @param axis      3-D: 3 numbers, not all 0; 2-D: ignored
 * @param angle     in radians, counter-clockwise (y upwards; 3-D: seen from the axis' tip)
 */
ICC_API icc_status icc_pose_turn(int32_t dim, double *transform, const double *handle,
                                 const double *axis, double angle);

#ifdef __cplusplus
}
#endif

#endif

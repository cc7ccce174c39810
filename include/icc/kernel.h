/**
 * @file icc/kernel.h
 * @brief Kernel coordinates: smooth blending weights for handles, without a mesh.
 *
 *     icc_shape (filled regions and curves, in 2-D or 3-D)
 *       -> icc_sampling (points spread over the shape)
 *         -> icc_weights (handles, and a weight of every handle at every sample)
 *           -> icc_binding (the weights at your points, kept for repeated poses)
 *
 * A *handle* is a point that you move, turn or transform. A *weight* says how much a handle moves a
 * point. The weights are optimised at each sample separately: they sum to 1, and the mean of the
 * handles weighted by them is the sample. Between the samples they are interpolated by a sum of
 * kernels. A *pose* is an affine transform per handle. It takes a point to the weighted mean of its
 * images under these transforms (linear blend skinning).
 *
 * These deformations are not certified to be one-to-one, and weights between samples can be
 * slightly negative. icc_weights_get_report() measures how much. For maps that are one-to-one see
 * icc/map.h.
 *
 * Objects are immutable. Painting, rigid parts and other methods make new objects, which share what
 * has not changed. The rules of icc/icc.h apply: `*out` is NULL on failure, `env` and `err` may be
 * NULL, and zero in an option means the default.
 *
 * Source: Sakaridis, Kernel Coordinates (ETH Zurich 2016). Numbers in brackets, such as (4.1), are
 * equations and sections of that thesis.
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

/** The shape to be deformed: filled regions and curves. */
typedef struct icc_shape icc_shape;

/**
 * Makes a shape from regions and curves, which may be mixed.
 *
 * *Regions* are domains. Their boundaries must not meet, which is checked exactly. One region may
 * lie within another. A point belongs to the innermost region around it, and a point on a boundary
 * belongs to the region that the boundary encloses. For example, a star in a square makes two
 * regions: the star and its surroundings.
 *
 * Boundaries are walls. Weights spread across a wall only outward, from the enclosed region to its
 * surroundings. So they take no short cut through the surroundings from one limb to another.
 *
 * *Curves* are segments between vertices. They may lie anywhere and are not walls. A sheet in space
 * is given by the edges of its triangles, each about as long as the spacing of the samples.
 *
 * @param[out] out   the shape; owned by the caller. It keeps the regions alive
 * @param dim        2 or 3
 * @param n_regions  number of regions; 0 for curves alone
 * @param regions    n_regions domains of dimension `dim`
 * @param n_vertices number of vertices of the curves
 * @param vertices   n_vertices * dim coordinates
 * @param n_segments number of segments of the curves
 * @param segments   n_segments * 2 vertex indices
 * @param env        may be NULL
 * @param err        may be NULL; `index` is the region, vertex or segment at fault
 * @return ::ICC_OK, or
 * - ::ICC_ERR_ARGUMENT if there is no region and no segment, a vertex is not finite or does not
 *   exist, or a segment has no length
 * - ::ICC_ERR_BOUNDARY if boundaries meet
 * - ::ICC_ERR_MEMORY, ::ICC_ERR_VERSION or ::ICC_ERR_CANCELLED
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
    /** a regular grid that starts at the lower corner of the regions' box, the first axis
     *  fastest */
    ICC_SAMPLING_GRID = 1,
    /** blue noise: random but evenly spaced, also on boundaries and curves */
    ICC_SAMPLING_BLUE = 2,
    ICC_SAMPLING_POINTS = 3 /**< your own points: icc_sampling_create_from_points() only */
};

/** Options of icc_sampling_create(). */
typedef struct icc_sampling_options {
    size_t size;   /**< set by the caller: `sizeof(icc_sampling_options)` */
    int32_t kind;  /**< `ICC_SAMPLING_*`; 0: blue */
    int32_t steps; /**< blue: steps of relaxation (inverse mean shift); 0: 60; -1: none */
    /** T, the distance between neighbours. 0: 1/100 of the longest side, in 3-D 1/20. In 3-D
     *  half the spacing costs 60 times as much */
    double spacing;
    /** grid: how far it extends beyond the regions, in spacings; 0: not at all */
    double margin;
    uint64_t seed;       /**< blue: seed of the random numbers; equal seeds give equal samplings */
    size_t n_fixed;      /**< number of points that must be samples */
    const double *fixed; /**< blue: n_fixed * dim coordinates, or NULL */
} icc_sampling_options;

/** What icc_sampling_get_info() reports. */
typedef struct icc_sampling_info {
    size_t size;      /**< set by the caller: `sizeof(icc_sampling_info)` */
    int32_t dim;      /**< dimension */
    int32_t kind;     /**< `ICC_SAMPLING_*` */
    size_t n_samples; /**< number of samples */
    size_t n_edge;    /**< samples on boundaries and curves; with blue noise these come first */
    /** T as requested; for your own points the mean distance of nearest neighbours */
    double spacing;
    double nearest; /**< smallest distance between two samples, divided by T */
    /** suggested width of the kernel, from the samples' spectrum (figure 6.10). For a grid
     *  (3.28) and for your own points it is 3 T / pi */
    double sigma;
} icc_sampling_info;

/**
 * Spreads samples over a shape. No sample ends up on the wrong side of a wall.
 *
 * With blue noise, boundaries and curves first get fixed samples about T apart, starting with their
 * ends, forks and corners. The other samples start from a jittered lattice and are relaxed (6.4),
 * but stay at least 0.4 T away from boundaries. Fixed points stay where they are, and samples on
 * boundaries make room for them.
 *
 * @param[out] out the sampling; owned by the caller. It keeps the shape alive
 * @param shape    the shape
 * @param options  may be NULL
 * @param env      may be NULL
 * @param err      may be NULL
 * @return ::ICC_OK, or
 * - ::ICC_ERR_RESOLUTION if no sample lies inside some region, which `err` names, or there would be
 *   more than 2^24 samples
 * - ::ICC_ERR_OUTSIDE if a fixed point is in no region
 * - ::ICC_ERR_ARGUMENT, for example for a grid on curves alone or a fixed point that is not finite
 * - ::ICC_ERR_MEMORY, ::ICC_ERR_VERSION or ::ICC_ERR_CANCELLED
 *
 * Cost: O(steps * n) time and O(n) memory; 10,000 samples take less than a second.
 */
ICC_API icc_status icc_sampling_create(icc_sampling **out, const icc_shape *shape,
                                       const icc_sampling_options *options, const icc_env *env,
                                       icc_error *err);

/**
 * Makes a sampling from your own points, which keep their order. The suggested width follows from
 * their mean spacing.
 *
 * @return ::ICC_OK, or
 * - ::ICC_ERR_OUTSIDE if a point, given by `index`, lies in no region and on no curve
 * - ::ICC_ERR_ARGUMENT if a point is not finite or two points coincide
 * - ::ICC_ERR_MEMORY
 */
ICC_API icc_status icc_sampling_create_from_points(icc_sampling **out, const icc_shape *shape,
                                                   size_t n, const double *points,
                                                   const icc_env *env, icc_error *err);

/** Frees a sampling. */
ICC_API void icc_sampling_free(icc_sampling *sampling);

/** Fills in `info`, whose `size` you have set. Returns ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_sampling_get_info(const icc_sampling *sampling, icc_sampling_info *info);

/** Copies the samples; `points` has room for n_samples * dim doubles. Returns ::ICC_OK or
 *  ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_sampling_get_points(const icc_sampling *sampling, double *points);

/**
 * Writes a sampling and its shape to memory. Call it twice: with capacity 0 for the number of
 * bytes, then with a buffer of that size. The format (docs/reference/formats.md) is versioned, the
 * same on every machine, and has a checksum.
 *
 * @param sampling     the sampling
 * @param capacity     number of bytes that `data` has room for
 * @param[out] data    NULL if capacity is 0
 * @param[out] n_bytes number of bytes needed. If it exceeds `capacity`, nothing useful is written
 */
ICC_API icc_status icc_sampling_save(const icc_sampling *sampling, size_t capacity, void *data,
                                     size_t *n_bytes);

/** Reads a sampling back, bit for bit. Returns ::ICC_ERR_FORMAT for bytes that
 *  icc_sampling_save() did not write, and ::ICC_ERR_VERSION for bytes that a later version
 *  wrote. Any bytes are safe to pass. */
ICC_API icc_status icc_sampling_load(icc_sampling **out, size_t n_bytes, const void *data,
                                     const icc_env *env, icc_error *err);

/* ----------------------------------------------------------------- weights */

/** Handles, and the weight of each handle everywhere in a shape. */
typedef struct icc_weights icc_weights;

/** The kernel that interpolates weights between samples. */
enum {
    /** Wendland's C2 function of radius 3 sigma: smooth, and positive definite for any width */
    ICC_KERNEL_WENDLAND = 1,
    /** the thesis's kernel exp(-d^2 / (2 sigma^2)), cut off at `cutoff` sigma, where it jumps.
     *  Not always positive definite */
    ICC_KERNEL_GAUSS = 2
};

/** The weights that the optimisation starts from. */
enum {
    ICC_INITIAL_HEAT = 1,  /**< diffusion of an impulse at each handle (4.11, 4.12) */
    ICC_INITIAL_EDGES = 2, /**< diffusion that keeps weights linear along the edges (4.7, 4.13) */
    /** inverse squared distance to the handles (4.10), where p is a tenth of their extent */
    ICC_INITIAL_INVERSE = 3,
    ICC_INITIAL_GIVEN = 4 /**< your own: icc_weights_options::initial_weights */
};

/** How weights are found. They always sum to 1. All methods except biharmonic treat each sample by
 *  itself, and their weights reproduce the sample. */
enum {
    /** least squared change of the initial weights, none negative (4.1) */
    ICC_WEIGHTS_QP = 1,
    ICC_WEIGHTS_EQUALITY = 2, /**< least squared change, of any sign (4.2 to 4.6) */
    /** least sum of absolute changes (4.8). Of several solutions, the one with the least sum of
     *  squared changes */
    ICC_WEIGHTS_L1 = 3,
    /** Bounded biharmonic weights (Jacobson et al. 2011), for comparison. In the plane only, where
     *  every handle and sample lies in a region, and every region that encloses none has a handle.
     *  No two walls may be so close that rounded points on them touch.
     *
     *  The weight of each handle lies between 0 and 1 and has the least integral of squared
     *  Laplacians, by finite elements on a mesh of the nodes. Enclosed regions come first, and the
     *  region around continues their weights. Then the weights of each node are divided by their
     *  sum.
     *
     *  These weights do not reproduce points: if handles are translated to the places that an
     *  affine map gives them, the shape does not follow that map. Initial weights have no
     *  influence, but ::ICC_INITIAL_EDGES keeps edges linear. After painting, negative weights
     *  become 0 and the weights are divided by their sum.
     *
     *  Cost: some 25 sparse factorisations for each handle, more for finer samplings */
    ICC_WEIGHTS_BIHARMONIC = 4
};

/**
 * A segment that stays straight, because weights are linear along it (5.6). It has nodes at both
 * ends and between them, at most one spacing apart. Nodes beside the line follow it, nearer ones
 * more closely. For the best spacing, make the sampling with these places as fixed points.
 *
 * An end may be a handle, or an end of an earlier line. Lines should not cross. Where a line comes
 * near a handle or an earlier line, the handle or the earlier line prevails. The weights of a
 * parallel line follow from those of the other line and can be negative. Nodes beside a parallel
 * line keep their weights, so between its nodes it is straight only to a few hundredths.
 */
typedef struct icc_line {
    double from[3]; /**< one end, in the shape, at least half a spacing away from the other */
    double to[3];   /**< the other end */
    /** 0, or k to stay parallel to the earlier line k - 1 (5.11). The two must be parallel to
     *  within 1e-9 of their length, and `to` must be neither a handle nor on an earlier line */
    int32_t parallel;
} icc_line;

/** Options of icc_weights_create(). */
typedef struct icc_weights_options {
    size_t size;     /**< set by the caller: `sizeof(icc_weights_options)` */
    int32_t kernel;  /**< `ICC_KERNEL_*`; 0: Wendland */
    int32_t initial; /**< `ICC_INITIAL_*`; 0: edges if there are any, else heat */
    int32_t method;  /**< `ICC_WEIGHTS_*`; 0: QP */
    int32_t steps;   /**< steps of diffusion; 0: 5 */
    /** 0 or 1: add an affine function to the kernels, so that sums and reproduction are exact
     *  between the samples. -1: do not, as in the thesis */
    int32_t affine_tail;
    /** 0 or 1: weights diffuse only between samples that see each other inside the shape. -1:
     *  also through walls, as in the thesis */
    int32_t within_shape;
    double sigma;          /**< width of the kernel; 0: icc_sampling_info::sigma */
    double cutoff;         /**< Gauss: radius in units of sigma; 0: 5 */
    size_t n_edges;        /**< number of edges between handles */
    const uint32_t *edges; /**< n_edges * 2 handle indices, or NULL */
    size_t n_lines;        /**< number of lines to keep straight */
    const icc_line *lines; /**< n_lines lines, or NULL */
    /** for ::ICC_INITIAL_GIVEN: n_samples * n_handles weights, sample after sample */
    const double *initial_weights;
} icc_weights_options;

/** What icc_weights_get_info() reports. */
typedef struct icc_weights_info {
    size_t size;      /**< set by the caller: `sizeof(icc_weights_info)` */
    int32_t dim;      /**< dimension */
    int32_t kernel;   /**< `ICC_KERNEL_*` */
    int32_t initial;  /**< `ICC_INITIAL_*` */
    int32_t method;   /**< `ICC_WEIGHTS_*` */
    size_t n_handles; /**< number of handles */
    /** places that carry weights: the handles, then places on lines, then the samples. Samples
     *  within half a spacing of a handle or of a line's node are left out */
    size_t n_nodes;
    /** QP: nodes outside the handles' convex hull, which no non-negative weights reproduce.
     *  There QP is relaxed, but weights still sum to 1 */
    size_t n_infeasible;
    size_t n_entries; /**< kernel values in the matrix: one triangle with the diagonal */
    double sigma;     /**< width of the kernel */
    /** smallest pivot of the matrix over the greatest: near 0 it almost loses positive
     *  definiteness */
    double definiteness;
    /** Weights from icc_weights_stiffen(): how far they are from the optimum. It is the step
     *  that is still possible down the energy's projected gradient, divided by the one at the
     *  start. Biharmonic weights: the largest change of a single weight that would lower the
     *  energy, before weights are divided by their sum. Else 0 */
    double residual;
} icc_weights_info;

/** What icc_weights_get_timings() reports: seconds for each step of making weights. For weights
 *  that were made from others, steps that were not repeated keep the earlier times. */
typedef struct icc_weights_timings {
    size_t size;     /**< set by the caller: `sizeof(icc_weights_timings)` */
    double factor;   /**< placing the nodes, and factorising the matrix */
    double initial;  /**< the initial weights */
    double optimise; /**< the optimisation */
} icc_weights_timings;

/**
 * Makes weights for handles.
 *
 * @param[out] out  the weights; owned by the caller. They keep the sampling alive
 * @param sampling  the samples
 * @param n_handles number of handles, at least dim + 1
 * @param handles   n_handles * dim coordinates in the shape, not all in one plane (2-D: on one
 *                  line)
 * @param options   may be NULL
 * @param env       may be NULL
 * @param err       may be NULL; `index` is the handle, edge or line at fault
 * @return ::ICC_OK, or
 * - ::ICC_ERR_OUTSIDE if a handle or line is outside the shape
 * - ::ICC_ERR_ARGUMENT, for example if two handles coincide, the handles cannot reproduce points,
 *   or weights are not finite
 * - ::ICC_ERR_SOLVER if sigma is too large for a positive definite matrix, or biharmonic weights
 *   are not found on a mesh with very thin triangles
 * - ::ICC_ERR_UNSUPPORTED, ::ICC_ERR_ARGUMENT or ::ICC_ERR_RESOLUTION if biharmonic weights do not
 *   exist for the shape, see ::ICC_WEIGHTS_BIHARMONIC
 * - ::ICC_ERR_MEMORY, ::ICC_ERR_VERSION or ::ICC_ERR_CANCELLED
 *
 * Cost for n nodes, m handles and k neighbours within the kernel's reach: O(steps n k m) and a
 * sparse factorisation, O(n^1.5) in 2-D.
 */
ICC_API icc_status icc_weights_create(icc_weights **out, const icc_sampling *sampling,
                                      size_t n_handles, const double *handles,
                                      const icc_weights_options *options, const icc_env *env,
                                      icc_error *err);

/** Frees weights. */
ICC_API void icc_weights_free(icc_weights *weights);

/** Fills in `info`, whose `size` you have set. Returns ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_weights_get_info(const icc_weights *weights, icc_weights_info *info);

/** Fills in `timings`, whose `size` you have set. Returns ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_weights_get_timings(const icc_weights *weights,
                                           icc_weights_timings *timings);

/**
 * Copies the nodes and their weights.
 *
 * @param weights      the weights
 * @param[out] points  n_nodes * dim coordinates, or NULL
 * @param[out] initial n_nodes * n_handles initial weights, or NULL
 * @param[out] values  n_nodes * n_handles weights, or NULL
 * @param[out] status  n_nodes statuses, or NULL: ::ICC_OK, or ::ICC_ERR_SOLVER where QP was relaxed
 */
ICC_API icc_status icc_weights_get_nodes(const icc_weights *weights, double *points,
                                         double *initial, double *values, icc_status *status);

/**
 * Paints weights. The brush falls smoothly from 1 at the centre to 0 at the radius. Amount * brush
 * is added to the weight of one handle at the nodes around a place, and these nodes are optimised
 * again from there. Handles, nodes on lines and nodes on edges keep their weights.
 *
 * @param[out] out new weights at the same nodes; owned by the caller. The old ones do not change
 * @param weights  the weights to change
 * @param handle   the handle whose weight is painted
 * @param centre   dim coordinates
 * @param radius   positive
 * @param amount   positive or negative
 * @param env      may be NULL
 * @param err      may be NULL
 *
 * Cost: one optimisation for each node within the radius, and one solve with the existing factor.
 */
ICC_API icc_status icc_weights_paint(icc_weights **out, const icc_weights *weights, size_t handle,
                                     const double *centre, double radius, double amount,
                                     const icc_env *env, icc_error *err);

/** Like icc_weights_paint(), with weights of your own: node nodes[i] starts from values[i *
 *  n_handles ...] and is optimised again. No node may be named twice. */
ICC_API icc_status icc_weights_repaint(icc_weights **out, const icc_weights *weights, size_t n,
                                       const uint32_t *nodes, const double *values,
                                       const icc_env *env, icc_error *err);

/** Makes weights with the same nodes and initial weights but another method (`ICC_WEIGHTS_*`).
 *  Painting and stiffening are lost, as in the thesis (6.3.1). Fails if
 *  icc_weights_create() would. */
ICC_API icc_status icc_weights_with_method(icc_weights **out, const icc_weights *weights,
                                           int32_t method, const icc_env *env, icc_error *err);

/**
 * Makes a part of the shape move as if it were rigid: weights vary there as little as possible
 * (5.12 to 5.35, with the sign of 5.35a corrected).
 *
 * This is one quadratic program for the weights at the part's nodes and at the nodes around it,
 * within the kernel's reach. Its value is half the sum of squared derivatives at the part's nodes,
 * weighted by `rigidity`. Derivatives of the change around the part count with a tenth of the mean
 * rigidity.
 *
 * Weights still sum to 1 and reproduce points. Handles, nodes on edges and lines, and all nodes
 * further away keep their weights. With QP, no weight becomes negative at a node where none was.
 * There are no other conditions. The residual of the optimality conditions
 * (icc_weights_info::residual) is at most 1e-8, and the program's value is within 1e-6 of its
 * minimum.
 *
 * @param[out] out new weights; owned by the caller
 * @param weights  the weights to change
 * @param n        number of nodes of the part
 * @param nodes    their indices
 * @param rigidity n positive numbers, the importance of each node; NULL: all equal
 * @param energy   half the weighted sum of squared derivatives at the part's nodes, before and
 *                 after; or NULL
 * @param env      may be NULL
 * @param err      may be NULL
 * @return ::ICC_OK, or
 * - ::ICC_ERR_ARGUMENT if a node does not exist or is named twice, or a rigidity is not positive
 * - ::ICC_ERR_SOLVER if it was not solved within the limit of steps
 * - ::ICC_ERR_UNSUPPORTED for biharmonic weights
 * - ::ICC_ERR_MEMORY or ::ICC_ERR_CANCELLED
 *
 * Cost: some hundred steps, each a product with a matrix of these nodes or two partial solves;
 * memory in proportion to the weights of these nodes and to the pairs of nodes within the kernel's
 * reach.
 */
ICC_API icc_status icc_weights_stiffen(icc_weights **out, const icc_weights *weights, size_t n,
                                       const uint32_t *nodes, const double *rigidity,
                                       double energy[2], const icc_env *env, icc_error *err);

/**
 * Evaluates weights at points. Returns ::ICC_OK even if every point failed: check `status` or
 * `n_failed`.
 *
 * @param weights        the weights
 * @param n              number of points
 * @param points         n * dim coordinates. Any finite point has weights. Far from all nodes they
 *                       are those of the affine tail, or 0 without it
 * @param[out] values    n * n_handles weights
 * @param[out] gradients n * n_handles * dim derivatives, or NULL (3.44)
 * @param[out] status    n statuses, or NULL: ::ICC_OK, or ::ICC_ERR_ARGUMENT for a point that is
 *                       not finite, whose values are NaN
 * @param[out] n_failed  number of points without weights, or NULL
 * @param env            may be NULL
 */
ICC_API icc_status icc_weights_evaluate(const icc_weights *weights, size_t n, const double *points,
                                        double *values, double *gradients, icc_status *status,
                                        size_t *n_failed, const icc_env *env);

/**
 * Evaluates the dual function of a node (3.2): the interpolant that is 1 at this node and 0 at all
 * other nodes. Weights are the sum of these functions, each times the weights at its node. With the
 * affine tail these functions sum to 1 and reproduce points.
 *
 * @param weights     any weights on the nodes: only nodes, kernel and tail matter
 * @param node        its number, as in icc_weights_get_nodes()
 * @param n           number of points
 * @param points      n * dim coordinates
 * @param[out] values n numbers
 * @param env         may be NULL
 * @param err         may be NULL
 * @return ::ICC_OK, or
 * - ::ICC_ERR_ARGUMENT if the node does not exist or a point is not finite
 * - ::ICC_ERR_MEMORY or ::ICC_ERR_CANCELLED
 *
 * Cost: one solve with the existing factor, and an evaluation for each point.
 */
ICC_API icc_status icc_weights_get_dual(const icc_weights *weights, size_t node, size_t n,
                                        const double *points, double *values, const icc_env *env,
                                        icc_error *err);

/** What icc_weights_get_report() reports: the quality of weights, measured at your points. */
typedef struct icc_weights_report {
    size_t size;         /**< set by the caller: `sizeof(icc_weights_report)` */
    size_t n_infeasible; /**< icc_weights_info::n_infeasible */
    size_t n_negative;   /**< points where a weight is below -1e-9 */
    double unity;        /**< largest deviation of the sum of weights from 1 */
    /** largest distance between a point and the weighted mean of the handles */
    double reproduction;
    double reproduction_mean; /**< mean of these distances */
    double lagrange;          /**< largest deviation from 1 and 0 at the handles */
    double linearity;         /**< largest deviation from linear weights along the edges */
    double least_weight;      /**< smallest weight */
    double definiteness;      /**< icc_weights_info::definiteness */
} icc_weights_report;

/** Measures the weights at n points (n * dim coordinates). Set the `size` of the report first. */
ICC_API icc_status icc_weights_get_report(const icc_weights *weights, size_t n,
                                          const double *points, icc_weights_report *report,
                                          const icc_env *env, icc_error *err);

/* ----------------------------------------------------------------- binding */

/** Points with their weights, and derivatives if requested. Use it to pose the same points
 *  repeatedly. */
typedef struct icc_binding icc_binding;

/**
 * Binds points to handles.
 *
 * @param[out] out    the binding; owned by the caller. It no longer needs the weights
 * @param weights     the weights
 * @param n           number of points
 * @param points      n * dim coordinates, finite
 * @param derivatives 1: poses have Jacobians, which takes dim * n_handles more doubles a point;
 *                    else 0
 * @param env         may be NULL
 * @param err         may be NULL
 */
ICC_API icc_status icc_binding_create(icc_binding **out, const icc_weights *weights, size_t n,
                                      const double *points, int32_t derivatives, const icc_env *env,
                                      icc_error *err);

/** Frees a binding. */
ICC_API void icc_binding_free(icc_binding *binding);

/** Reports the numbers of points, handles and dimensions; each pointer may be NULL. */
ICC_API icc_status icc_binding_get_counts(const icc_binding *binding, size_t *n_points,
                                          size_t *n_handles, int32_t *dim);

/** Copies the handles' positions, n_handles * dim, and the weights, n_points * n_handles; each
 *  pointer may be NULL. */
ICC_API icc_status icc_binding_get_weights(const icc_binding *binding, double *handles,
                                           double *weights);

/**
 * Poses the points: x -> sum of w_j(x) (A_j x + b_j) (3.37). It is computed as x + sum of w_j(x)
 * (A_j x + b_j - x), which is the same where weights sum to 1. So the rest pose is exact.
 *
 * @param binding        the binding
 * @param transforms     n_handles * dim * (dim + 1) numbers: for each handle the rows of (A | b)
 * @param[out] images    n * dim coordinates
 * @param[out] jacobians n * dim * dim derivatives of the images by the points; NULL if not needed.
 *                       The binding must have derivatives
 * @param env            may be NULL
 * @return ::ICC_OK, or
 * - ::ICC_ERR_ARGUMENT if a transform is not finite
 * - ::ICC_ERR_UNSUPPORTED if the binding has no derivatives
 * - ::ICC_ERR_MEMORY, ::ICC_ERR_VERSION or ::ICC_ERR_CANCELLED
 */
ICC_API icc_status icc_binding_pose(const icc_binding *binding, const double *transforms,
                                    double *images, double *jacobians, const icc_env *env);

/** Writes a binding to memory, as icc_sampling_save() does a sampling. */
ICC_API icc_status icc_binding_save(const icc_binding *binding, size_t capacity, void *data,
                                    size_t *n_bytes);

/** Reads a binding back, as icc_sampling_load() does a sampling. */
ICC_API icc_status icc_binding_load(icc_binding **out, size_t n_bytes, const void *data,
                                    const icc_env *env, icc_error *err);

/* ------------------------------------------------------------------- poses */

/** Writes the rest pose to `transforms`: n_handles identities, see icc_binding_pose(). */
ICC_API icc_status icc_pose_reset(int32_t dim, size_t n_handles, double *transforms);

/** Moves one handle: adds `offset`, dim numbers, to its transform. */
ICC_API icc_status icc_pose_move(int32_t dim, double *transform, const double *offset);

/**
 * Rotates a handle about its posed position, where its transform has taken it.
 *
 * @param dim       2 or 3
 * @param transform the handle's transform, dim * (dim + 1) numbers
 * @param handle    the handle's position at rest, dim coordinates
 * @param axis      3-D: 3 numbers, not all 0; ignored in 2-D
 * @param angle     radians, counter-clockwise (2-D: y upwards; 3-D: seen from the axis' tip)
 */
ICC_API icc_status icc_pose_turn(int32_t dim, double *transform, const double *handle,
                                 const double *axis, double angle);

#ifdef __cplusplus
}
#endif

#endif

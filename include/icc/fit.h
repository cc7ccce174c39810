/**
 * @file icc/fit.h
 * @brief Maps from what is known only in part: control points, pins, a wall that moves, a warp.
 *
 *     icc_constraint (what is known), any number
 *       -> icc_fit
 *         -> icc_map, an ordinary map of kind mesh
 *
 *     a mesh and any images of its vertices
 *       -> icc_map_create_nearest() -> icc_map
 *
 * icc_map_create() needs to know where the whole boundary goes. The functions of this file do not.
 * They choose the rest themselves, in two steps:
 * - A *model* takes the shape as the constraints ask, as smoothly or as rigidly as possible.
 * - Where the model folds, a *repair* replaces it by a map that is one-to-one. Elsewhere the model
 *   stays as it is.
 *
 * The result is certified like every mesh map. Everything here works in the plane.
 *
 * The rules that hold for all objects are in icc/icc.h.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ICC_FIT_H
#define ICC_FIT_H

#include <icc/map.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ----------------------------------------------------------------- nearest */

/** Options of icc_map_create_nearest(). */
typedef struct icc_nearest_options {
    size_t size;          /**< set by the caller: `sizeof(icc_nearest_options)` */
    size_t n_held;        /**< number of vertices whose images must stay as given */
    const uint32_t *held; /**< n_held vertices of the mesh, or NULL */
} icc_nearest_options;

/** How a folded map became one-to-one. */
enum {
    ICC_REPAIR_NONE = 0, /**< it was one-to-one: nothing was changed */
    /** folded patches were mapped anew. Features pass one another as they do outside of the
     *  patches */
    ICC_REPAIR_PATCHES = 1,
    /** everything was mapped anew, because the folded patches could not be told apart. The map
     *  may turn around some features in another way than the given one */
    ICC_REPAIR_WHOLE = 2
};

/** What icc_map_create_nearest() has done. */
typedef struct icc_nearest_report {
    size_t size;         /**< set by the caller: `sizeof(icc_nearest_report)` */
    int32_t repair;      /**< `ICC_REPAIR_*` */
    size_t n_folded;     /**< cells of the given mesh whose image is flat or reversed */
    size_t n_patches;    /**< patches that were mapped anew */
    double changed;      /**< their share of the source's area */
    double moved;        /**< root mean square distance of the given vertices from their given
                              images, over all of them */
    double most_moved;   /**< largest such distance */
    size_t n_iterations; /**< Newton steps */
} icc_nearest_report;

/**
 * Makes the one-to-one map that is nearest to any given warp: a thin plate, a polynomial, a
 * displacement field, a neural field or a pose, sampled at the vertices of a mesh.
 *
 * If every triangle keeps its orientation and the image of the boundary is simple, the map is the
 * given one, bit for bit. So this is also the way to make an icc_map of a mesh map from another
 * program. Otherwise the folded triangles and their surroundings are cut out and mapped anew. From
 * there, the map goes back towards the given images as far as triangles stay positive. "Near" is
 * measured by the squared difference of the derivatives, with a small share of the symmetric
 * Dirichlet energy, which keeps triangles from collapsing.
 *
 * A collar around the patches gives way a little. Beyond it, the images do not change at all. All
 * vertices stay where they are in the source and keep their numbers. Patches may get new vertices,
 * with higher numbers, and other triangles.
 *
 * The images of the boundary's vertices and of held ones do not change. So the image of the
 * boundary must be simple already, and held images must lie inside it. Holes are allowed. Held
 * vertices inside become point features of the map.
 *
 * @param[out] out    the map; owned by the caller. It has no charts
 * @param mesh        a conforming mesh of triangles in one piece. It may have holes
 * @param images      2 n_vertices coordinates
 * @param options     may be NULL
 * @param[out] report may be NULL; its `size` is set by the caller
 * @param env         may be NULL
 * @param err         may be NULL; `side` is 1 if the mesh is at fault and 2 if its images are
 * @return ::ICC_OK, or
 * - ::ICC_ERR_BOUNDARY if the mesh is not valid, or if the image of its boundary meets itself
 * - ::ICC_ERR_TOPOLOGY if the mesh has several pieces
 * - ::ICC_ERR_ARGUMENT, also if the images are a mirror image: change the sign of one coordinate
 * - ::ICC_ERR_CERTIFICATE if no one-to-one map was found
 * - ::ICC_ERR_RESOLUTION if a coordinate is too small beside the others for exact signs
 * - ::ICC_ERR_UNSUPPORTED if the mesh is not in the plane
 * - ::ICC_ERR_MEMORY, ::ICC_ERR_VERSION or ::ICC_ERR_CANCELLED
 *
 * Cost: below 1 us a triangle if nothing folds. Otherwise about 20 us for each triangle in and
 * around the patches. Deterministic.
 */
ICC_API icc_status icc_map_create_nearest(icc_map **out, const icc_mesh *mesh, const double *images,
                                          const icc_nearest_options *options,
                                          icc_nearest_report *report, const icc_env *env,
                                          icc_error *err);

/* --------------------------------------------------------------------- fit */

/** A map that is made from constraints. */
typedef struct icc_fit icc_fit;

/** Kinds of constraints: icc_constraint::kind. */
enum {
    ICC_CONSTRAINT_POINTS = 1, /**< points go to their targets. They may lie anywhere */
    /** a polyline goes to a polyline: vertex to vertex, and edge to edge linearly. In a mesh it
     *  runs along edges. Without a domain and mesh, lines may begin, end and meet at vertices that
     *  they have in common, and they are exact */
    ICC_CONSTRAINT_LINE = 2,
    /** vertices of the domain, or of the mesh, go to their targets. An edge of the boundary goes
     *  along linearly if both its ends are told */
    ICC_CONSTRAINT_VERTICES = 3,
    /** vertices of the domain or of the mesh may move along a straight line only */
    ICC_CONSTRAINT_SLIDING = 4
};

/** A part of what you know about a map: where some points, a line or some vertices go. */
typedef struct icc_constraint {
    /** set by the caller: `sizeof(icc_constraint)`, the same for all elements of an array */
    size_t size;
    int32_t kind;             /**< `ICC_CONSTRAINT_*` */
    size_t n;                 /**< number of its points or vertices; of a line at least 2 */
    const double *source;     /**< points and lines: 2 n coordinates. Otherwise NULL */
    const uint32_t *vertices; /**< vertices and sliding: n numbers. Otherwise NULL */
    /** 2 n coordinates. Sliding: a point of each line, or NULL for the vertex itself */
    const double *target;
    /** sliding: 2 n coordinates, the direction of each line in the target. NULL: the direction of
     *  the boundary at the vertex, which must be straight there. Otherwise NULL */
    const double *direction;
    /** points, with the spline: how far each may be off its target, such as the standard
     *  deviation of its measurement; 0: not at all. NULL: all are exact */
    const double *tolerance;
} icc_constraint;

/** How a fit carries everything that is not told: icc_fit_options::model. */
enum {
    /** as smoothly as possible: of all functions through the points the one that bends the least
     *  inside the region. Affine functions do not bend, so three points give their affine map.
     *  For maps and pictures. It takes points and lines, and neither a domain nor a mesh */
    ICC_FIT_SPLINE = 1,
    /** as rigidly as possible: every small piece keeps its shape and size. For characters, and for
     *  meshes whose boundary moves */
    ICC_FIT_ELASTIC = 2
};

/** Options of icc_fit_create(). */
typedef struct icc_fit_options {
    size_t size;   /**< set by the caller: `sizeof(icc_fit_options)` */
    int32_t model; /**< `ICC_FIT_*`; 0: the spline without a domain and mesh, else elastic */
    /** without a domain and mesh: the box that the map covers at least, lower and upper corner;
     *  NULL: the bounding box of the points */
    const double *box;
    /** without a domain and mesh: how far the map reaches beyond the box, as a share of its
     *  longest side, at most 1000. Near: distortions of the whole, as of an old map. Far: local
     *  ones. 0: chosen by leaving each point out in turn */
    double margin;
    /** spline: 0: points with a tolerance are smoothed as leaving each point out in turn suggests.
     *  Above 0: a factor, larger for smoother. Negative: all points are exact */
    double smoothing;
    /** elastic: a length in the source: how far a point carries its surroundings along. 0: as far
     *  as the mesh makes it, so a single point pulls a spike */
    double reach;
    /** elastic: cells are stiffer by their area to the power of minus this number, from 0 to 3. 0:
     *  all alike. 1.5: thin layers of cells along a wall move as if glued to it */
    double stiffness;
    /** elastic, with a mesh: a further factor above 0 for each cell; or NULL */
    const double *cell_stiffness;
    /** elastic, with a domain: the longest edge of the mesh that libicc makes, as a length in the
     *  source; 0: chosen */
    double cell;
    /** elastic, 1: parts of the free outline may come to lie on each other. Then the result is
     *  refused if they do. 0: they push each other away */
    int32_t no_contact;
} icc_fit_options;

/** What icc_fit_get_info() reports. */
typedef struct icc_fit_info {
    size_t size;      /**< set by the caller: `sizeof(icc_fit_info)` */
    int32_t model;    /**< `ICC_FIT_*`: never 0 */
    size_t n_items;   /**< points and vertices of all constraints */
    double margin;    /**< spline: as used */
    double smoothing; /**< spline: as used; 0: all points are exact */
    double residual;  /**< root mean square distance of the images of points from their targets */
    /** spline: root mean square distance of the targets from where the other points alone would
     *  take them. An honest estimate of the accuracy between points. NaN if not known */
    double left_out;
    double affine_residual; /**< spline: like `residual`, of the best affine map alone */
    /** elastic: number of exact and sliding items that were not reached, because the shape would
     *  have overlapped or folded on the way */
    size_t n_off;
    double most_off;  /**< elastic: the largest distance of such an item from its target or line */
    int32_t repair;   /**< spline: `ICC_REPAIR_*` */
    size_t n_folded;  /**< spline: triangles of the model that are flat or reversed */
    size_t n_patches; /**< spline: patches that were mapped anew */
    double changed;   /**< spline: their share of the area */
    size_t n_iterations; /**< Newton steps */
} icc_fit_info;

/**
 * Makes a map from what is known of it. Pass a domain, a mesh or neither.
 *
 * *Neither*: the map covers a box around the points and lines. This is the way to use control
 * points on a map or a picture, and rivers or roads that are known on both sides. One point gives a
 * shift, and two points give a similarity.
 *
 * *A domain*: its outline is free except where constraints tell it. It may have holes, but no lines
 * and points. libicc makes the mesh. This is the way to pose a figure by pins.
 *
 * *A mesh*: it is kept, vertex for vertex and cell for cell. It may have holes. Its cells are
 * triangles or, with offsets, convex quadrilaterals, which stay convex. In the map each
 * quadrilateral is two triangles. This is the way to move a wall in a mesh.
 *
 * Exact items end exactly at their targets. If an elastic shape cannot get there without folding or
 * overlapping, the result is the map as far as it got: check icc_fit_info::n_off.
 *
 * @param[out] out      the fit; owned by the caller, see icc_fit_free()
 * @param domain        a domain of the plane, or NULL
 * @param mesh          a mesh of triangles and quadrilaterals in the plane, or NULL
 * @param n_constraints at least 1
 * @param constraints   n_constraints of them; they are copied
 * @param options       may be NULL
 * @param env           may be NULL
 * @param err           may be NULL; if an item is at fault, `index` counts it over all constraints
 *                      (::ICC_ITEM_POINT). `side` is 1 for the source, and 2 for the target
 * @return ::ICC_OK, or
 * - ::ICC_ERR_ARGUMENT if two items coincide and have different targets, if a number is not finite
 *   or too small beside the others, or if an option does not suit the model. For control points
 *   also if different exact ones have the same target, if a part of a line has no length, or if the
 *   targets mirror the points or lie on a line
 * - ::ICC_ERR_OUTSIDE if a point is not inside the domain
 * - ::ICC_ERR_BOUNDARY if the mesh is not valid
 * - ::ICC_ERR_TOPOLOGY if the mesh has several pieces
 * - ::ICC_ERR_RESOLUTION if points are too close together beside the box, or if the cell is so
 *   small that there would be more than four million triangles
 * - ::ICC_ERR_CERTIFICATE if no one-to-one map was found, or if lines meet one another, a point or
 *   the outline
 * - ::ICC_ERR_UNSUPPORTED if the domain or mesh is not in the plane, if the domain is a mask or has
 *   lines or points, or for vertices without a domain and mesh
 * - ::ICC_ERR_MEMORY, ::ICC_ERR_VERSION or ::ICC_ERR_CANCELLED
 *
 * Cost: control points some 30 ms up to 100 and 0.6 s for 3,000, several times as much if they
 * fold. Figures and meshes 5 to 20 us for each triangle, several times as much where they turn far
 * or touch. Deterministic.
 */
ICC_API icc_status icc_fit_create(icc_fit **out, const icc_domain *domain, const icc_mesh *mesh,
                                  size_t n_constraints, const icc_constraint *constraints,
                                  const icc_fit_options *options, const icc_env *env,
                                  icc_error *err);

/**
 * Makes the fit to targets that have moved, starting from `fit`. Use it while something is dragged.
 * An elastic fit keeps its mesh and continues from its present shape. A spline keeps its margin,
 * its smoothing and its factorised system, so that it only has to be solved, and repaired where it
 * folds. Where the spline needs a finer mesh, its triangles may change.
 *
 * @param[out] out the fit; owned by the caller
 * @param fit      the fit before. It does not change
 * @param targets  2 n_items coordinates: the targets of all items, constraint after constraint
 * @param env      may be NULL
 * @param err      may be NULL
 * @return as icc_fit_create()
 */
ICC_API icc_status icc_fit_move(icc_fit **out, const icc_fit *fit, const double *targets,
                                const icc_env *env, icc_error *err);

/** Frees a fit and its map. */
ICC_API void icc_fit_free(icc_fit *fit);

/** The map; borrowed. */
ICC_API const icc_map *icc_fit_map(const icc_fit *fit);

/** Fills in `info`, whose `size` you have set. Returns ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_fit_get_info(const icc_fit *fit, icc_fit_info *info);

/**
 * Copies how far each item is off.
 *
 * @param fit            the fit
 * @param[out] residuals 2 n_items coordinates: the image of each item minus its target; or NULL.
 *                       Sliding vertices: minus the nearest point of their line
 * @param[out] left_out  2 n_items coordinates: where the other points alone would take each point,
 *                       minus its target. NaN where that is not known: for items that are no
 *                       points, and for the elastic model. Or NULL
 * @return ::ICC_OK or ::ICC_ERR_ARGUMENT
 */
ICC_API icc_status icc_fit_get_residuals(const icc_fit *fit, double *residuals, double *left_out);

#ifdef __cplusplus
}
#endif

#endif

/**
 * @file icc/chart.h
 * @brief Charts: coordinates of the inside of a domain, and maps made from two of them.
 *
 *     icc_domain (a boundary and what it encloses)
 *       -> icc_chart (coordinates: a boundary point and a share of the way to the maximum)
 *         -> icc_map (two charts whose boundaries correspond)
 *
 * A chart fills its domain with curves. Each curve starts at a boundary point, and all curves end
 * at the same inner point, the *maximum*. A point x has two coordinates: the boundary point where
 * its curve starts, and t, the share of the curve's length from the boundary to x.
 *
 * The rules that hold for all objects are in icc/icc.h. The terms "certified", "simplex" and
 * "facet" are explained in icc/map.h. "Thesis" and "paper" are the sources named in icc/stages.h.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ICC_CHART_H
#define ICC_CHART_H

#include <icc/map.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------- chart */

/** Coordinates of the inside of a domain: a boundary point and a share in [0,1]. */
typedef struct icc_chart icc_chart;

/** How coordinates are made. Methods gradient and field work in 2-D and beyond. Method foliation
 *  works in 2-D and on domains with a mesh, method disc in 2-D. */
enum {
    /** Integral Curve Coordinates as Huynh and Gingold published them. They use a regular grid,
     *  a cousin tree, a function on it, and piecewise linear gradient lines. They work in any
     *  dimension, on the simplices of the Kuhn triangulation and their faces.
     *
     *  These coordinates are not one-to-one, and never certified. Lines merge, so an open part
     *  of the area collapses; in 3-D and beyond it is most of it. Thin parts of a shape between
     *  grid vertices are not reached. icc_chart_get_report() estimates how much is lost. Beyond
     *  2-D the function may also have several maxima where lines end:
     *  icc_gradient_info::n_maxima. */
    ICC_METHOD_GRADIENT = 1,
    /** Integral Curve Coordinates along leaves, which are curves that cannot merge. In 2-D they
     *  are level lines of an angle-valued, discretely harmonic function on a triangle mesh of
     *  the domain. libicc checks a certificate for every chart, with integers and exact signs.
     *  If it holds, the chart is a homeomorphism of the closed domain in exact arithmetic:
     *  one-to-one and continuous both ways. If it fails there is no chart
     *  (::ICC_ERR_CERTIFICATE). The coordinates are continuous and piecewise smooth. In doubles,
     *  a round trip returns to about 1e-15 of the domain's size. A mesh *sampled* from the map
     *  can still have inverted triangles.
     *
     *  On a domain with a mesh (icc_domain_create_mesh()) it works in any dimension. Leaves are
     *  then straight in every simplex and pass through the simplices in an order, a shelling.
     *  They all end at an inner vertex, or at the middle of a simplex if there is none. The
     *  certificate checks that order and promises the same. (Beyond 3-D the orientation of
     *  simplices is certain, but not computed exactly.) Some meshes have no such order:
     *  ::ICC_ERR_TOPOLOGY. Leaves near a flat simplex are long. */
    ICC_METHOD_FOLIATION = 2,
    /** Integral Curve Coordinates along a vector field in which curves cannot merge, on a
     *  regular grid in any dimension. Every grid vertex has a vector that points uphill in all
     *  simplices around it, for the discretely harmonic function. Between the vertices the field
     *  is linear. Curves are followed exactly, except for rounding.
     *
     *  The chart is certified if three conditions hold. Every vertex has such a vector. The
     *  field crosses the whole boundary inward, which is checked vertex by vertex. No grid
     *  vertex inside was given up. Otherwise there is a chart without a certificate, and
     *  icc_field_info::n_infeasible, n_not_inward and n_stray count what is wrong.
     *
     *  Two certified charts do not always make a certified map, because doubles may lack the
     *  digits: icc_map_report::n_lost and n_flat. Curves converge on their way. So points that
     *  one chart tells apart may coincide in the other, for example if a ball is mapped to a
     *  pancake. */
    ICC_METHOD_FIELD = 3,
    /** Polar coordinates of the harmonic map to a disc (Tutte), piecewise linear. It is a
     *  homeomorphism under the same certificate as foliation. The curves are the preimages of
     *  radii. A slit as narrow as about 1e-15 of the shape's size can be too narrow to mesh; the
     *  error says so. */
    ICC_METHOD_DISC = 4
};

/** The function whose gradient lines are followed: icc_function_create() explains each of them. */
enum {
    /** thesis (4.1): 10 at the maximum, times 0.95 from parent to child */
    ICC_FUNCTION_DECAY = 1,
    ICC_FUNCTION_DISTANCE = 2,  /**< minus the distance in the tree (L1 distance) */
    ICC_FUNCTION_LAPLACE = 3,   /**< discretely harmonic: 1 at the maximum, 0 outside */
    ICC_FUNCTION_BILAPLACE = 4, /**< discretely biharmonic, simply supported (Navier) */
    /** discretely biharmonic, clamped: changes its sign unless constrained */
    ICC_FUNCTION_CLAMPED = 5,
    /** like Laplace, but 0 where the grid's edges cross the boundary: it follows the shape, not
     *  a staircase */
    ICC_FUNCTION_HARMONIC = 6,
    /** reported of a function that has the caller's values: icc_function_create_values(). Not for
     *  options */
    ICC_FUNCTION_VALUES = 7
};

/** Whether f(parent) >= (1 + min_fall) f(child) is imposed on the edges of the tree inside. This
 *  concerns Laplace, harmonic and bi-Laplace functions. Decay and distance satisfy it anyway. */
enum {
    /** Only if the function without constraints has critical points besides one maximum at the
     *  root. (In 2-D, the saddles of holes do not count, because no function can avoid them.)
     *  Charts first move the root as for ::ICC_CONSTRAINTS_NONE, and impose constraints only if
     *  that does not help. If they are imposed, the root stays at its first place */
    ICC_CONSTRAINTS_NEEDED = 1,
    /** never. A chart of a bi-Laplace function then has its maximum where the function is
     *  greatest, which may be beside the requested place: icc_gradient_info::moved */
    ICC_CONSTRAINTS_NONE = 2,
    ICC_CONSTRAINTS_ALL = 3 /**< always: the maximum stays at the requested place */
};

/** How the linear systems of Laplace and bi-Laplace functions are solved. */
enum {
    /** sparse factorisation: each value has a relative error of about 1e-12 */
    ICC_SOLVER_DIRECT = 1,
    /** conjugate gradients with a multigrid preconditioner: for large grids, mainly in 3-D */
    ICC_SOLVER_ITERATIVE = 2
};

/** The two published forms of Algorithm 2: icc_tree_create(). */
enum {
    ICC_TREE_THESIS = 1, /**< vertices just outside the boundary belong to the tree */
    ICC_TREE_PAPER = 2   /**< vertices just outside are children of all their neighbours inside */
};

/** Options of icc_chart_create(). */
typedef struct icc_chart_options {
    size_t size; /**< set by the caller: `sizeof(icc_chart_options)` */
    /** `ICC_METHOD_*`; 0: the best available, which is foliation in 2-D and on domains with a
     *  mesh, else field */
    int32_t method;
    int32_t function; /**< gradient: `ICC_FUNCTION_*`; 0: decay */
    int32_t tree;     /**< gradient: `ICC_TREE_*`; 0: thesis */
    /** grid or mesh cells along the longest side, 2..16384; 0: 50, as in the papers. For
     *  gradient on a mask see icc_grid_create() */
    int32_t cells;
    /** Requested maximum: the nearest vertex inside is taken. NULL: chosen by the method.
     *  Gradient and field take the grassfire's maximum. Foliation takes the deepest vertex, or
     *  on your own mesh the deepest inner vertex. Disc allows NULL only, because its maximum is
     *  the point that the harmonic map takes to the centre. Bi-Laplace functions without
     *  constraints may move the maximum: icc_gradient_info::moved */
    const double *maximum;
    int32_t constraints; /**< gradient: `ICC_CONSTRAINTS_*`; 0: needed */
    int32_t solver;      /**< gradient: `ICC_SOLVER_*`; 0: by the predicted work */
    /** gradient: least relative fall along tree edges, in (0, 0.01]; 0: 1e-6 */
    double min_fall;
    /** gradient, constrained bi-Laplace: least value at the leaves of the tree, in (0, 0.01]; 0:
     *  1e-9 */
    double leaf_min;
    /** gradient: the order in which the tree expands along the axes, a permutation of 0..dim-1;
     *  NULL: 0, 1, 2 and so on, see icc_tree_options */
    const int32_t *axis_order;
} icc_chart_options;

/** A function on the vertices of a tree that falls from parent to child: icc/stages.h. */
typedef struct icc_function icc_function;

/** What icc_chart_get_info() reports for every method. Members that only one method has are in
 *  icc_gradient_info, icc_field_info, icc_foliation_info, icc_shelling_info and icc_disc_info. */
typedef struct icc_chart_info {
    size_t size;    /**< set by the caller: `sizeof(icc_chart_info)` */
    int32_t dim;    /**< dimension */
    int32_t method; /**< `ICC_METHOD_*` */
    /** 1: proved to be one-to-one, exactly (field: in doubles). 0: not, see `reason` */
    int32_t certified;
    int32_t reason; /**< `ICC_REASON_*`: why it is not certified; 0 if it is */
    /** cells along the longest side that were used. Method field may take more than requested in
     *  thin shapes. 0 on a domain's mesh */
    int32_t cells;
    double maximum[ICC_MAX_DIM]; /**< the point where every curve ends */
    /** distance between neighbours in the grid or lattice; 0 on a domain's mesh */
    double spacing;
} icc_chart_info;

/** What icc_chart_get_gradient_info() reports about charts of method gradient. */
typedef struct icc_gradient_info {
    size_t size;          /**< set by the caller: `sizeof(icc_gradient_info)` */
    int32_t function;     /**< `ICC_FUNCTION_*` */
    int32_t tree;         /**< `ICC_TREE_*` */
    size_t n_grid;        /**< grid vertices */
    size_t n_inside;      /**< grid vertices inside the domain */
    size_t n_tree;        /**< grid vertices in the tree */
    size_t n_unreachable; /**< grid vertices inside that the tree does not reach */
    /** pairs of neighbours inside that are neither parent and child nor cousins */
    size_t n_cousin_violations;
    size_t n_maxima;  /**< maxima of the function inside */
    size_t n_minima;  /**< minima of the function inside */
    size_t n_saddles; /**< saddles of the function inside */
    /** facets (in 2-D: edges) between two simplices that curves pass through, see
     *  icc_function_get_facets() */
    size_t n_edges;
    size_t n_compression; /**< facets where curves merge on the way up */
    size_t n_expansion;   /**< facets where curves merge on the way down */
    /** bi-Laplace functions without constraints: distance of icc_chart_info::maximum from the
     *  requested vertex, or from the grassfire's. The maximum moves because the function is
     *  greatest beside that vertex. Else 0 */
    double moved;
} icc_gradient_info;

/** What icc_chart_get_field_info() reports about charts of method field. Their function is
 *  ::ICC_FUNCTION_LAPLACE, their tree has the form ::ICC_TREE_THESIS. */
typedef struct icc_field_info {
    size_t size;     /**< set by the caller: `sizeof(icc_field_info)` */
    size_t n_grid;   /**< grid vertices */
    size_t n_inside; /**< grid vertices inside the domain */
    /** grid vertices inside that were given up so that the remaining ones form a ball */
    size_t n_stray;
    size_t n_tree;        /**< grid vertices in the tree */
    size_t n_unreachable; /**< grid vertices inside that the tree does not reach */
    /** pairs of neighbours inside that are neither parent and child nor cousins */
    size_t n_cousin_violations;
    size_t n_maxima;     /**< maxima of the function inside */
    size_t n_minima;     /**< minima of the function inside */
    size_t n_saddles;    /**< saddles of the function inside */
    size_t n_infeasible; /**< grid vertices where no vector points uphill in all simplices */
    /** pairs of a boundary facet and a grid vertex, where the facet runs through a simplex of
     *  that vertex */
    size_t n_contacts;
    size_t n_not_inward; /**< contacts where the vector does not point inward */
} icc_field_info;

/** What icc_chart_get_foliation_info() reports about charts of method foliation in 2-D, on a
 *  mesh that libicc makes. */
typedef struct icc_foliation_info {
    size_t size;             /**< set by the caller: `sizeof(icc_foliation_info)` */
    size_t n_mesh_vertices;  /**< vertices of the mesh */
    size_t n_mesh_boundary;  /**< mesh vertices on the boundary */
    size_t n_mesh_simplices; /**< triangles of the mesh */
    /** mesh edges whose two ends have the same label; they are ordered by index */
    size_t n_ties;
    double harmonic_share; /**< share of the boundary flux that is harmonic */
} icc_foliation_info;

/** What icc_chart_get_shelling_info() reports about charts of method foliation on a domain's own
 *  mesh. */
typedef struct icc_shelling_info {
    size_t size;             /**< set by the caller: `sizeof(icc_shelling_info)` */
    size_t n_mesh_vertices;  /**< vertices of the mesh, plus one if none lies inside */
    size_t n_mesh_boundary;  /**< mesh vertices on the boundary */
    size_t n_mesh_simplices; /**< simplices of the mesh */
    double harmonic_share;   /**< share of the boundary flux that is harmonic */
    /** 1: the order of the simplices was found from the boundary inwards; 0: from the centre
     *  outwards */
    int32_t order_peeled;
    /** number of tried orders that were complete at first; the best of them is used */
    int32_t n_orders;
    double order_beta; /**< weight of reversed flux in the order that is used */
    size_t n_reversed; /**< facets that the harmonic flux crosses against the order */
    /** weighted sum of squared differences between the flux along the leaves and the harmonic
     *  flux; 0 is best */
    double flux_energy;
    double flux_divergence; /**< largest share of a simplex's flux that is lost by rounding */
} icc_shelling_info;

/** What icc_chart_get_disc_info() reports about charts of method disc. */
typedef struct icc_disc_info {
    size_t size;             /**< set by the caller: `sizeof(icc_disc_info)` */
    size_t n_mesh_vertices;  /**< vertices of the mesh */
    size_t n_mesh_boundary;  /**< mesh vertices on the boundary */
    size_t n_mesh_simplices; /**< triangles of the mesh */
} icc_disc_info;

/** What icc_chart_get_timings() reports: seconds for each step of making a chart. Steps that the
 *  method does not have are 0. A loaded chart has the times of loading it. */
typedef struct icc_chart_timings {
    size_t size;     /**< set by the caller: `sizeof(icc_chart_timings)` */
    double grid;     /**< gradient, field: the grid and the maximum */
    double tree;     /**< gradient, field: the tree and its check */
    double function; /**< gradient, field: the function and its check */
    double mesh;     /**< foliation, disc: the mesh; on a domain's mesh, preparing the leaves */
    double centre;   /**< foliation on a domain's mesh: choosing the maximum */
    double solve;    /**< field: the vectors and their check; foliation, disc: the equations */
    double order;    /**< foliation on a domain's mesh: the order of the simplices */
    double certify;  /**< foliation, disc: the certificate */
} icc_chart_timings;

/** What icc_chart_get_report() estimates from evenly spread points. All shares lie in [0,1].
 *  "Area" and "length" are for 2-D; beyond, read volume and area, and so on. For a certified
 *  chart all shares and counts are 0, without sampling. */
typedef struct icc_chart_report {
    size_t size;       /**< set by the caller: `sizeof(icc_chart_report)` */
    size_t n_points;   /**< points inside that were used */
    size_t n_boundary; /**< points on the boundary that were used */
    /** share of the area from which no curve reaches both the boundary and the maximum */
    double unreachable;
    /** share of the area that no curve from the boundary enters (expansion edges) */
    double uncovered;
    /** share of the coordinates, boundary length times t, whose point lies on a line where
     *  curves have merged (compression edges) */
    double collapsed;
    double not_inward; /**< share of the boundary length where the gradient does not point inward */
} icc_chart_report;

/**
 * Makes a chart: coordinates of the inside of a domain.
 *
 * @param[out] out the chart; owned by the caller, see icc_chart_free(). It keeps the domain alive
 * @param domain   the domain
 * @param options  may be NULL
 * @param env      may be NULL
 * @param err      may be NULL
 * @return ::ICC_OK, or
 * - ::ICC_ERR_RESOLUTION if no grid vertex lies inside the domain, or the grid would have more than
 *   2^28 vertices
 * - ::ICC_ERR_OUTSIDE if `maximum` is outside
 * - ::ICC_ERR_CERTIFICATE if the chart could not be proved one-to-one; `err` has the reason
 * - ::ICC_ERR_TOPOLOGY if the domain's mesh has no order for method foliation
 * - ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY, ::ICC_ERR_UNSUPPORTED, ::ICC_ERR_VERSION or
 *   ::ICC_ERR_CANCELLED
 *
 * Cost with n boundary vertices and N cells along the longest side:
 * - gradient and field in 2-D: O(N^2 + n N) time and memory, about 1 ms at N = 50
 * - gradient and field beyond 2-D: O(N^dim), in 3-D at N = 64 some tenths of a second
 * - foliation and disc in 2-D: a sparse factorisation of at most 2 n + 4 N^2 vertices, about 1 ms
 *   at N = 50
 * - foliation on a domain's mesh in 3-D: about 10 us a tetrahedron
 */
ICC_API icc_status icc_chart_create(icc_chart **out, const icc_domain *domain,
                                    const icc_chart_options *options, const icc_env *env,
                                    icc_error *err);

/**
 * Makes a chart of method gradient from a function. The function, its tree and its grid may be the
 * library's or your own: icc/stages.h.
 *
 * icc_chart_create() makes the same chart, bit for bit, from the same stages: icc_grid_create(),
 * icc_grid_find_maximum() or icc_grid_find_nearest(), icc_tree_create() and icc_function_create().
 * For bilaplace and clamped it also moves the root, see icc_function_create().
 *
 * The chart has a copy of the function. Beyond 2-D this copy has values at more vertices outside.
 * Where the tree does not reach, points have no coordinates.
 *
 * @param[out] out the chart; owned by the caller, see icc_chart_free(). It keeps the domain alive
 *                 that the grid was made from
 * @param function the function; you may free it
 * @param env      may be NULL
 * @param err      may be NULL; `index` is a vertex beside the root that is higher
 * @return ::ICC_OK, or
 * - ::ICC_ERR_UNSUPPORTED if the grid was not made from a domain: it comes from a mask of vertices
 *   or from icc_grid_refine()
 * - ::ICC_ERR_ARGUMENT if a neighbour of the root is higher than the root, so that no curve ends
 *   there
 * - ::ICC_ERR_MEMORY, ::ICC_ERR_CANCELLED or ::ICC_ERR_VERSION
 *
 * Cost: O(vertices) time; 8 to 20 bytes a vertex for the copy, and the boundary's cells.
 */
ICC_API icc_status icc_chart_create_function(icc_chart **out, const icc_function *function,
                                             const icc_env *env, icc_error *err);

/** Frees a chart. */
ICC_API void icc_chart_free(icc_chart *chart);

/** Fills in `info`, whose `size` you have set. Returns ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_chart_get_info(const icc_chart *chart, icc_chart_info *info);

/** Fills in `info`, whose `size` you have set. Returns ::ICC_OK, ::ICC_ERR_ARGUMENT, or
 *  ::ICC_ERR_UNSUPPORTED if the chart is not of method gradient. */
ICC_API icc_status icc_chart_get_gradient_info(const icc_chart *chart, icc_gradient_info *info);

/** Like icc_chart_get_gradient_info(), for method field. */
ICC_API icc_status icc_chart_get_field_info(const icc_chart *chart, icc_field_info *info);

/** Like icc_chart_get_gradient_info(), for method foliation in 2-D unless the domain brings a
 *  mesh. */
ICC_API icc_status icc_chart_get_foliation_info(const icc_chart *chart, icc_foliation_info *info);

/** Like icc_chart_get_gradient_info(), for method foliation on a domain's own mesh. */
ICC_API icc_status icc_chart_get_shelling_info(const icc_chart *chart, icc_shelling_info *info);

/** Like icc_chart_get_gradient_info(), for method disc. */
ICC_API icc_status icc_chart_get_disc_info(const icc_chart *chart, icc_disc_info *info);

/** Fills in `timings`, whose `size` you have set. Returns ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_chart_get_timings(const icc_chart *chart, icc_chart_timings *timings);

/** The domain that the chart was made on; borrowed. */
ICC_API const icc_domain *icc_chart_domain(const icc_chart *chart);

/**
 * Estimates which part of the domain the coordinates miss. Deterministic.
 *
 * @param chart         the chart
 * @param n_points      number of points inside, and as many on the boundary; 0: 4096
 * @param[out] measures its `size` is set by the caller
 * @param env           may be NULL
 * @param err           may be NULL
 */
ICC_API icc_status icc_chart_get_report(const icc_chart *chart, size_t n_points,
                                        icc_chart_report *measures, const icc_env *env,
                                        icc_error *err);

/**
 * Computes the coordinates of points in a chart. Returns ::ICC_OK even if every point failed: check
 * `status` or `n_failed`.
 *
 * A point on the boundary has t = 0. The maximum has t = 1, facet 0 and the facet's midpoint. A
 * point without coordinates gets NaN in `bary` and `t`, UINT32_MAX in `facet` and its own status.
 * Other points are not affected.
 *
 * @param chart         the chart
 * @param n             number of points
 * @param points        n * dim coordinates
 * @param[out] facet    n indices of the boundary facet where the curve starts
 * @param[out] bary     n * dim barycentric coordinates on that facet: not negative, with sum 1
 * @param[out] t        n shares of the curve's arc length from the boundary, in [0,1]
 * @param[out] status   n statuses, or NULL. ::ICC_OK; ::ICC_ERR_OUTSIDE; ::ICC_ERR_TRACE if the
 *                      curve does not reach both the boundary and the maximum; ::ICC_ERR_ARGUMENT
 *                      if the point is not finite
 * @param[out] n_failed number of points without coordinates, or NULL
 * @param env           may be NULL
 * @return ::ICC_OK if the call has run, however many points failed, or
 * - ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY, ::ICC_ERR_VERSION or ::ICC_ERR_CANCELLED; the outputs are
 *   then undefined
 *
 * Cost: some microseconds a point for charts; for the first call in each direction on a plane mesh,
 * also time and memory proportional to the mesh. That memory comes from the object's own
 * icc_env::alloc, whatever `env` is. If there is none the call fails, and the next call tries
 * again.
 */
ICC_API icc_status icc_chart_encode(const icc_chart *chart, size_t n, const double *points,
                                    uint32_t *facet, double *bary, double *t, icc_status *status,
                                    size_t *n_failed, const icc_env *env);

/**
 * Computes the points that have given coordinates. This is the inverse of icc_chart_encode(), and
 * like it returns ::ICC_OK even if every point failed.
 *
 * @param chart         the chart
 * @param n             number of points
 * @param facet         n facet indices
 * @param bary          n * dim barycentric coordinates: not negative, with sum 1 up to 1e-9
 * @param t             n shares in [0,1]; 0 is the boundary point, 1 the maximum
 * @param[out] points   n * dim coordinates; NaN if there is no point
 * @param[out] status   n statuses, or NULL. ::ICC_OK; ::ICC_ERR_TRACE if the curve does not reach
 *                      the maximum or has left the domain there; ::ICC_ERR_ARGUMENT
 * @param[out] n_failed number of coordinates without a point, or NULL
 * @param env           may be NULL
 * @return as icc_chart_encode()
 */
ICC_API icc_status icc_chart_decode(const icc_chart *chart, size_t n, const uint32_t *facet,
                                    const double *bary, const double *t, double *points,
                                    icc_status *status, size_t *n_failed, const icc_env *env);

/** What a chart loses at a point, as bits. 0: the point and its coordinates lead to each other. The
 *  first bit says that they do not. The others say why for charts of method gradient, and come only
 *  with the first. Curves *merge* where they meet at an edge of the grid's triangulation, or at
 *  another lower face, and go on as one. */
enum {
    /** The way back does not return. icc_chart_encode_flags(): the coordinates belong to another
     *  point, or to none. icc_chart_decode_flags(): the point has other coordinates. If it is the
     *  only bit, curves are so close together that doubles do not tell them apart. In an
     *  uncertified chart of method field, the curve may also have left the domain */
    ICC_LOSS_AWAY = 1,
    /** Encode: the curve merges with others on its way down to the boundary, at an expansion edge
     *  (thesis, 6.4). No curve from the boundary reaches the point */
    ICC_LOSS_UNCOVERED = 2,
    /** Decode: curves have merged between the boundary and the point, at a compression edge. They
     *  all lead to this point */
    ICC_LOSS_COLLAPSED = 4,
    /** Decode: the curve leaves the domain and enters it again below the point, because the cells
     *  are too large for the shape. Encode finds the place where it enters */
    ICC_LOSS_GAP = 8
};

/**
 * Computes coordinates like icc_chart_encode(), and tells for each point whether
 * icc_chart_decode() brings it back.
 *
 * A point comes back if it is decoded to within 1e-6 of the longest side of the domain's bounding
 * box. Every point is decoded to find out. Charts of method gradient lose many points: some percent
 * in 2-D, and up to half of them beyond.
 *
 * @param chart         the chart
 * @param n             number of points
 * @param points        n * dim coordinates
 * @param[out] facet    as for icc_chart_encode(), like `bary` and `t`
 * @param[out] bary     n * dim numbers
 * @param[out] t        n numbers
 * @param[out] status   n statuses, or NULL
 * @param[out] flags    n sums of `ICC_LOSS_*`, or NULL; 0 for points without coordinates
 * @param[out] n_failed number of points without coordinates, or NULL
 * @param env           may be NULL
 * @return as icc_chart_encode()
 *
 * Cost: about twice that of icc_chart_encode(), and three times for points that do not come back.
 */
ICC_API icc_status icc_chart_encode_flags(const icc_chart *chart, size_t n, const double *points,
                                          uint32_t *facet, double *bary, double *t,
                                          icc_status *status, int32_t *flags, size_t *n_failed,
                                          const icc_env *env);

/**
 * Computes points like icc_chart_decode(), and tells for each whether icc_chart_encode() returns
 * its coordinates.
 *
 * Coordinates come back if the boundary point does to within 1e-6 of the longest side of the
 * domain's bounding box, and t to within 1e-6. With t = 1 every boundary point is as good.
 *
 * @param chart         the chart
 * @param n             number of points
 * @param facet         as for icc_chart_decode(), like `bary` and `t`
 * @param bary          n * dim numbers
 * @param t             n numbers
 * @param[out] points   n * dim coordinates; NaN if there is no point
 * @param[out] status   n statuses, or NULL
 * @param[out] flags    n sums of `ICC_LOSS_*`, or NULL; 0 for coordinates without a point
 * @param[out] n_failed number of coordinates without a point, or NULL
 * @param env           may be NULL
 * @return as icc_chart_decode()
 *
 * Cost: about twice that of icc_chart_decode(), and four times for coordinates that do not come
 * back.
 */
ICC_API icc_status icc_chart_decode_flags(const icc_chart *chart, size_t n, const uint32_t *facet,
                                          const double *bary, const double *t, double *points,
                                          icc_status *status, int32_t *flags, size_t *n_failed,
                                          const icc_env *env);

/**
 * Computes the whole curve through a point, from the boundary to the maximum, as a polyline.
 *
 * @param chart        the chart
 * @param point        dim coordinates
 * @param capacity     number of points that `curve` has room for
 * @param[out] curve   capacity * dim coordinates; may be NULL if capacity is 0
 * @param[out] n_curve number of points of the curve, which may exceed `capacity`
 * @param env          may be NULL
 * @param err          may be NULL
 * @return ::ICC_OK, ::ICC_ERR_OUTSIDE, ::ICC_ERR_TRACE, ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY or
 *         ::ICC_ERR_VERSION
 */
ICC_API icc_status icc_chart_trace(const icc_chart *chart, const double *point, size_t capacity,
                                   double *curve, size_t *n_curve, const icc_env *env,
                                   icc_error *err);

/**
 * Writes a chart and its domain to memory, for other processes and machines. Call it twice: with
 * capacity 0 for the number of bytes, then with a buffer of that size. The format
 * (docs/reference/formats.md) is versioned, the same on every machine, and has a checksum.
 *
 * @param chart        the chart
 * @param capacity     number of bytes that `data` has room for
 * @param[out] data    NULL if capacity is 0
 * @param[out] n_bytes number of bytes needed. If it exceeds `capacity`, nothing useful is written
 * @return ::ICC_OK or ::ICC_ERR_ARGUMENT
 */
ICC_API icc_status icc_chart_save(const icc_chart *chart, size_t capacity, void *data,
                                  size_t *n_bytes);

/**
 * Reads a chart back. It gives the same results as the saved one, bit for bit, for any number of
 * threads. Its info is the same.
 *
 * Charts on a mesh (foliation, disc) are stored in full and certified anew, so bytes that do not
 * pass are refused wherever they come from. Charts on a grid (gradient, field) are rebuilt from
 * their inputs and compared with a checksum of the original's numbers. The inputs of a chart from a
 * function are those of its stages, with your own parents and values. Any bytes are safe to pass.
 *
 * @param[out] out the chart; owned by the caller
 * @param n_bytes  number of bytes of `data`
 * @param data     any bytes
 * @param env      may be NULL
 * @param err      may be NULL
 * @return ::ICC_OK, or
 * - ::ICC_ERR_FORMAT for bytes that icc_chart_save() did not write, or that need more than
 *   icc_env::load_limit allows
 * - ::ICC_ERR_VERSION for bytes that a later version wrote, and for a chart on a grid that gives
 *   other values here than where it was saved
 * - ::ICC_ERR_MEMORY, ::ICC_ERR_CANCELLED or ::ICC_ERR_ARGUMENT
 *
 * Cost: O(n log n) time and O(n) memory in the number of bytes for charts on a mesh; for charts on
 * a grid, that of icc_chart_create() with the stored options.
 */
ICC_API icc_status icc_chart_load(icc_chart **out, size_t n_bytes, const void *data,
                                  const icc_env *env, icc_error *err);

/* ---------------------------------------------------------- charts of maps */

/** Makes a map from two charts of the same method. Their domains must correspond as
 *  icc_map_create() requires. A mesh map uses the source chart's mesh. Of the options only
 *  `kind` and `iterations` are used. The map keeps the charts alive. */
ICC_API icc_status icc_map_create_from_charts(icc_map **out, const icc_chart *source,
                                              const icc_chart *target,
                                              const icc_map_options *options, const icc_env *env,
                                              icc_error *err);

/** The chart of the source; borrowed. NULL for a map made by icc_map_retarget(), for a mesh map
 *  beyond 3-D, and for one in 3-D unless a method or a maximum was asked for. */
ICC_API const icc_chart *icc_map_source_chart(const icc_map *map);

/** The chart of the target; borrowed. NULL like icc_map_source_chart(). */
ICC_API const icc_chart *icc_map_target_chart(const icc_map *map);

#ifdef __cplusplus
}
#endif

#endif

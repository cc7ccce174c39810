/**
 * @file icc/chart.h
 * @brief Charts: coordinates of the inside of a domain, and maps made from two of them.
 *
 *     icc_domain (a boundary and what it encloses)
 *       -> icc_chart (coordinates of the inside: boundary point + share of the way to the maximum)
 *         -> icc_map (two charts and the homeomorphism of their boundaries)
 *
 * What holds for all objects is said in icc/icc.h.
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

/** How coordinates are made. Gradient and field work in 2-D and beyond, foliation in 2-D and on
 *  domains with a mesh, disc in 2-D. */
enum {
    /** Integral Curve Coordinates as Huynh and Gingold published them: a regular grid, a cousin
     *  tree, a function on it, piecewise linear gradient lines; in any dimension, on the simplices
     *  of the Kuhn triangulation and their faces. Not one-to-one: lines merge, so that an open
     *  share of the area collapses (in 3-D and beyond, most of it), and thin parts of a shape
     *  between grid vertices are not reached. icc_chart_get_report() estimates how much. Beyond 2-D
     *  the function may have several maxima, too, and lines that end at them:
     *  icc_gradient_info::n_maxima. Never certified. */
    ICC_METHOD_GRADIENT = 1,
    /** Integral Curve Coordinates along leaves that cannot merge: level lines of an angle-valued,
     *  discretely harmonic function on a triangle mesh of the domain. Whenever its certificate
     *  holds, the chart is a homeomorphism of the closed domain in exact arithmetic. The
     *  certificate is checked for every chart, with integers and exact signs; if it fails there is
     *  no chart (::ICC_ERR_CERTIFICATE). The coordinates are continuous and piecewise smooth; in
     *  doubles, a round trip returns to about 1e-15 of the domain's size. A mesh *sampled* from the
     *  map can still have inverted triangles.
     *
     *  On a domain with a mesh (icc_domain_create_mesh()), in any dimension: leaves that are
     *  straight in every simplex and pass through the simplices in an order, a shelling; all end at
     *  an inner vertex of the mesh, or at the middle of a simplex if there is none. The certificate
     *  checks that order, and promises the same (beyond 3-D the orientation of simplices is
     *  certain, but not exact). Not every mesh has such an order: ::ICC_ERR_TOPOLOGY. Leaves near a
     *  flat simplex are long. */
    ICC_METHOD_FOLIATION = 2,
    /** Integral Curve Coordinates along a vector field in which curves cannot merge, on a regular
     *  grid in any dimension. Every grid vertex has a vector that points uphill in all simplices
     *  around it, for the discretely harmonic function; between vertices the field is linear. The
     *  curves are followed exactly but for rounding. Certified when there is such a vector
     *  everywhere, the field crosses the whole boundary inward, which is checked vertex by vertex,
     *  and no grid vertex inside was given up. If not, there is a chart all the same, and
     *  icc_field_info::n_infeasible, n_not_inward and n_stray count what is wrong.
     *
     *  Two certified charts do not suffice for a certified map: doubles must have enough digits for
     *  it, too, see icc_map_report::n_lost and n_flat. Curves converge on their way, and points
     *  that one chart tells apart may coincide in the other, as when a ball is mapped to a pancake.
     */
    ICC_METHOD_FIELD = 3,
    /** Polar coordinates of the harmonic map to a disc (Tutte), piecewise linear. A homeomorphism
     *  under the same certificate; the curves are the preimages of radii. A slit as narrow as about
     *  1e-15 of the shape's size can be too narrow to mesh, which is an error that says so. */
    ICC_METHOD_DISC = 4
};

/** The function whose gradient lines are followed. */
enum {
    ICC_FUNCTION_DECAY = 1,     /**< thesis (4.1): 10 at the maximum, times 0.95 from parent to
                                     child */
    ICC_FUNCTION_DISTANCE = 2,  /**< minus the distance in the tree (L1 distance) */
    ICC_FUNCTION_LAPLACE = 3,   /**< discretely harmonic: 1 at the maximum, 0 outside */
    ICC_FUNCTION_BILAPLACE = 4, /**< discretely biharmonic, simply supported (Navier) */
    ICC_FUNCTION_CLAMPED = 5,   /**< discretely biharmonic, clamped: changes its sign unless
                                     constrained */
    ICC_FUNCTION_HARMONIC = 6   /**< as Laplace, but 0 on the boundary itself, where the grid's
                                     edges cross it: follows the shape, not a staircase */
};

/** Whether f(parent) >= (1 + min_fall) f(child) is imposed on the edges of the tree inside
 *  (Laplace, harmonic and bi-Laplace; decay and distance satisfy it anyway). */
enum {
    ICC_CONSTRAINTS_NEEDED = 1, /**< only if the function without them has critical points other
                                     than one maximum at the root (and, in 2-D, the saddles of
                                     holes, which no function can avoid); in charts, only if that is
                                     still so after the root has moved as for
                                     ::ICC_CONSTRAINTS_NONE. If they are imposed, the root does not
                                     move */
    ICC_CONSTRAINTS_NONE = 2,   /**< never. Charts of bi-Laplace functions then have their maximum
                                     where the function puts it, which may be beside the requested
                                     place: icc_gradient_info::moved */
    ICC_CONSTRAINTS_ALL = 3     /**< always: the maximum stays at the requested place */
};

/** How the linear systems of Laplace and bi-Laplace are solved. */
enum {
    ICC_SOLVER_DIRECT = 1,   /**< sparse factorisation: each value to about 1e-12 of itself */
    ICC_SOLVER_ITERATIVE = 2 /**< conjugate gradients with a multigrid preconditioner: for large
                                  grids, above all in 3-D */
};

/** The two published forms of Algorithm 2. */
enum {
    ICC_TREE_THESIS = 1, /**< vertices just outside the boundary belong to the tree */
    ICC_TREE_PAPER = 2   /**< vertices just outside are children of all their neighbours inside */
};

/** Options of icc_chart_create(). */
typedef struct icc_chart_options {
    size_t size;           /**< set by the caller: `sizeof(icc_chart_options)` */
    int32_t method;        /**< `ICC_METHOD_*`; 0: the best available: foliation in 2-D and on
                                domains with a mesh, else field */
    int32_t function;      /**< gradient: `ICC_FUNCTION_*`; 0: decay */
    int32_t tree;          /**< gradient: `ICC_TREE_*`; 0: thesis */
    int32_t cells;         /**< grid or mesh cells along the longest side, 2..16384; 0: 50, as in
                                the papers; gradient on a mask: see icc_grid_create() */
    const double *maximum; /**< the requested maximum: the nearest vertex inside is taken. NULL: the
                                grassfire's (gradient, field), the deepest vertex (foliation; on a
                                caller-supplied mesh, the deepest inner vertex). Disc has its own,
                                the point that goes to the centre: NULL only. Bi-Laplace functions
                                without constraints may move it: icc_gradient_info::moved */
    int32_t constraints;   /**< gradient: `ICC_CONSTRAINTS_*`; 0: needed */
    int32_t solver;        /**< gradient: `ICC_SOLVER_*`; 0: by the predicted work */
    double min_fall;       /**< gradient: least relative fall along tree edges, in (0, 0.01]; 0:
                                1e-6 */
    double leaf_min;       /**< gradient, constrained bi-Laplace: least value at the leaves, in
                                (0, 0.01]; 0: 1e-9 */
} icc_chart_options;

/** What icc_chart_get_info() fills in, for every method. What only one method has is in a struct of
 *  its own: icc_gradient_info, icc_field_info, icc_foliation_info, icc_shelling_info,
 *  icc_disc_info. */
typedef struct icc_chart_info {
    size_t size;                 /**< set by the caller: `sizeof(icc_chart_info)` */
    int32_t dim;                 /**< dimension */
    int32_t method;              /**< `ICC_METHOD_*` */
    int32_t certified;           /**< 1: proved to be one-to-one, exactly (field: in doubles); 0:
                                      not, see `reason` */
    int32_t reason;              /**< `ICC_REASON_*`: why it is not certified; 0 if it is */
    int32_t cells;               /**< cells along the longest side that were used; method field in
                                      thin shapes may take more than were asked for; 0 on a
                                      domain's mesh */
    double maximum[ICC_MAX_DIM]; /**< the point that every curve ends at */
    double spacing;              /**< distance of grid or lattice neighbours; 0 on a domain's
                                      mesh */
} icc_chart_info;

/** What only charts of method gradient have. */
typedef struct icc_gradient_info {
    size_t size;                /**< set by the caller: `sizeof(icc_gradient_info)` */
    int32_t function;           /**< `ICC_FUNCTION_*` */
    int32_t tree;               /**< `ICC_TREE_*` */
    size_t n_grid;              /**< grid vertices */
    size_t n_inside;            /**< grid vertices inside the domain */
    size_t n_tree;              /**< grid vertices in the tree */
    size_t n_unreachable;       /**< grid vertices inside that the tree does not reach */
    size_t n_cousin_violations; /**< neighbours inside that are neither parent and child nor
                                     cousins */
    size_t n_maxima;            /**< of the function, inside */
    size_t n_minima;            /**< of the function, inside */
    size_t n_saddles;           /**< of the function, inside */
    size_t n_edges;             /**< 2-D: edges between two triangles that curves run through */
    size_t n_compression;       /**< 2-D: edges where curves merge on the way up */
    size_t n_expansion;         /**< 2-D: edges where curves merge on the way down */
    double moved;               /**< bi-Laplace functions without constraints: how far
                                     icc_chart_info::maximum lies from the vertex that was asked for
                                     (or the grassfire's), because the function is greatest beside
                                     it; else 0 */
} icc_gradient_info;

/** What only charts of method field have. The function is ::ICC_FUNCTION_LAPLACE, the tree's form
 *  ::ICC_TREE_THESIS. */
typedef struct icc_field_info {
    size_t size;                /**< set by the caller: `sizeof(icc_field_info)` */
    size_t n_grid;              /**< grid vertices */
    size_t n_inside;            /**< grid vertices inside the domain */
    size_t n_stray;             /**< grid vertices inside that were given up, because without them
                                     the others form a ball */
    size_t n_tree;              /**< grid vertices in the tree */
    size_t n_unreachable;       /**< grid vertices inside that the tree does not reach */
    size_t n_cousin_violations; /**< neighbours inside that are neither parent and child nor
                                     cousins */
    size_t n_maxima;            /**< of the function, inside */
    size_t n_minima;            /**< of the function, inside */
    size_t n_saddles;           /**< of the function, inside */
    size_t n_infeasible;        /**< grid vertices where no vector points uphill in all simplices */
    size_t n_contacts;          /**< pairs of a facet and a grid vertex of a simplex that it runs
                                     through */
    size_t n_not_inward;        /**< those of them where the vector does not point inward */
} icc_field_info;

/** What only charts of method foliation have in 2-D, on a mesh that the library makes. */
typedef struct icc_foliation_info {
    size_t size;             /**< set by the caller: `sizeof(icc_foliation_info)` */
    size_t n_mesh_vertices;  /**< vertices of the mesh */
    size_t n_mesh_boundary;  /**< of them on the boundary */
    size_t n_mesh_simplices; /**< triangles of the mesh */
    size_t n_ties;           /**< mesh edges whose ends have the same label: ordered by index */
    double harmonic_share;   /**< share of the boundary flux that is harmonic */
} icc_foliation_info;

/** What only charts of method foliation have on a domain's mesh, icc_domain_create_mesh(). */
typedef struct icc_shelling_info {
    size_t size;             /**< set by the caller: `sizeof(icc_shelling_info)` */
    size_t n_mesh_vertices;  /**< vertices of the mesh, and one more where none lies inside */
    size_t n_mesh_boundary;  /**< of them on the boundary */
    size_t n_mesh_simplices; /**< simplices of the mesh */
    double harmonic_share;   /**< share of the boundary flux that is harmonic */
    int32_t order_peeled;    /**< 1: the order of the simplices was found from the boundary inwards,
                                  0: from the centre outwards */
    int32_t n_orders;        /**< how many of those that are tried were complete at first; the best
                                  is used */
    double order_beta;       /**< how much reversed flux weighed in it */
    size_t n_reversed;       /**< facets that the harmonic flux runs through the other way */
    double flux_energy;      /**< how far the flux along the leaves is from the harmonic one: sum of
                                  the squared differences, weighted; 0 at best */
    double flux_divergence;  /**< largest share of a simplex's flux that gets lost by rounding */
} icc_shelling_info;

/** What only charts of method disc have. */
typedef struct icc_disc_info {
    size_t size;             /**< set by the caller: `sizeof(icc_disc_info)` */
    size_t n_mesh_vertices;  /**< vertices of the mesh */
    size_t n_mesh_boundary;  /**< of them on the boundary */
    size_t n_mesh_simplices; /**< triangles of the mesh */
} icc_disc_info;

/** How long each step of making a chart took, in seconds: what icc_chart_get_timings() fills in. A
 *  step that the chart's method does not have is 0. A loaded chart has those of loading it. */
typedef struct icc_chart_timings {
    size_t size;     /**< set by the caller: `sizeof(icc_chart_timings)` */
    double grid;     /**< gradient, field: the grid, and the maximum */
    double tree;     /**< gradient, field: the tree, and checking it */
    double function; /**< gradient, field: the function, and checking it */
    double mesh;     /**< foliation, disc: the mesh; on a domain's mesh, preparing the leaves */
    double centre;   /**< foliation on a domain's mesh: choosing the maximum */
    double solve;    /**< field: the vectors, and checking them; foliation, disc: the equations */
    double order;    /**< foliation on a domain's mesh: the order of the simplices */
    double certify;  /**< foliation, disc: the certificate */
} icc_chart_timings;

/** Shares that icc_chart_get_report() estimates from evenly spread points. All lie in [0,1]. "Area"
 *  and "length" are for 2-D; beyond, read volume and area, and so on. For a certified chart all
 *  shares and counts are 0, without sampling. */
typedef struct icc_chart_report {
    size_t size;        /**< set by the caller: `sizeof(icc_chart_report)` */
    size_t n_points;    /**< points of the area that were used */
    size_t n_boundary;  /**< points of the boundary that were used */
    double unreachable; /**< area from which no curve reaches both the boundary and the
                             maximum */
    double uncovered;   /**< area that no curve from the boundary enters (expansion edges) */
    double collapsed;   /**< coordinates (boundary length times share of the way) whose point
                             lies on a line where curves have merged (compression edges) */
    double not_inward;  /**< boundary length where the gradient does not point inward */
} icc_chart_report;

/**
 * Makes a chart: coordinates of the inside of a domain.
 *
 * @param[out] out  the chart; owned by the caller, see icc_chart_free(). It keeps the domain alive.
 * @param domain    the domain
 * @param options   may be NULL
 * @param env       may be NULL
 * @param err       may be NULL
 * @return ::ICC_OK; ::ICC_ERR_RESOLUTION when no grid vertex lies inside the domain or the grid
 *         would have more than 2^28 vertices; ::ICC_ERR_OUTSIDE when `maximum` is outside;
 *         ::ICC_ERR_CERTIFICATE when the chart could not be proved one-to-one (`err` has the
 *         reason); ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY, ::ICC_ERR_UNSUPPORTED, ::ICC_ERR_VERSION,
 *         ::ICC_ERR_CANCELLED
 *
 * Cost with n boundary vertices and N cells along the longest side, by method:
 * - gradient and field: at most O(N^2 + n N) time and memory in 2-D, about 1 ms at N = 50; O(N^dim)
 *   beyond, in 3-D at N = 64 some tenths of a second. A point takes some 10 us in each direction in
 *   3-D. Field keeps about 40 bytes a grid vertex and needs twice as much while it is made.
 * - foliation and disc in 2-D: a mesh of at most 2 n + 4 N^2 vertices (far fewer in practice),
 *   whose Laplacian is factorised: about 1 ms at N = 50 and n < 100, 0.06 s at n = 15,000.
 * - foliation on a domain with a mesh, in 3-D: some 10 us a tetrahedron. A point takes 1 to 4 us in
 *   each direction.
 */
ICC_API icc_status icc_chart_create(icc_chart **out, const icc_domain *domain,
                                    const icc_chart_options *options, const icc_env *env,
                                    icc_error *err);

/** Frees a chart. */
ICC_API void icc_chart_free(icc_chart *chart);

/** Fills in `info`, whose `size` the caller has set. ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_chart_get_info(const icc_chart *chart, icc_chart_info *info);

/** Fills in what only charts of method gradient have; `size` as there. ::ICC_OK,
 *  ::ICC_ERR_UNSUPPORTED for charts that are made otherwise, or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_chart_get_gradient_info(const icc_chart *chart, icc_gradient_info *info);

/** The same for method field. */
ICC_API icc_status icc_chart_get_field_info(const icc_chart *chart, icc_field_info *info);

/** The same for method foliation in 2-D, unless the domain brings a mesh. */
ICC_API icc_status icc_chart_get_foliation_info(const icc_chart *chart, icc_foliation_info *info);

/** The same for method foliation on a domain's mesh. */
ICC_API icc_status icc_chart_get_shelling_info(const icc_chart *chart, icc_shelling_info *info);

/** The same for method disc. */
ICC_API icc_status icc_chart_get_disc_info(const icc_chart *chart, icc_disc_info *info);

/** Fills in `timings`, whose `size` the caller has set. ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_chart_get_timings(const icc_chart *chart, icc_chart_timings *timings);

/** The domain that the chart was made on; borrowed. */
ICC_API const icc_domain *icc_chart_domain(const icc_chart *chart);

/**
 * Estimates what the coordinates miss. Deterministic.
 *
 * @param chart         the chart
 * @param n_points      points to use, for the area and for the boundary each; 0: 4096
 * @param[out] measures its `size` is set by the caller
 * @param env           may be NULL
 * @param err           may be NULL
 */
ICC_API icc_status icc_chart_get_report(const icc_chart *chart, size_t n_points,
                                        icc_chart_report *measures, const icc_env *env,
                                        icc_error *err);

/**
 * Cartesian -> integral curve coordinates. Returns ::ICC_OK even if every point failed: see
 * `status` and `n_failed`.
 *
 * A point on the boundary has t = 0. The maximum has t = 1, facet 0 and the facet's midpoint. A
 * point without coordinates gets NaN in `bary` and `t`, UINT32_MAX in `facet` and its own status;
 * the other points are not affected.
 *
 * @param chart         the chart
 * @param n             number of points
 * @param points        n * dim coordinates
 * @param[out] facet    n indices of the boundary facet where the curve starts
 * @param[out] bary     n * dim barycentric coordinates there: not negative, sum 1
 * @param[out] t        n shares of the curve's arc length from the boundary, in [0,1]
 * @param[out] status   n statuses: ::ICC_OK, ::ICC_ERR_OUTSIDE, ::ICC_ERR_TRACE (the curve does not
 *                      reach the boundary and the maximum), ::ICC_ERR_ARGUMENT (not finite); or
 *                      NULL
 * @param[out] n_failed how many points have no coordinates, or NULL
 * @param env           may be NULL
 * @return ::ICC_OK when the call ran, however many points failed; ::ICC_ERR_ARGUMENT,
 *         ::ICC_ERR_MEMORY, ::ICC_ERR_VERSION or ::ICC_ERR_CANCELLED (the outputs are then
 *         undefined)
 *
 * Charts and maps on a mesh in the plane make what finds points in it when they are first asked,
 * for each direction apart, in time proportional to the mesh: with the object's own memory
 * (icc_env::alloc), whatever `env` is. When there is none, the call fails, and the next one tries
 * again.
 */
ICC_API icc_status icc_chart_encode(const icc_chart *chart, size_t n, const double *points,
                                    uint32_t *facet, double *bary, double *t, icc_status *status,
                                    size_t *n_failed, const icc_env *env);

/**
 * Integral curve coordinates -> Cartesian; the inverse of icc_chart_encode(), and like it ::ICC_OK
 * even if every point failed.
 *
 * @param chart         the chart
 * @param n             number of points
 * @param facet         n facet indices
 * @param bary          n * dim barycentric coordinates, not negative, sum 1 (up to 1e-9)
 * @param t             n shares in [0,1]; t = 0 gives the boundary point, t = 1 the maximum
 * @param[out] points   n * dim coordinates; NaN where there is no point
 * @param[out] status   n statuses: ::ICC_OK, ::ICC_ERR_TRACE (the curve does not reach the maximum,
 *                      or has left the domain there), ::ICC_ERR_ARGUMENT; or NULL
 * @param[out] n_failed how many coordinates have no point, or NULL
 * @param env           may be NULL
 * @return as icc_chart_encode()
 */
ICC_API icc_status icc_chart_decode(const icc_chart *chart, size_t n, const uint32_t *facet,
                                    const double *bary, const double *t, double *points,
                                    icc_status *status, size_t *n_failed, const icc_env *env);

/**
 * The whole curve through a point, from the boundary to the maximum, as a polyline.
 *
 * @param chart          the chart
 * @param point          dim coordinates
 * @param capacity       how many points `curve` has room for
 * @param[out] curve     capacity * dim coordinates; may be NULL when capacity is 0
 * @param[out] n_curve   how many points the curve has, also beyond `capacity`
 * @param env            may be NULL
 * @param err            may be NULL
 * @return ::ICC_OK, ::ICC_ERR_OUTSIDE, ::ICC_ERR_TRACE, ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY,
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
 * @param chart         the chart
 * @param capacity      bytes that `data` has room for
 * @param[out] data     NULL when capacity is 0
 * @param[out] n_bytes  bytes that are needed, also beyond `capacity`: nothing useful is written
 *                      then
 * @return ::ICC_OK, ::ICC_ERR_ARGUMENT
 */
ICC_API icc_status icc_chart_save(const icc_chart *chart, size_t capacity, void *data,
                                  size_t *n_bytes);

/**
 * Reads a chart back. It gives the same results as the one that was saved, bit for bit, with any
 * number of threads. Its info is the same.
 *
 * Charts on a mesh (foliation, disc) are stored in full and certified anew: bytes that do not pass
 * are refused, wherever they come from. Charts on a grid (gradient, field) are rebuilt from their
 * inputs and compared with a checksum of the original's numbers.
 *
 * @param[out] out the chart; owned by the caller
 * @param n_bytes  bytes of `data`
 * @param data     any bytes
 * @param env      may be NULL
 * @param err      may be NULL
 * @return ::ICC_OK; ::ICC_ERR_FORMAT for anything that icc_chart_save() did not write;
 *         ::ICC_ERR_VERSION for what a later version wrote, and for a chart on a grid that gives
 *         different values here than where it was saved; ::ICC_ERR_MEMORY, ::ICC_ERR_CANCELLED,
 *         ::ICC_ERR_ARGUMENT
 *
 * Cost: O(n log n) time and O(n) memory in the number of bytes for charts on a mesh; for charts on
 * a grid as icc_chart_create() with the stored options, up to icc_env::load_limit: bytes that need
 * more are refused (::ICC_ERR_FORMAT) before the work begins.
 */
ICC_API icc_status icc_chart_load(icc_chart **out, size_t n_bytes, const void *data,
                                  const icc_env *env, icc_error *err);

/* ---------------------------------------------------------- charts of maps */

/**
 * Makes a map from two charts, which must use the same method, on domains that correspond as
 * icc_map_create() requires. Kind mesh uses the source chart's mesh. Only the options `kind` and
 * `iterations` are used. The map keeps the charts alive.
 */
ICC_API icc_status icc_map_create_from_charts(icc_map **out, const icc_chart *source,
                                              const icc_chart *target,
                                              const icc_map_options *options, const icc_env *env,
                                              icc_error *err);

/** The chart of the source; borrowed. NULL for maps made by icc_map_retarget(). */
ICC_API const icc_chart *icc_map_source_chart(const icc_map *map);

/** The chart of the target; borrowed. NULL for maps made by icc_map_retarget(). */
ICC_API const icc_chart *icc_map_target_chart(const icc_map *map);

#ifdef __cplusplus
}
#endif

#endif

/**
 * @file icc/stages.h
 * @brief The stages of Integral Curve Coordinates one by one: grid, maximum, tree, function, and
 * the triangulation of sparse points.
 *
 * Use these functions to study or teach the method, or to use one stage alone. The rules of
 * icc/icc.h apply.
 *
 * Source: L. Huynh, Bijective Deformations in R^n via Integral Curve Coordinates, thesis, George
 * Mason University, 2013, chapters 4 and 6; L. Huynh and Y. Gingold, paper of the same name.
 * "Thesis" and "paper" below mean these two.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ICC_STAGES_H
#define ICC_STAGES_H

#include <icc/chart.h>

#ifdef __cplusplus
extern "C" {
#endif

/* -------------------------------------------------------------------- grid */

/** A regular grid of vertices, each inside or outside a shape. Vertex (i_0, i_1, ..) has the
 *  index i_0 + shape[0] * (i_1 + shape[1] * (..)) and the position origin + spacing * i. */
typedef struct icc_grid icc_grid;

/** What icc_grid_get_info() reports. */
typedef struct icc_grid_info {
    size_t size;                /**< set by the caller: `sizeof(icc_grid_info)` */
    int32_t dim;                /**< dimension, 1..::ICC_MAX_DIM */
    size_t shape[ICC_MAX_DIM];  /**< vertices along each axis */
    double origin[ICC_MAX_DIM]; /**< position of vertex 0 */
    double spacing;             /**< distance between neighbours, the same along every axis */
    size_t n_vertices;          /**< product of `shape` */
    size_t n_inside;            /**< vertices inside */
    /** vertices inside the boundary that count as outside: pieces other than the largest, see
     *  icc_grid_create(), and vertices removed by icc_grid_restrict() */
    size_t n_stray;
    /** grid cells along the longest side of the domain; 0 for a grid from a mask of vertices */
    int32_t cells;
} icc_grid_info;

/**
 * Covers a domain with a grid that is at least two vertices wider than the domain on every side.
 *
 * A vertex is inside if it lies strictly inside the boundary. Where a domain is thinner than the
 * grid, the vertices inside may fall into several pieces. Beyond 2-D only the largest piece is
 * kept. The vertices of the other pieces count as outside: icc_grid_info::n_stray.
 *
 * If the domain comes from a mask (icc_domain_create_mask()), the grid includes the boundary's
 * vertices. Each cell of the mask is cut into an even number of parts along each axis: 2, or as
 * many more as `cells` requires.
 *
 * @param[out] out the grid; owned by the caller
 * @param domain   the domain
 * @param cells    cells along the longest side of the bounding box, 2..16384; 0: 50. For masks: at
 *                 least that many; 0: two for each cell of the mask
 * @param env      may be NULL
 * @param err      may be NULL
 * @return ::ICC_OK, or
 * - ::ICC_ERR_RESOLUTION if no vertex is inside, or there would be more than 2^28 vertices
 * - ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY or ::ICC_ERR_CANCELLED
 */
ICC_API icc_status icc_grid_create(icc_grid **out, const icc_domain *domain, int32_t cells,
                                   const icc_env *env, icc_error *err);

/**
 * Makes a grid from a mask of its vertices, with origin 0 and spacing 1. (icc_domain_create_mask()
 * takes a mask of cells instead.)
 *
 * @param[out] out the grid; owned by the caller
 * @param dim      1..::ICC_MAX_DIM
 * @param shape    vertices along each axis, dim numbers; the first axis is fastest
 * @param inside   one byte per vertex: 0 is outside, anything else inside
 * @param env      may be NULL
 * @param err      may be NULL
 */
ICC_API icc_status icc_grid_create_mask(icc_grid **out, int32_t dim, const size_t *shape,
                                        const uint8_t *inside, const icc_env *env, icc_error *err);

/**
 * Makes a grid of half the spacing with the same inside. Each simplex of the Kuhn triangulation is
 * cut into 2^dim. A new vertex halves an edge, and is inside if both ends of the edge are inside.
 * Walls that are one vertex thick stay one vertex thick. For a grid that follows its domain more
 * closely, make one with twice icc_grid_info::cells instead.
 *
 * @param[out] out the grid; owned by the caller
 * @param grid     the grid
 * @param env      may be NULL
 * @param err      may be NULL
 * @return ::ICC_OK, or
 * - ::ICC_ERR_RESOLUTION if there would be more than 2^28 vertices
 * - ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY or ::ICC_ERR_CANCELLED
 */
ICC_API icc_status icc_grid_refine(icc_grid **out, const icc_grid *grid, const icc_env *env,
                                   icc_error *err);

/**
 * Copies a grid and moves some vertices to the outside.
 *
 * @param[out] out the grid; owned by the caller
 * @param grid     the grid
 * @param keep     one byte per vertex: 0 moves it to the outside, counted by icc_grid_info::n_stray
 * @param env      may be NULL
 * @param err      may be NULL
 */
ICC_API icc_status icc_grid_restrict(icc_grid **out, const icc_grid *grid, const uint8_t *keep,
                                     const icc_env *env, icc_error *err);

/** Frees a grid. */
ICC_API void icc_grid_free(icc_grid *grid);

/** Fills in `info`, whose `size` you have set. Returns ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_grid_get_info(const icc_grid *grid, icc_grid_info *info);

/** One byte per vertex, 1 inside and 0 outside; borrowed. */
ICC_API const uint8_t *icc_grid_inside(const icc_grid *grid);

/**
 * Copies the positions of grid vertices.
 *
 * @param grid        the grid
 * @param n           number of vertices
 * @param vertices    n vertex numbers, or NULL for the vertices 0 to n - 1
 * @param[out] points room for n * dim coordinates
 * @return ::ICC_OK; ::ICC_ERR_ARGUMENT if a number is not that of a vertex
 */
ICC_API icc_status icc_grid_get_points(const icc_grid *grid, size_t n, const uint32_t *vertices,
                                       double *points);

/**
 * Finds the maximum: the vertex farthest from the outside in the grassfire transform (Algorithm 1).
 * Of several such vertices it takes the one nearest to their mean, then the smallest index.
 *
 * @param grid        the grid
 * @param[out] vertex the maximum
 * @param[out] rounds number of rounds that the fire burnt before it reached the vertex, 0 for a
 *                    vertex next to the outside; or NULL
 * @param env         may be NULL
 * @param err         may be NULL
 *
 * Cost: O(vertices) time and memory.
 */
ICC_API icc_status icc_grid_find_maximum(const icc_grid *grid, uint32_t *vertex, uint32_t *rounds,
                                         const icc_env *env, icc_error *err);

/** Finds the vertex inside that is nearest to a point; of several, the smallest index.
 *  O(vertices). */
ICC_API icc_status icc_grid_find_nearest(const icc_grid *grid, const double *point,
                                         uint32_t *vertex);

/* -------------------------------------------------------------------- tree */

/** A breadth-first tree over a grid. In a *cousin tree*, which libicc builds where the shape
 *  allows it, any two neighbouring vertices are parent and child or cousins. *Cousins* have
 *  parents that are neighbours too. */
typedef struct icc_tree icc_tree;

/** Options of icc_tree_create(). */
typedef struct icc_tree_options {
    size_t size;  /**< set by the caller: `sizeof(icc_tree_options)` */
    int32_t form; /**< `ICC_TREE_*`; 0: thesis */
    /** the order in which a generation expands along the axes, a permutation of 0..dim-1; NULL:
     *  0, 1, 2 and so on */
    const int32_t *axis_order;
} icc_tree_options;

/** What icc_tree_get_report() reports. */
typedef struct icc_tree_report {
    size_t size;                /**< set by the caller: `sizeof(icc_tree_report)` */
    size_t n_inside;            /**< vertices inside that the tree reaches */
    size_t n_outside;           /**< vertices outside that belong to the tree */
    size_t n_unreachable;       /**< vertices inside that it does not reach */
    size_t n_pairs;             /**< pairs of neighbouring vertices, both inside and reached */
    size_t n_cousin_violations; /**< pairs that are neither parent and child nor cousins */
    uint32_t violation[2];      /**< the first such pair in index order, or UINT32_MAX */
} icc_tree_report;

/**
 * Grows the tree of Algorithm 2 from a vertex inside.
 *
 * Vertices outside that neighbour the inside also have a generation: one more than the smallest
 * among their neighbours inside. The two forms treat them differently. In the thesis' form they
 * have a parent and belong to the tree, as do the vertices that they expand into. In the paper's
 * form their parent is UINT32_MAX, which stands for all their neighbours inside. A grid made by
 * icc_grid_create() is wide enough for both layers. A mask may end at its last vertex and then
 * lacks the layers beyond.
 *
 * The paper's Theorem 2 says that the result is a cousin tree. It held in every 2-D case tried, but
 * is false in 3-D and beyond. The library does not rely on it. icc_tree_get_report() checks it, and
 * icc_tree_grow() finds an order that can be used instead.
 *
 * @param[out] out the tree; owned by the caller. It keeps the grid alive
 * @param grid     the grid
 * @param root     the maximum: a vertex inside
 * @param options  may be NULL
 * @param env      may be NULL
 * @param err      may be NULL
 *
 * Cost: O(vertices * dim) time, 12 bytes a vertex.
 */
ICC_API icc_status icc_tree_create(icc_tree **out, const icc_grid *grid, uint32_t root,
                                   const icc_tree_options *options, const icc_env *env,
                                   icc_error *err);

/**
 * Makes a tree from the caller's parents.
 *
 * The caller gives parents to the vertices inside. The layers outside follow as in
 * icc_tree_create(). The tree need not be a cousin tree: icc_tree_get_report() says whether it is.
 * The parents of a tree from icc_tree_create() give the same tree again.
 *
 * @param[out] out the tree; owned by the caller; keeps the grid alive
 * @param grid     the grid
 * @param root     the maximum: a vertex inside
 * @param parents  one number per grid vertex: a neighbour inside; UINT32_MAX for the root and for
 *                 vertices that the tree leaves out. Numbers of vertices outside are ignored
 * @param options  may be NULL
 * @param env      may be NULL
 * @param err      may be NULL; `index` is a vertex whose parents do not lead to the root
 * @return ::ICC_OK; ::ICC_ERR_ARGUMENT if the parents of a vertex do not lead to the root, or one
 *         of them is not a neighbour inside; ::ICC_ERR_MEMORY, ::ICC_ERR_CANCELLED,
 *         ::ICC_ERR_VERSION
 *
 * Cost: O(vertices * dim) time, 12 bytes a vertex.
 */
ICC_API icc_status icc_tree_create_parents(icc_tree **out, const icc_grid *grid, uint32_t root,
                                           const uint32_t *parents, const icc_tree_options *options,
                                           const icc_env *env, icc_error *err);

/** Frees a tree. */
ICC_API void icc_tree_free(icc_tree *tree);

/** The parent of each vertex: UINT32_MAX for the root and for vertices without one; borrowed. */
ICC_API const uint32_t *icc_tree_parents(const icc_tree *tree);

/** The generation of each vertex: 0 for the root, -1 for unreached vertices; borrowed. */
ICC_API const int32_t *icc_tree_generations(const icc_tree *tree);

/** Checks the cousin rule (Definition 2) on every pair of neighbours inside. O(vertices * dim). */
ICC_API icc_status icc_tree_get_report(const icc_tree *tree, icc_tree_report *report,
                                       const icc_env *env, icc_error *err);

/* ------------------------------------------------------------------- function */

/** Options of icc_function_create(). */
typedef struct icc_function_options {
    size_t size;         /**< set by the caller: `sizeof(icc_function_options)` */
    int32_t function;    /**< `ICC_FUNCTION_*`; 0: decay */
    int32_t constraints; /**< `ICC_CONSTRAINTS_*`; 0: needed */
    /** `ICC_SOLVER_*`; 0: by the predicted work of a factorisation. Clamped, harmonic and
     *  constrained bi-Laplace are always factorised. Laplace is solved iteratively where a
     *  factorisation would lose small values, as in long thin rings */
    int32_t solver;
    double min_fall; /**< least relative fall from parent to child, in (0, 0.01]; 0: 1e-6 */
    /** constrained bi-Laplace: least value at vertices without children, in (0, 0.01]; 0: 1e-9 */
    double leaf_min;
} icc_function_options;

/** What icc_function_get_info() reports. Members that do not apply to the function are 0. */
typedef struct icc_function_info {
    size_t size;         /**< set by the caller: `sizeof(icc_function_info)` */
    int32_t function;    /**< `ICC_FUNCTION_*` */
    int32_t constrained; /**< 1: the tree's inequalities were imposed */
    int32_t solver;      /**< `ICC_SOLVER_*` */
    /** 1: the function is greatest at `highest` and not at the root, where curves should end.
     *  Only seen for bilaplace and clamped without inequalities. icc_chart_create() then moves
     *  the root */
    int32_t beside;
    size_t n_unknowns; /**< vertices inside that the tree reaches, except the root */
    /** tree edges where the function without constraints breaks the inequality; if constraints
     *  were not imposed, where this function does */
    size_t n_violated;
    size_t n_active; /**< inequalities that hold with equality */
    /** KKT residual: the largest |min(slack, multiplier)| of an inequality, or |row of the
     *  equation| if there are no inequalities. The function is 1 at the root */
    double residual;
    double least_log; /**< smallest value of icc_function_logs() inside; 0 if there are none */
    /** how much greater the function is at `highest`, as a share of its value at the root; 0 if
     *  that is the root */
    double excess;
    uint32_t highest; /**< the vertex inside with the greatest value */
} icc_function_info;

/** What icc_function_get_solver_report() reports: how the function was computed. Members that do
 *  not apply are 0. */
typedef struct icc_solver_report {
    size_t size; /**< set by the caller: `sizeof(icc_solver_report)` */
    /** iterations of the active set or interior point method; 0 without constraints */
    size_t n_iterations;
    size_t n_inner; /**< iterations of conjugate gradients, in total */
    double work;    /**< multiplications of the largest factorisation */
    /** icc_function_info::residual before the final sweep from the root to the leaves */
    double residual_before;
    double seconds_setup;  /**< time to number the unknowns and build the matrices */
    double seconds_order;  /**< time for orderings and symbolic factorisations */
    double seconds_factor; /**< time for factorisations */
    double seconds_solve;  /**< time for triangular solves and conjugate gradients */
    double seconds_verify; /**< time to count critical points, sweep and find the residuals */
} icc_solver_report;

/** What icc_function_get_report() reports: critical points of a function on the vertices inside.
 *  They are found from the links of the vertices in the Kuhn triangulation. */
typedef struct icc_function_report {
    size_t size;     /**< set by the caller: `sizeof(icc_function_report)` */
    size_t n_maxima; /**< vertices with no higher neighbour */
    size_t n_minima; /**< vertices with no lower neighbour */
    /** other vertices where the higher or the lower neighbours do not form a contractible set.
     *  Exact up to 3-D. Beyond 3-D a vertex counts as a saddle if neither set can be reduced to
     *  a point by strong collapses */
    size_t n_saddles;
    /** the first critical vertex in index order except the root, or UINT32_MAX */
    uint32_t critical;
} icc_function_report;

/** Kinds of edges that icc_function_get_edges() lists, and of facets that
 *  icc_function_get_facets() lists. */
enum {
    ICC_EDGE_COMPRESSION = 1, /**< the gradients on both sides point to the edge */
    ICC_EDGE_EXPANSION = 2    /**< the gradients on both sides point away from it */
};

/** What icc_function_get_facets() counts. */
typedef struct icc_facet_report {
    size_t size;          /**< set by the caller: `sizeof(icc_facet_report)` */
    size_t n_tested;      /**< facets examined */
    size_t n_compression; /**< facets where curves merge on the way up */
    size_t n_expansion;   /**< facets where curves merge on the way down */
} icc_facet_report;

/**
 * Makes a function: a value for every vertex of a tree.
 *
 * - *decay*: 10 at the root, times 0.95 with each generation (thesis, equation 4.1). From about
 *   generation 13,850 on that would underflow, and the values are -1, -2 and so on.
 * - *distance*: minus the generation.
 * - *laplace*: 1 at the root, 0 at the vertices outside that neighbour the inside, and the mean of
 *   its neighbours at every other vertex. It has the least Dirichlet energy. Beyond those zeros its
 *   value is minus that of two steps back.
 * - *harmonic*: like laplace, but 0 where the grid's edges cross the boundary of the domain that
 *   the grid was made from. The cut edges have weights of their own (F. Gibou, R. P. Fedkiw, L.-T.
 *   Cheng, M. Kang, 2002). Values at the vertices outside continue from there.
 * - *bilaplace*: least sum of squared Laplacians over the vertices inside. This is f = c L^-2
 *   e_root (simply supported, Navier).
 * - *clamped*: least sum of squared Laplacians over the vertices inside and those outside next to
 *   them.
 *
 * Decay and distance depend on the generation alone. Laplace is 0 on a staircase of vertices, which
 * leaves part of the area uncovered at any resolution. With harmonic that part shrinks as the grid
 * gets finer. On the grid of a mask, whose boundary consists of vertices, both are the same.
 *
 * Laplace, harmonic and bilaplace are positive inside, however far from the root. Clamped changes
 * its sign unless it is constrained. With constraints, the function has the least energy among
 * those that fall by `min_fall` along every tree edge inside. Bilaplace and clamped are then also
 * at least `leaf_min` at the leaves.
 *
 * Bilaplace and clamped are shapes of a plate that is loaded at the root. An off-centre load does
 * not make a plate highest right under it. So without constraints the maximum may be another
 * vertex: icc_function_info::highest and icc_function_info::beside. A tree grown from there has a
 * different function. icc_chart_create() moves the root until the two agree.
 *
 * The library assumes nothing about critical points: icc_function_get_report() counts them. On a
 * tree that is not a cousin tree, as in 3-D, the inequalities do not rule out critical points
 * besides the maximum.
 *
 * @param[out] out the function; owned by the caller. It keeps the tree alive
 * @param tree     the tree
 * @param options  may be NULL
 * @param env      may be NULL
 * @param err      may be NULL
 * @return ::ICC_OK, or
 * - ::ICC_ERR_RESOLUTION if the root is the only vertex inside (laplace, bilaplace, clamped,
 *   harmonic)
 * - ::ICC_ERR_UNSUPPORTED for harmonic on a refined grid, or on one that was not made from a domain
 * - ::ICC_ERR_SOLVER if a solver did not converge, see below
 * - ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY, ::ICC_ERR_CANCELLED or ::ICC_ERR_VERSION
 *
 * ::ICC_ERR_SOLVER has been seen in two cases only. One is constrained bilaplace or clamped, if the
 * inequalities ask for more than 1 at the root, as they do on deep trees, or if `leaf_min` is 1e-2.
 * The other is harmonic, where laplace would be solved iteratively.
 */
ICC_API icc_status icc_function_create(icc_function **out, const icc_tree *tree,
                                       const icc_function_options *options, const icc_env *env,
                                       icc_error *err);

/**
 * Makes a function from the caller's values.
 *
 * The values may be any: icc_function_get_report() counts their critical points, and
 * icc_function_info::n_violated is the number of tree edges along which the function does not fall.
 *
 * Values at vertices outside decide where curves meet the boundary. A NaN there is replaced. Beside
 * a vertex inside, the function then falls by as much as from the parent of that vertex to it. (Of
 * several such vertices, the lowest counts.) In the layer behind, it goes on linearly.
 *
 * @param[out] out the function; owned by the caller; keeps the tree alive. Its
 *                 icc_function_info::function is ::ICC_FUNCTION_VALUES
 * @param tree     the tree
 * @param values   one per grid vertex, at most 2^900 in size; NaN is allowed outside. Values at
 *                 vertices that the tree does not reach are ignored
 * @param env      may be NULL
 * @param err      may be NULL; `index` is a vertex whose value is refused
 * @return ::ICC_OK, ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY, ::ICC_ERR_CANCELLED, ::ICC_ERR_VERSION
 *
 * Cost: O(vertices) time, 8 bytes a vertex.
 */
ICC_API icc_status icc_function_create_values(icc_function **out, const icc_tree *tree,
                                              const double *values, const icc_env *env,
                                              icc_error *err);

/**
 * Makes a function from the logarithms of its values. Doubles cannot hold the values of long limbs,
 * which fall below 2^-1022. At the vertices outside, the function is that of
 * ::ICC_FUNCTION_LAPLACE: 0 beside the inside, and negative behind.
 *
 * @param[out] out as for icc_function_create_values()
 * @param tree     the tree
 * @param logs     one natural logarithm per grid vertex, at most 2^28 in size at the vertices
 *                 inside that the tree reaches; others are ignored
 * @param env      may be NULL
 * @param err      may be NULL; `index` is a vertex inside whose logarithm is not finite
 * @return as for icc_function_create_values()
 */
ICC_API icc_status icc_function_create_logs(icc_function **out, const icc_tree *tree,
                                            const double *logs, const icc_env *env, icc_error *err);

/**
 * Solves an equation with the caller's fixed values and right-hand side.
 *
 * (L f)(v) is the sum of f(v) - f(u) over the 2 dim neighbours u of v along the axes, whatever the
 * spacing. The equation holds at every vertex inside that the tree reaches and that is not fixed:
 * - laplace: L f = right_side. This f has the least Dirichlet energy minus the sum of
 *   right_side f.
 * - bilaplace: L (L f) = right_side, where L f is 0 at the vertices outside (simply supported).
 *
 * At vertices outside that neighbour the inside, f is the fixed value, or 0 if that is NaN. The
 * root is free unless you fix it. Fixed to 1, and with nothing else, it gives the function of
 * icc_function_create() without constraints. Values may have any sign, and critical points
 * anywhere: icc_function_get_report(). icc_function_info::n_unknowns counts the free vertices, and
 * icc_function_info::residual is the largest error of the equation at these.
 *
 * @param[out] out   the function; owned by the caller; keeps the tree alive
 * @param tree       the tree
 * @param options    function: laplace, or 0 for the same, or bilaplace. Constraints: none, or 0 for
 *                   the same. Solver: direct, or 0 for the same. NULL: laplace
 * @param fixed      one value per grid vertex, at most 2^900 in size, or NaN where it is free;
 *                   NULL: no vertex is fixed
 * @param right_side one finite number per grid vertex; only those of free vertices count; NULL: 0
 * @param env        may be NULL
 * @param err        may be NULL; `index` is a vertex whose value is too large, or whose right-hand
 *                   side is not finite
 * @return ::ICC_OK, or
 * - ::ICC_ERR_UNSUPPORTED for other functions, constraints needed or all, and solver iterative
 * - ::ICC_ERR_SOLVER if a value exceeds 2^900 in size, or rounding spoils six digits
 * - ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY, ::ICC_ERR_CANCELLED or ::ICC_ERR_VERSION
 *
 * Cost: one factorisation, as for icc_function_create() with a direct solver. About 300 bytes a
 * vertex inside in 2-D besides the factor.
 */
ICC_API icc_status icc_function_create_solve(icc_function **out, const icc_tree *tree,
                                             const icc_function_options *options,
                                             const double *fixed, const double *right_side,
                                             const icc_env *env, icc_error *err);

/** The function of a chart of method gradient or field, or NULL for other charts; borrowed, like
 *  the tree and the grid that belong to it. */
ICC_API const icc_function *icc_chart_function(const icc_chart *chart);

/** The tree that a function was made on; borrowed. */
ICC_API const icc_tree *icc_function_tree(const icc_function *function);

/** The grid that a tree was grown on; borrowed. */
ICC_API const icc_grid *icc_tree_grid(const icc_tree *tree);

/** The vertex that a tree was grown from; UINT32_MAX for NULL. */
ICC_API uint32_t icc_tree_root(const icc_tree *tree);

/** Frees a function. */
ICC_API void icc_function_free(icc_function *function);

/** Fills in `info`, whose `size` you have set. Returns ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_function_get_info(const icc_function *function, icc_function_info *info);

/** Fills in `report`, whose `size` you have set. Returns ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_function_get_solver_report(const icc_function *function,
                                                  icc_solver_report *report);

/** One value per grid vertex; NaN where the tree does not reach; borrowed. Beyond 2-D the
 *  function of a gradient chart extends to some vertices outside. Laplace and bilaplace decay
 *  exponentially in long limbs. Values below 2^-1022 are 0 here, and those above 2^1024
 *  infinite, but icc_function_logs() has them. */
ICC_API const double *icc_function_values(const icc_function *function);

/**
 * The natural logarithm of every value, accurate even where the values underflow. It is -HUGE_VAL
 * outside and NaN where the tree does not reach; borrowed. NULL for decay and distance, and if some
 * value inside is not positive.
 *
 * The logarithms of a chart's function are computed on first use, by any thread, with 8 bytes a
 * vertex. The result is also NULL if there is no memory for them then.
 */
ICC_API const double *icc_function_logs(const icc_function *function);

/** Counts critical points. Vertices outside or without a value count as lower than all others.
 *  Equal values are ordered by vertex index. Cost: about 10 ns a vertex in 2-D and 3-D, up to 10
 *  us in 6-D. */
ICC_API icc_status icc_function_get_report(const icc_function *function,
                                           icc_function_report *report, const icc_env *env,
                                           icc_error *err);

/**
 * Lists compression and expansion edges in 2-D (thesis, sections 5 and 6.4). It looks at edges
 * between two triangles that have a value at every corner, with at least one corner inside.
 *
 * @param function      the function
 * @param capacity      number of edges that the arrays have room for
 * @param[out] edges    `capacity` pairs of vertices
 * @param[out] kinds    `capacity` kinds, `ICC_EDGE_*`
 * @param[out] n_edges  number of edges found, which may exceed `capacity`
 * @param[out] n_tested number of edges examined, or NULL
 * @return ::ICC_OK, ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY, or ::ICC_ERR_UNSUPPORTED if it is not
 *         2-D
 */
ICC_API icc_status icc_function_get_edges(const icc_function *function, size_t capacity,
                                          uint32_t *edges, int32_t *kinds, size_t *n_edges,
                                          size_t *n_tested);

/**
 * Lists compression and expansion facets in any dimension. In 2-D these are the edges of
 * icc_function_get_edges(), in the same order.
 *
 * A facet is shared by two simplices of the Kuhn triangulation. It is examined if both have a value
 * at every corner and at least one corner is inside. Exact signs of differences decide to which
 * side of it each gradient points, as they do for curves. A gradient parallel to the facet counts
 * for neither kind. Curves from the other side may merge there, too.
 *
 * Curves also run along lower faces (edges in 3-D, for example). These are not listed.
 *
 * @param function     the function
 * @param capacity     number of facets that the arrays have room for; 0: only count
 * @param[out] facets  `capacity` times dim vertices, or NULL if `capacity` is 0
 * @param[out] kinds   `capacity` kinds, `ICC_EDGE_*`, or NULL if `capacity` is 0
 * @param[out] report  its `size` is set by the caller. n_compression + n_expansion is the number of
 *                     facets found, which may exceed `capacity`
 * @param env          may be NULL
 * @param err          may be NULL
 * @return ::ICC_OK, ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY, ::ICC_ERR_CANCELLED or ::ICC_ERR_VERSION
 *
 * Cost: dim! (dim + 1) / 2 facets a vertex. 60 ns a vertex in 2-D, 0.2 us in 3-D, 0.7 us in 4-D,
 * and up to 15 us in 6-D.
 */
ICC_API icc_status icc_function_get_facets(const icc_function *function, size_t capacity,
                                           uint32_t *facets, int32_t *kinds,
                                           icc_facet_report *report, const icc_env *env,
                                           icc_error *err);

/* ------------------------------------------------------------------ curves */

/** Integral curves of a function through given points, uphill or downhill. The function is linear
 *  in every simplex of the grid's Kuhn triangulation, so each curve is a polyline. */
typedef struct icc_curves icc_curves;

/** The two ways along a curve: icc_curves_create(). */
enum {
    ICC_WAY_UP = 1,  /**< uphill, to a maximum */
    ICC_WAY_DOWN = 2 /**< downhill, to the boundary */
};

/** How a curve ends: icc_curves_get_ends(). */
enum {
    ICC_END_NONE = 0,     /**< no curve: the point lies outside, or where there are no values */
    ICC_END_MAXIMUM = 1,  /**< at the root of the tree */
    ICC_END_BOUNDARY = 2, /**< on the boundary of the domain that the grid was made from */
    /** at a vertex other than the root that has no higher neighbour, or downhill no lower one */
    ICC_END_CRITICAL = 3,
    /** where the values end. This is usual downhill on a grid from a mask of vertices, which has no
     *  boundary */
    ICC_END_VALUES = 4
};

/** What icc_curves_get_info() reports. */
typedef struct icc_curves_info {
    size_t size;       /**< set by the caller: `sizeof(icc_curves_info)` */
    int32_t dim;       /**< dimension */
    int32_t way;       /**< `ICC_WAY_*` */
    size_t n_curves;   /**< as many as there were points */
    size_t n_vertices; /**< vertices of all curves */
    size_t n_merged;   /**< curves that others join, see icc_curves_get_ends() */
} icc_curves_info;

/**
 * Traces the curves through points (Algorithms 3 to 5). The signs of differences of f decide
 * exactly which simplex comes next. Doubles give the place where the curve enters it.
 *
 * @param[out] out  the curves; owned by the caller; they do not need the function any more
 * @param function  the function
 * @param n         number of points
 * @param points    n * dim coordinates
 * @param way       `ICC_WAY_*`
 * @param env       may be NULL
 * @param err       may be NULL; `index` is a point that is not finite
 * @return ::ICC_OK, also if some points have no curve; ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY,
 *         ::ICC_ERR_CANCELLED, ::ICC_ERR_VERSION
 *
 * Cost: some 50 ns a vertex in 2-D, 150 ns in 3-D; the curves take 8 * dim bytes a vertex.
 */
ICC_API icc_status icc_curves_create(icc_curves **out, const icc_function *function, size_t n,
                                     const double *points, int32_t way, const icc_env *env,
                                     icc_error *err);

/** Frees curves. */
ICC_API void icc_curves_free(icc_curves *curves);

/** Fills in `info`, whose `size` the caller has set. ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_curves_get_info(const icc_curves *curves, icc_curves_info *info);

/**
 * Copies the vertices of the curves. Both arrays may be NULL.
 *
 * @param curves        the curves
 * @param[out] first    room for n_curves + 1 numbers. The vertices of curve i are first[i] to
 *                      first[i + 1] - 1. The first one is its point
 * @param[out] vertices room for n_vertices * dim coordinates
 * @return ::ICC_OK or ::ICC_ERR_ARGUMENT
 */
ICC_API icc_status icc_curves_get_vertices(const icc_curves *curves, size_t *first,
                                           double *vertices);

/**
 * Copies how the curves end. Every array may be NULL. The others have room for one entry a curve.
 *
 * @param curves       the curves
 * @param[out] ends    `ICC_END_*`
 * @param[out] lengths arc length
 * @param[out] alone   arc length up to the first vertex, edge or other lower face that the curve
 *                     follows, where other curves join it; the whole length if there is none.
 *                     Uphill, points share the rest of their curve (compression). Downhill, no
 *                     curve from the boundary reaches the point (expansion; thesis, 6.4)
 * @param[out] facets  the facet of the boundary where the curve ends, or UINT32_MAX
 * @param[out] bary    n_curves * dim barycentric coordinates on that facet, or 0
 * @return ::ICC_OK or ::ICC_ERR_ARGUMENT
 */
ICC_API icc_status icc_curves_get_ends(const icc_curves *curves, int32_t *ends, double *lengths,
                                       double *alone, uint32_t *facets, double *bary);

/* ------------------------------------------------------------------- order */

/** How icc_tree_grow() found an order. */
enum {
    ICC_GROW_AS_GIVEN = 1, /**< the given order is regular */
    ICC_GROW_GROWN = 2,    /**< some vertices had to wait for others */
    /** growth got stuck; instead the vertices were removed one by one, and that order was
     *  reversed */
    ICC_GROW_THINNED = 3
};

/** What icc_tree_grow() reports. */
typedef struct icc_grow_report {
    size_t size;    /**< set by the caller: `sizeof(icc_grow_report)` */
    int32_t method; /**< `ICC_GROW_*` */
    /** the first vertex in the given order that growth could not place, or UINT32_MAX */
    uint32_t vertex;
    size_t n_vertices;  /**< vertices inside that the tree reaches */
    size_t n_deferred;  /**< vertices that had to wait while growing */
    size_t n_unplaced;  /**< vertices left when growth got stuck */
    size_t n_remaining; /**< vertices left, except the root, if thinning got stuck too */
    size_t n_reversed;  /**< edges of the Kuhn triangulation whose two ends changed order */
    size_t n_tests;     /**< links that were tested: less than 2^(dim+3) a vertex */
} icc_grow_report;

/**
 * Orders the vertices inside so that the root is the only critical one. A function that falls with
 * the rank then has one critical point, the maximum, in any dimension.
 *
 * In 2-D the tree's own order had this property in every case tried. Beyond 2-D it often does not,
 * see icc_tree_create(). Here a set grows from the root, in the given order. It takes each vertex
 * whose neighbours in the set form a contractible part of its link. Other vertices wait until
 * theirs do. (The links are those of the Kuhn triangulation, and are tested as for
 * icc_function_report::n_saddles.) If growth gets stuck, the set of all vertices is thinned down to
 * the root instead.
 *
 * Both fail for some shapes, such as Bing's house with two rooms. A finer grid may help. Nothing
 * helps if the vertices inside do not form a ball, which may happen where parts of a surface come
 * close to each other. Growth then leaves out the few vertices where it would close a ring.
 *
 * @param tree        the tree
 * @param values      the preferred order, as one value per grid vertex, the largest first; equal
 *                    values in the order of the tree. NULL: the order of the tree
 * @param[out] rank   room for one number per grid vertex: 0 for the root, then 1, 2 and so on.
 *                    UINT32_MAX for vertices outside or not reached. Undefined after a failure
 *                    other than ::ICC_ERR_TOPOLOGY
 * @param[out] report what was done, or NULL; also after ::ICC_ERR_TOPOLOGY
 * @param env         may be NULL
 * @param err         may be NULL; `index` is the vertex where growth got stuck
 * @return ::ICC_OK, or
 * - ::ICC_ERR_TOPOLOGY if both got stuck. The vertices that growth has placed have their ranks, the
 *   others UINT32_MAX. Remove these with icc_grid_restrict(), and the order has one critical vertex
 * - ::ICC_ERR_ARGUMENT, for example if a value inside is NaN
 * - ::ICC_ERR_MEMORY or ::ICC_ERR_CANCELLED
 *
 * Cost: less than 2^(dim+3) tests a vertex, in practice about one: 0.1 us in 2-D, 0.3 us in 3-D.
 * Memory: 6 bytes a grid vertex, and 8 a vertex inside for `values`.
 */
ICC_API icc_status icc_tree_grow(const icc_tree *tree, const double *values, uint32_t *rank,
                                 icc_grow_report *report, const icc_env *env, icc_error *err);

/**
 * Counts the critical vertices of any order of the vertices inside, as icc_function_get_report()
 * does for functions. It tests every link, wherever the order comes from. Only vertices that the
 * tree reaches count.
 *
 * @param tree        the tree
 * @param rank        one number per grid vertex, smaller for higher vertices; equal numbers count
 *                    as in icc_function_get_report(). Numbers of other vertices are ignored
 * @param[out] report its `size` is set by the caller
 * @param env         may be NULL
 * @param err         may be NULL
 */
ICC_API icc_status icc_tree_get_rank_report(const icc_tree *tree, const uint32_t *rank,
                                            icc_function_report *report, const icc_env *env,
                                            icc_error *err);

/* ----------------------------------------------------------- triangulation */

/**
 * Computes the constrained Delaunay triangulation of a simple polygon with points inside (2-D).
 *
 * All decisions are exact. Triangles are counter-clockwise (y upwards). No vertex is added, so a
 * polygon of b vertices with p points inside always has b + 2 p - 2 triangles.
 *
 * @param n_boundary     number of vertices of the polygon, in either orientation; they come first
 * @param n_points       number of all vertices, including those of the polygon
 * @param points         n_points * 2 coordinates
 * @param[out] triangles room for 3 * (2 * n_points - n_boundary - 2) vertex indices
 * @param env            may be NULL
 * @param err            may be NULL; `index` is a point that is not strictly inside the polygon, or
 *                       that repeats another
 * @return ::ICC_OK, ::ICC_ERR_BOUNDARY, ::ICC_ERR_OUTSIDE, ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY or
 *         ::ICC_ERR_CANCELLED
 *
 * Cost: O(n log n) in practice, about 1 us and 100 bytes a vertex.
 */
ICC_API icc_status icc_triangulate(size_t n_boundary, size_t n_points, const double *points,
                                   uint32_t *triangles, const icc_env *env, icc_error *err);

#ifdef __cplusplus
}
#endif

#endif

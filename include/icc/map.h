/**
 * @file icc/map.h
 * @brief Domains, maps between them, matches and pictures: what most programs need.
 *
 *     icc_domain (a boundary and what it encloses), twice
 *       -> icc_match (common vertices, if the two boundaries do not correspond)
 *       -> icc_map (a one-to-one map of the insides that agrees with the boundaries)
 *         -> mapped points, derivatives, meshes and pictures
 *
 * The rules that hold for all objects are in icc/icc.h.
 *
 * Four terms are used throughout:
 * - A map or chart is *certified* if libicc has proved that it is one-to-one.
 * - The *energy* of a map measures its distortion: icc_map_info::energy. A map of low distortion
 *   changes angles and sizes little.
 * - A *chart* gives coordinates to the inside of a domain, along curves that all end at one inner
 *   point, the *maximum*: icc/chart.h. Maps are made from two charts.
 * - A *simplex* is a triangle in 2-D and a tetrahedron in 3-D. A *facet* is a piece of a boundary:
 *   an edge in 2-D and a triangle in 3-D.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ICC_MAP_H
#define ICC_MAP_H

#include <icc/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------ domain */

/** A shape: its boundary, and what lies inside. */
typedef struct icc_domain icc_domain;

/** Where a point lies: icc_domain_locate(). */
enum {
    ICC_INSIDE = 1, /**< in the interior */
    /** On the boundary, within a tolerance. The tolerance is 1e-14 of the bounding box's longest
     *  side, or `dim` * 2^-52 of the largest coordinate along each axis, whichever is more. So a
     *  point of a facet that you compute in doubles from the facet's vertices counts as on the
     *  boundary. */
    ICC_BOUNDARY = 2,
    ICC_OUTSIDE = 3 /**< outside, or in a hole */
};

/** What icc_domain_get_info() reports. */
typedef struct icc_domain_info {
    size_t size; /**< set by the caller: `sizeof(icc_domain_info)` */
    int32_t dim; /**< dimension */
    /** +1 if the facets are listed as seen from outside, else -1. Seen from outside means: in
     *  1-D the lower end comes first; in 2-D the ring runs counter-clockwise (y upwards); in 3-D
     *  each face runs counter-clockwise. In any dimension, the determinants of the facets are
     *  positive as seen from an inner point */
    int32_t orientation;
    size_t n_vertices;         /**< vertices of the boundary and of all features */
    size_t n_facets;           /**< facets of the boundary, of holes and of regions */
    double lower[ICC_MAX_DIM]; /**< bounding box, lower corner */
    double upper[ICC_MAX_DIM]; /**< bounding box, upper corner */
    /** length, area (2-D) or volume (3-D), without holes. It may overflow to HUGE_VAL if
     *  coordinates are near 1e300 */
    double measure;
    size_t n_features; /**< features: icc_domain_create_features() */
    /** vertices of the mesh of the inside, including those on the boundary; 0: no mesh */
    size_t n_mesh_vertices;
    size_t n_mesh_simplices; /**< simplices of that mesh */
    /** with features: places where 3 or more sides meet. A side is a segment between two vertices
     *  of the outer ring or of features, counted once */
    size_t n_junctions;
    size_t n_pieces;  /**< with features: connected pieces of all rings, lines and points */
    size_t n_faces;   /**< with features: parts that rings and lines divide the domain into */
    size_t n_voids;   /**< 3-D: closed surfaces of the boundary besides the outermost one */
    size_t genus;     /**< 3-D: handles of all surfaces of the boundary together */
    size_t n_holes;   /**< features of kind ::ICC_FEATURE_HOLE */
    size_t n_lines;   /**< features of kind ::ICC_FEATURE_LINE, with the circles around points */
    size_t n_points;  /**< features of kind ::ICC_FEATURE_POINT */
    size_t n_regions; /**< features of kind ::ICC_FEATURE_REGION */
} icc_domain_info;

/**
 * Makes a domain from its boundary. Either orientation is accepted and remembered.
 *
 * *2-D*: a simple polygon, which does not touch itself. If `facets` is NULL, facet i joins the
 * vertices i and i + 1, and the last facet leads back to vertex 0. Otherwise each facet is two
 * vertex indices. The facets must form one closed ring through all vertices, in any order but all
 * in the same direction. Vertices on a straight line are fine. libicc checks exactly that
 * - no edge has length zero,
 * - no vertex is repeated,
 * - no edges cross, touch or run back over each other.
 *
 * *3-D*: a closed surface of triangles, three vertex indices each, in any order. Coplanar faces are
 * fine. libicc checks exactly that
 * - no face has area 0,
 * - each edge belongs to two faces, which run along it in opposite directions,
 * - the faces at each vertex form one cycle,
 * - the surface does not meet itself: two faces share only their common vertices and edges.
 *
 * The surface may have handles, and the solid may have voids. A void is a closed surface inside the
 * outer one that is turned the other way. libicc checks exactly that there is one outer surface,
 * and that nothing lies in a void. Handles and voids are counted in icc_domain_info::genus and
 * icc_domain_info::n_voids. Charts, grids, kernels and matches need a ball, without either.
 *
 * *4-D to 6-D*: a closed boundary of simplices, dim vertex indices each. libicc checks that
 * - each ridge (dim - 1 vertices) belongs to two facets, which run along it in opposite directions,
 * - the facets at each vertex are connected, and the boundary is one piece,
 * - no facet is flat (exact in 4-D, up to rounding of 4e-13 beyond),
 * - the volume is not 0, up to rounding.
 *
 * Beyond 3-D it does NOT check whether the boundary meets itself, nor its topology.
 *
 * *1-D*: an interval, which has two facets of one vertex each.
 *
 * All checks use the coordinates as given. The shape may lie anywhere and have any size, such as an
 * offset of 1e9 or coordinates of 1e300. Internally it is shifted and scaled by exact operations. A
 * coordinate is refused if it is not 0 and at most 2^-200 times the largest one. Except in 2-D,
 * vertices that belong to no facet are kept but ignored.
 *
 * @param[out] out   the domain; owned by the caller, see icc_domain_free()
 * @param dim        1..::ICC_MAX_DIM
 * @param n_vertices at least dim + 1
 * @param vertices   n_vertices * dim coordinates
 * @param n_facets   number of facets; ignored if `facets` is NULL
 * @param facets     n_facets * dim vertex indices; NULL in 2-D only
 * @param env        may be NULL
 * @param err        may be NULL; `index` is the vertex or facet at fault. If there are two, the
 *                   message names both
 * @return ::ICC_OK, or
 * - ::ICC_ERR_BOUNDARY if the shape is not valid
 * - ::ICC_ERR_TOPOLOGY if it has several pieces, or something lies in a void
 * - ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY, ::ICC_ERR_VERSION or ::ICC_ERR_CANCELLED
 *
 * Cost: O(n log n) time and O(n) memory for ordinary shapes, about 50 ns a vertex in 2-D and 1 us a
 * triangle in 3-D.
 */
ICC_API icc_status icc_domain_create(icc_domain **out, int32_t dim, size_t n_vertices,
                                     const double *vertices, size_t n_facets,
                                     const uint32_t *facets, const icc_env *env, icc_error *err);

/** Kinds of features: icc_feature::kind. */
enum {
    /** a simple polygon whose inside is not part of the domain; in 3-D a void, which is a closed
     *  surface of triangles */
    ICC_FEATURE_HOLE = 1,
    /** a polyline of 2 or more vertices; with two vertices, a bone. In 2-D it is closed if the last
     *  vertex repeats the first one */
    ICC_FEATURE_LINE = 2,
    ICC_FEATURE_POINT = 3, /**< one vertex */
    /** a simple polygon whose inside is part of the domain: for example a county, an island in a
     *  hole, or a polygon beside the outer ring. In 3-D a closed surface of triangles inside the
     *  outer one, with the domain on both sides */
    ICC_FEATURE_REGION = 4
};

/** A hole, line, point or region of a domain. A map takes it to the feature of the same number in
 *  the other domain: vertex to vertex, and edge to edge or triangle to triangle linearly. */
typedef struct icc_feature {
    /** set by the caller: `sizeof(icc_feature)`, the same for all elements of an array */
    size_t size;
    int32_t kind; /**< `ICC_FEATURE_*` */
    /** hole, region: at least 3, in 3-D at least 4; line: at least 2; point: 1 */
    size_t n_vertices;
    const double *vertices; /**< n_vertices times 2 coordinates, in 3-D times 3 */
    /** 2-D, point: its size, if above 0, see icc_domain_create_features(). Otherwise 0 */
    double radius;
    size_t n_facets; /**< 3-D, hole or region: number of its triangles. Otherwise 0 */
    /** 3-D, hole or region: 3 n_facets numbers of its own vertices. Otherwise NULL */
    const uint32_t *facets;
} icc_feature;

/**
 * Makes a domain of the plane with features inside: holes, lines, points and regions. You choose
 * where a map takes them.
 *
 * The vertices of the domain are those of the outer ring, followed by those of the features in
 * their order. Its facets are the edges of the outer ring, followed by the edges of the holes and
 * then by those of the regions.
 *
 * *Where the domain is.* A place belongs to the domain if it lies in more of the outer ring and the
 * regions than of the holes. So a region inside the outer ring divides the domain, a region in a
 * hole is an island, and a region outside adds to the domain. With regions, `n_outer` may be 0. A
 * region with holes is a region and holes.
 *
 * *Features may share vertices*, whose coordinates must be exactly equal: with each other, with the
 * outer ring and with themselves. They may run along the same edges, so regions can share borders,
 * and lines can end on the boundary. The other domain of a map must share the same vertices, and
 * around each of them the edges must leave in the same order. libicc checks exactly, with the
 * coordinates as given, that
 * - edges meet only at common vertices; no vertex lies inside another edge
 * - no line repeats a vertex at once or runs along an edge twice
 * - each ring is a simple polygon; rings may run either way
 * - two rings share no edge, unless one of them is a region
 * - nothing lies outside the domain.
 *
 * A point with a radius is a handle with a size. The circle around it moves along and may grow or
 * shrink, but does not turn. The domain represents the circle by a line of 16 vertices, a regular
 * polygon that lacks one edge. These lines become further features. They follow all given features,
 * in the order of their points. In the other domain the same points must have a radius.
 *
 * For icc_domain_locate(), points in a hole are outside. Points on a line, at a point feature or on
 * a border between regions are inside. Only mesh maps (::ICC_MAP_MESH) work on a domain with
 * features. Other functions that take a domain refuse it with ::ICC_ERR_UNSUPPORTED. Without
 * features the result is that of icc_domain_create().
 *
 * @param[out] out   the domain; owned by the caller, see icc_domain_free()
 * @param n_outer    vertices of the outer ring, at least 3; with regions it may be 0
 * @param outer      2 n_outer coordinates; NULL if n_outer is 0
 * @param n_features number of features
 * @param features   n_features of them; they are copied
 * @param env        may be NULL
 * @param err        may be NULL. If the outer ring is at fault, `index` is its vertex or edge.
 *                   Otherwise `index` is the feature (::ICC_ITEM_FEATURE), and the message names
 *                   its vertex and any other feature involved. Circles are numbered from n_features
 * @return ::ICC_OK, or
 * - ::ICC_ERR_OUTSIDE if a feature lies outside the domain, or crosses or touches the outer ring
 *   elsewhere than at a common vertex
 * - ::ICC_ERR_BOUNDARY if features meet themselves or one another elsewhere than at a common vertex
 * - ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY, ::ICC_ERR_VERSION or ::ICC_ERR_CANCELLED
 *
 * Cost: O(n log n) time and O(n) memory for n vertices in all.
 */
ICC_API icc_status icc_domain_create_features(icc_domain **out, size_t n_outer, const double *outer,
                                              size_t n_features, const icc_feature *features,
                                              const icc_env *env, icc_error *err);

/**
 * Makes a solid in 3-D with features inside: voids, inner surfaces, lines and points. You choose
 * where a map takes them.
 *
 * The outer surface is that of icc_domain_create(). It may have handles, and voids of its own. Each
 * feature of kind ::ICC_FEATURE_HOLE or ::ICC_FEATURE_REGION is one closed surface, which may have
 * handles and may be turned either way. A hole is a void: its inside is not part of the domain. A
 * region divides the domain. Regions may contain voids and other regions. Voids are empty. A line
 * is a polyline that does not close.
 *
 * The vertices of the domain are those of the outer surface, followed by those of the features in
 * their order. Its facets are the triangles of the outer surface, then those of the holes, then
 * those of the regions.
 *
 * libicc checks exactly, with the coordinates as given, that
 * - every surface passes the checks of icc_domain_create(), and every vertex is used
 * - features touch neither themselves, nor one another, nor the outer surface
 * - everything lies inside the outer surface, and nothing lies in a void.
 *
 * For icc_domain_locate(), points in a void are outside. Points on an inner surface, on a line or
 * at a point are inside. Without features the result is that of icc_domain_create().
 *
 * @param[out] out   the domain; owned by the caller, see icc_domain_free()
 * @param n_vertices vertices of the outer surface, at least 4
 * @param vertices   3 n_vertices coordinates
 * @param n_facets   triangles of the outer surface, at least 4
 * @param facets     3 n_facets vertex numbers
 * @param n_features number of features
 * @param features   n_features of them; they are copied
 * @param env        may be NULL
 * @param err        may be NULL. If the outer surface is at fault, `index` is its vertex or facet.
 *                   Otherwise `index` is the feature (::ICC_ITEM_FEATURE), and the message names
 *                   its vertex or face and any other feature involved, in their own numbers
 * @return ::ICC_OK, or
 * - ::ICC_ERR_OUTSIDE if a feature lies outside the outer surface or in a void, or touches the
 *   outer surface
 * - ::ICC_ERR_BOUNDARY if a surface is not valid, or features meet themselves or one another
 * - ::ICC_ERR_TOPOLOGY if the outer surface has several pieces side by side or something in its
 *   voids, or a feature has several pieces
 * - ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY, ::ICC_ERR_VERSION or ::ICC_ERR_CANCELLED
 *
 * Cost: O(n log n) time and O(n) memory for n vertices in all.
 */
ICC_API icc_status icc_domain_create_solid(icc_domain **out, size_t n_vertices,
                                           const double *vertices, size_t n_facets,
                                           const uint32_t *facets, size_t n_features,
                                           const icc_feature *features, const icc_env *env,
                                           icc_error *err);

/**
 * Makes a domain from a mask of cells, such as pixels or voxels. Cell (i_0, i_1, ..) covers [i_0,
 * i_0 + 1] x [i_1, i_1 + 1] x .. in coordinates 0, 1, 2 and so on. (icc_grid_create_mask() takes a
 * mask of grid vertices instead.)
 *
 * The mask must be solid and without holes:
 * - The cells form one piece, joined by faces. So does the outside.
 * - No two cells touch only along an edge or a corner. The same holds for gaps.
 * - The Euler characteristic is 1.
 *
 * In 2-D and 3-D this makes the mask a disc or a ball. In higher dimensions, holes of different
 * dimensions may cancel out and pass; then icc_tree_grow() fails on the grid of the mask.
 *
 * Each cell is cut in two along each axis. Each boundary face of the pieces is cut into (dim - 1)!
 * simplices, as in Kuhn's triangulation. The grid that icc_grid_create() makes is cut in the same
 * way. icc_domain_get_boundary() returns these facets and their vertices. The vertices are sorted
 * with the first axis fastest, except that a 2-D domain is a counter-clockwise polygon. The target
 * of a map from a mask is a domain with the same facets and moved vertices.
 *
 * @param[out] out the domain; owned by the caller
 * @param dim      1..::ICC_MAX_DIM
 * @param shape    cells along each axis, dim numbers
 * @param cells    one byte per cell, the first axis fastest: 0 is outside, anything else inside
 * @param env      may be NULL
 * @param err      may be NULL; `index` is a cell at fault
 * @return ::ICC_OK, or
 * - ::ICC_ERR_TOPOLOGY if the mask is not as described
 * - ::ICC_ERR_RESOLUTION if its grid would have more than 2^28 vertices, or too many facets
 * - ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY or ::ICC_ERR_CANCELLED
 *
 * Cost: at most O(cells * 4^dim) time, 0.15 us a cell in 3-D, in addition to icc_domain_create().
 */
ICC_API icc_status icc_domain_create_mask(icc_domain **out, int32_t dim, const size_t *shape,
                                          const uint8_t *cells, const icc_env *env, icc_error *err);

/**
 * A mesh of triangles in 2-D, tetrahedra in 3-D, or simplices beyond. It is either yours, and
 * libicc only reads it, or it has room for a mesh that libicc writes.
 *
 * To get a mesh, call icc_domain_get_mesh() or icc_map_get_mesh() twice. The first time, set
 * `vertices` and `cells` to NULL; the call sets the dimension and the counts. The second time, pass
 * arrays of that size. Either array may stay NULL.
 */
typedef struct icc_mesh {
    size_t size; /**< set by the caller: `sizeof(icc_mesh)` */
    int32_t dim; /**< dimension */
    /** number of vertices, fewer than 2^26; when libicc writes the mesh, the capacity of
     *  `vertices` */
    size_t n_vertices;
    double *vertices; /**< n_vertices * dim coordinates */
    /** number of cells, fewer than 2^26; when libicc writes the mesh, the capacity of `cells` */
    size_t n_cells;
    /** n_cells * (dim + 1) vertex indices, cell after cell. A cell may list its vertices in any
     *  order */
    uint32_t *cells;
    /** NULL if every cell has dim + 1 vertices. Otherwise n_cells + 1 numbers as in VTK: where
     *  each cell begins in `cells`, and where the last one ends */
    const size_t *offsets;
    /** VTK's types of the n_cells cells, or NULL. Only simplices are supported, 5 in 2-D and 10 in
     *  3-D, and quadrilaterals, 9, by icc_fit_create(). Other types give ::ICC_ERR_UNSUPPORTED */
    const uint8_t *types;
    /** For icc_domain_create_mesh() in 3-D: a number for each of the n_cells cells. Otherwise NULL,
     *  or the call gives ::ICC_ERR_UNSUPPORTED */
    const int32_t *regions;
} icc_mesh;

/**
 * Makes a domain from a conforming mesh of its inside: triangles in 2-D, tetrahedra in 3-D,
 * simplices beyond. On such a domain ::ICC_METHOD_FOLIATION works in every dimension. Everything
 * else works as on a domain made from its boundary alone.
 *
 * The vertices of the domain are the boundary vertices of the mesh, in the order of the mesh. Two
 * domains correspond, as icc_map_create() requires, if they have the same number of boundary
 * vertices and the same facets. Their meshes may differ inside.
 *
 * You may pass the facets yourself, for example in the order of the surface that was meshed.
 * Otherwise libicc sorts them by their vertices, the smallest index first, and orients them as seen
 * from outside.
 *
 * libicc checks the following, exactly up to 3-D and up to rounding beyond:
 * - The boundary passes the checks of icc_domain_create().
 * - Every simplex has a volume.
 * - A facet belongs to at most two simplices, which lie on opposite sides of it.
 * - The mesh is connected. In 2-D and beyond 3-D its Euler characteristic is 1. In 3-D it may have
 *   handles and voids, as for icc_domain_create().
 *
 * So the simplices fill the domain and do not overlap. Vertices that belong to no simplex are
 * ignored.
 *
 * *Regions.* If icc_mesh::regions gives the cells different numbers, the facets between cells of
 * different numbers become features of kind ::ICC_FEATURE_REGION, and a map keeps them. Each
 * connected part of a number but the outermost one is the inside of a region. The regions come in
 * the order of their numbers. icc_domain_get_regions() then has the numbers of the features, and
 * icc_domain_get_mesh() has the cells in your order. The surfaces must be closed and touch neither
 * one another nor the boundary.
 *
 * @param[out] out the domain; owned by the caller
 * @param mesh     the mesh, of dimension 2..::ICC_MAX_DIM
 * @param n_facets number of facets of the boundary; ignored if `facets` is NULL
 * @param facets   n_facets * dim vertex indices of the mesh's boundary, all seen from the same
 *                 side; or NULL
 * @param env      may be NULL
 * @param err      may be NULL; `index` is the simplex, vertex or given facet at fault. If the
 *                 boundary is refused, vertices and facets are those of the domain
 * @return ::ICC_OK, or
 * - ::ICC_ERR_BOUNDARY if a simplex is flat or lists a vertex twice or one that does not exist; if
 *   three simplices share a facet, or two lie on one side of it; if `facets` are not the boundary;
 *   or if a surface between regions touches another one or the boundary
 * - ::ICC_ERR_TOPOLOGY if the mesh has several pieces, or holes other than in 3-D
 * - ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY or ::ICC_ERR_CANCELLED
 *
 * Cost: O(n) time and memory in addition to icc_domain_create(), 0.5 us a tetrahedron.
 */
ICC_API icc_status icc_domain_create_mesh(icc_domain **out, const icc_mesh *mesh, size_t n_facets,
                                          const uint32_t *facets, const icc_env *env,
                                          icc_error *err);

/** Options of icc_domain_fill(): how it chooses inner vertices. */
typedef struct icc_fill_options {
    size_t size; /**< set by the caller: `sizeof(icc_fill_options)` */
    /** tetrahedra are refined until the circumradius is at most this many shortest edges; at
     *  least 1.2. 0: the default. Infinite: no vertices except those that filling needs */
    double ratio;
    uint64_t max_points; /**< refinement ends at this number of inner vertices; 0: no limit */
} icc_fill_options;

/**
 * Fills a domain in 3-D with tetrahedra, which leave out its voids. The result is a domain with a
 * mesh, as icc_domain_create_mesh() makes it. Its vertices and facets are those of the surface, bit
 * for bit. New vertices are added inside only. Vertices that belong to no facet are left out.
 *
 * The mesh keeps what icc_domain_create_solid() put inside. Points are vertices, inner surfaces
 * consist of faces, and lines of edges, with new vertices on the lines where they need some.
 * icc_domain_get_regions() tells the part of each tetrahedron.
 *
 * Every decision about the mesh is exact, and the result passes the checks of
 * icc_domain_create_mesh(). It has the same bits on every machine. There is no guarantee that every
 * surface can be filled. There is none for angles either: tetrahedra next to the surface may be
 * very flat. docs/theory/solid-maps.md says what is tried.
 *
 * @param[out] out the filled domain, owned by the caller
 * @param surface  a domain in 3-D without a mesh
 * @param options  may be NULL
 * @param env      may be NULL
 * @param err      may be NULL
 * @return ::ICC_OK, or
 * - ::ICC_ERR_UNSUPPORTED if `surface` is not in 3-D or has a mesh
 * - ::ICC_ERR_RESOLUTION if a facet cannot be told apart from its surroundings; icc_error::index
 *   names it
 * - ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY or ::ICC_ERR_CANCELLED
 *
 * Cost: about 10 us and 200 bytes per tetrahedron; several times as long if filling fails.
 */
ICC_API icc_status icc_domain_fill(icc_domain **out, const icc_domain *surface,
                                   const icc_fill_options *options, const icc_env *env,
                                   icc_error *err);

/**
 * Repairs a mask in which cells, or gaps, touch only along an edge or a corner.
 * icc_domain_create_mask() refuses such masks. The function fills cells one at a time, each time
 * the one that leaves the fewest such contacts around it. Contacts that filling cannot remove stay,
 * and so does every other defect.
 *
 * @param dim           1..::ICC_MAX_DIM
 * @param shape         cells along each axis
 * @param[in,out] cells as for icc_domain_create_mask(); filled cells become 1
 * @param[out] n_filled number of filled cells, or NULL
 * @param env           may be NULL
 * @param err           may be NULL
 * @return ::ICC_OK; on ::ICC_ERR_RESOLUTION, ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY or
 *         ::ICC_ERR_CANCELLED the cells are unchanged
 */
ICC_API icc_status icc_mask_repair(int32_t dim, const size_t *shape, uint8_t *cells,
                                   size_t *n_filled, const icc_env *env, icc_error *err);

/** Frees a domain. */
ICC_API void icc_domain_free(icc_domain *domain);

/** Fills in `info`, whose `size` you have set. Returns ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_domain_get_info(const icc_domain *domain, icc_domain_info *info);

/** What icc_domain_get_feature() reports. */
typedef struct icc_feature_info {
    size_t size;  /**< set by the caller: `sizeof(icc_feature_info)` */
    int32_t kind; /**< `ICC_FEATURE_*` */
    /** hole or region: +1 if it is listed counter-clockwise (y upwards; in 3-D as seen from outside
     *  it), -1 if clockwise; else 0 */
    int32_t orientation;
    size_t first_vertex; /**< number of its first vertex in the domain; the others follow */
    size_t n_vertices;   /**< number of its vertices */
    /** hole or region: number of its first facet; in 2-D the one from its first vertex to the next.
     *  Else 0 */
    size_t first_facet;
    size_t n_facets; /**< hole or region: number of its facets. Else 0 */
    size_t genus;    /**< 3-D, hole or region: number of its handles. Else 0 */
    /** 3-D: the region in which it lies, as icc_domain_get_regions() numbers them; else 0 */
    size_t around;
} icc_feature_info;

/**
 * Reports a feature of a domain. Its coordinates are among those that icc_domain_get_boundary()
 * copies.
 *
 * @param domain       the domain
 * @param feature      its number, less than icc_domain_info::n_features
 * @param[in,out] info set its `size`; the rest is filled in
 * @return ::ICC_OK or ::ICC_ERR_ARGUMENT
 */
ICC_API icc_status icc_domain_get_feature(const icc_domain *domain, size_t feature,
                                          icc_feature_info *info);

/**
 * Copies the mesh of the inside, if the domain comes from icc_domain_create_mesh() or
 * icc_domain_fill(). Boundary vertices come first, in the order of icc_domain_get_boundary(); inner
 * vertices follow. Each cell has a positive determinant.
 *
 * @param domain       a domain with a mesh: icc_domain_info::n_mesh_vertices is not 0
 * @param[in,out] mesh the arrays that you provide are filled; then the dimension and the counts are
 *                     set
 * @return ::ICC_OK, or
 * - ::ICC_ERR_ARGUMENT if `domain` or `mesh` is NULL, or the arrays are too small
 * - ::ICC_ERR_UNSUPPORTED if the domain has no mesh
 */
ICC_API icc_status icc_domain_get_mesh(const icc_domain *domain, icc_mesh *mesh);

/**
 * Copies the region of each cell of the mesh, for a solid that icc_domain_fill() filled, or a mesh
 * that came with icc_mesh::regions. Regions are numbered like the features of kind
 * ::ICC_FEATURE_REGION, starting at 1. Cells of region k lie within the k-th such surface, but not
 * within a region inside it. Cells within no such surface have number 0. The files that the command
 * `libicc` writes count from 1 instead, as libicc-files(5) explains.
 *
 * @param domain       a domain with a mesh: icc_domain_info::n_mesh_simplices is not 0
 * @param[out] regions room for n_mesh_simplices numbers
 * @return ::ICC_OK, or
 * - ::ICC_ERR_ARGUMENT if `domain` or `regions` is NULL
 * - ::ICC_ERR_UNSUPPORTED if the domain has no mesh
 */
ICC_API icc_status icc_domain_get_regions(const icc_domain *domain, uint32_t *regions);

/**
 * Copies the boundary as it was given. If the domain has features, the vertices include those of
 * all features, and the facets include those of the holes and regions. With regions, some facets
 * may lie inside the domain.
 *
 * @param domain        the domain
 * @param[out] vertices room for n_vertices * dim doubles, or NULL
 * @param[out] facets   room for n_facets * dim indices, or NULL
 */
ICC_API icc_status icc_domain_get_boundary(const icc_domain *domain, double *vertices,
                                           uint32_t *facets);

/**
 * Reports where points lie, and the nearest point of the boundary to each.
 *
 * Up to 3-D the answer is exact, up to the tolerance of ::ICC_BOUNDARY. Beyond 3-D, points within
 * about 1e-13 of the bounding box's longest side from the boundary may be misplaced. If a boundary
 * beyond 3-D meets itself, a point is inside if an odd number of layers separates it from infinity.
 *
 * @param domain     the domain
 * @param n          number of points
 * @param points     n * dim coordinates; a point that is not finite is outside
 * @param[out] where n values ::ICC_INSIDE, ::ICC_BOUNDARY or ::ICC_OUTSIDE
 * @param[out] facet n indices of the nearest facet, or NULL
 * @param[out] bary  n * dim barycentric coordinates of the nearest point on that facet, or NULL
 * @param env        may be NULL
 *
 * Cost: O(log n) a point for ordinary shapes; in 3-D with 27,000 faces 1 us, or 5 to 10 us with the
 * nearest facet.
 */
ICC_API icc_status icc_domain_locate(const icc_domain *domain, size_t n, const double *points,
                                     int32_t *where, uint32_t *facet, double *bary,
                                     const icc_env *env);

/** Defects that icc_boundary_defects() lists. Here a and b are indices of vertices or facets. */
enum {
    ICC_DEFECT_NOT_FINITE = 1, /**< vertex a has a coordinate that is not finite; b = a */
    ICC_DEFECT_REPEATED = 2,   /**< vertices a < b coincide */
    ICC_DEFECT_SPIKE = 3,      /**< at vertex a the boundary turns back over itself; b = a */
    ICC_DEFECT_CROSSING = 4,   /**< facets a < b cross */
    ICC_DEFECT_TOUCH = 5,      /**< facets a < b touch or overlap without sharing a vertex */
    ICC_DEFECT_FLAT = 6        /**< the shape has no area; a = b = 0 */
};

/**
 * Lists the defects that keep a closed polygon from being the boundary of a domain. They are sorted
 * by a, then by b. Vertices that are not finite are listed and otherwise ignored.
 *
 * @param n_vertices     vertices of the ring
 * @param vertices       n_vertices * 2 coordinates; facet i joins vertices i and i + 1
 * @param capacity       number of defects that the two arrays have room for
 * @param[out] kinds     `capacity` kinds, `ICC_DEFECT_*`
 * @param[out] items     `capacity` pairs (a, b), see `ICC_DEFECT_*`
 * @param[out] n_defects number of defects, which may exceed `capacity`. The search ends at 10,000 +
 *                       4 n_vertices defects
 * @param env            may be NULL
 * @param err            may be NULL
 *
 * Cost: O((n + k) log n) for k pairs of facets whose boxes overlap.
 */
ICC_API icc_status icc_boundary_defects(size_t n_vertices, const double *vertices, size_t capacity,
                                        int32_t *kinds, uint32_t *items, size_t *n_defects,
                                        const icc_env *env, icc_error *err);
/* ------------------------------------------------------------------- match */

/** Two domains that do not correspond, and the pairs of points that belong together. */
typedef struct icc_match icc_match;

/** How icc_match_create() treats rotations. */
enum {
    /** prefer small rotations: of nearly equal pairings take the one that turns the shape least.
     *  People expect this of letters, squares and maps */
    ICC_TURNING_UPRIGHT = 1,
    ICC_TURNING_FREE = 2 /**< no preference: any rotation is as good as any other */
};

/** How icc_match_create() pairs the parts of two outlines between landmarks. */
enum {
    ICC_BETWEEN_ELASTIC = 1, /**< by shape: similar parts are paired */
    /** by arc length, for outlines without distinct parts, such as discs. By shape these would
     *  be ambiguous. Without landmarks the pairing starts where the two outlines are nearest
     *  when laid on one another unturned */
    ICC_BETWEEN_ARC = 2
};

/** Options of icc_match_create(). */
typedef struct icc_match_options {
    size_t size;     /**< set by the caller: `sizeof(icc_match_options)` */
    int32_t turning; /**< without landmarks: `ICC_TURNING_*`; 0: upright */
    int32_t between; /**< `ICC_BETWEEN_*`; 0: elastic */
    /** without landmarks: pairings whose icc_match_info::sure is less are refused. 0: 1.06. 1:
     *  none is refused */
    double least_sure;
    /** in the plane: a share of the perimeter, at most 0.01. If the pairing brings a vertex of
     *  the source and one of the target within this distance of each other, they become one
     *  common vertex instead of two. This is not done where an edge next to them would become
     *  three times longer or shorter. 0: only vertices within 0.3 of the shorter edge at them
     *  are joined */
    double drop;
    /** in space: how far the common surfaces may be off the given ones, as a share of the
     *  diagonal of each one's bounding box. At most 0.1; 0: 1e-3. A negative value means not at
     *  all: the result then has four to six times as many vertices as both surfaces together and
     *  many thin triangles. Even then, vertices that rounding brings together are joined, up to
     *  1e-3 */
    double tolerance;
    /** in space, 1: the source keeps all its vertices and edges. Its edges and triangles get
     *  more vertices where the target would otherwise be too far off. 0: it need not keep them.
     *  In the plane the source always keeps its vertices */
    int32_t keep_source;
} icc_match_options;

/** What icc_match_get_info() reports. */
typedef struct icc_match_info {
    size_t size; /**< set by the caller: `sizeof(icc_match_info)` */
    int32_t dim; /**< dimension */
    /** 1: the target's mirror image fits clearly better, by the same measure as `sure`. Perhaps
     *  y points down in one of the two. This is only a hint, because a map cannot mirror.
     *  Without landmarks only */
    int32_t mirrored;
    size_t n_vertices;  /**< common vertices of the two domains */
    size_t n_landmarks; /**< common vertices that are landmarks */
    size_t n_joined;    /**< common vertices that are vertices of both given domains */
    /** cost of the outlines' pairing, from 0 for similar shapes to 4. HUGE_VAL by arc length and in
     *  space. Of several parts: `cost` to `turn` and `mirrored` are about the one whose pairing by
     *  shape is least sure. If the whole has placed all parts, they are about the one that costs
     *  most */
    double cost;
    /** cost of the best pairing that differs from this one by more than 5 % of the perimeter.
     *  HUGE_VAL if none was found, if there were landmarks, or if the whole has placed all parts */
    double second;
    /** (second + 0.05) / (cost + 0.05): confidence in the pairing. 1 means that another pairing
     *  is as good. It is a comparison, not a probability */
    double sure;
    /** degrees by which the source is turned, counter-clockwise, to lie as the target does */
    double turn;
    /** how much the outer ring shrinks where it shrinks most: the edge's share of the target's
     *  perimeter over its share of the source's. In space, the same for triangles and areas */
    double least_slope;
    double most_slope; /**< the same where the outer ring grows most */
    /** in space: distortion of the common triangles, both surfaces scaled to the same area. It
     *  is the mean, by area of the source, of (s^2 + t^2) (1 + 1 / (s t)^2) for the singular
     *  values s and t. 4 means that no length changes */
    double energy;
    /** in space: largest distance between the common and the given surfaces. It is measured both
     *  ways, from vertices and from middles of edges and triangles, as a share of the diagonal,
     *  like icc_match_options::tolerance */
    double off;
    /** in space: smallest angle of the common triangles on either surface, in degrees */
    double least_angle;
    size_t n_overlay; /**< in space: common vertices before the surfaces were simplified */
} icc_match_info;

/**
 * Pairs the boundaries of two domains that do not correspond, and gives them common vertices. The
 * two new domains have the given shapes and are ready for icc_map_create(). The given ones may
 * differ in number of vertices, in first vertex and in direction.
 *
 * *Outlines.* Without landmarks libicc compares all starting points by how the outlines turn at
 * several scales. It then tries rotations and follows the best pairing. This is a heuristic. It
 * guarantees that the pairing is monotone and passes through all landmarks, but not that it is the
 * one you mean.
 *
 * Every vertex of the two domains is in the result, bit for bit and in its order. The vertices that
 * one outline lacks are added on its edges, rounded. The result begins with the source's vertex 0
 * and runs in the source's direction. It passes the checks of icc_domain_create(). If two outlines
 * have the same number of vertices, and vertex i clearly belongs to vertex i + k for some k, they
 * are paired vertex by vertex (not by arc length). So the result of a match passes through another
 * match unchanged.
 *
 * *Several outlines.* A domain may have several parts: regions beside one another, or an island in
 * a hole. Both domains must have as many. Parts are paired by their places in the bounding box of
 * the whole, by the roots of their shares of the area, and by twice their numbers of holes, at the
 * least sum of squares. Then outlines are paired part by part. A part whose shape is ambiguous,
 * such as the round dot of an i, is placed by the affine map that fits the other outlines and its
 * own centre best. So is any other part that then fits clearly better. The whole should lie upright
 * in both domains, or landmarks should tell which parts belong together.
 *
 * *Features.* Each hole, line and point is paired with one of its kind in the partner of its part.
 * The pairing of the outline around it predicts where it should lie in the target, by mean value
 * coordinates. The assignment minimises the sum of squared distances to these places. Holes, closed
 * lines and regions inside others are then paired along themselves from where they lie nearest,
 * lines from end to end. The result has the source's features, in its order and directions, and
 * their partners in the target. Features that meet one another or the outer ring are refused.
 *
 * *Surfaces.* In space the two surfaces get common triangles. Both are drawn on the sphere,
 * one-to-one, and cut by one another there. Both are then simplified together up to
 * icc_match_options::tolerance, except where a surface would meet itself. Exact signs prove that
 * the drawings are one-to-one and are cut into the same pieces, before positions are rounded.
 * libicc checks on each result that neither surface meets itself, and measures icc_match_info::off.
 *
 * It does not guarantee that similar parts are paired. Without landmarks this works for surfaces
 * that are nearly the same up to a motion, or that bend moderately. It does not work for bodies
 * with limbs in other poses, as icc_match_info::energy shows. With landmarks, each at a vertex, the
 * parts between the same landmarks are paired. Landmarks become common vertices, wherever they lie.
 * Vertices that remain keep their bits. Facets are listed as seen from outside.
 *
 * *icc_match_options::keep_source.* In space, the source's surface then stays as it is. Common
 * vertices begin with those of the source that have facets, in their order. Others are added on its
 * edges and inside its facets, rounded. No common facet is part of two facets of the source. The
 * target is as close as without this option. Thin triangles of the source stay thin.
 *
 * @param[out] out    the match; owned by the caller, see icc_match_free()
 * @param source      a domain of the plane, possibly with features, or a surface in space without a
 *                    mesh
 * @param target      likewise, of the same dimension. It has as many parts, holes, regions inside
 *                    others, lines, closed lines, points, and points with a radius
 * @param n_landmarks number of pairs of points that are known, at most 1000; in space 128
 * @param landmarks   n_landmarks * 2 dim coordinates: a point of the source, followed by its
 *                    partner in the target. Or NULL if there are none. In the plane a point on the
 *                    boundary is taken as it is. Any other point stands for the nearest vertex
 *                    within 0.5 % of the shape's diameter, or else for the nearest boundary point.
 *                    Here the boundary includes point features, holes and lines, so such a landmark
 *                    also says which features belong together. In space a point stands for the
 *                    nearest vertex
 * @param options     may be NULL
 * @param env         may be NULL
 * @param err         may be NULL; `index` is the landmark at fault, or as stated below
 * @return ::ICC_OK, or
 * - ::ICC_ERR_AMBIGUOUS if another pairing is nearly as good: give a landmark, or ask for arc
 *   length. Also if two features or parts could change places: `index` is one of the source's, and
 *   a landmark on it decides
 * - ::ICC_ERR_ARGUMENT if a landmark is more than 2 % of the diameter off an outline, coincides
 *   with another one, comes in a different order on the two outlines, or pairs features of
 *   different kinds
 * - ::ICC_ERR_UNSUPPORTED for another dimension, a domain with a mesh, or features that meet
 * - ::ICC_ERR_BOUNDARY if the numbers of parts or features differ; or if common vertices cannot be
 *   told apart in doubles, where `index` is one of them
 * - ::ICC_ERR_RESOLUTION if the triangles of a surface differ too much in size to be drawn on the
 *   sphere in doubles. Also if landmarks differ so much in position that paths between them take
 *   too many vertices
 * - ::ICC_ERR_MEMORY, ::ICC_ERR_VERSION or ::ICC_ERR_CANCELLED
 *
 * Cost: in 2-D some tenths of a second for each part, and parts are paired in parallel. Plus O(m^3)
 * at worst for m features of a kind. In space about 1 s for 4,700 vertices. Deterministic. The map
 * between the two new domains takes longer to make than one between outlines that correspond.
 */
ICC_API icc_status icc_match_create(icc_match **out, const icc_domain *source,
                                    const icc_domain *target, size_t n_landmarks,
                                    const double *landmarks, const icc_match_options *options,
                                    const icc_env *env, icc_error *err);

/** Frees a match. */
ICC_API void icc_match_free(icc_match *match);

/** The source with the common vertices; borrowed. */
ICC_API const icc_domain *icc_match_source(const icc_match *match);

/** The target with the common vertices; borrowed. */
ICC_API const icc_domain *icc_match_target(const icc_match *match);

/** Fills in `info`, whose `size` you have set. Returns ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_match_get_info(const icc_match *match, icc_match_info *info);

/**
 * Reports where the common vertices come from.
 *
 * @param match       the match
 * @param[out] source for each common vertex (icc_match_info::n_vertices) its number in the given
 *                    source, or UINT32_MAX if it was added; or NULL
 * @param[out] target likewise for the given target
 * @return ::ICC_OK or ::ICC_ERR_ARGUMENT
 */
ICC_API icc_status icc_match_get_origins(const icc_match *match, uint32_t *source,
                                         uint32_t *target);

/**
 * Takes points of the source's boundary to the target's boundary.
 *
 * A point first moves to the nearest place on the boundary of icc_match_source(): on the outer
 * ring, a hole, a line or a point; in space on the surface. From there it goes to the same place of
 * icc_match_target(). All common vertices go to their partners bit for bit, including those of
 * lines, points and landmarks. Between them each edge or facet is mapped one-to-one. Points of a
 * given surface are at most icc_match_info::off away from the common one.
 *
 * To transfer data that is known at the corners of the given facets, such as texture coordinates,
 * call icc_domain_locate() on the given domain. For each vertex of icc_match_source(), or any other
 * point, it returns the facet and the weights of its corners.
 *
 * @param match       the match
 * @param n           number of points
 * @param points      n * dim coordinates
 * @param[out] images n * dim coordinates; NaN for a point that is not finite. May be the same array
 *                    as `points`
 * @param[out] off    distance of each point from that nearest place; NaN for a point that is not
 *                    finite. May be NULL
 * @param env         may be NULL
 * @return ::ICC_OK, ::ICC_ERR_ARGUMENT, ::ICC_ERR_VERSION or ::ICC_ERR_CANCELLED
 *
 * Cost: that of icc_domain_locate() with the nearest facet.
 */
ICC_API icc_status icc_match_apply(const icc_match *match, size_t n, const double *points,
                                   double *images, double *off, const icc_env *env);

/** Takes points of the target's boundary to the source's; otherwise like icc_match_apply(). */
ICC_API icc_status icc_match_apply_inverse(const icc_match *match, size_t n, const double *points,
                                           double *images, double *off, const icc_env *env);

/** Writes a match and both its domains to memory, as icc_chart_save() does a chart. */
ICC_API icc_status icc_match_save(const icc_match *match, size_t capacity, void *data,
                                  size_t *n_bytes);

/** Reads a match back, as icc_chart_load() does a chart. Its domains are checked as they were
 *  when they were made, and must correspond. The contents of icc_match_info and
 *  icc_match_get_origins() come from the bytes. */
ICC_API icc_status icc_match_load(icc_match **out, size_t n_bytes, const void *data,
                                  const icc_env *env, icc_error *err);

/* --------------------------------------------------------------------- map */

/** A map from one domain to another that agrees with the boundaries. */
typedef struct icc_map icc_map;

/** How a map works. */
enum {
    /** A *curve map* takes each point through the two charts, as the papers do. It works in any
     *  dimension. */
    ICC_MAP_CURVES = 1,
    /** A *mesh map* is piecewise linear on an internal mesh. It is always certified and has the
     *  fastest queries: less than 0.1 us a point in 2-D, 1 to 5 us in 3-D. On the boundary it
     *  agrees with the given facets up to rounding: images of points on a facet lie on the
     *  target's facet to one unit in the last place.
     *
     *  In 2-D the mesh is made of triangles that fill the source. Every vertex has an image,
     *  chosen for low distortion. Every triangle is exactly positive before and after, which
     *  means that it keeps its orientation. Both boundaries are exactly simple.
     *
     *  In 3-D the map needs two closed surfaces. The source is filled unless it brings a mesh.
     *  The map is made without charts and uses the source's mesh, with images that are chosen
     *  and certified as in 2-D. Where necessary, inner edges of the source's mesh between
     *  boundary vertices are cut, or the map is made on the target's mesh.
     *
     *  In 4-D to 6-D the map is made without charts. Its mesh is that of either domain, or the
     *  cells of either mask, or the cone from one inner vertex to all facets. The cone needs a
     *  point inside each boundary that sees all of it, or nearly all. Certified then means that
     *  every simplex is positive before and after. The signs are certain, but a simplex that is
     *  nearly flat counts as inverted. Whether a boundary meets itself is not checked. */
    ICC_MAP_MESH = 2
};

/** A path between two vertices of a domain with features, and its path in the target. Ties tell
 *  a map on which side one feature passes another. The map takes the first path to one that can
 *  be moved to the second with its ends held and without crossing a feature. */
typedef struct icc_tie {
    /** set by the caller: `sizeof(icc_tie)`, the same for all elements of an array */
    size_t size;
    /** first and last vertex: numbers of the domain, see icc_domain_create_features() */
    uint32_t vertex[2];
    size_t n_source;      /**< number of its bends in the source */
    const double *source; /**< 2 n_source coordinates */
    size_t n_target;      /**< number of its bends in the target, which may differ */
    const double *target; /**< 2 n_target coordinates */
} icc_tie;

/** Whether vertices of features may slide: icc_map_options::slide. A *chain* is a row of edges of
 *  rings and lines between two places where more or fewer than two edges meet, a line ends, or a
 *  point lies. A closed chain begins and ends at one of its vertices. The ends of a chain go to
 *  their partners. If the chain slides, its other vertices need not. The chain as a whole still
 *  goes exactly to its partner, edge by edge and in order. libicc chooses where vertices go, so
 *  that the energy is low. That suits interfaces of materials and borders whose vertices mean
 *  nothing by themselves. Circles around points do not slide. The energy is never higher than
 *  without sliding. */
enum {
    ICC_SLIDE_NONE = 0,   /**< vertex i goes to vertex i */
    ICC_SLIDE_INSIDE = 1, /**< chains inside the domain slide */
    ICC_SLIDE_ALL = 2     /**< chains of the boundary slide as well */
};

/** Options of icc_chart_create(); see icc/chart.h. */
struct icc_chart_options;

/** Options of icc_map_create(). */
typedef struct icc_map_options {
    size_t size; /**< set by the caller: `sizeof(icc_map_options)` */
    /** `ICC_MAP_*`: this kind, or ::ICC_ERR_CERTIFICATE if no such map is found. 0: the best
     *  that is found, see icc_map_info::kind. That is a mesh map for foliation and disc in 2-D,
     *  unless both domains bring meshes, and for foliation in 3-D. From 3-D on it is also a mesh
     *  map if `chart` names neither a method nor a maximum. It is a curve map in all other cases,
     *  or if no mesh map is found */
    int32_t kind;
    /** mesh map: at most this many improvement steps on each level of refinement. 0: as long as
     *  they pay off. -1: no improvement */
    int32_t iterations;
    /** For both charts, or NULL. Its `maximum` is the source's. For a mesh map in 2-D, method 0
     *  means disc (foliation if a maximum is given), and cells 0 means 20. In 3-D, a map gets
     *  charts if a method, a maximum or kind ::ICC_MAP_CURVES is asked for, and for masks.
     *  Method 0 then means foliation, or field for masks. Beyond 3-D, a mesh map has no charts,
     *  so kind ::ICC_MAP_MESH allows neither a method nor a maximum. */
    const struct icc_chart_options *chart;
    const double *target_maximum; /**< the target's maximum; NULL: chosen by the method */
    /** with features: in each part of the domain, one less than it has pieces; or 0. A piece is
     *  what is connected by lines and rings, see icc_domain_info::n_pieces */
    size_t n_ties;
    /** with features: paths that join all pieces of each part to a tree. They lie inside both
     *  domains and do not cross. NULL: libicc chooses the way that looks least twisted */
    const icc_tie *ties;
    /** with features: `ICC_SLIDE_*`, whether vertices may slide along lines and borders. The map
     *  then needs improvement, so `iterations` must not be -1. Ends of ties stay. Several maps are
     *  made in turn, which may take 5 to 15 times as long. Domains without features and
     *  icc_map_create_from_charts() refuse to slide with ::ICC_ERR_UNSUPPORTED */
    int32_t slide;
} icc_map_options;

/** Why a chart or a map is not certified. If there are several reasons, the first is given. The
 *  members named here count how much is wrong. */
enum {
    ICC_REASON_NONE = 0,       /**< it is certified */
    ICC_REASON_GRADIENT = 1,   /**< the curves of method gradient merge */
    ICC_REASON_INFEASIBLE = 2, /**< field: icc_field_info::n_infeasible */
    ICC_REASON_NOT_INWARD = 3, /**< field: icc_field_info::n_not_inward */
    ICC_REASON_STRAY = 4,      /**< field: icc_field_info::n_stray */
    ICC_REASON_LOST = 5,       /**< maps of method field: icc_map_report::n_lost */
    ICC_REASON_FLAT = 6        /**< maps of method field: icc_map_report::n_flat */
};

/** What icc_map_get_info() reports about a map. It is saved with the map. Members that do not
 *  apply to the kind are 0. */
typedef struct icc_map_info {
    size_t size;  /**< set by the caller: `sizeof(icc_map_info)` */
    int32_t dim;  /**< dimension */
    int32_t kind; /**< `ICC_MAP_*`: never 0 */
    /** 1: proved to be one-to-one, exactly (field: in doubles, see icc_map_report::n_lost). 0:
     *  not, see `reason` */
    int32_t certified;
    int32_t reason;      /**< `ICC_REASON_*`: why it is not certified; 0 if it is */
    int32_t reason_side; /**< whose chart is the reason: 1 the source's, 2 the target's; else 0 */
    /** with features, 1: the map is isotopic to the expected one, so it can be moved there while
     *  it stays one-to-one. After icc_map_create() the expected map is the one that the ties
     *  describe, or else the cuts that libicc chose. After icc_map_retarget() it is the previous
     *  map, carried along while every vertex of the target moves straight to its new place. 0:
     *  not so, or undecided, because rounding or the paths of the vertices leave it open */
    int32_t class_kept;
    size_t n_vertices;  /**< mesh map: vertices */
    size_t n_simplices; /**< mesh map: triangles, tetrahedra in 3-D, or simplices beyond */
    /** mesh map: its distortion, the mean symmetric Dirichlet energy |J|^2 + |J^-1|^2, where J
     *  is the derivative of the map, with the target scaled to the source's area or volume. The
     *  least possible value, 2 dim, means that no length changes */
    double energy;
    size_t n_holes;  /**< features: holes */
    size_t n_lines;  /**< features: lines */
    size_t n_points; /**< features: points */
    size_t n_ties;   /**< with features: number of ties, see icc_map_get_tie() */
    /** length of the ties in the target, divided by that of the straight lines between their
     *  ends. The map is twisted if it is much more than 1 */
    double detour;
    /** with features: places with a given vertex that does not go to its partner, see
     *  icc_map_options::slide */
    size_t n_slid;
} icc_map_info;

/** What icc_map_get_report() reports about how a map was made. Members that do not apply to the
 *  kind are 0. Seconds of the parts are 0 if the map was loaded. */
typedef struct icc_map_report {
    size_t size;    /**< set by the caller: `sizeof(icc_map_report)` */
    double seconds; /**< time to make the map, including the charts; or to load it */
    /** mesh map: of `seconds`, the time for repair, until all simplices keep their orientation */
    double seconds_repair;
    double seconds_improve; /**< mesh map: of `seconds`, the time to improve the map */
    /** of `seconds`, the time to certify a mesh map or a curve map of method field */
    double seconds_certify;
    double energy_start; /**< mesh map: icc_map_info::energy before the improvement */
    size_t n_inverted;   /**< mesh map: simplices that were inverted or flat at first */
    /** curve map, if a mesh map was tried first: simplices that stayed inverted; in 3-D by the
     *  best of several ways */
    size_t n_unrepaired;
    size_t n_iterations; /**< mesh map: improvement steps */
    int32_t n_levels;    /**< mesh map: refinements */
    /** with features: number of tried ways to cut them apart that led to a map; 1 with ties */
    int32_t n_trees;
    /** field: evenly spread points that were mapped there and back, half of them in the target.
     *  0 unless both charts are certified */
    size_t n_samples;
    /** field: samples that come back more than 1e-9 of the bounding box's diagonal away, or
     *  whose derivative does not match that of the way back. 0 if certified */
    size_t n_lost;
    /** field: samples around which volume shrinks to less than 1e-6 of its mean. At most 0.2 %
     *  if certified */
    size_t n_flat;
    /** mesh map: simplices that become flat or reversed, on either side, when icc_map_get_mesh()
     *  rounds them. 0 unless a shape is about 1e9 times as far from the origin as it is large */
    size_t n_spoilt;
} icc_map_report;

/**
 * Makes the map between two domains whose boundaries correspond. Facet i goes to facet i, with the
 * same barycentric coordinates.
 *
 * If the boundary moves by an affine map, up to rounding, a mesh map moves the inside by the same
 * affine map, up to rounding. Vertices still go exactly to their partners. This does not hold with
 * `iterations` -1, or with features whose ties ask for another isotopy class.
 *
 * Both charts are built together, and their maxima are paired.
 *
 * In 3-D, a source without a mesh is filled by icc_domain_fill() without options, unless the
 * method is gradient or field. Method field needs no mesh. A target without a mesh is filled for a
 * chart. A mesh map is found for most pairs in
 * 3-D, but not for all. docs/theory/solid-maps.md says what is tried. For 4-D to 6-D
 * docs/theory/higher-maps.md does.
 *
 * @param[out] out the map; owned by the caller, see icc_map_free()
 * @param source   the domain before
 * @param target   the domain after. It has the same dimension, number of vertices and facets, and
 *                 features of the same kinds with as many vertices. In 2-D its rings, including the
 *                 holes, have the same orientation
 * @param options  may be NULL
 * @param env      may be NULL
 * @param err      may be NULL; `side` is 1 for the source, 2 for the target
 * @return as icc_chart_create(), or
 * - ::ICC_ERR_BOUNDARY if the domains do not correspond
 * - ::ICC_ERR_RESOLUTION if a surface cannot be filled; `err` names the side and the facet
 * - ::ICC_ERR_CERTIFICATE if the options ask for a mesh map and none was found
 *
 * Cost of a mesh map: two charts and a limited amount of improvement; in 2-D 4 ms for a few dozen
 * vertices, 0.3 s for 15,000. If the limit ended the improvement, icc_map_improve() continues it.
 * Deterministic: work is counted, and no clock is read.
 */
ICC_API icc_status icc_map_create(icc_map **out, const icc_domain *source, const icc_domain *target,
                                  const icc_map_options *options, const icc_env *env,
                                  icc_error *err);

/**
 * Makes the map between two polygons whose vertices correspond. It calls icc_domain_create() for
 * both, then icc_map_create() without options.
 *
 * @param[out] out the map; owned by the caller, see icc_map_free()
 * @param n        number of vertices of each polygon, at least 3
 * @param before   2 n coordinates x, y
 * @param after    2 n coordinates x, y, in the same direction
 * @param env      may be NULL
 * @param err      may be NULL; `side` is 1 for `before` and 2 for `after`; `index` is the vertex at
 *                 fault
 * @return as icc_domain_create() and icc_map_create()
 *
 * Cost: that of these calls.
 */
ICC_API icc_status icc_map_create_polygons(icc_map **out, size_t n, const double *before,
                                           const double *after, const icc_env *env, icc_error *err);

/** Options of icc_map_improve(). */
typedef struct icc_improve_options {
    size_t size;        /**< set by the caller: `sizeof(icc_improve_options)` */
    int32_t iterations; /**< at most this many steps on each level; 0: as long as they pay off */
    int32_t levels;     /**< at most this many refinements; 0: as long as they pay off; -1: none */
    /** the last level ends when a step gains less than this share of the energy; 0: the default */
    double tolerance;
} icc_improve_options;

/** What icc_map_improve() has done. */
typedef struct icc_improve_report {
    size_t size;         /**< set by the caller: `sizeof(icc_improve_report)` */
    double energy_start; /**< icc_map_info::energy before */
    double energy;       /**< icc_map_info::energy after; never more */
    size_t n_iterations; /**< improvement steps */
    size_t n_simplices;  /**< triangles or tetrahedra at the end */
    int32_t n_levels;    /**< refinements */
    int32_t cancelled;   /**< 1: the progress callback stopped it early */
} icc_improve_report;

/**
 * Makes a map of lower distortion from a mesh map. The given map does not change.
 *
 * The energy never rises, and every intermediate map is certified. So you may stop early: if the
 * progress callback asks to stop, the call succeeds with the map reached by then. The report says
 * so.
 *
 * Steps and refinements end when they do not pay off. If all options are 0, the work and the number
 * of triangles are also limited in proportion to the given map; another call continues from there.
 * If any option is set, neither is limited.
 *
 * In 3-D a refinement cuts edges in the middle, and replaces tetrahedra by others that fill the
 * same space, before and after. So the map's mesh (icc_map_get_mesh()) is no longer the source's
 * own mesh. Its surface stays as it is, and every tetrahedron is exactly positive before and after.
 * Beyond 3-D there are no refinements.
 *
 * @param[out] out    the map; owned by the caller
 * @param map         a mesh map, else ::ICC_ERR_UNSUPPORTED
 * @param options     may be NULL
 * @param[out] report may be NULL; its `size` is set by the caller
 * @param env         may be NULL
 * @param err         may be NULL
 * @return as icc_map_create()
 *
 * Cost: about 1 us for each step and triangle, 1.5 us for each step and tetrahedron.
 */
ICC_API icc_status icc_map_improve(icc_map **out, const icc_map *map,
                                   const icc_improve_options *options, icc_improve_report *report,
                                   const icc_env *env, icc_error *err);

/** Options of icc_map_retarget(). */
typedef struct icc_retarget_options {
    size_t size; /**< set by the caller: `sizeof(icc_retarget_options)` */
    /** at most this many improvement steps; 0: as many as suit an interactive frame; -1: none */
    int32_t iterations;
} icc_retarget_options;

/**
 * Makes the map to a target that has moved. Use it to drag an outline or a surface, where each
 * frame continues from the one before. The source stays. The new map starts from the mesh and the
 * images of `map`, moves them along and improves them by a few steps. Without features it keeps the
 * mesh. Frames with the same mesh and allocator share data about it.
 *
 * Without features, any target in the plane is reached, however far away. The mesh may change on
 * the way.
 *
 * Features move straight to their new places. On the way they pass one another on the same sides as
 * before (icc_map_info::class_kept). Vertices that have slid (icc_map_options::slide) keep the edge
 * and the share of it to which they go. The mesh changes as needed, and the first frame may refine
 * it, also if `iterations` is -1. If features would meet on the way, the call fails with
 * ::ICC_ERR_CERTIFICATE; take another way, in several calls. If the target has a very different
 * size or is far away, the features first move along with the whole shape.
 *
 * A *face* is a part of the domain between lines. With `iterations` 0 or -1, a face changes only if
 * a vertex on its boundary has a new place. Everything else keeps its places exactly. All faces
 * change if the way is blocked, because the map is then made anew. They also change if the target's
 * box shrinks or grows so far that libicc scales its coordinates anew.
 *
 * In 3-D, tetrahedra that block the way are replaced or cut. As a last resort the map is made anew
 * by icc_map_create(), which fills a target without a mesh; icc_env::log then says so. There is no
 * guarantee that a target is reached, but every map that is returned is certified. Beyond 3-D inner
 * vertices are moved, or the map is made anew.
 *
 * @param[out] out the map; owned by the caller. It has no charts: icc_map_source_chart() returns
 *                 NULL
 * @param map      a mesh map, else ::ICC_ERR_UNSUPPORTED. It does not change
 * @param target   the new target, which must correspond as icc_map_create() requires. In 3-D it may
 *                 be a surface or have a mesh, which is used only if the map is made anew
 * @param options  may be NULL
 * @param env      may be NULL
 * @param err      may be NULL; in 3-D it names a surface vertex where the way is blocked
 * @return as icc_map_create(), and ::ICC_ERR_CERTIFICATE if the target cannot be reached
 *
 * Cost, if the target is reached at once: a third to a half of icc_map_create() in the plane, and a
 * tenth in space, see docs/performance.md. With features the first frame of a small map may take
 * longer than icc_map_create().
 */
ICC_API icc_status icc_map_retarget(icc_map **out, const icc_map *map, const icc_domain *target,
                                    const icc_retarget_options *options, const icc_env *env,
                                    icc_error *err);

/**
 * Copies the mesh of a mesh map, in your coordinates. They are rounded once, whereas the
 * certificate is about the unrounded numbers inside. icc_map_report::n_spoilt counts the simplices
 * that rounding makes flat or reversed.
 *
 * @param map          the map
 * @param[in,out] mesh the mesh on the source: the arrays that you provide are filled, then the
 *                     dimension and the counts are set. Triangles run counter-clockwise, tetrahedra
 *                     have positive determinants
 * @param[out] images  room for icc_map_info::n_vertices * dim coordinates in the target, or NULL
 * @return ::ICC_OK, or
 * - ::ICC_ERR_ARGUMENT if `map` or `mesh` is NULL, or the arrays are too small
 * - ::ICC_ERR_UNSUPPORTED if it is not a mesh map
 */
ICC_API icc_status icc_map_get_mesh(const icc_map *map, icc_mesh *mesh, double *images);

/**
 * Copies the region of each cell of the mesh that icc_map_get_mesh() copies. Regions are numbered
 * as in icc_domain_get_regions(), in 2-D as well: region k lies within the k-th feature of kind
 * ::ICC_FEATURE_REGION of the source, but not within a region inside it, and 0 is the rest. If two
 * regions of the plane overlap and neither lies in the other, the number is one of theirs.
 *
 * @param map          the map
 * @param[out] regions room for icc_map_info::n_simplices numbers. All are 0 if the source has no
 *                     regions
 * @param err          may be NULL
 * @return ::ICC_OK, or
 * - ::ICC_ERR_ARGUMENT if `map` or `regions` is NULL
 * - ::ICC_ERR_UNSUPPORTED if it is not a mesh map
 * - ::ICC_ERR_MEMORY
 */
ICC_API icc_status icc_map_get_regions(const icc_map *map, uint32_t *regions, icc_error *err);

/** What icc_map_certify() found out about the image of your mesh. */
typedef struct icc_certificate {
    size_t size; /**< set by the caller: `sizeof(icc_certificate)` */
    /** 1: every simplex keeps its orientation and both boundaries are simple, so the mesh and
     *  its image are one-to-one */
    int32_t certified;
    /** 1: no part of the boundary meets itself or another part, except at common vertices in 2-D,
     *  and the mesh lies on one side of it. The same is true of the image */
    int32_t boundary_simple;
    size_t n_inverted; /**< simplices whose image has the opposite orientation */
    size_t n_flat;     /**< simplices that have no volume or whose image has none */
    size_t n_no_image; /**< vertices that have no image */
    int64_t first;     /**< the first simplex at fault, or -1 */
    /** why it is not certified, in one line of English; empty if it is certified */
    char message[256];
} icc_certificate;

/**
 * Maps the vertices of your mesh of triangles (2-D) or tetrahedra (3-D), and checks exactly whether
 * the image is a valid mesh too. Even a one-to-one map can fail this test, because the simplices
 * are straight where the map bends.
 *
 * The mesh may have holes, voids and handles, and several pieces. Each facet belongs to one simplex
 * or two. In 3-D no vertex or edge belongs to two parts of the boundary.
 *
 * @param map              a map in 2-D or 3-D, else ::ICC_ERR_UNSUPPORTED
 * @param mesh             a mesh of the map's dimension, with its vertices in the source
 * @param[out] images      the images of its vertices: n_vertices * dim coordinates, or NULL
 * @param[out] certificate its `size` is set by the caller
 * @param env              may be NULL
 * @param err              may be NULL
 * @return ::ICC_OK once the check has run, whatever it found, or
 * - ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY, ::ICC_ERR_UNSUPPORTED or ::ICC_ERR_CANCELLED
 */
ICC_API icc_status icc_map_certify(const icc_map *map, const icc_mesh *mesh, double *images,
                                   icc_certificate *certificate, const icc_env *env,
                                   icc_error *err);

/**
 * Maps your mesh of triangles (2-D) or tetrahedra (3-D) so that no simplex inverts. It maps the
 * vertices, then moves the images of inner vertices until every simplex keeps its orientation.
 * Inner vertices without an image get one.
 *
 * The simplices and the images of boundary vertices do not change. So repair cannot always succeed:
 * a simplex with all its corners on the boundary stays as the map makes it. Check `certificate`. On
 * failure the images are the best that were found. A mesh is not repaired if it is not valid
 * itself, or if a boundary vertex has no image.
 *
 * @param map              a map in 2-D or 3-D, else ::ICC_ERR_UNSUPPORTED
 * @param mesh             a mesh of the map's dimension, with its vertices in the source
 * @param[out] images      the images of its vertices: n_vertices * dim coordinates
 * @param[out] certificate about the returned images; its `size` is set by the caller
 * @param env              may be NULL
 * @param err              may be NULL
 * @return as icc_map_certify()
 *
 * Cost: proportional to the number of inverted simplices; at worst a fixed number of passes over
 * the mesh. Deterministic: iterations are limited, and no clock is read.
 */
ICC_API icc_status icc_map_repair(const icc_map *map, const icc_mesh *mesh, double *images,
                                  icc_certificate *certificate, const icc_env *env, icc_error *err);

/** Frees a map. */
ICC_API void icc_map_free(icc_map *map);

/** Fills in `info`, whose `size` you have set. Returns ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_map_get_info(const icc_map *map, icc_map_info *info);

/** Fills in `report`, whose `size` you have set. Returns ::ICC_OK or ::ICC_ERR_ARGUMENT.
 *  Counting n_spoilt takes a pass over the mesh if its coordinates have to be rounded. */
ICC_API icc_status icc_map_get_report(const icc_map *map, icc_map_report *report);

/**
 * Maps points from the source to the target. Returns ::ICC_OK even if every point failed: check
 * `status` or `n_failed`. A certified curve map of method field reports ::ICC_ERR_TRACE for a point
 * that would not come back to within 1e-6 of the bounding box's diagonal.
 *
 * @param map           the map
 * @param n             number of points
 * @param points        n * dim coordinates in the source
 * @param[out] images   n * dim coordinates; NaN for a point without an image. May be the same array
 *                      as `points`
 * @param[out] status   n statuses: ::ICC_OK, ::ICC_ERR_OUTSIDE, ::ICC_ERR_TRACE or
 *                      ::ICC_ERR_ARGUMENT; or NULL
 * @param[out] n_failed number of points without an image, or NULL
 * @param env           may be NULL
 * @return as icc_chart_encode()
 */
ICC_API icc_status icc_map_apply(const icc_map *map, size_t n, const double *points, double *images,
                                 icc_status *status, size_t *n_failed, const icc_env *env);

/** Maps points from the target to the source; otherwise like icc_map_apply(). */
ICC_API icc_status icc_map_apply_inverse(const icc_map *map, size_t n, const double *points,
                                         double *images, icc_status *status, size_t *n_failed,
                                         const icc_env *env);

/**
 * Computes the derivative of the map at points of the source. It is exact for the piecewise map, up
 * to rounding. At a kink it is one-sided. If the map is certified, the determinant is positive.
 * Method field reports no derivative where rounding would make it otherwise, or where the point
 * does not come back. Returns ::ICC_OK even if every point failed.
 *
 * @param map            the map
 * @param n              number of points
 * @param points         n * dim coordinates in the source's interior. On the boundary and at the
 *                       maximum there is no derivative (::ICC_ERR_TRACE)
 * @param[out] jacobians n * dim * dim numbers: row i, column j is the derivative of image
 *                       coordinate i by point coordinate j. NaN where there is none
 * @param[out] status    n statuses, or NULL
 * @param[out] n_failed  number of points without a derivative, or NULL
 * @param env            may be NULL
 * @return as icc_chart_encode()
 */
ICC_API icc_status icc_map_jacobian(const icc_map *map, size_t n, const double *points,
                                    double *jacobians, icc_status *status, size_t *n_failed,
                                    const icc_env *env);

/** What icc_map_get_tie() reports. */
typedef struct icc_tie_info {
    size_t size;        /**< set by the caller: `sizeof(icc_tie_info)` */
    uint32_t vertex[2]; /**< first and last vertex, as in icc_tie */
    /** number of its bends in the source: always 0, because it is an edge of a triangulation of
     *  the source's vertices */
    size_t n_source;
    size_t n_target;  /**< number of its bends in the target */
    double length[2]; /**< length of the tie in the source, and in the target */
} icc_tie_info;

/**
 * Reports a tie of a map between domains with features. All ties together tell on which side each
 * feature passes the others. Passed as icc_map_options::ties they make a map that is isotopic to
 * this one: it can be moved to this one while it stays one-to-one. If icc_map_info::detour is
 * large, they may be too entangled for double precision and are then refused with
 * ::ICC_ERR_RESOLUTION.
 *
 * The ties follow from the map alone. In the source they are a shortest tree of straight lines
 * between vertices, which may differ from the ties that the map was made with. In the target they
 * are drawn with few bends and do not cross.
 *
 * @param map         the map
 * @param tie         its number, less than icc_map_info::n_ties
 * @param[out] info   `size` is set by the caller
 * @param[out] source 2 * n_source coordinates of bends, or NULL
 * @param[out] target 2 * n_target coordinates of bends, or NULL
 * @return ::ICC_OK, or ::ICC_ERR_ARGUMENT if `map` or `info` is NULL or there is no such tie. Also
 *         ::ICC_ERR_UNSUPPORTED if an end of the tie has slid (icc_map_options::slide), so that it
 *         is a vertex of one domain only
 */
ICC_API icc_status icc_map_get_tie(const icc_map *map, size_t tie, icc_tie_info *info,
                                   double *source, double *target);

/** Writes a map with its domains and charts to memory, in two calls as icc_chart_save() does. */
ICC_API icc_status icc_map_save(const icc_map *map, size_t capacity, void *data, size_t *n_bytes);

/** Reads a map back, as icc_chart_load() does a chart. The mesh of a mesh map is stored in full
 *  and certified anew. */
ICC_API icc_status icc_map_load(icc_map **out, size_t n_bytes, const void *data, const icc_env *env,
                                icc_error *err);

/* ----------------------------------------------------------------- picture */

/** How a picture is read between the centres of its pixels. */
enum {
    /** the nearest pixel's own samples, never averaged: for classes and labels */
    ICC_INTERPOLATION_NEAREST = 1,
    ICC_INTERPOLATION_LINEAR = 2, /**< bilinear */
    ICC_INTERPOLATION_CUBIC = 3   /**< bicubic, exact for quadratic functions; may overshoot */
};

/** A picture in memory. Rows run from top to bottom, and the samples of a pixel lie side by
 *  side. */
typedef struct icc_picture {
    size_t size;      /**< set by the caller: `sizeof(icc_picture)` */
    int32_t width;    /**< pixels in a row */
    int32_t height;   /**< rows */
    int32_t channels; /**< samples per pixel, 1..64 */
    /** bytes per sample, in the machine's order. 1 or 2: unsigned integers that use all values.
     *  4 or 8: floats */
    int32_t bytes;
    /** 1: the last of two to four channels of 1 or 2 bytes is opacity, and the other channels
     *  are not multiplied by it. 0: no opacity */
    int32_t alpha;
    size_t stride;         /**< bytes from one row to the next */
    void *pixels;          /**< the first row, with any alignment; a source is only read */
    int32_t interpolation; /**< source: `ICC_INTERPOLATION_*`; 0: linear */
    int32_t has_nodata;    /**< source, 1: samples equal to `nodata` are missing. Not with alpha */
    double nodata;         /**< source: the value of missing samples; may be NaN */
} icc_picture;

/**
 * Warps a picture. Every target pixel whose centre lies in the target domain or on its boundary
 * gets the colour of the place in the source that is mapped there. All other pixels stay as they
 * are. Pixel (i, j), in column i and row j, covers [i, i+1] x [j, j+1] in the coordinates of the
 * domains.
 *
 * Colours between pixels are interpolated bilinearly, weighted by opacity. Where the map shrinks
 * the picture, up to 16 x 16 samples are averaged to avoid aliasing. Beyond its edge the source
 * continues with the colour of the edge. The identity copies pixels exactly.
 *
 * Pictures of floats, with more than four channels, with missing samples or with another
 * interpolation are computed pixel by pixel, each channel separately. A target pixel is missing (it
 * gets `nodata`) if the source's pixel at its place is missing. Next to missing samples, the known
 * ones are interpolated linearly. Averages are taken over known samples only.
 *
 * @param map           a map in 2-D; mesh maps are the fastest
 * @param source        the picture to read
 * @param target        the picture to write, of any width and height, with the source's channels,
 *                      bytes and alpha. Its pixels must not overlap the source's
 * @param[out] n_failed number of pixels inside without an image, which are left as they are; or
 *                      NULL. Always 0 for mesh maps
 * @param env           may be NULL; results are the same for every number of threads
 * @param err           may be NULL
 * @return ::ICC_OK, ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY, ::ICC_ERR_VERSION, or ::ICC_ERR_CANCELLED
 *         (then some pixels have been written)
 *
 * Cost with a mesh map: nanoseconds a pixel, or tenths of a microsecond if computed pixel by pixel.
 */
ICC_API icc_status icc_map_warp(const icc_map *map, const icc_picture *source,
                                const icc_picture *target, size_t *n_failed, const icc_env *env,
                                icc_error *err);

/* -------------------------------------------------------------- sampled field */

/** What a sample gets whose place has no image: icc_map_sample(). */
enum {
    ICC_OUTSIDE_NAN = 1,      /**< NaN; cells with such a corner are missing */
    ICC_OUTSIDE_IDENTITY = 2, /**< the place stays where it is */
    /** the place moves as the nearest point of the boundary does */
    ICC_OUTSIDE_NEAREST = 3
};

/**
 * A map that is sampled on a regular grid and read multilinearly between the samples.
 *
 * Sample (i, j, k) has the place origin + i step 0 + j step 1 + k step 2. Samples are stored with
 * the first axis fastest, and the components of a sample side by side. A *cell* lies between
 * neighbouring samples. It has 4 corners in 2-D and 8 in 3-D.
 */
typedef struct icc_field {
    size_t size;          /**< set by the caller: `sizeof(icc_field)` */
    int32_t dim;          /**< 2 or 3 */
    int32_t bytes;        /**< of each value: 4 for float, 8 for double */
    int32_t displacement; /**< 1: values are added to the place; 0: they are the image itself */
    int32_t outside;      /**< `ICC_OUTSIDE_*`; 0: NaN. Read by icc_map_sample() only */
    size_t shape[3];      /**< samples along each axis, at least 2 */
    double origin[3];     /**< place of the first sample */
    /** one step along axis k is step[dim * k], step[dim * k + 1], ..; in any directions */
    double step[9];
    /** shape[0] * shape[1] * .. * dim values with any alignment; icc_field_certify() only reads
     *  them */
    void *values;
} icc_field;

/** What icc_field_certify() found about the cells of a field. */
typedef struct icc_field_report {
    size_t size; /**< set by the caller: `sizeof(icc_field_report)` */
    /** 1: the Jacobian determinant is proven positive in every point of every cell */
    int32_t certified;
    /** 1: the field is also proven one-to-one on its whole box. 0: this is not proven */
    int32_t one_to_one;
    size_t n_cells;     /**< cells of the grid */
    size_t n_folded;    /**< cells with a point where the determinant is proven not positive */
    size_t n_undecided; /**< cells whose sign is not known */
    size_t n_missing;   /**< cells with a corner that is not finite; they are not judged */
    /** least determinant at a corner of a judged cell, relative to that of the grid; rounded */
    double least;
    /** why it is not certified or not known to be one-to-one, in one line; or empty */
    char message[192];
} icc_field_report;

/** Why icc_field_certify() lists a cell. */
enum {
    ICC_CELL_FOLDED = 1,    /**< somewhere in it the determinant is not positive */
    ICC_CELL_UNDECIDED = 2, /**< its sign is not known */
    ICC_CELL_MISSING = 3    /**< a corner is not finite */
};

/**
 * Samples a map on a grid. The sampled field can fold although the map does not, because it is
 * multilinear between the samples. icc_field_certify() tells. If it folds, sample more finely.
 *
 * @param map              a map in 2-D or 3-D, else ::ICC_ERR_UNSUPPORTED
 * @param inverse          1: sample the inverse map, with places in the target, as programs want
 *                         that resample images; 0: the map
 * @param field            the grid, with room for the values, which are written. Values are rounded
 *                         once to the type that they are stored in
 * @param[out] n_outside   samples whose place has no image, or NULL. `outside` says what they get
 * @param env              may be NULL; results are the same for every number of threads
 * @param err              may be NULL
 * @return ::ICC_OK, ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY, ::ICC_ERR_VERSION,
 *         ::ICC_ERR_UNSUPPORTED, or ::ICC_ERR_CANCELLED (then some values have been written)
 *
 * Cost: that of icc_map_apply() for each sample.
 */
ICC_API icc_status icc_map_sample(const icc_map *map, int32_t inverse, const icc_field *field,
                                  size_t *n_outside, const icc_env *env, icc_error *err);

/**
 * Proves that a sampled field does not fold, or lists the cells where it does. The field may come
 * from any program, such as a registration. The proof is about the stored values, whatever their
 * type, and about exact multilinear interpolation. A program that rounds while it interpolates may
 * still reverse points that are closer together than its rounding errors.
 *
 * *What is proven.* Signs are exact. In 2-D the determinant is bilinear, so its signs at the
 * corners decide. In 3-D it is a polynomial of degree 2 in each variable. A cell is proven if all
 * Bernstein coefficients are positive, after subdivision if necessary, and disproven by a corner of
 * a part where the determinant is not positive. Subdivision is bounded. The rest is undecided,
 * which needs a determinant that is nearly 0 inside the cell, or numbers beyond 2^-200 and 2^200.
 *
 * A field whose cells are all proven keeps the orientation and is one-to-one near each point. It is
 * one-to-one on the whole box if the image of the box's boundary is also simple. This is proven if
 * all samples on the boundary have the same displacement. In 2-D the image of the boundary is a
 * polygon, which is checked exactly if its vertices are representable. On a grid along the
 * coordinate axes, the field is also one-to-one if the displacements of any two places differ by
 * less than the places do, which is proven by bounds of the derivatives. Otherwise `one_to_one` is
 * 0, which does not mean that two places meet.
 *
 * @param field       the grid and its values
 * @param capacity    room for listed cells, or 0
 * @param[out] cells  the first cells that are not proven, in ascending order. The first axis is the
 *                    fastest, with shape[k] - 1 cells along axis k. NULL if capacity is 0
 * @param[out] kinds  `ICC_CELL_*` of each listed cell. NULL if capacity is 0
 * @param[out] report its `size` is set by the caller. All such cells are n_folded + n_undecided +
 *                    n_missing
 * @param env         may be NULL; results are the same for every number of threads
 * @param err         may be NULL
 * @return ::ICC_OK once the check has run, whatever it found, or ::ICC_ERR_ARGUMENT,
 *         ::ICC_ERR_MEMORY, ::ICC_ERR_VERSION or ::ICC_ERR_CANCELLED
 *
 * Cost: about 1 us a cell in 3-D, and 1 byte of memory.
 */
ICC_API icc_status icc_field_certify(const icc_field *field, size_t capacity, uint32_t *cells,
                                     int32_t *kinds, icc_field_report *report, const icc_env *env,
                                     icc_error *err);

#ifdef __cplusplus
}
#endif

#endif

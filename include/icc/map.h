/**
 * @file icc/map.h
 * @brief Domains, maps between them, matches and pictures: what most programs need.
 *
 *     icc_domain (a boundary and what it encloses), twice
 *       -> icc_match (common vertices, for boundaries that do not correspond)
 *       -> icc_map (a one-to-one map of the insides that agrees with the boundaries)
 *         -> points, derivatives, meshes and pictures are mapped
 *
 * What holds for all objects is said in icc/icc.h.
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

/** Where a point lies. */
enum {
    ICC_INSIDE = 1, /**< in the interior */
    /** On the boundary: within 1e-14 of the bounding box's longest side, or within `dim` * 2^-52 of
     *  the largest coordinate along each axis, whichever is more. So a point of a facet that is
     *  computed in doubles, as a mean of its vertices, counts as on the boundary wherever the shape
     *  lies. */
    ICC_BOUNDARY = 2,
    ICC_OUTSIDE = 3 /**< elsewhere */
};

/** What icc_domain_get_info() reports. */
typedef struct icc_domain_info {
    size_t size;               /**< set by the caller: `sizeof(icc_domain_info)` */
    int32_t dim;               /**< dimension */
    int32_t orientation;       /**< +1 when the facets are listed as seen from outside: 2-D the ring
                                    counter-clockwise, with y upwards; 3-D each face
                                    counter-clockwise; any n: the determinants of the facets,
                                    seen from within, positive; 1-D the lower end first. Else -1 */
    size_t n_vertices;         /**< vertices of the boundary and of all features */
    size_t n_facets;           /**< facets of the boundary */
    double lower[ICC_MAX_DIM]; /**< bounding box */
    double upper[ICC_MAX_DIM]; /**< bounding box */
    double measure;            /**< length, area (2-D), volume (3-D) and so on, without holes; may
                                    overflow to HUGE_VAL for coordinates near 1e300 */
    size_t n_features;         /**< features inside: see icc_domain_create_features() */
    size_t n_mesh_vertices;    /**< vertices of the mesh of its inside, with those of the boundary;
                                    0: it has none */
    size_t n_mesh_simplices;   /**< simplices of that */
} icc_domain_info;

/**
 * Makes a domain from its boundary. Either orientation is accepted and remembered.
 *
 * 2-D: a simple polygon. `facets` may be NULL: facet i then joins vertex i and vertex i + 1, the
 * last one back to vertex 0. Otherwise the facets, two vertex indices each, must form one closed
 * ring through all vertices, in any order but all in the same direction. Collinear vertices are
 * fine. Checked exactly: no edge has length zero, no vertex is repeated, and no edges cross, touch
 * or run back over each other.
 *
 * 3-D: a closed surface of triangles, three vertex indices each, in any order. Checked exactly: no
 * face with area 0; each edge belongs to two faces, which run along it in opposite directions; the
 * faces at each vertex form one cycle; one component, so no inner voids; genus 0; no
 * self-intersection: two faces have nothing in common but the vertices and edges that they share.
 * Coplanar faces are fine.
 *
 * 4-D to 6-D: a closed boundary of simplices, dim vertex indices each. Checked: each ridge (dim - 1
 * vertices) belongs to two facets, which run along it in opposite directions; the facets at each
 * vertex are connected; one component; and, exactly in 4-D and to rounding (1e-13) beyond, no flat
 * facet; to rounding, a volume other than 0. Self-intersection is NOT checked beyond 3-D, nor is
 * the topology of the boundary.
 *
 * 1-D: an interval: two facets of one vertex each.
 *
 * All checks use the coordinates as given. Internally the shape is shifted and scaled by exact
 * operations, so any position and size will do (an offset of 1e9, coordinates of 1e300). A
 * coordinate is refused if it is not 0 and at most 2^-200 times the largest one. Except in 2-D,
 * vertices that belong to no facet are kept and otherwise ignored.
 *
 * @param[out] out   the domain; owned by the caller, see icc_domain_free()
 * @param dim        1..::ICC_MAX_DIM
 * @param n_vertices at least dim + 1
 * @param vertices   n_vertices * dim coordinates
 * @param n_facets   number of facets; ignored when `facets` is NULL
 * @param facets     n_facets * dim vertex indices; NULL in 2-D only
 * @param env        may be NULL
 * @param err        may be NULL; `index` is the vertex or facet at fault; where there are two, the
 *                   message names both
 * @return ::ICC_OK, ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY, ::ICC_ERR_BOUNDARY (what is wrong with
 *         the shape), ::ICC_ERR_TOPOLOGY (several components, an inner void, handles),
 *         ::ICC_ERR_VERSION or ::ICC_ERR_CANCELLED
 *
 * Cost: O(n log n) time, O(n) memory for ordinary shapes; in 2-D 30 to 60 ns a vertex of an
 * outline, and as much again to 0.2 us when its first point is located; in 3-D 0.6 to 2 us and 70
 * bytes a triangle (115 while it is made). If many triangles meet at one vertex, or are long, thin
 * and close, comparing them takes 5 to 40 us and 2 kB a triangle.
 */
ICC_API icc_status icc_domain_create(icc_domain **out, int32_t dim, size_t n_vertices,
                                     const double *vertices, size_t n_facets,
                                     const uint32_t *facets, const icc_env *env, icc_error *err);

/** What icc_feature::kind says. */
enum {
    ICC_FEATURE_HOLE = 1, /**< a simple polygon whose inside is not part of the domain */
    ICC_FEATURE_LINE = 2, /**< a polyline that does not meet itself, of 2 or more vertices; with two
                                of them, a bone */
    ICC_FEATURE_POINT = 3 /**< one vertex */
};

/** Something inside a domain of the plane that a map takes to the feature of the same number in the
 *  other domain, vertex by vertex and edges linearly. */
typedef struct icc_feature {
    size_t size;            /**< set by the caller: `sizeof(icc_feature)`, the same in all of an
                                 array */
    int32_t kind;           /**< `ICC_FEATURE_*` */
    size_t n_vertices;      /**< hole: at least 3; line: at least 2; point: 1 */
    const double *vertices; /**< 2 n_vertices coordinates */
    double radius;          /**< of a point with a size: above 0; else 0 */
    size_t n_facets;        /**< of a surface inside a domain in space; 0 as yet */
    const uint32_t *facets; /**< 3 n_facets vertex indices; NULL as yet */
} icc_feature;

/**
 * Makes a domain of the plane with features inside: holes, lines and points, whose images a map
 * prescribes.
 *
 * The vertices of the domain are those of the outer ring, then those of the features in their
 * order; its facets are the edges of the outer ring, then those of the holes, which bound it as
 * well. Features must lie strictly inside the outer ring and outside all holes, and may not meet
 * themselves or one another. All of this is checked exactly, with the coordinates as given. Rings
 * may run either way. A hole that touches the outer ring in a point is refused, since the domain
 * would be pinched there: merge the rings. So is a point on the boundary: make it a vertex of the
 * ring.
 *
 * A point with a radius is a handle with a size: the circle round it goes along, larger or smaller,
 * but does not turn. It is an open line of 16 vertices, a regular polygon without one edge, that
 * the domain has as a further feature of its own. These follow all given features, in the order of
 * their points; in the other domain the same points must have a radius.
 *
 * To icc_domain_locate() what lies in a hole is outside; lines and points are inside, as what is
 * around them. Only maps of kind mesh work on such a domain. What else takes domains refuses it
 * with ::ICC_ERR_UNSUPPORTED. Without features the result is that of icc_domain_create().
 *
 * @param[out] out   the domain; owned by the caller, see icc_domain_free()
 * @param n_outer    vertices of the outer ring, at least 3
 * @param outer      2 n_outer coordinates
 * @param n_features how many features there are
 * @param features   n_features of them; they are copied
 * @param env        may be NULL
 * @param err        may be NULL. For a defect of the outer ring `index` is its vertex or edge; else
 *                   it is the feature at fault (::ICC_ITEM_FEATURE), and the message names the
 *                   vertex, and the other feature where there are two; circles have the numbers
 *                   from n_features on
 * @return ::ICC_OK; ::ICC_ERR_OUTSIDE (a feature is not strictly inside the outer ring, or lies in
 *         a hole); ::ICC_ERR_BOUNDARY (a ring or line meets itself, two features meet, two points
 *         are the same); ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY, ::ICC_ERR_VERSION,
 *         ::ICC_ERR_CANCELLED
 *
 * Cost: O(n log n) time and O(n) memory for n vertices in all.
 */
ICC_API icc_status icc_domain_create_features(icc_domain **out, size_t n_outer, const double *outer,
                                              size_t n_features, const icc_feature *features,
                                              const icc_env *env, icc_error *err);

/**
 * Makes a domain from a mask of cells, such as voxels (not of vertices, as icc_grid_create_mask()
 * takes): cell (i_0, i_1, ..) covers [i_0, i_0 + 1] x [i_1, i_1 + 1] x .. in coordinates 0, 1, ..
 *
 * The mask must be a solid without holes: the cells form one piece, joined by faces; no cells touch
 * only along an edge or a corner, nor do gaps; the outside is one piece; the Euler characteristic
 * is 1. In 2-D and 3-D this makes it a disc or a ball. In higher dimensions holes of different
 * dimensions may cancel out and pass; icc_tree_grow() fails on the grid of such a mask.
 *
 * Each cell is cut in two along each axis, and each face of the pieces on the boundary into (dim -
 * 1)! simplices (Kuhn's), like the grid that icc_grid_create() makes. icc_domain_get_boundary()
 * returns these facets, and the vertices in the caller's order of axes, the first axis fastest; in
 * 2-D as a counter-clockwise polygon. The target of a map from a mask is a domain with the same
 * facets and moved vertices.
 *
 * @param[out] out the domain; owned by the caller
 * @param dim      1..::ICC_MAX_DIM
 * @param shape    cells along each axis, dim numbers
 * @param cells    one byte per cell, the first axis runs fastest: 0 outside, anything else inside
 * @param env      may be NULL
 * @param err      may be NULL; `index` is a cell at fault
 * @return ::ICC_OK, ::ICC_ERR_TOPOLOGY (what is wrong with the mask), ::ICC_ERR_RESOLUTION (its
 *         grid would have more than 2^28 vertices, or too many facets), ::ICC_ERR_ARGUMENT, ...
 *
 * Cost: at most O(cells * 4^dim) time, 0.15 us a cell in 3-D, on top of icc_domain_create().
 */
ICC_API icc_status icc_domain_create_mask(icc_domain **out, int32_t dim, const size_t *shape,
                                          const uint8_t *cells, const icc_env *env, icc_error *err);

/** A mesh of triangles in 2-D, of tetrahedra in 3-D, of simplices beyond: a caller's, which is only
 *  read, or room for one of the library's.
 *
 *  To be given a mesh, call icc_domain_get_mesh() or icc_map_get_mesh() twice: with `vertices` and
 *  `cells` NULL for dim and the numbers, then with arrays of that size. Either may stay NULL. */
typedef struct icc_mesh {
    size_t size;       /**< set by the caller: `sizeof(icc_mesh)` */
    int32_t dim;       /**< dimension */
    size_t n_vertices; /**< vertices, fewer than 2^26; where a mesh is written, how many `vertices`
                               has room for */
    double *vertices;  /**< n_vertices * dim coordinates */
    size_t n_cells;    /**< cells, fewer than 2^26; where a mesh is written, how many `cells` has
                               room for */
    uint32_t *cells;   /**< vertex indices of all cells, one cell after the other: n_cells * (dim +
                               1). A cell may list its vertices in any order */
    const size_t
        *offsets; /**< NULL: every cell has dim + 1 vertices. Else n_cells + 1 numbers: where
                               in `cells` each cell begins, and where the last one ends, as VTK has
                               it */
    const uint8_t
        *types; /**< VTK's types of the n_cells cells, or NULL. Only simplices are supported
                               as yet: 5 in 2-D, 10 in 3-D; others are ::ICC_ERR_UNSUPPORTED */
    const int32_t *regions; /**< numbers of n_cells regions; NULL. Nothing reads them as yet: else
                               ::ICC_ERR_UNSUPPORTED */
} icc_mesh;

/**
 * Makes a domain from a conforming mesh of its inside: triangles in 2-D, tetrahedra in 3-D,
 * simplices beyond. On such a domain ::ICC_METHOD_FOLIATION works in every dimension, with leaves
 * that are straight in every simplex. Everything else works as on a domain made from its boundary
 * alone.
 *
 * The vertices of the domain are those of the mesh that lie on its boundary, in the order of the
 * mesh. Two domains correspond, as icc_map_create() requires, if they have the same number of these
 * vertices and the same facets; their meshes may differ inside. You may pass the facets in any
 * order, such as that of the surface that was meshed; otherwise they are sorted by their vertices
 * (the smallest index first, and so on) and oriented as seen from outside.
 *
 * Checked exactly up to 3-D, to rounding beyond: what icc_domain_create() checks of the boundary;
 * every simplex has a volume; a facet belongs to at most two simplices, which lie on opposite sides
 * of it; the mesh is connected; its Euler characteristic is 1. So the simplices fill the domain and
 * do not overlap. A simplex may list its vertices in any order. Vertices that belong to no simplex
 * are ignored.
 *
 * @param[out] out    the domain; owned by the caller
  * @param mesh        the mesh, of dimension 2..::ICC_MAX_DIM
 * @param n_facets    facets of the boundary; ignored when `facets` is NULL
 * @param facets      n_facets * dim vertex indices: the boundary of the mesh, in the caller's order
 *                    and all seen from the same side; or NULL
 * @param env         may be NULL
 * @param err         may be NULL; `index` is the simplex, the vertex or the one of `facets` at
 *                    fault. When the boundary is refused, vertices and facets are those of the
 *                    domain
 * @return ::ICC_OK; ::ICC_ERR_BOUNDARY (a simplex is flat, or lists a vertex twice or one that does
 *         not exist; a facet has three simplices, or two on one side; `facets` are not the mesh's);
 *         ::ICC_ERR_TOPOLOGY (several pieces, holes); ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY,
 *         ::ICC_ERR_CANCELLED
 *
 * Cost: O(n) time and memory on top of icc_domain_create(): 0.5 us a tetrahedron.
 */
ICC_API icc_status icc_domain_create_mesh(icc_domain **out, const icc_mesh *mesh, size_t n_facets,
                                          const uint32_t *facets, const icc_env *env,
                                          icc_error *err);

/** How icc_domain_fill() chooses inner vertices. */
typedef struct icc_fill_options {
    size_t size;         /**< sizeof(icc_fill_options) */
    double ratio;        /**< circumradius over shortest edge from which tetrahedra are refined, at
                              least 1.2; 0: the default; infinite: no vertices but those it takes */
    uint64_t max_points; /**< refinement ends at so many inner vertices; 0: no limit */
} icc_fill_options;

/**
 * Fills a closed surface in 3-D with tetrahedra: makes the domain that icc_domain_create_mesh()
 * makes of a mesh of its inside. The vertices and facets are those of the surface, bit by bit;
 * vertices are added inside only.
 *
 * Everything that decides whether the mesh is one is exact, and the result is checked as that of
 * icc_domain_create_mesh() is. The same bits on every machine. Vertices that belong to no facet are
 * not among those of the result.
 *
 * Not guaranteed: that every surface can be filled, and angles. Tetrahedra at facets may be very
 * flat.
 *
 * Cost: proportional to the number of tetrahedra, some 10 us and 200 bytes each; several times as
 * long if it fails. docs/theory/solid-maps.md says what is tried.
 * @param[out] out the filled domain, for the caller to free; NULL on failure
 * @param surface a domain in 3-D without a mesh
 * @param options may be NULL
 * @param env     may be NULL
 * @param err     may be NULL
 * @return ::ICC_OK; ::ICC_ERR_UNSUPPORTED unless `surface` is in 3-D and has no mesh;
 *         ::ICC_ERR_RESOLUTION if a facet, which icc_error::index names, cannot be told from what
 *         is next to it; ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY, ::ICC_ERR_CANCELLED
 */
ICC_API icc_status icc_domain_fill(icc_domain **out, const icc_domain *surface,
                                   const icc_fill_options *options, const icc_env *env,
                                   icc_error *err);

/**
 * Fills cells of a mask where others, or gaps, touch only along an edge or a corner, which
 * icc_domain_create_mask() refuses. Cells are filled one at a time, each time the one that leaves
 * the fewest such places around it. Whatever this cannot mend, and every other defect, is left as
 * it is.
 *
 * @param dim           1..::ICC_MAX_DIM
 * @param shape         cells along each axis
 * @param[in,out] cells as for icc_domain_create_mask(); filled cells become 1
 * @param[out] n_filled how many, or NULL
 * @param env           may be NULL
 * @param err           may be NULL
 * @return ::ICC_OK, ::ICC_ERR_RESOLUTION, ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY,
 *         ::ICC_ERR_CANCELLED; unless it is ::ICC_OK, the cells are unchanged
 */
ICC_API icc_status icc_mask_repair(int32_t dim, const size_t *shape, uint8_t *cells,
                                   size_t *n_filled, const icc_env *env, icc_error *err);

/** Frees a domain. */
ICC_API void icc_domain_free(icc_domain *domain);

/** Fills in `info`, whose `size` the caller has set. ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_domain_get_info(const icc_domain *domain, icc_domain_info *info);

/** What icc_domain_get_feature() reports. */
typedef struct icc_feature_info {
    size_t size;         /**< set by the caller: `sizeof(icc_feature_info)` */
    int32_t kind;        /**< `ICC_FEATURE_*` */
    int32_t orientation; /**< of a hole: +1 when it is listed counter-clockwise, with y upwards, -1
                              clockwise; else 0 */
    size_t first_vertex; /**< its vertices have this number among those of the domain and the
                              following ones */
    size_t n_vertices;   /**< how many there are */
    size_t first_facet;  /**< of a hole: the facet from its first vertex to the next; as many follow
                              as it has vertices. Else 0 */
} icc_feature_info;

/**
 * Reports a feature of a domain; icc_domain_get_boundary() has the coordinates.
 *
 * @param domain     the domain
 * @param feature    its number, less than icc_domain_info::n_features
 * @param[in,out] info `size` has been set; the rest is filled in
 * @return ::ICC_OK or ::ICC_ERR_ARGUMENT
 */
ICC_API icc_status icc_domain_get_feature(const icc_domain *domain, size_t feature,
                                          icc_feature_info *info);

/**
 * Copies the mesh of the inside: icc_domain_create_mesh(), icc_domain_fill().
 *
 * @param domain       a domain with a mesh: icc_domain_info::n_mesh_vertices is not 0
 * @param[in,out] mesh what it has room for is filled: the vertices of the boundary, in the order of
 *                     icc_domain_get_boundary(), then those inside; and the cells, each with a
 *                     positive determinant. Then its dimension and its numbers are set
 * @return ::ICC_OK; ::ICC_ERR_ARGUMENT without a domain or a mesh, or if it has too little room;
 *         ::ICC_ERR_UNSUPPORTED if the domain has no mesh
 */
ICC_API icc_status icc_domain_get_mesh(const icc_domain *domain, icc_mesh *mesh);

/**
 * Copies the boundary as it was given: of a domain with features, the vertices of the outer ring
 * and of all features, and the facets of the outer ring and of the holes.
 *
 * @param domain        the domain
 * @param[out] vertices room for n_vertices * dim doubles, or NULL
 * @param[out] facets   room for n_facets * dim indices, or NULL
 */
ICC_API icc_status icc_domain_get_boundary(const icc_domain *domain, double *vertices,
                                           uint32_t *facets);

/**
 * Reports where points lie, exactly up to the tolerance of ::ICC_BOUNDARY, and finds the nearest
 * boundary points. Beyond 3-D it is not exact: points nearer to the boundary than about 1e-13 of
 * the bounding box's longest side may be misplaced; and where a boundary meets itself, a point is
 * inside if an odd number of layers separates it from infinity.
 *
 * @param domain     the domain
 * @param n          number of points
 * @param points     n * dim coordinates; a point that is not finite is outside
 * @param[out] where n values ::ICC_INSIDE, ::ICC_BOUNDARY or ::ICC_OUTSIDE
 * @param[out] facet n indices of the nearest facet, or NULL
 * @param[out] bary  n * dim barycentric coordinates of the nearest point on it, or NULL
 * @param env        may be NULL
 *
 * Cost: O(log n) a point for ordinary shapes: in 3-D with 27,000 faces 0.5 to 2 us to place a
 * point, 5 to 10 us to find the nearest facet.
 */
ICC_API icc_status icc_domain_locate(const icc_domain *domain, size_t n, const double *points,
                                     int32_t *where, uint32_t *facet, double *bary,
                                     const icc_env *env);

/** Defects that icc_boundary_defects() lists. `a` and `b` are vertex or facet indices. */
enum {
    ICC_DEFECT_NOT_FINITE = 1, /**< vertex a has a coordinate that is not finite; b = a */
    ICC_DEFECT_REPEATED = 2,   /**< vertices a < b coincide */
    ICC_DEFECT_SPIKE = 3,      /**< at vertex a the boundary runs back over itself; b = a */
    ICC_DEFECT_CROSSING = 4,   /**< facets a < b cross */
    ICC_DEFECT_TOUCH = 5,      /**< facets a < b touch or overlap without sharing a vertex */
    ICC_DEFECT_FLAT = 6        /**< the shape has no area; a = b = 0 */
};

/**
 * Lists the defects that keep a closed polygon from being the boundary of a domain.
 *
 * @param n_vertices    vertices of the ring
 * @param vertices      n_vertices * 2 coordinates; facet i joins vertices i and i + 1
 * @param capacity      how many defects the two arrays have room for
 * @param[out] kinds    `capacity` kinds, `ICC_DEFECT_*`
 * @param[out] items    `capacity` pairs (a, b), see `ICC_DEFECT_*`
 * @param[out] n_defects how many there are, also beyond `capacity`; the search ends at 10,000 +
 *                      4 n_vertices, so there may be more then
 * @param env           may be NULL
 * @param err           may be NULL
 *
 * Sorted by a, then b. Vertices that are not finite are listed and otherwise ignored.
 * Cost: O((n + k) log n) for k pairs of facets whose boxes overlap.
 */
ICC_API icc_status icc_boundary_defects(size_t n_vertices, const double *vertices, size_t capacity,
                                        int32_t *kinds, uint32_t *items, size_t *n_defects,
                                        const icc_env *env, icc_error *err);
/* ------------------------------------------------------------------- match */

/** Two domains that do not correspond, and which points of them go together. */
typedef struct icc_match icc_match;

/** How icc_match_create() takes rotations. */
enum {
    ICC_TURNING_UPRIGHT = 1, /**< of pairings that are nearly as good, the one that turns the shape
                                least: as people expect of letters, squares and maps */
    ICC_TURNING_FREE = 2     /**< any rotation is as good as any other */
};

/** How icc_match_create() pairs what lies between landmarks. */
enum {
    ICC_BETWEEN_ELASTIC = 1, /**< by shape: like parts go to like parts */
    ICC_BETWEEN_ARC = 2      /**< by arc length, for outlines without features as discs, which are
                                ambiguous by shape; without landmarks it starts where the outlines,
                                laid on one another unturned, are nearest */
};

/** Options of icc_match_create(). */
typedef struct icc_match_options {
    size_t size;     /**< set by the caller: `sizeof(icc_match_options)` */
    int32_t turning; /**< without landmarks: `ICC_TURNING_UPRIGHT` or `ICC_TURNING_FREE`; 0: upright
                        */
    int32_t between; /**< `ICC_BETWEEN_ELASTIC` or `ICC_BETWEEN_ARC`; 0: elastic */
    double least_sure; /**< without landmarks, a pairing with less icc_match_info::sure is refused;
                            0: 1.06; 1: none is */
    double drop;       /**< where vertices of the two outlines are paired with points that lie
                            within this share of the perimeter of each other, both vertices become
                            one pair and the two added points are dropped, unless what is between
                            neighbours would become three times longer or shorter by it; at most
                            0.01; 0: only where they lie within 0.3 of the shorter edge at them */
    double tolerance;  /**< in space, how far the common surfaces may be off those that were given,
                            as a share of the diagonal of each one's bounding box: at most 0.1; 0:
                            1e-3; < 0: not at all, which takes four to six times as many vertices as
                            both have together, and many thin triangles (what rounding brings
                            together goes, up to 1e-3) */
    int32_t keep_source; /**< in space, 1: the source keeps all its vertices and edges, which have
                            more vertices, as the triangles do, where the target would be too far
                            off; 0: it does not. In the plane it always does */
} icc_match_options;

/** What icc_match_get_info() reports. */
typedef struct icc_match_info {
    size_t size;        /**< set by the caller: `sizeof(icc_match_info)` */
    int32_t dim;        /**< dimension */
    int32_t mirrored;   /**< 1: the target's mirror image fits clearly better, compared as for
                             `sure`. Then y may point down in one of the two. It changes nothing,
                             because a map cannot mirror; without landmarks only */
    size_t n_vertices;  /**< common vertices of the two domains */
    size_t n_landmarks; /**< landmarks; they are among these */
    size_t n_joined;    /**< of these, how many are vertices of the source and of the target */
    double cost;        /**< of the outer rings' pairing: 0 for similar shapes, at most 4;
                             HUGE_VAL by arc length and in space */
    double second;      /**< of the best one that differs from it by more than 5 % of the
                             perimeter; HUGE_VAL: no other was found, or there were landmarks */
    double sure;        /**< (second + 0.05) / (cost + 0.05): 1 if another pairing is as good; a
                             comparison, not a probability */
    double turn;        /**< the source is turned by so many degrees, counter-clockwise, to lie as
                             the target does */
    double least_slope; /**< share of the target's perimeter over that of the source's, of the edge
                             of the outer ring that shrinks most, */
    double most_slope;  /**< and of the one that grows most; in space of areas and triangles */
    double energy;      /**< in space: how the common triangles are stretched, once both surfaces
                             have the same area: the mean, by area of the source, of (s^2 + t^2)
                             (1 + 1 / (s t)^2) for the singular values s and t; 4 for an isometry */
    double off;         /**< in space: the farthest that the common surfaces are off those that
                             were given, as measured from vertices and from middles of edges and
                             triangles, both ways; as icc_match_options::tolerance has it */
    double least_angle; /**< in space: of the common triangles on either surface, in degrees */
    size_t n_overlay;   /**< in space: common vertices before surfaces were made coarse */
} icc_match_info;

/**
 * Pairs the boundaries of two domains that need not have the same number of vertices, the same
 * first vertex or the same sense, and makes two domains of the same shapes with common vertices,
 * ready for icc_map_create().
 *
 * Without landmarks all starting points are compared, by how the outlines turn at several scales;
 * then rotations are tried, and the best pairing is followed. It is a heuristic: what is
 * guaranteed is that the result is a monotone pairing that passes through all landmarks, not that
 * it is the one you mean. Every vertex of the two domains is in the result bit by bit and in its
 * order; the others are added on edges, rounded. Outlines of as many vertices that are clearly in
 * step are paired vertex by vertex, so that what came out of a match goes through another one
 * unchanged; not by arc length. The result begins with the source's vertex 0 and has the source's
 * sense. It is checked as icc_domain_create() checks it.
 *
 * Holes, lines and points inside go together, too, each with one of its kind. The outer rings'
 * pairing says about where each should be in the target (by mean value coordinates); it goes to
 * what is there, so that the squares of all distances have the least sum. Holes and lines are then
 * paired along themselves, from where they lie nearest; lines from end to end. The result has the
 * features of the source, in its order and with its senses, and those of the target that go with
 * them.
 *
 * In space, surfaces that need not have the same triangles become two with common ones. Both are
 * drawn on the sphere, one-to-one, and cut by one another there; then both are made coarse
 * together, up to icc_match_options::tolerance, except where a surface would meet itself. By exact
 * signs, before places are rounded: the drawings are one-to-one, and what they are cut into is the
 * same on both. Checked on each result: neither surface meets itself, and the distance in
 * icc_match_info::off. That like parts lie on one another is neither: without landmarks, surfaces
 * that are nearly the same up to a motion, or bend moderately, do well; bodies with limbs in other
 * poses do not, and icc_match_info::energy shows it. With landmarks, each at a vertex, like parts
 * are those between like landmarks. Landmarks then are common vertices, whatever places they are
 * in. Vertices that are left have the bits they were given with; facets are listed as seen from
 * outside.
 *
 * With icc_match_options::keep_source, in space, the source's surface stays what it is: common
 * vertices begin with those of the source that have facets, in their order; others are added on its
 * edges and inside its facets, rounded, and no common facet is a part of two of these. The target
 * is as near as without. What is thin in the source stays thin.
 *
 * @param[out] out    the match; owned by the caller, see icc_match_free()
 * @param source      a domain of the plane, which may have features, or of space; without a mesh
 * @param target      likewise, of the same dimension, with as many holes, lines and points, and
 *                    points with a radius
 * @param n_landmarks how many pairs of points are known, at most 1000; in space 128
 * @param landmarks   n_landmarks * 2 dim coordinates: a point of the source, then one of the
 *                    target. The nearest vertex within 0.5 % of the shape's diameter is taken, or
 *                    else the nearest boundary point; a point on the boundary is taken as it is.
 *                    Points inside and those of holes and lines are boundary points here: such a
 *                    landmark says which features go together, and where. In space the nearest
 *                    vertex is taken. NULL if there are none
 * @param options     may be NULL
 * @param env         may be NULL
 * @param err         may be NULL; `index` is the landmark at fault
 * @return ::ICC_OK; ::ICC_ERR_AMBIGUOUS (another pairing is nearly as good: give a
 *         landmark, or ask for arc length, which is never taken unasked; or two features, of which
 *         `index` is one of the source's, could change places: give a landmark on one of them);
 *         ::ICC_ERR_ARGUMENT (a landmark is more than 2 % of the diameter off an outline, or lies
 *         where another one does, or does not follow it round both outlines alike, or pairs what
 *         cannot go together); ::ICC_ERR_UNSUPPORTED (another dimension, a mesh);
 *         ::ICC_ERR_BOUNDARY (other numbers of features of a kind; or the common vertices, which
 *         `index` tells of, cannot be told apart in doubles); ::ICC_ERR_RESOLUTION (surfaces whose
 *         triangles are too different in size to be drawn on the sphere in doubles, or landmarks
 *         in so different places that paths between them take too many vertices);
 *         ::ICC_ERR_MEMORY, ::ICC_ERR_VERSION, ::ICC_ERR_CANCELLED
 *
 * Cost in 2-D: some tenths of a second whatever the number of vertices n, then O(n log n); for m
 * features of a kind O(m^3) at worst, mostly O(m^2). In space O(n log n), some 1 s and 20 MB for
 * 4,700 vertices on both sides, 10 s and 150 MB for 21,000. Deterministic. The map between the two
 * domains then takes longer than between outlines of which the same vertices correspond.
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

/** Fills in `info`, whose `size` the caller has set. ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_match_get_info(const icc_match *match, icc_match_info *info);

/**
 * Reports where the common vertices come from.
 *
 * @param match       the match
 * @param[out] source icc_match_info::n_vertices numbers of vertices of the source that was given,
 *                    UINT32_MAX for one that was added; or NULL
 * @param[out] target likewise of the target
 * @return ::ICC_OK or ::ICC_ERR_ARGUMENT
 */
ICC_API icc_status icc_match_get_origins(const icc_match *match, uint32_t *source,
                                         uint32_t *target);

/**
 * Takes points of the source to the target. A point first goes to the nearest place on the outer
 * ring, the holes, the lines and the points of icc_match_source(), or in space on its surface. Then
 * it goes to the same place of icc_match_target(). All common vertices, also those of lines, points
 * and landmarks, go to their partners bit by bit. Between them each edge or facet is mapped
 * one-to-one. Points of a surface that was given are at most icc_match_info::off away from the
 * common one.
 *
 * What is known at the corners of the facets that were given, as places in a texture: take the
 * vertices of icc_match_source(), or any points, to icc_domain_locate() on the domain that was
 * given, which tells of each the facet and the weights of its corners.
 *
 * @param match        the match
 * @param n            number of points
 * @param points       n * dim coordinates
 * @param[out] images  n * dim coordinates; NaN for a point that is not finite. May be the same
 *                     array as `points`.
 * @param[out] off     how far each point was from that nearest place; NaN for one that is not
 *                     finite. May be NULL
 * @param env          may be NULL
 * @return ::ICC_OK, ::ICC_ERR_ARGUMENT, ::ICC_ERR_VERSION, ::ICC_ERR_CANCELLED
 *
 * Cost: as icc_domain_locate() takes to find the nearest facet.
 */
ICC_API icc_status icc_match_apply(const icc_match *match, size_t n, const double *points,
                                   double *images, double *off, const icc_env *env);

/** Target -> source; otherwise as icc_match_apply(). */
ICC_API icc_status icc_match_apply_inverse(const icc_match *match, size_t n, const double *points,
                                           double *images, double *off, const icc_env *env);

/** Writes a match as bytes, as icc_chart_save() does a chart: with both domains. */
ICC_API icc_status icc_match_save(const icc_match *match, size_t capacity, void *data,
                                  size_t *n_bytes);

/**
 * Reads a match back, as icc_chart_load() does a chart: its domains are checked as they were when
 * they were made, and have to correspond. What icc_match_info and icc_match_get_origins() say is
 * taken from the bytes.
 */
ICC_API icc_status icc_match_load(icc_match **out, size_t n_bytes, const void *data,
                                  const icc_env *env, icc_error *err);

/* --------------------------------------------------------------------- map */

/** A map from one domain to another that agrees with the boundaries. */
typedef struct icc_map icc_map;

/** How a map works. */
enum {
    ICC_MAP_CURVES = 1, /**< point by point through the two charts, as the papers do; any
                             dimension */
    /** A piecewise linear map on an internal mesh, always certified. The fastest queries: in 2-D
     *  less than 0.1 us a point, in 3-D 1 to 5 us. On the boundary it agrees with the cages up to
     *  rounding (samples of a side lie on it to one unit in the last place).
     *
     *  In 2-D: triangles that fill the source, with an image for every vertex, made fair. Every
     *  triangle is exactly positive before and after, and both boundaries are exactly simple.
     *
     *  In 3-D, between closed surfaces, which are filled unless they bring a mesh: the source's
     *  mesh, with images that are made fair and certified likewise. The target's mesh serves its
     *  chart only. Inner edges of the source's mesh that join boundary vertices are cut where that
     *  is needed. */
    ICC_MAP_MESH = 2
};

/** A path between two vertices of a domain with features, and where a map takes it: the map's image
 *  of the one can be moved to the other with its ends held and without crossing a feature. */
typedef struct icc_tie {
    size_t size;          /**< set by the caller: `sizeof(icc_tie)`, the same in all of an array */
    uint32_t vertex[2];   /**< where it begins and ends: vertices of the domain (see
                               icc_domain_create_features()) */
    size_t n_source;      /**< its bends in the source */
    const double *source; /**< 2 n_source coordinates */
    size_t n_target;      /**< its bends in the target, which may be more or fewer */
    const double *target; /**< 2 n_target coordinates */
} icc_tie;

/** Options of icc_chart_create(); see icc/chart.h. */
struct icc_chart_options;

/** Options of icc_map_create(). */
typedef struct icc_map_options {
    size_t size;        /**< set by the caller: `sizeof(icc_map_options)` */
    int32_t kind;       /**< `ICC_MAP_*`: this kind, or ::ICC_ERR_CERTIFICATE if no such map is
                             found. 0: the best that can be had, which icc_map_info::kind tells:
                             mesh for foliation and disc in 2-D, unless both domains have
                             caller-supplied meshes, and for foliation in 3-D; else, and where no
                             mesh map is found, curves */
    int32_t iterations; /**< mesh: at most so many improvement steps on each level of
                           refinement; 0: as long as they pay off; -1: no improvement */
    /** For both charts, or NULL; its `maximum` is the source's. For kind mesh in 2-D method 0 means
     *  disc (foliation when a maximum is given), and cells 0 means 20. In 3-D method 0 means
     *  foliation, but field for masks. */
    const struct icc_chart_options *chart;
    const double *target_maximum; /**< the target's maximum, or NULL: as the method chooses */
    size_t n_ties;                /**< with features: as many as there are features; or 0 */
    const icc_tie *ties;          /**< which way round one another the features go: paths that join
                                       all of them and the outer ring to a tree, inside both domains
                                       and without crossing; or NULL: as seems least twisted */
} icc_map_options;

/** Why a chart or a map is not certified: the first of several reasons. The counts named here
 *  report to what extent. */
enum {
    ICC_REASON_NONE = 0,       /**< it is certified */
    ICC_REASON_GRADIENT = 1,   /**< the curves of method gradient merge */
    ICC_REASON_INFEASIBLE = 2, /**< field: icc_field_info::n_infeasible */
    ICC_REASON_NOT_INWARD = 3, /**< field: icc_field_info::n_not_inward */
    ICC_REASON_STRAY = 4,      /**< field: icc_field_info::n_stray */
    ICC_REASON_LOST = 5,       /**< maps of method field: icc_map_report::n_lost */
    ICC_REASON_FLAT = 6        /**< maps of method field: icc_map_report::n_flat */
};

/** What icc_map_get_info() reports: what the map is. It is saved with the map. Members that do not
 *  apply to the kind are 0. */
typedef struct icc_map_info {
    size_t size;         /**< set by the caller: `sizeof(icc_map_info)` */
    int32_t dim;         /**< dimension */
    int32_t kind;        /**< `ICC_MAP_*`: never 0 */
    int32_t certified;   /**< 1: proved to be one-to-one, exactly (field: in doubles, see
                              icc_map_report::n_lost); 0: not, see `reason` */
    int32_t reason;      /**< `ICC_REASON_*`: why it is not certified; 0 if it is */
    int32_t reason_side; /**< 1: because the source's chart is not, 2: the target's; else 0 */
    int32_t class_kept;  /**< with features, 1: the map can be moved, while it stays one-to-one, to
                              what its ties, or the cuts chosen for it, said; and after
                              icc_map_retarget() to what became of the map before while every vertex
                              of the target went straight to its new place. 0: not so, or rounding
                              or the way of the vertices leaves it open */
    size_t n_vertices;   /**< mesh: vertices */
    size_t n_simplices;  /**< mesh: triangles, or in 3-D tetrahedra */
    double energy;       /**< mesh: mean symmetric Dirichlet energy |J|^2 + |J^-1|^2, the target
                              scaled to the source's area or volume; 4 for an isometry, in 3-D 6 */
    size_t n_holes;      /**< features inside: holes, */
    size_t n_lines;      /**< lines */
    size_t n_points;     /**< and points */
    size_t n_ties;       /**< with features: as many ties, see icc_map_get_tie() */
    double detour; /**< lengths of these in the target over those of the straight lines between
                              their ends: what is much more than 1 is twisted */
} icc_map_info;

/** What icc_map_get_report() reports: how the map was made. Members that do not apply to the kind
 *  are 0, and seconds are 0 where the map was loaded. */
typedef struct icc_map_report {
    size_t size;            /**< set by the caller: `sizeof(icc_map_report)` */
    double seconds;         /**< time to make the map, including the charts; or to load it */
    double seconds_repair;  /**< mesh: of that, time to make all simplices positive */
    double seconds_improve; /**< of that, time to improve it */
    double seconds_certify; /**< of that, time to certify it; kind curves of method field
                                 likewise */
    double energy_start;    /**< mesh: icc_map_info::energy before the improvement */
    size_t n_inverted;      /**< mesh: simplices that were not positive at first */
    size_t n_unrepaired;    /**< kind curves although kind mesh was tried: simplices that stay
                                 inverted, in 3-D by the best way */
    size_t n_iterations;    /**< mesh: steps of improvement */
    int32_t n_levels;       /**< mesh: refinements */
    int32_t n_trees;        /**< with features: ways to cut them apart that were tried and led to a
                                 map; 1 with ties */
    size_t n_samples;       /**< field: evenly spread points, half of them in the target, that were
                                 mapped there and back; 0 unless both charts are certified */
    size_t n_lost;          /**< field: of these, points that come back more than 1e-9 of the
                                 bounding box's diagonal away, or whose derivative does not match
                                 that of the way back. None if certified */
    size_t n_flat;          /**< field: of these, points around which volume shrinks to less than
                                 1e-6 of its mean. At most 0.2 % if certified */
    size_t n_spoilt;        /**< mesh: simplices that rounding makes flat or reversed, on either
                                 side, when icc_map_get_mesh() hands them out; 0 unless a shape is
                                 about 1e9 times as far from the origin as it is large */
} icc_map_report;

/**
 * Makes the map between two domains whose boundaries correspond: facet i goes to facet i, with the
 * same barycentric coordinates.
 *
 * If a boundary moves affinely, up to rounding, a map of kind mesh takes its inside along by the
 * same affine map, up to rounding. Vertices still go to their partners as given. Exceptions are
 * options with `iterations` -1, and features whose ties ask for another isotopy class.
 *
 * Both charts are built together, and their maxima are paired.
 *
 * In 3-D a surface without a mesh is filled as icc_domain_fill() does it without options, unless
 * the method is gradient or field. One that cannot be filled is ::ICC_ERR_RESOLUTION, and `err`
 * names the side and the facet; method field needs no mesh.
 *
 * @param[out] out the map; owned by the caller, see icc_map_free()
 * @param source   domain before
 * @param target   domain after: same dimension, same number of vertices, same facets, and in 2-D
 *                 the same orientation, also of each hole, else ::ICC_ERR_BOUNDARY. Features i are
 *                 of the same kind, with equally many vertices
 * @param options  may be NULL
 * @param env      may be NULL
 * @param err      may be NULL; `side` is 1 for the source, 2 for the target
 * @return as icc_chart_create(), or ::ICC_ERR_BOUNDARY; ::ICC_ERR_CERTIFICATE also if the options
 *         ask for kind mesh and no such map was found
 *
 * Cost of kind mesh: that of two charts, and a number of improvement steps that is limited in
 * proportion to the size of the boundary in 2-D, and by a number of passes over the tetrahedra in
 * 3-D. In 2-D from 4 ms for cages of a few dozen vertices to 0.3 s for 15,000. Where the limit ends
 * the improvement, icc_map_improve() goes on. Deterministic: work is counted, and no clock is read.
 * In 3-D a map of kind mesh is found for most pairs, not for all. docs/theory/solid-maps.md says
 * what is tried, and in which order.
 */
ICC_API icc_status icc_map_create(icc_map **out, const icc_domain *source, const icc_domain *target,
                                  const icc_map_options *options, const icc_env *env,
                                  icc_error *err);

/**
 * Makes the map between two polygons whose vertices correspond: icc_domain_create() of both, then
 * icc_map_create() without options.
 *
 * @param[out] out the map; owned by the caller, see icc_map_free()
 * @param n        number of vertices of each, at least 3
 * @param before   2 n coordinates x, y
 * @param after    2 n coordinates x, y, the same way round
 * @param env      may be NULL
 * @param err      may be NULL; `side` is 1 for `before`, 2 for `after`; `index` is the vertex at
 *                 fault
 * @return as icc_domain_create() and icc_map_create()
 *
 * Cost: that of those.
 */
ICC_API icc_status icc_map_create_polygons(icc_map **out, size_t n, const double *before,
                                           const double *after, const icc_env *env, icc_error *err);

/** Options of icc_map_improve(). */
typedef struct icc_improve_options {
    size_t size;        /**< set by the caller: `sizeof(icc_improve_options)` */
    int32_t iterations; /**< at most so many steps on each level; 0: as long as they pay */
    int32_t levels;     /**< at most so many refinements; 0: as long as they pay; -1: none */
    double tolerance;   /**< the last level ends when a step gains less than this share of the
                             energy; 0: the default */
} icc_improve_options;

/** What icc_map_improve() did. */
typedef struct icc_improve_report {
    size_t size;         /**< set by the caller: `sizeof(icc_improve_report)` */
    double energy_start; /**< as icc_map_info::energy, before */
    double energy;       /**< and after; never more */
    size_t n_iterations; /**< steps */
    size_t n_simplices;  /**< triangles or tetrahedra at the end */
    int32_t n_levels;    /**< refinements */
    int32_t cancelled;   /**< 1: the progress callback stopped it early */
} icc_improve_report;

/**
 * Makes a fairer map from one of kind mesh; the given map is not changed. The energy never rises
 * and every intermediate map is certified, so stopping early is safe: when the progress callback
 * asks to stop, the call succeeds with the map reached so far and says so in the report.
 *
 * Steps and refinements end where they do not pay. When all options are 0, the work and the number
 * of triangles are limited in proportion to what the map has; calling again goes on from there.
 * When any is set, neither is limited.
 *
 * In 3-D a refinement replaces tetrahedra by others that fill the same space, before and after, and
 * cuts edges in the middle. So the map's mesh (icc_map_get_mesh()) is no longer the source's
 * inside; its surface stays as it is, and every tetrahedron is exactly positive before and after.
 *
 * Cost: about a microsecond for each step and triangle, half as much again for a tetrahedron.
 *
 * @param[out] out    the map; owned by the caller
 * @param map         a map of kind mesh, else ::ICC_ERR_UNSUPPORTED
 * @param options     may be NULL
 * @param[out] report may be NULL; its `size` is set by the caller
 * @param env         may be NULL
 * @param err         may be NULL
 */
ICC_API icc_status icc_map_improve(icc_map **out, const icc_map *map,
                                   const icc_improve_options *options, icc_improve_report *report,
                                   const icc_env *env, icc_error *err);

/** Options of icc_map_retarget(). */
typedef struct icc_retarget_options {
    size_t size;        /**< set by the caller: `sizeof(icc_retarget_options)` */
    int32_t iterations; /**< at most so many improvement steps; 0: what a frame has time for; -1:
                             none */
} icc_retarget_options;

/**
 * Makes the map to a target that has moved. The source stays; the mesh and the images of its inner
 * vertices are taken from `map`, moved along, and improved by a few steps. For dragging a cage or a
 * surface, where each frame continues from the one before. The mesh is not refined further; frames
 * with the same mesh and allocator share what is known of it.
 *
 * Without features inside, any target in the plane is reached, however far it is; if need be with
 * another mesh.
 *
 * In 3-D, tetrahedra are replaced and cut where the way is blocked, and as a last resort the map is
 * made anew, as icc_map_create() does it, which fills a target without a mesh; `log` then says so.
 * That a target is reached is not guaranteed, only that what is returned is certified. A frame that
 * is reached at once costs a tenth of making the map or less; docs/performance.md has a table.
 *
 * Features go straight to their new places, and the map stays what becomes of the old one: it
 * passes them on the same sides (icc_map_info::class_kept). The mesh changes as it must. Where
 * features would meet on the way, the call fails with ::ICC_ERR_CERTIFICATE: go another way, in
 * several calls. To a target of a very different size, or far away, all go along with the shape
 * first, and straight from there.
 *
 * @param[out] out   the map; owned by the caller. It has no charts: icc_map_source_chart() gives
 *                   NULL.
 * @param map        a map of kind mesh, else ::ICC_ERR_UNSUPPORTED. It stays as it is
 * @param target     the new target, which must correspond as icc_map_create() requires; in 3-D a
 *                   surface or a mesh, whose inside is used by a map that is made anew only
  * @param options    may be NULL
 * @param env        may be NULL
 * @param err        may be NULL
 * @return as icc_map_create(); ::ICC_ERR_CERTIFICATE when the target cannot be reached; in 3-D
 *         `err` then names a vertex of the surface where the way is blocked
 */
ICC_API icc_status icc_map_retarget(icc_map **out, const icc_map *map, const icc_domain *target,
                                    const icc_retarget_options *options, const icc_env *env,
                                    icc_error *err);

/**
 * Copies the mesh of a map of kind mesh, in the caller's coordinates. They are rounded once, but
 * the certificate is about the unrounded numbers inside. icc_map_report::n_spoilt counts the
 * simplices that rounding makes flat or reversed.
 *
 * @param map          the map
 * @param[in,out] mesh what it has room for is filled, on the source: its vertices and its cells,
 *                     triangles counter-clockwise, tetrahedra with positive determinants. Then its
 *                     dimension and its numbers are set
 * @param[out] images  room for icc_map_info::n_vertices * dim coordinates in the target, or NULL
 * @return ::ICC_OK; ::ICC_ERR_ARGUMENT without a map or a mesh, or if it has too little room;
 *         ::ICC_ERR_UNSUPPORTED (not of kind mesh)
 */
ICC_API icc_status icc_map_get_mesh(const icc_map *map, icc_mesh *mesh, double *images);

/** What icc_map_certify() found out about the image of a caller-supplied mesh. */
typedef struct icc_certificate {
    size_t size;             /**< set by the caller: `sizeof(icc_certificate)` */
    int32_t certified;       /**< 1: every simplex keeps its orientation and both boundaries are
                                  simple, so the mesh and its image are one-to-one */
    int32_t boundary_simple; /**< 1: no part of the boundary meets itself or another part, and the
                                  mesh lies on one side of it; the same is true of the images */
    size_t n_inverted;       /**< simplices whose image has the opposite orientation */
    size_t n_flat;           /**< simplices without volume, or whose image has none */
    size_t n_no_image;       /**< vertices that have no image */
    int64_t first;           /**< the first simplex at fault, or -1 */
    char message[256];       /**< why it is not certified, one line of English; empty if it is */
} icc_certificate;

/**
 * Maps the vertices of a caller-supplied mesh of triangles (2-D) or tetrahedra (3-D) and checks,
 * exactly, whether the image is a mesh too. It need not be, even though the map is one-to-one: its
 * simplices are straight where the map bends.
 *
 * The mesh may have holes, voids and handles, and may be in several pieces. Each facet belongs to
 * one simplex or two, and no vertex or edge belongs to two parts of the boundary.
 *
 * @param map              a map in 2-D or 3-D, else ::ICC_ERR_UNSUPPORTED
 * @param mesh             of the dimension of the map; its vertices are in the source
 * @param[out] images      the images of its vertices: n_vertices * dim coordinates, or NULL
 * @param[out] certificate its `size` is set by the caller
 * @param env              may be NULL
 * @param err              may be NULL
 * @return ::ICC_OK once the check has run, whatever it found; ::ICC_ERR_ARGUMENT, ...
 */
ICC_API icc_status icc_map_certify(const icc_map *map, const icc_mesh *mesh, double *images,
                                   icc_certificate *certificate, const icc_env *env,
                                   icc_error *err);

/**
 * Maps a caller-supplied mesh of triangles (2-D) or tetrahedra (3-D) so that no simplex inverts:
 * maps the vertices, then moves the images of inner ones until every simplex keeps its orientation.
 * Inner vertices without an image get one.
 *
 * Simplices and the images of boundary vertices do not change, so this cannot always succeed (a
 * simplex with all its corners on the boundary stays as the map makes it): check `certificate`. If
 * it fails, the images are the best that were found. A mesh is not repaired if it cannot be
 * certified itself, or if a vertex of its boundary has no image.
 *
 * @param map              a map in 2-D or 3-D, else ::ICC_ERR_UNSUPPORTED
 * @param mesh             of the dimension of the map; its vertices are in the source
 * @param[out] images      the images of its vertices: n_vertices * dim coordinates
 * @param[out] certificate of the images returned; its `size` is set by the caller
 * @param env              may be NULL
 * @param err              may be NULL
 * @return as icc_map_certify()
 *
 * Cost: proportional to the number of inverted simplices; at worst a limited number of passes over
 * the mesh. Deterministic: iterations are capped, and no clock is read.
 */
ICC_API icc_status icc_map_repair(const icc_map *map, const icc_mesh *mesh, double *images,
                                  icc_certificate *certificate, const icc_env *env, icc_error *err);

/** Frees a map. */
ICC_API void icc_map_free(icc_map *map);

/** Fills in `info`, whose `size` the caller has set. ::ICC_OK or ::ICC_ERR_ARGUMENT. */
ICC_API icc_status icc_map_get_info(const icc_map *map, icc_map_info *info);

/** The same for `report`. If the mesh's coordinates have to be rounded, counting n_spoilt takes a
 *  pass over the mesh. */
ICC_API icc_status icc_map_get_report(const icc_map *map, icc_map_report *report);

/**
 * Source -> target. Returns ::ICC_OK even if every point failed: see `status` and `n_failed`. A
 * certified map of method field gives no image (::ICC_ERR_TRACE) to a point that would not come
 * back to within 1e-6 of its bounding box's diagonal.
 *
 * @param map           the map
 * @param n             number of points
 * @param points        n * dim coordinates in the source
 * @param[out] images   n * dim coordinates; NaN for a point without an image. May be the same array
 *                      as `points`.
 * @param[out] status   n statuses: ::ICC_OK, ::ICC_ERR_OUTSIDE, ::ICC_ERR_TRACE,
 *                      ::ICC_ERR_ARGUMENT; or NULL
 * @param[out] n_failed how many points have no image, or NULL
 * @param env           may be NULL
 * @return as icc_chart_encode()
 */
ICC_API icc_status icc_map_apply(const icc_map *map, size_t n, const double *points, double *images,
                                 icc_status *status, size_t *n_failed, const icc_env *env);

/** Target -> source; otherwise as icc_map_apply(). */
ICC_API icc_status icc_map_apply_inverse(const icc_map *map, size_t n, const double *points,
                                         double *images, icc_status *status, size_t *n_failed,
                                         const icc_env *env);

/**
 * The derivative of the map at points of the source, exact for the piecewise map up to rounding;
 * one-sided where it has a kink. Where a map is certified the determinant is positive; if rounding
 * would make it otherwise (method field), or the point does not come back, there is no derivative.
 * Returns ::ICC_OK even if every point failed.
 *
 * @param map            the map
 * @param n              number of points
 * @param points         n * dim coordinates in the source's interior; on the boundary and at the
 *                       maximum there is no derivative (::ICC_ERR_TRACE)
 * @param[out] jacobians n * dim * dim: row i, column j is the derivative of image coordinate i by
 *                       point coordinate j; NaN where there is none
 * @param[out] status    n statuses, or NULL
 * @param[out] n_failed  how many points have no derivative, or NULL
 * @param env            may be NULL
 * @return as icc_chart_encode()
 */
ICC_API icc_status icc_map_jacobian(const icc_map *map, size_t n, const double *points,
                                    double *jacobians, icc_status *status, size_t *n_failed,
                                    const icc_env *env);

/** What icc_map_get_tie() reports. */
typedef struct icc_tie_info {
    size_t size;        /**< set by the caller: `sizeof(icc_tie_info)` */
    uint32_t vertex[2]; /**< as in icc_tie */
    size_t n_source;    /**< its bends in the source: none as yet, they are edges of a triangulation
                             of the source's vertices */
    size_t n_target;    /**< and in the target */
    double length[2];   /**< of the tie in the source, and in the target */
} icc_tie_info;

/**
 * Reports a tie of a map of domains with features: which way round one another the features go. All
 * of them, as icc_map_options::ties, make another map that can be moved to this one while it stays
 * one-to-one; where icc_map_info::detour is large, they may be too entangled for doubles, and are
 * then refused with ::ICC_ERR_RESOLUTION. They follow from the map alone: the source's are a
 * shortest tree of straight lines between vertices, in which the ties that it was made with, if
 * any, need not be; the target's are drawn with few bends and do not cross.
 *
 * @param map         the map
 * @param tie         its number, less than icc_map_info::n_ties
 * @param[out] info   `size` is set by the caller
 * @param[out] source 2 * n_source coordinates of bends, or NULL
 * @param[out] target 2 * n_target coordinates of bends, or NULL
 * @return ::ICC_OK; ::ICC_ERR_ARGUMENT (`map` or `info` is NULL, or there is no such tie)
 */
ICC_API icc_status icc_map_get_tie(const icc_map *map, size_t tie, icc_tie_info *info,
                                   double *source, double *target);

/**
 * Writes a map to memory, with its domains and charts, in two calls as icc_chart_save() does.
 */
ICC_API icc_status icc_map_save(const icc_map *map, size_t capacity, void *data, size_t *n_bytes);

/**
 * Reads a map back, as icc_chart_load() does a chart. The mesh of a map of kind mesh is stored in
 * full, and certified anew.
 */
ICC_API icc_status icc_map_load(icc_map **out, size_t n_bytes, const void *data, const icc_env *env,
                                icc_error *err);

/* ----------------------------------------------------------------- picture */

/** How a picture is read between the centres of its pixels. */
enum {
    ICC_INTERPOLATION_NEAREST = 1, /**< the pixel's own samples, for classes and labels; no means */
    ICC_INTERPOLATION_LINEAR = 2,  /**< bilinear */
    ICC_INTERPOLATION_CUBIC = 3    /**< bicubic, exact for quadratic functions; may overshoot */
};

/** A picture in memory: rows from top to bottom, samples of a pixel side by side. */
typedef struct icc_picture {
    size_t size;      /**< set by the caller: `sizeof(icc_picture)` */
    int32_t width;    /**< pixels in a row */
    int32_t height;   /**< rows */
    int32_t channels; /**< samples of a pixel, 1..64 */
    int32_t bytes;    /**< of a sample, in the machine's order: 1 or 2, unsigned, all values used;
                           4 or 8: floats */
    int32_t alpha;    /**< 1: the last of two to four channels of 1 or 2 bytes is opacity, and the
                           others are not multiplied by it; 0: there is none */
    size_t stride;    /**< bytes from one row to the next */
    void *pixels;     /**< the first row; any alignment. A source is only read. */
    int32_t interpolation; /**< of a source: `ICC_INTERPOLATION_*`; 0: linear */
    int32_t has_nodata; /**< of a source: 1: samples that are `nodata` are missing; without alpha */
    double nodata;      /**< may be NaN */
} icc_picture;

/**
 * Warps a picture: every pixel of the target whose centre lies in the target domain or on its
 * boundary gets the colour of the place in the source that is mapped there; all other pixels are
 * left alone. Pixel (i, j), column i of row j, covers [i, i+1] x [j, j+1] in the coordinates of the
 * domains.
 *
 * Colours between pixels are interpolated bilinearly, weighted by opacity. Where the map shrinks
 * the picture they are means of up to 16 x 16 samples, to avoid aliasing. Beyond its edge the
 * source continues with the colour of the edge. The identity copies pixels exactly.
 *
 * Floats, more than four channels, missing samples and other interpolations are taken pixel by
 * pixel, each channel by itself. A pixel of the target is missing (it gets `nodata`) where the
 * source's pixel at its place is missing; next to missing samples what is known is interpolated
 * linearly. Means are of what is known.
 *
 * @param map           the map, 2-D; kind mesh is the fastest
 * @param source        read
 * @param target        has the channels, bytes and alpha of the source, and any width and height.
 *                      Its pixels must not overlap the source's.
 * @param[out] n_failed pixels inside without an image, which are left alone, or NULL; always 0 for
 *                      kind mesh
 * @param env           may be NULL; results are the same for every number of threads
 * @param err           may be NULL
 * @return ::ICC_OK, ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY, ::ICC_ERR_VERSION, ::ICC_ERR_CANCELLED
 *         (some pixels have been written)
 *
 * Cost of kind mesh: nanoseconds a pixel, for what is taken pixel by pixel some tenths of a
 * microsecond.
 */
ICC_API icc_status icc_map_warp(const icc_map *map, const icc_picture *source,
                                const icc_picture *target, size_t *n_failed, const icc_env *env,
                                icc_error *err);

#ifdef __cplusplus
}
#endif

#endif

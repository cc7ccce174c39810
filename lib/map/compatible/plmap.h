/* A piecewise linear map of the plane: a triangle mesh of the source and an image for every vertex.
 *
 * Words of this folder
 * - point, image: the place of a vertex before and after the map.
 * - plmap: a piecewise linear map as a mesh that can be edited. A mesh_map (map/plane/mesh_map.h)
 *   has one, and finders for its points. A simplicial map (map/energy/simplicial_map.h) is a view
 *   of a map in the plane or in space.
 * - positive triangle: one that is counter-clockwise, by the exact sign of its determinant.
 * - fixed vertex: one of the boundary, of a line or of a point, whose image is prescribed.
 * - row: the edges of the mesh along one side of a network (domain/network.h).
 * - chord: an inner edge between two fixed vertices.
 * - overlay: the common refinement of two triangulations.
 * - energy: the mean symmetric Dirichlet energy; 4 for an isometry.
 *
 * Invariants
 * - Points are positive everywhere. Images are positive once overlays have replaced inverted parts,
 *   and then each operation keeps them so.
 * - The vertices of the boundary stay on its facets. With features, each side of the network is a
 *   row of edges.
 *
 * Ways
 * - To a one-to-one map: overlay.h, compatible.h, overlay_start.h, overlay_patches.h.
 * - To less energy: points_and_images.h moves both, flips.h flips edges, and improve.h does
 *   both and refines the mesh.
 * - To another mesh: coarsen.h, density.h. What new triangles are worth: triangle_quality.h.
 * - To bytes: plmap_file.h.
 * - To another target: move_targets.h, for the faces that change: moving_part.h.
 *
 * Begin with this file, then overlay.c. */
#ifndef ICCP_PLMAP_H
#define ICCP_PLMAP_H

#include "base/minmax.h"
#include "map/energy/simplicial_map.h"
#include "math/vec.h"
#include "mesh/corners.h"
#include "mesh/planar.h"

#include <string.h>

/* What a vertex is fixed to, and what iccp_plmap::facet then means. */
enum {
    ICCP_FREE = 0,
    ICCP_ALONG,     /* to the boundary: the facet of the edge that begins there and has the inside
                       on its left. The facet runs along with the edge */
    ICCP_AGAINST,   /* the same, but the facet runs against the edge */
    ICCP_ON_POINT,  /* held inside the mesh (moving_part.h, map/nearest, lib/fit): no facet */
    ICCP_ON_NETWORK /* to the network of a source with features: a side of it, or a lone point. At a
                       node, `facet` and `along` are the node's place (domain/network.h) */
};

typedef struct iccp_plmap {
    iccp_memory memory;
    iccp_corners corners;
    size_t n_vertices;
    size_t vertex_room, triangle_room;
    double *points;  /* 2 n_vertices: local in the source */
    double *images;  /* 2 n_vertices: local in the target */
    uint8_t *fixed;  /* of each vertex: ICCP_FREE or what it is fixed to */
    uint32_t *facet; /* of fixed vertices: a facet of the source (domain/features.h) */
    double *along;   /* of fixed vertices: their place on that facet, in [0, 1] */
    double stretch;  /* multiplies lengths of the source in energies, so that both areas are
                            the same and energies measure shape alone */
    const struct iccp_newton_plan *plan; /* as in iccp_simplicial_map, borrowed */
    struct iccp_edge_set *held; /* edges that must stay (map/nearest), borrowed; NULL: none */
    const icc_domain *featured; /* the source if it has features, borrowed; NULL otherwise */
} iccp_plmap;

/* Makes room for so many vertices and triangles. The caller fills them in. */
icc_status iccp_plmap_begin(iccp_plmap *map, size_t n_vertices, size_t n_triangles, double stretch,
                            const iccp_memory *memory);

/* Fills in the mesh and the images. The caller then says which vertices are fixed. */
void iccp_plmap_fill(iccp_plmap *map, const double *points, const double *images,
                     const uint32_t *vertex, const uint32_t *twin);

/* Copies the mesh of a domain. `images`: 2 n_vertices, or NULL for the points themselves. */
icc_status iccp_plmap_create(iccp_plmap *map, const iccp_planar *mesh, const icc_domain *domain,
                             const double *images, double stretch, const iccp_memory *memory);
icc_status iccp_plmap_copy(iccp_plmap *map, const iccp_plmap *other, const iccp_memory *memory);
void iccp_plmap_free(iccp_plmap *map);

static inline const double *iccp_plmap_image(const iccp_plmap *map, uint32_t corner)
{
    return map->images + 2 * (size_t)map->corners.vertex[corner];
}

static inline const double *iccp_plmap_point(const iccp_plmap *map, uint32_t corner)
{
    return map->points + 2 * (size_t)map->corners.vertex[corner];
}

/* Copies what is known of vertex `b` of one map to vertex `a` of another. */
static inline void iccp_plmap_copy_vertex(iccp_plmap *to, size_t a, const iccp_plmap *from,
                                          size_t b)
{
    memcpy(to->points + 2 * a, from->points + 2 * b, 2 * sizeof *to->points);
    memcpy(to->images + 2 * a, from->images + 2 * b, 2 * sizeof *to->images);
    to->fixed[a] = from->fixed[b];
    to->facet[a] = from->facet[b];
    to->along[a] = from->along[b];
}

/* Returns the square of an edge's length after the map, or before it and stretched, whichever is
 * longer. */
static inline double iccp_plmap_length2(const iccp_plmap *map, uint32_t a, uint32_t b)
{
    const size_t i = 2 * (size_t)a, j = 2 * (size_t)b;
    return iccp_max(map->stretch * map->stretch *
                        iccp_vec_distance2(2, map->points + i, map->points + j),
                    iccp_vec_distance2(2, map->images + i, map->images + j));
}

/* Returns a view of the map without neighbours. It is valid until the mesh changes. */
static inline iccp_simplicial_map iccp_plmap_simplicial(const iccp_plmap *map)
{
    return (iccp_simplicial_map){.dim = 2,
                                 .n_points = map->n_vertices,
                                 .n_simplices = map->corners.n_triangles,
                                 .corners = map->corners.vertex,
                                 .points = map->points,
                                 .images = map->images,
                                 .fixed = map->fixed,
                                 .plan = map->plan,
                                 .stretch = map->stretch};
}

static inline size_t iccp_plmap_count_inverted(const iccp_plmap *map)
{
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
    return iccp_simplicial_count_inverted(&simplicial);
}

static inline double iccp_plmap_energy(const iccp_plmap *map)
{
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
    return iccp_simplicial_energy(&simplicial);
}

/* Replaces the map by its inverse. */
static inline void iccp_plmap_swap(iccp_plmap *map)
{
    double *points = map->points;
    map->points = map->images;
    map->images = points;
    map->stretch = 1 / map->stretch;
}

/* Returns ICCP_ALONG or ICCP_AGAINST for the boundary facets of a domain without features. */
static inline uint8_t iccp_plmap_sense(const icc_domain *domain)
{
    return domain->orientation > 0 ? ICCP_ALONG : ICCP_AGAINST;
}

/* ---- the network of a source with features ---- */

/* Makes all vertices free. `featured`: the source if it has features, or NULL. It must live as long
 * as the map uses it. */
void iccp_plmap_fix_none(iccp_plmap *map, const icc_domain *featured);

/* Fixes a vertex to the place of a vertex of the source. */
void iccp_plmap_fix_node(iccp_plmap *map, size_t v, uint32_t source_vertex);

/* Returns the node of the network at which a vertex lies, or UINT32_MAX if it lies at none. */
uint32_t iccp_plmap_node(const iccp_plmap *map, uint32_t v);

/* Whether the edge between two neighbours in the mesh is a piece of a side of the network. Then
 * *facet is the side, and *from and *to are their places on it. */
bool iccp_plmap_on_line(const iccp_plmap *map, uint32_t a, uint32_t b, uint32_t *facet,
                        double *from, double *to);

/* Whether the edge that a corner faces is a piece of a side. Such an edge must stay. */
static inline bool iccp_plmap_is_line(const iccp_plmap *map, uint32_t corner)
{
    const uint32_t a = map->corners.vertex[iccp_after(corner)];
    const uint32_t b = map->corners.vertex[iccp_before(corner)];
    uint32_t facet;
    double from, to;
    return map->fixed[a] == ICCP_ON_NETWORK && map->fixed[b] == ICCP_ON_NETWORK &&
           iccp_plmap_on_line(map, a, b, &facet, &from, &to);
}

/* Whether the edge that a corner faces may be cut. It may not in a part of a map with features
 * (moving_part.h) if the edge has a triangle outside the part, or an end that is held. */
static inline bool iccp_plmap_may_cut(const iccp_plmap *map, uint32_t corner)
{
    const uint32_t *v = map->corners.vertex;
    return map->featured == NULL || iccp_plmap_is_line(map, corner) ||
           (map->corners.twin[corner] != ICCP_NO_NEIGHBOUR &&
            map->fixed[v[iccp_after(corner)]] != ICCP_ON_POINT &&
            map->fixed[v[iccp_before(corner)]] != ICCP_ON_POINT);
}

/* Whether the edge that a corner faces lies inside the mesh and not on a side, and the other
 * diagonal of its two triangles would not lie on a side either. */
bool iccp_plmap_may_flip(const iccp_plmap *map, uint32_t corner);

/* Finds the mesh's vertex at each vertex of a source with features. Returns false unless there is
 * exactly one at each node. */
bool iccp_plmap_find_vertices(const iccp_plmap *map, uint32_t *vertex);

/* Whether a triangle is positive before and after the map, exactly. */
bool iccp_plmap_positive_point(const iccp_plmap *map, uint32_t triangle);
bool iccp_plmap_positive_image(const iccp_plmap *map, uint32_t triangle);

/* Whether that holds for all triangles. */
bool iccp_plmap_is_positive(const iccp_plmap *map);

/* Makes room for n cuts, so that none of them has to move the map. */
icc_status iccp_plmap_expect_cuts(iccp_plmap *map, size_t n);

/* Cuts the edge that a corner faces at its middle, before and after the map. *done is false if the
 * edge may not be cut, or if rounding would spoil a triangle that is positive now. Makes room as
 * needed. */
icc_status iccp_plmap_cut(iccp_plmap *map, uint32_t corner, bool *done);

/* Cuts all chords at their middles, so that there are free vertices between fixed ones. All
 * triangles keep their signs. */
icc_status iccp_cut_chords(iccp_plmap *map);

#endif

/* A piecewise linear map: a triangle mesh of the source and an image for every vertex. */
#ifndef ICCP_PLMAP_H
#define ICCP_PLMAP_H

#include "base/minmax.h"
#include "map/energy/simplicial_map.h"
#include "math/vec.h"
#include "mesh/corners.h"
#include "mesh/planar.h"

/* What holds a vertex, and what its facet is then. */
enum {
    ICCP_FREE = 0,
    ICCP_ALONG,      /* the boundary: that with the edge which begins there, counter-clockwise as
                        seen from inside, and runs along with it, */
    ICCP_AGAINST,    /* or against it */
    ICCP_LINE_BEGIN, /* a line, whose first vertex this is: its first segment */
    ICCP_ON_LINE,    /* a line: the segment that begins there, or the last one */
    ICCP_ON_POINT    /* a point: its own */
};

typedef struct iccp_plmap {
    iccp_memory memory;
    iccp_corners corners;
    size_t n_vertices;
    size_t vertex_room, triangle_room;
    double *points;  /* 2 n_vertices: local in the source */
    double *images;  /* 2 n_vertices: local in the target */
    uint8_t *fixed;  /* of each vertex: as above */
    uint32_t *facet; /* of fixed vertices: the source's facet (domain/features.h) */
    double *along;   /* of fixed vertices: where on that facet they lie, in [0, 1] */
    double stretch;  /* lengths of the source are multiplied by this for energies, so that both
                            areas are the same and energies are those of shape alone */
    const struct iccp_newton_plan *plan; /* as in iccp_simplicial_map, borrowed */
} iccp_plmap;

/* Room for so many vertices and triangles, which are still to be filled in. */
icc_status iccp_plmap_begin(iccp_plmap *map, size_t n_vertices, size_t n_triangles, double stretch,
                            const iccp_memory *memory);

/* Fills in the mesh and the images; what holds vertices is still to be said. */
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

/* The square of the distance of two vertices after the map, or before it and stretched: the longer
 * one. */
static inline double iccp_plmap_length2(const iccp_plmap *map, uint32_t a, uint32_t b)
{
    const size_t i = 2 * (size_t)a, j = 2 * (size_t)b;
    return iccp_max(map->stretch * map->stretch *
                        iccp_vec_distance2(2, map->points + i, map->points + j),
                    iccp_vec_distance2(2, map->images + i, map->images + j));
}

/* The map without its neighbours, until its mesh changes. */
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

/* Makes it the inverse map. */
static inline void iccp_plmap_swap(iccp_plmap *map)
{
    double *points = map->points;
    map->points = map->images;
    map->images = points;
    map->stretch = 1 / map->stretch;
}

/* How the facets of a domain without features run. */
static inline uint8_t iccp_plmap_sense(const icc_domain *domain)
{
    return domain->orientation > 0 ? ICCP_ALONG : ICCP_AGAINST;
}

/* Whether the edge between two neighbours in the mesh is a piece of a line: *facet is then the
 * segment, and *from, *to say where on it they lie. */
bool iccp_plmap_on_line(const iccp_plmap *map, uint32_t a, uint32_t b, uint32_t *facet,
                        double *from, double *to);

/* Whether the edge that a corner faces is a piece of a line, which must stay. */
static inline bool iccp_plmap_is_line(const iccp_plmap *map, uint32_t corner)
{
    const uint32_t a = map->corners.vertex[iccp_after(corner)];
    const uint32_t b = map->corners.vertex[iccp_before(corner)];
    uint32_t facet;
    double from, to;
    return map->fixed[a] >= ICCP_LINE_BEGIN && map->fixed[b] >= ICCP_LINE_BEGIN &&
           iccp_plmap_on_line(map, a, b, &facet, &from, &to);
}

/* The mesh's vertex at each vertex of the source. False unless there is one for each. */
bool iccp_plmap_find_vertices(const iccp_plmap *map, const icc_domain *source, uint32_t *vertex);

/* Whether a triangle is positive before and after the map, exactly. */
bool iccp_plmap_positive_point(const iccp_plmap *map, uint32_t triangle);
bool iccp_plmap_positive_image(const iccp_plmap *map, uint32_t triangle);

/* Cuts the edge that a corner faces at its middle, before and after the map, unless rounding would
 * make a triangle that is positive now, before or after, not positive. Makes room as needed. */
icc_status iccp_plmap_cut(iccp_plmap *map, uint32_t corner, bool *done);

/* Cuts the inner edges between two fixed vertices at their middle, which gives them something to
 * move. All triangles keep their signs. */
icc_status iccp_cut_chords(iccp_plmap *map);

#endif

/* The regions of a folded plane map that must be mapped anew.
 *
 * Words of this folder
 * - model: the images as given. They may fold.
 * - folded triangle: one whose image is flat or reversed, exactly.
 * - region: triangles that are connected across edges and contain folded ones.
 * - rim: the rings of edges around a region, with the region on their left. The first ring is the
 *   outer one. The others go around holes of the mesh.
 * - held vertex: one inside the mesh whose image must stay (ICCP_ON_POINT). Held edge: one between
 *   them that must stay, too, except that new held vertices may divide it (iccp_plmap::held).
 * - sound region: the images of its rim bound a plane region, and the images of its held vertices
 *   lie inside it. Exact.
 *
 * Ways: regions.h finds sound regions, refill.h maps one anew. adopt.h and insert_points.h give it
 * back the vertices that the region had. map_regions.h maps all anew. approach.h moves the result
 * towards the model, nearest.h does everything. nearest_map.h serves callers. Begin with
 * nearest.h. */
#ifndef ICCP_REGIONS_H
#define ICCP_REGIONS_H

#include "geometry/sweep.h"
#include "map/compatible/plmap.h"

typedef struct iccp_region {
    uint32_t first;  /* the triangle that was chosen first */
    size_t begin, n; /* its triangles in iccp_regions::order */
} iccp_region;

typedef struct iccp_regions {
    iccp_memory memory;
    const iccp_plmap *map;
    size_t n;
    iccp_region *item;
    uint32_t *order;  /* the chosen triangles, region by region */
    uint32_t *region; /* of each triangle: its region, or UINT32_MAX */
    bool is_stuck;    /* one region is everything and is not sound */
    /* The rest is for the search. */
    size_t n_chosen;
    uint32_t *chosen;       /* triangles in the order in which they were chosen */
    uint32_t *settled;      /* of the first triangle of a region: the size at which it was sound */
    uint32_t *begin, *star; /* the triangles around each vertex */
    uint32_t *link;         /* of each vertex: the corner that faces the rim's edge from there */
    uint32_t *seen, *visited; /* of each vertex and triangle: the last search that met it */
    uint32_t search;
} iccp_regions;

typedef struct iccp_rim {
    size_t n_rings, n_points; /* points include those that close rings */
    iccp_chain *ring;         /* then one chain for each held vertex, after n_points */
    uint32_t *vertex;         /* n_points, then the vertices inside: n_held held ones first */
    uint32_t *corner;         /* n_points: the corner that faces the edge from there */
    double *points, *images;  /* of `vertex` up to the held ones */
    size_t n_held, n_inside;  /* n_inside counts held ones, too */
    size_t n_edges;           /* held edges inside */
    uint32_t *edges;          /* 2 n_edges: places in `vertex` */
} iccp_rim;

/* Chooses the folded triangles, nearly folded ones, and two rings around them. */
icc_status iccp_regions_create(iccp_regions *regions, const iccp_plmap *map, const iccp_env *env);
void iccp_regions_free(iccp_regions *regions);

/* Lets regions grow until all are sound, or until one is everything (is_stuck). Those that touch
 * become one. O(n log n) for each round of growth, and about sqrt(n) rounds at most. */
icc_status iccp_regions_settle(iccp_regions *regions, const iccp_env *env);

/* Makes everything one region. */
void iccp_regions_take_all(iccp_regions *regions);

/* Lets a sound region grow, because it could not be mapped. Then call iccp_regions_settle(). */
icc_status iccp_regions_widen(iccp_regions *regions, size_t region);

/* Lists the rim of a sound region. */
icc_status iccp_rim_create(iccp_rim *rim, iccp_regions *regions, size_t region,
                           const iccp_memory *memory);
void iccp_rim_free(iccp_rim *rim, const iccp_memory *memory);

#endif

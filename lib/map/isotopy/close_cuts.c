/* Closes the cuts of overlays. Two edges of cut polygons that are partners become one edge. Corners
 * at the same node or bend become one vertex. */
#include "map/isotopy/close_cuts.h"

#include <string.h>

static const uint32_t NONE = ICCP_NO_NEIGHBOUR;

typedef struct closing {
    const iccp_overlay *overlays;
    const iccp_cut_polygons *polygons;
    const iccp_domain_pair *domains;
    size_t n_vertices, n_triangles; /* of all overlays */
    uint32_t
        *number;     /* of each vertex of the overlays, from overlay to overlay: the map's vertex */
    uint32_t *first; /* of each node and bend: the map's vertex there */
    uint32_t *facing; /* of each edge of the polygons: the corner of the map that faces it */
} closing;

/* Numbers the vertices of the overlays in their order. Corners at the same place get the number of
 * the first one. Returns the number of vertices of the map. */
static uint32_t number_vertices(const closing *c)
{
    const iccp_cut_polygons *p = c->polygons;
    uint32_t n = 0, *number = c->number;
    for (size_t q = 0; q < p->n_polygons; ++q)
        for (uint32_t i = 0; i < c->overlays[q].n_vertices; ++i) {
            if (i >= iccp_cut_polygon_size(p, q)) {
                *number++ = n++;
                continue;
            }
            uint32_t *first = &c->first[p->vertex[p->first[q] + i]];
            if (*first == NONE)
                *first = n++;
            *number++ = *first;
        }
    return n;
}

/* Fills in the map's triangles. */
static void join_triangles(iccp_plmap *map, const closing *c)
{
    const iccp_cut_polygons *p = c->polygons;
    iccp_corners *mesh = &map->corners;
    const uint32_t *number = c->number;
    uint32_t begin = 0;
    for (size_t q = 0; q < p->n_polygons; ++q) {
        const iccp_overlay *o = &c->overlays[q];
        for (uint32_t x = 0; x < 3 * o->corners.n_triangles; ++x) {
            const uint32_t twin = o->corners.twin[x];
            mesh->vertex[begin + x] = number[o->corners.vertex[x]];
            mesh->twin[begin + x] = twin != NONE ? begin + twin : NONE;
            if (twin == NONE)
                c->facing[p->first[q] + o->corners.vertex[iccp_after(x)]] = begin + x;
        }
        number += o->n_vertices;
        begin += 3 * (uint32_t)o->corners.n_triangles;
    }
    for (uint32_t i = 0; i < p->n; ++i)
        if (p->partner[i] != NONE)
            mesh->twin[c->facing[i]] = c->facing[p->partner[i]];
}

/* Fixes the vertices at the corners of a polygon that are vertices of the domain. `number` has the
 * vertices of its overlay. */
static void place_corners(iccp_plmap *map, const closing *c, size_t polygon, const uint32_t *number)
{
    const iccp_cut_polygons *p = c->polygons;
    const uint32_t n = iccp_cut_polygon_size(p, polygon), *vertex = p->vertex + p->first[polygon];
    for (uint32_t i = 0; i < n; ++i)
        if (vertex[i] < c->domains->n)
            iccp_plmap_fix_node(map, number[i], vertex[i]);
}

static void place_vertices(iccp_plmap *map, const closing *c)
{
    const uint32_t *number = c->number;
    iccp_plmap_fix_none(map, c->domains->domain[0]);
    for (size_t q = 0; q < c->polygons->n_polygons; ++q) {
        const iccp_overlay *o = &c->overlays[q];
        for (size_t i = 0; i < o->n_vertices; ++i) {
            memcpy(map->points + 2 * (size_t)number[i], o->points + 2 * i, 2 * sizeof(double));
            memcpy(map->images + 2 * (size_t)number[i], o->images + 2 * i, 2 * sizeof(double));
        }
        place_corners(map, c, q, number);
        number += o->n_vertices;
    }
}

icc_status iccp_close_cuts(iccp_plmap *map, const iccp_overlay *overlays,
                           const iccp_cut_polygons *polygons, const iccp_domain_pair *domains,
                           const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    closing c = {.overlays = overlays, .polygons = polygons, .domains = domains};
    /* A polygon has no more bends than corners. */
    const size_t n_places = domains->n + polygons->n;
    icc_status status = ICC_ERR_MEMORY;
    *map = (iccp_plmap){.memory = *memory};
    for (size_t q = 0; q < polygons->n_polygons; ++q) {
        c.n_vertices += overlays[q].n_vertices;
        c.n_triangles += overlays[q].corners.n_triangles;
    }
    c.number = iccp_alloc(memory, c.n_vertices, sizeof *c.number);
    c.first = iccp_alloc(memory, n_places, sizeof *c.first);
    c.facing = iccp_alloc(memory, polygons->n, sizeof *c.facing);
    if (c.number != NULL && c.first != NULL && c.facing != NULL) {
        memset(c.first, 0xff, n_places * sizeof *c.first);
        const uint32_t n = number_vertices(&c);
        status = iccp_plmap_begin(map, n, c.n_triangles, 1 / domains->scale, memory);
    }
    if (status == ICC_OK) {
        place_vertices(map, &c);
        join_triangles(map, &c);
    }
    iccp_free(memory, c.number);
    iccp_free(memory, c.first);
    iccp_free(memory, c.facing);
    return status;
}

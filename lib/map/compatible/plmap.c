/* Makes piecewise linear maps of the plane, tests them, and cuts their edges. */
#include "map/compatible/plmap.h"

#include "domain/network.h"
#include "math/predicates.h"

#include <string.h>

/* Makes room for so many vertices and triangles in all. On failure the map stays as it is. */
static icc_status make_room(iccp_plmap *map, size_t n_vertices, size_t n_triangles)
{
    const iccp_memory *memory = &map->memory;
    const size_t n = map->n_vertices, n_corners = 3 * map->corners.n_triangles;
    bool is_there = true;
    if (n_vertices > map->vertex_room) {
        const size_t room = n_vertices;
        is_there &= iccp_enlarge(memory, &map->points, n, room, 2 * sizeof *map->points);
        is_there &= iccp_enlarge(memory, &map->images, n, room, 2 * sizeof *map->images);
        is_there &= iccp_enlarge(memory, &map->fixed, n, room, sizeof *map->fixed);
        is_there &= iccp_enlarge(memory, &map->facet, n, room, sizeof *map->facet);
        is_there &= iccp_enlarge(memory, &map->along, n, room, sizeof *map->along);
        if (is_there)
            map->vertex_room = room;
    }
    if (n_triangles > map->triangle_room) {
        const size_t room = 3 * n_triangles;
        is_there &= iccp_enlarge(memory, &map->corners.vertex, n_corners, room, sizeof(uint32_t));
        is_there &= iccp_enlarge(memory, &map->corners.twin, n_corners, room, sizeof(uint32_t));
        if (is_there)
            map->triangle_room = n_triangles;
    }
    return is_there ? ICC_OK : ICC_ERR_MEMORY;
}

icc_status iccp_plmap_expect_cuts(iccp_plmap *map, size_t n)
{
    return make_room(map, map->n_vertices + n, map->corners.n_triangles + 2 * n);
}

icc_status iccp_plmap_begin(iccp_plmap *map, size_t n_vertices, size_t n_triangles, double stretch,
                            const iccp_memory *memory)
{
    *map = (iccp_plmap){.memory = *memory, .stretch = stretch};
    const icc_status status = make_room(map, n_vertices, n_triangles);
    if (status != ICC_OK) {
        iccp_plmap_free(map);
        return status;
    }
    map->n_vertices = n_vertices;
    map->corners.n_triangles = n_triangles;
    return ICC_OK;
}

void iccp_plmap_fill(iccp_plmap *map, const double *points, const double *images,
                     const uint32_t *vertex, const uint32_t *twin)
{
    const size_t n_vertices = map->n_vertices, n_triangles = map->corners.n_triangles;
    memcpy(map->points, points, 2 * n_vertices * sizeof *points);
    memcpy(map->images, images, 2 * n_vertices * sizeof *images);
    memcpy(map->corners.vertex, vertex, 3 * n_triangles * sizeof *vertex);
    memcpy(map->corners.twin, twin, 3 * n_triangles * sizeof *twin);
}

icc_status iccp_plmap_create(iccp_plmap *map, const iccp_planar *mesh, const icc_domain *domain,
                             const double *images, double stretch, const iccp_memory *memory)
{
    const icc_status status =
        iccp_plmap_begin(map, mesh->n_vertices, mesh->n_triangles, stretch, memory);
    if (status == ICC_OK)
        iccp_plmap_fill(map, mesh->points, images != NULL ? images : mesh->points, mesh->triangles,
                        mesh->twins);
    for (uint32_t v = 0; status == ICC_OK && v < mesh->n_vertices; ++v) {
        map->fixed[v] = v < mesh->n_boundary ? iccp_plmap_sense(domain) : ICCP_FREE;
        map->facet[v] = map->fixed[v] ? mesh->facet[v] : 0;
        map->along[v] = map->fixed[v] ? iccp_planar_along(mesh, domain, v, 0) : 0;
    }
    return status;
}

icc_status iccp_plmap_copy(iccp_plmap *map, const iccp_plmap *other, const iccp_memory *memory)
{
    const icc_status status = iccp_plmap_begin(map, other->n_vertices, other->corners.n_triangles,
                                               other->stretch, memory);
    if (status == ICC_OK) {
        iccp_plmap_fill(map, other->points, other->images, other->corners.vertex,
                        other->corners.twin);
        map->featured = other->featured;
        map->held = other->held;
        memcpy(map->fixed, other->fixed, other->n_vertices * sizeof *map->fixed);
        memcpy(map->facet, other->facet, other->n_vertices * sizeof *map->facet);
        memcpy(map->along, other->along, other->n_vertices * sizeof *map->along);
    }
    return status;
}

void iccp_plmap_free(iccp_plmap *map)
{
    iccp_free(&map->memory, map->points);
    iccp_free(&map->memory, map->images);
    iccp_free(&map->memory, map->fixed);
    iccp_free(&map->memory, map->facet);
    iccp_free(&map->memory, map->along);
    iccp_free(&map->memory, map->corners.vertex);
    iccp_free(&map->memory, map->corners.twin);
    *map = (iccp_plmap){.memory = map->memory};
}

bool iccp_plmap_positive_point(const iccp_plmap *map, uint32_t triangle)
{
    const uint32_t c = 3 * triangle;
    return iccp_orient2d(iccp_plmap_point(map, c), iccp_plmap_point(map, c + 1),
                         iccp_plmap_point(map, c + 2)) > 0;
}

bool iccp_plmap_positive_image(const iccp_plmap *map, uint32_t triangle)
{
    const uint32_t c = 3 * triangle;
    return iccp_orient2d(iccp_plmap_image(map, c), iccp_plmap_image(map, c + 1),
                         iccp_plmap_image(map, c + 2)) > 0;
}

bool iccp_plmap_is_positive(const iccp_plmap *map)
{
    bool is = true;
    for (uint32_t t = 0; t < map->corners.n_triangles && is; ++t)
        is = iccp_plmap_positive_point(map, t) && iccp_plmap_positive_image(map, t);
    return is;
}

/* Whether the halves x a m and x m b of triangle x a b keep its sign. */
static bool can_halve(const double *x, const double *a, const double *b, const double m[2])
{
    return iccp_orient2d(x, a, b) <= 0 ||
           (iccp_orient2d(x, a, m) > 0 && iccp_orient2d(x, m, b) > 0);
}

static bool can_cut(const iccp_plmap *map, uint32_t corner, const double point[2],
                    const double image[2])
{
    const uint32_t a = iccp_after(corner), b = iccp_before(corner);
    return can_halve(iccp_plmap_point(map, corner), iccp_plmap_point(map, a),
                     iccp_plmap_point(map, b), point) &&
           can_halve(iccp_plmap_image(map, corner), iccp_plmap_image(map, a),
                     iccp_plmap_image(map, b), image);
}

static void middle_of(const double *a, const double *b, double m[2])
{
    m[0] = 0.5 * a[0] + 0.5 * b[0];
    m[1] = 0.5 * a[1] + 0.5 * b[1];
}

/* ---- the network of a source with features ---- */

/* The node at an end of a facet: 0 or 1. */
static uint32_t node_at(const iccp_plmap *map, uint32_t facet, uint32_t end)
{
    return iccp_network_of(map->featured)->node[map->featured->facets[2 * (size_t)facet + end]];
}

void iccp_plmap_fix_none(iccp_plmap *map, const icc_domain *featured)
{
    map->featured = featured;
    memset(map->fixed, ICCP_FREE, map->n_vertices * sizeof *map->fixed);
    memset(map->facet, 0, map->n_vertices * sizeof *map->facet);
    for (size_t v = 0; v < map->n_vertices; ++v)
        map->along[v] = 0;
}

void iccp_plmap_fix_node(iccp_plmap *map, size_t v, uint32_t source_vertex)
{
    const uint32_t place = iccp_network_of(map->featured)->place[source_vertex];
    map->fixed[v] = ICCP_ON_NETWORK;
    map->facet[v] = place / 2;
    map->along[v] = place % 2;
}

uint32_t iccp_plmap_node(const iccp_plmap *map, uint32_t v)
{
    const double along = map->along[v];
    return map->fixed[v] != ICCP_ON_NETWORK || (along > 0 && along < 1)
               ? UINT32_MAX
               : node_at(map, map->facet[v], along > 0);
}

/* Finds where a vertex lies on a facet. `node`: its node, or UINT32_MAX. Returns false if it does
 * not lie there. */
static bool find_place(const iccp_plmap *map, uint32_t v, uint32_t node, uint32_t facet,
                       double *place)
{
    const bool is_end = node != UINT32_MAX && node == node_at(map, facet, 1);
    *place = node == UINT32_MAX ? map->along[v] : is_end;
    return node == UINT32_MAX ? map->facet[v] == facet : is_end || node == node_at(map, facet, 0);
}

/* Two nodes are on a side if the network joins them. Otherwise the vertex that is no node tells the
 * side. */
bool iccp_plmap_on_line(const iccp_plmap *map, uint32_t a, uint32_t b, uint32_t *facet,
                        double *from, double *to)
{
    if (map->fixed[a] != ICCP_ON_NETWORK || map->fixed[b] != ICCP_ON_NETWORK)
        return false;
    const uint32_t node[2] = {iccp_plmap_node(map, a), iccp_plmap_node(map, b)};
    if (node[0] != UINT32_MAX && node[1] != UINT32_MAX) {
        if (!iccp_network_side(iccp_network_of(map->featured), map->featured, node[0], node[1],
                               facet))
            return false;
    } else {
        *facet = map->facet[node[0] == UINT32_MAX ? a : b];
    }
    return find_place(map, a, node[0], *facet, from) && find_place(map, b, node[1], *facet, to);
}

bool iccp_plmap_may_flip(const iccp_plmap *map, uint32_t corner)
{
    const uint32_t twin = map->corners.twin[corner];
    uint32_t facet;
    double from, to;
    return twin != ICCP_NO_NEIGHBOUR && !iccp_plmap_is_line(map, corner) &&
           !iccp_plmap_on_line(map, map->corners.vertex[corner], map->corners.vertex[twin], &facet,
                               &from, &to);
}

bool iccp_plmap_find_vertices(const iccp_plmap *map, uint32_t *vertex)
{
    const iccp_network *network = iccp_network_of(map->featured);
    const size_t n_given = map->featured->n_vertices;
    size_t n = 0;
    memset(vertex, 0xff, n_given * sizeof *vertex);
    for (uint32_t v = 0; v < map->n_vertices; ++v) {
        const uint32_t node = iccp_plmap_node(map, v);
        if (node == UINT32_MAX)
            continue;
        if (vertex[node] != UINT32_MAX)
            return false;
        vertex[node] = v;
        ++n;
    }
    for (size_t v = 0; v < n_given; ++v)
        vertex[v] = vertex[network->node[v]];
    return n == network->n_nodes;
}

/* Records what vertex m is fixed to, in the middle of the edge from a to b. An edge of the boundary
 * has the inside on its left. Returns false if rounding leaves no place between a and b. */
static bool place_on_edge(iccp_plmap *map, size_t m, bool is_boundary, uint32_t a, uint32_t b)
{
    uint32_t facet = 0;
    double from = 0, to = 0;
    bool has_place = true;
    map->fixed[m] = ICCP_FREE;
    if (iccp_plmap_on_line(map, a, b, &facet, &from, &to)) {
        const double middle = 0.5 * (from + to);
        map->fixed[m] = ICCP_ON_NETWORK;
        has_place = (from < middle && middle < to) || (to < middle && middle < from);
    } else if (is_boundary) {
        map->fixed[m] = map->fixed[a];
        facet = map->facet[a];
        from = map->along[a];
        to = map->facet[b] == facet ? map->along[b] : map->fixed[a] == ICCP_ALONG ? 1 : 0;
    }
    map->facet[m] = facet;
    map->along[m] = 0.5 * (from + to);
    return has_place;
}

icc_status iccp_plmap_cut(iccp_plmap *map, uint32_t corner, bool *done)
{
    const uint32_t twin = map->corners.twin[corner];
    const uint32_t after = iccp_after(corner), before = iccp_before(corner);
    double point[2], image[2];
    middle_of(iccp_plmap_point(map, after), iccp_plmap_point(map, before), point);
    middle_of(iccp_plmap_image(map, after), iccp_plmap_image(map, before), image);
    *done = false;
    if (!iccp_plmap_may_cut(map, corner) || !can_cut(map, corner, point, image) ||
        (twin != ICCP_NO_NEIGHBOUR && !can_cut(map, twin, point, image)))
        return ICC_OK;
    /* Half as much again, so that n cuts that nobody expected cost O(n). */
    const size_t m = map->n_vertices, n_triangles = map->corners.n_triangles;
    if (m + 1 > map->vertex_room || n_triangles + 2 > map->triangle_room) {
        const icc_status status = iccp_plmap_expect_cuts(map, m / 2 + 1);
        if (status != ICC_OK)
            return status;
    }
    *done = place_on_edge(map, m, twin == ICCP_NO_NEIGHBOUR, map->corners.vertex[after],
                          map->corners.vertex[before]);
    if (!*done)
        return ICC_OK;
    ++map->n_vertices;
    memcpy(map->points + 2 * m, point, sizeof point);
    memcpy(map->images + 2 * m, image, sizeof image);
    iccp_cut_edge(&map->corners, corner, (uint32_t)m);
    return ICC_OK;
}

static bool faces_chord(const iccp_plmap *map, uint32_t corner)
{
    return map->corners.twin[corner] != ICCP_NO_NEIGHBOUR &&
           map->fixed[map->corners.vertex[iccp_after(corner)]] &&
           map->fixed[map->corners.vertex[iccp_before(corner)]] && !iccp_plmap_is_line(map, corner);
}

icc_status iccp_cut_chords(iccp_plmap *map)
{
    size_t n = 0;
    for (uint32_t c = 0; c < 3 * map->corners.n_triangles; ++c)
        n += faces_chord(map, c) && c < map->corners.twin[c];
    icc_status status = iccp_plmap_expect_cuts(map, n);
    for (uint32_t c = 0; status == ICC_OK && c < 3 * map->corners.n_triangles; ++c) {
        bool done;
        if (faces_chord(map, c))
            status = iccp_plmap_cut(map, c, &done);
    }
    return status;
}

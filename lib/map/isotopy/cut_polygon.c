/* Cuts a domain open to polygons. The inside of the domain is triangulated with walls, cuts and
 * diagonals between vertices. It is then parted along all walls and cuts. The result is one polygon
 * for each face, because the cuts in a face join its components to a tree. */
#include "map/isotopy/cut_polygon.h"

#include <string.h>

static const uint32_t NONE = ICCP_NO_NEIGHBOUR;

/* All points of one side: the domain's vertices, then the bends. */
static double *list_points(const iccp_domain_pair *domains, int side, const iccp_cuts *cuts,
                           const iccp_memory *memory)
{
    const size_t n_bends = cuts->first[cuts->n];
    double *points = iccp_alloc(memory, domains->n + n_bends, 2 * sizeof *points);
    if (points == NULL)
        return NULL;
    memcpy(points, domains->domain[side]->vertices, 2 * domains->n * sizeof *points);
    if (n_bends > 0)
        memcpy(points + 2 * domains->n, cuts->points[side], 2 * n_bends * sizeof *points);
    return points;
}

/* The walls of the domain, then the pieces of the cuts. */
static uint32_t *list_pairs(const iccp_domain_pair *domains, const iccp_cuts *cuts, size_t n_pairs,
                            const iccp_memory *memory)
{
    uint32_t *pairs = iccp_alloc(memory, n_pairs, 2 * sizeof *pairs), *pair = pairs;
    if (pairs == NULL)
        return NULL;
    memcpy(pairs, domains->pairs, 2 * domains->n_walls * sizeof *pairs);
    pair += 2 * domains->n_walls;
    for (size_t i = 0; i < cuts->n; ++i) {
        *pair++ = domains->node[cuts->ends[2 * i]];
        for (uint32_t bend = cuts->first[i]; bend < cuts->first[i + 1]; ++bend)
            for (int twice = 0; twice < 2; ++twice)
                *pair++ = (uint32_t)domains->n + bend;
        *pair++ = domains->node[cuts->ends[2 * i + 1]];
    }
    return pairs;
}

typedef struct round_trip {
    const iccp_corners *mesh; /* its vertices are the domain's nodes and the bends */
    const iccp_walls *walls;  /* those of the domain, then the cuts */
    size_t n_halves;          /* half-walls */
    uint32_t *facing;         /* of each half-wall: the corner on its left that faces it */
    uint32_t *number;         /* of each corner of the mesh: the polygon's corner there */
    uint32_t *edge;           /* of each corner of the mesh: the polygon's edge that it faces */
    uint32_t *polygon;        /* of each of the polygons' corners */
    uint32_t *place;          /* of each triangle: its place among those of the polygons */
    uint32_t *next;           /* of each polygon: the place of its next triangle */
} round_trip;

static uint32_t half_of(const round_trip *w, uint32_t corner)
{
    const uint32_t *v = w->mesh->vertex;
    return iccp_walls_find(w->walls, v[iccp_after(corner)], v[iccp_before(corner)]);
}

/* Finds the corners that face walls. Returns their number. */
static uint32_t face_walls(const round_trip *w)
{
    uint32_t n = 0;
    memset(w->facing, 0xff, w->n_halves * sizeof *w->facing);
    for (uint32_t c = 0; c < 3 * w->mesh->n_triangles; ++c) {
        const uint32_t half = half_of(w, c);
        if (half == NONE)
            continue;
        w->facing[half] = c;
        ++n;
    }
    return n;
}

/* Goes from the edge that a corner faces to the next edge of the polygon. */
static uint32_t next_edge(const round_trip *w, uint32_t facing)
{
    uint32_t other = iccp_after(facing);
    while (half_of(w, other) == NONE)
        other = iccp_after(w->mesh->twin[other]);
    return other;
}

/* Sets the polygon's corner for all corners of the mesh between the edge that a corner faces and
 * the edge before it. */
static void number_corners(const round_trip *w, uint32_t facing, uint32_t number)
{
    uint32_t at = iccp_after(facing);
    w->number[at] = number;
    while (half_of(w, iccp_after(at)) == NONE) {
        at = iccp_after(w->mesh->twin[iccp_after(at)]);
        w->number[at] = number;
    }
}

/* Walks once around a polygon. */
static void go_round(const round_trip *w, iccp_cut_polygons *p, uint32_t begin)
{
    uint32_t facing = begin;
    do {
        number_corners(w, facing, p->n);
        w->polygon[p->n] = (uint32_t)p->n_polygons;
        p->vertex[p->n] = w->mesh->vertex[iccp_after(facing)];
        w->edge[facing] = p->n++;
        facing = next_edge(w, facing);
    } while (facing != begin);
    p->first[++p->n_polygons] = p->n;
}

/* Walks around all polygons. A face where cuts join no tree has more corners than polygons with its
 * triangles would have: ICC_ERR_TOPOLOGY. */
static icc_status go_round_all(const round_trip *w, iccp_cut_polygons *p)
{
    memset(w->edge, 0xff, 3 * w->mesh->n_triangles * sizeof *w->edge);
    p->n = 0;
    p->first[0] = 0;
    for (size_t half = 0; half < w->n_halves; ++half)
        if (w->facing[half] != NONE && w->edge[w->facing[half]] == NONE)
            go_round(w, p, w->facing[half]);
    return p->n == w->mesh->n_triangles + 2 * p->n_polygons ? ICC_OK : ICC_ERR_TOPOLOGY;
}

/* Parts the triangles along the polygons' edges, and sorts them by polygon. Replaces their vertices
 * by corners of their polygon. */
static void part(const round_trip *w, iccp_cut_polygons *p, const double *points)
{
    for (size_t q = 0; q < p->n_polygons; ++q)
        w->next[q] = p->first[q] - 2 * (uint32_t)q;
    for (size_t t = 0; t < w->mesh->n_triangles; ++t)
        w->place[t] = w->next[w->polygon[w->number[3 * t]]]++;
    for (uint32_t c = 0; c < 3 * w->mesh->n_triangles; ++c) {
        const uint32_t twin = w->mesh->twin[c], q = w->polygon[w->number[c]];
        const uint32_t first = p->first[q], triangle = first - 2 * q;
        const size_t at = 3 * (size_t)w->place[c / 3] + c % 3;
        p->mesh.vertex[at] = w->number[c] - first;
        p->mesh.twin[at] =
            w->edge[c] == NONE ? 3 * (w->place[twin / 3] - triangle) + twin % 3 : NONE;
        if (w->edge[c] != NONE)
            p->partner[w->edge[c]] = twin != NONE ? w->edge[twin] : NONE;
    }
    for (size_t i = 0; i < p->n; ++i)
        memcpy(p->points + 2 * i, points + 2 * (size_t)p->vertex[i], 2 * sizeof *points);
}

static icc_status open_up(iccp_cut_polygons *p, const iccp_corners *mesh, const iccp_walls *walls,
                          size_t n_walls, const double *points)
{
    const iccp_memory *memory = &p->memory;
    const size_t n_corners = 3 * mesh->n_triangles;
    round_trip w = {.mesh = mesh, .walls = walls, .n_halves = 2 * n_walls};
    icc_status status = ICC_ERR_MEMORY;
    w.facing = iccp_alloc(memory, w.n_halves, sizeof *w.facing);
    const size_t n = w.facing != NULL ? face_walls(&w) : 0;
    w.number = iccp_alloc(memory, n_corners, sizeof *w.number);
    w.edge = iccp_alloc(memory, n_corners, sizeof *w.edge);
    w.polygon = iccp_alloc(memory, n, sizeof *w.polygon);
    w.place = iccp_alloc(memory, mesh->n_triangles, sizeof *w.place);
    w.next = iccp_alloc(memory, n, sizeof *w.next);
    p->first = iccp_alloc(memory, n + 1, sizeof *p->first);
    p->vertex = iccp_alloc(memory, n, sizeof *p->vertex);
    p->partner = iccp_alloc(memory, n, sizeof *p->partner);
    p->points = iccp_alloc(memory, n, 2 * sizeof *p->points);
    p->mesh.n_triangles = mesh->n_triangles;
    p->mesh.vertex = iccp_alloc(memory, n_corners, sizeof *p->mesh.vertex);
    p->mesh.twin = iccp_alloc(memory, n_corners, sizeof *p->mesh.twin);
    if (w.facing != NULL && w.number != NULL && w.edge != NULL && w.polygon != NULL &&
        w.place != NULL && w.next != NULL && p->first != NULL && p->vertex != NULL &&
        p->partner != NULL && p->points != NULL && p->mesh.vertex != NULL && p->mesh.twin != NULL)
        status = go_round_all(&w, p);
    if (status == ICC_OK)
        part(&w, p, points);
    iccp_free(memory, w.facing);
    iccp_free(memory, w.number);
    iccp_free(memory, w.edge);
    iccp_free(memory, w.polygon);
    iccp_free(memory, w.place);
    iccp_free(memory, w.next);
    return status;
}

icc_status iccp_cut_polygons_create(iccp_cut_polygons *polygons, const iccp_domain_pair *domains,
                                    int side, const iccp_cuts *cuts, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const size_t n_bends = cuts->first[cuts->n], n = domains->n + n_bends;
    const size_t n_walls = domains->n_walls + n_bends + cuts->n;
    double *points = list_points(domains, side, cuts, memory);
    uint32_t *pairs = list_pairs(domains, cuts, n_walls, memory);
    iccp_walls walls = {0};
    iccp_corners mesh = {0};
    *polygons = (iccp_cut_polygons){.memory = *memory};
    icc_status status = ICC_ERR_MEMORY;
    if (points != NULL && pairs != NULL)
        status = iccp_walls_create(&walls, n, n_walls, pairs, memory);
    if (status == ICC_OK)
        status = iccp_triangulate_inside(&mesh, domains, n, points, n_walls, pairs, env);
    if (status == ICC_OK)
        status = open_up(polygons, &mesh, &walls, n_walls, points);
    else if (status != ICC_ERR_MEMORY && status != ICC_ERR_CANCELLED)
        status = ICC_ERR_CERTIFICATE;
    iccp_free(memory, mesh.vertex);
    iccp_free(memory, mesh.twin);
    iccp_walls_free(&walls, memory);
    iccp_free(memory, pairs);
    iccp_free(memory, points);
    if (status != ICC_OK)
        iccp_cut_polygons_free(polygons);
    return status;
}

void iccp_cut_polygons_free(iccp_cut_polygons *p)
{
    const iccp_memory *memory = &p->memory;
    iccp_free(memory, p->first);
    iccp_free(memory, p->vertex);
    iccp_free(memory, p->partner);
    iccp_free(memory, p->points);
    iccp_free(memory, p->mesh.vertex);
    iccp_free(memory, p->mesh.twin);
    *p = (iccp_cut_polygons){.memory = p->memory};
}

bool iccp_cut_polygons_same(const iccp_cut_polygons *a, const iccp_cut_polygons *b)
{
    return a->n == b->n && a->n_polygons == b->n_polygons &&
           memcmp(a->first, b->first, (a->n_polygons + 1) * sizeof *a->first) == 0 &&
           memcmp(a->vertex, b->vertex, a->n * sizeof *a->vertex) == 0;
}

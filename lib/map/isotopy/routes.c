/* E. W. Dijkstra, A note on two problems in connexion with graphs, 1959, on the middles of the
 * edges of a triangulation. A path that is laid cuts the edges that it crosses and thereby becomes
 * edges itself: what is left to paths laid later is again triangles, and it stays connected as long
 * as paths do not close a ring. No point needs to be placed for that: only combinatorics count. */
#include "map/isotopy/routes.h"

#include "math/elementary.h"

#include <math.h>
#include <string.h>

static const uint32_t NONE = ICCP_NO_NEIGHBOUR;

/* ---- walls and sectors ---- */

/* What an edge that cannot be crossed is called at its end u; ICCP_WHOLE_SECTOR for others. */
static uint32_t name_of(const iccp_routes *r, uint32_t u, uint32_t x)
{
    const uint32_t n = (uint32_t)r->scene->n;
    if (x < n)
        return iccp_walls_have(&r->scene->walls, u, x) ? x : ICCP_WHOLE_SECTOR;
    const iccp_crossing *c = &r->crossing[x - n];
    const iccp_path_ends *path = &r->path[c->path];
    if (c->place == 0 && path->vertex[0] == u)
        return n + 2 * c->path;
    return c->place + 1 == path->n && path->vertex[1] == u ? n + 2 * c->path + 1
                                                           : ICCP_WHOLE_SECTOR;
}

/* Whether a wall or path runs along the edge between two vertices. */
static bool is_blocked(const iccp_routes *r, uint32_t a, uint32_t b)
{
    const uint32_t n = (uint32_t)r->scene->n;
    if (a < n)
        return name_of(r, a, b) != ICCP_WHOLE_SECTOR;
    if (b < n)
        return name_of(r, b, a) != ICCP_WHOLE_SECTOR;
    const iccp_crossing *c = &r->crossing[a - n], *d = &r->crossing[b - n];
    return c->path == d->path && (c->place + 1 == d->place || d->place + 1 == c->place);
}

static bool is_open(const iccp_routes *r, uint32_t corner)
{
    const uint32_t *v = r->mesh.vertex;
    return r->mesh.twin[corner] != NONE &&
           !is_blocked(r, v[iccp_after(corner)], v[iccp_before(corner)]);
}

/* The sector of a corner; *first becomes the sector's first corner, counter-clockwise, or the same
 * where the sector is whole. */
static uint32_t sector_of(const iccp_routes *r, uint32_t corner, uint32_t *first)
{
    const uint32_t u = r->mesh.vertex[corner];
    uint32_t at = corner;
    do {
        const uint32_t name = name_of(r, u, r->mesh.vertex[iccp_after(at)]);
        *first = at;
        if (name != ICCP_WHOLE_SECTOR)
            return name;
        at = iccp_before(r->mesh.twin[iccp_before(at)]);
    } while (at != corner);
    return ICCP_WHOLE_SECTOR;
}

/* The corners at a vertex, counter-clockwise: all of them, or those of one sector. NONE when there
 * is none, or none is left. */
static uint32_t next_at(const iccp_routes *r, uint32_t corner, uint32_t first, uint32_t sector)
{
    const uint32_t facing = iccp_after(corner), twin = r->mesh.twin[facing];
    if (twin == NONE || (sector != ICCP_ANY_SECTOR && !is_open(r, facing)))
        return NONE;
    const uint32_t next = iccp_after(twin);
    return next != first ? next : NONE;
}

static uint32_t first_at(const iccp_routes *r, uint32_t u, uint32_t sector)
{
    const uint32_t begin = r->corner[u];
    uint32_t first = begin, twin;
    while ((twin = r->mesh.twin[iccp_before(first)]) != NONE && iccp_before(twin) != begin)
        first = iccp_before(twin);
    if (twin != NONE)
        first = begin;
    if (sector == ICCP_ANY_SECTOR || sector == ICCP_WHOLE_SECTOR)
        return first;
    uint32_t at = first;
    while (at != NONE && name_of(r, u, r->mesh.vertex[iccp_after(at)]) != sector)
        at = next_at(r, at, first, ICCP_ANY_SECTOR);
    return at;
}

/* ---- searching ---- */

static double distance_between(const double *p, const double *q)
{
    return iccp_hypot(q[0] - p[0], q[1] - p[1]);
}

static const double *point_at(const iccp_routes *r, uint32_t corner)
{
    return r->points + 2 * (size_t)r->mesh.vertex[corner];
}

/* The middle of the edge that a corner faces. */
static void middle_of(const iccp_routes *r, uint32_t corner, double m[2])
{
    const double *a = point_at(r, iccp_after(corner)), *b = point_at(r, iccp_before(corner));
    m[0] = 0.5 * (a[0] + b[0]);
    m[1] = 0.5 * (a[1] + b[1]);
}

/* Offers a way to the middle of an edge, across which it goes on. */
static void offer(iccp_routes *r, uint32_t corner, uint32_t previous, const double from[2],
                  double distance, double most)
{
    double m[2];
    if (!is_open(r, corner))
        return;
    middle_of(r, corner, m);
    distance += distance_between(from, m);
    if (distance >= most || (r->stamp[corner] == r->search && distance >= r->distance[corner]))
        return;
    r->stamp[corner] = r->search;
    r->distance[corner] = distance;
    r->previous[corner] = previous;
    iccp_heap_put(&r->queue, corner, distance);
}

/* The straight way, where there is one. */
static void find_straight(const iccp_routes *r, uint32_t start, iccp_way *way)
{
    for (int k = 0; k < 2; ++k) {
        const uint32_t end = k == 0 ? iccp_after(start) : iccp_before(start);
        const uint32_t facing = k == 0 ? iccp_before(start) : iccp_after(start);
        if (r->mesh.vertex[end] != way->to || !r->is_goal[end] || !is_open(r, facing))
            continue;
        const double length = distance_between(point_at(r, start), point_at(r, end));
        if (length < way->length) {
            uint32_t first;
            way->length = length;
            way->is_straight = true;
            way->n = 1;
            way->corner[0] = facing;
            way->sector[0] = sector_of(r, start, &first);
            way->sector[1] = sector_of(r, end, &first);
        }
    }
}

static icc_status keep_way(const iccp_routes *r, uint32_t last, iccp_way *way)
{
    size_t n = 0;
    uint32_t first, begin = last;
    for (uint32_t c = last; c != NONE; c = r->previous[c], ++n)
        begin = c;
    if (n > way->room) {
        uint32_t *corner = iccp_grow(&r->memory, way->corner, 0, 2 * n, sizeof *corner);
        if (corner == NULL)
            return ICC_ERR_MEMORY;
        way->corner = corner;
        way->room = 2 * n;
    }
    way->n = n;
    way->is_straight = false;
    for (uint32_t c = last; c != NONE; c = r->previous[c])
        way->corner[--n] = c;
    way->sector[0] = sector_of(r, begin, &first);
    way->sector[1] = sector_of(r, r->mesh.twin[last], &first);
    return ICC_OK;
}

/* From the start's corners on, until nothing shorter can come. Returns the last corner of the
 * shortest way that crosses an edge; NONE if the straight one is as short. */
static uint32_t search(iccp_routes *r, iccp_way *way)
{
    uint32_t last = NONE;
    while (r->queue.n_entries > 0) {
        const uint32_t c = iccp_heap_pop(&r->queue), apex = r->mesh.twin[c];
        double m[2];
        if (r->distance[c] >= way->length)
            break;
        middle_of(r, c, m);
        if (r->is_goal[apex]) {
            const double length = r->distance[c] + distance_between(m, point_at(r, apex));
            if (length < way->length) {
                way->length = length;
                last = c;
            }
        }
        offer(r, iccp_after(apex), c, m, r->distance[c], way->length);
        offer(r, iccp_before(apex), c, m, r->distance[c], way->length);
    }
    iccp_heap_clear(&r->queue);
    return last;
}

static void mark_goals(iccp_routes *r, uint32_t to, uint32_t sector, uint8_t mark)
{
    const uint32_t first = first_at(r, to, sector);
    for (uint32_t at = first; at != NONE; at = next_at(r, at, first, sector))
        r->is_goal[at] = mark;
}

icc_status iccp_routes_find(iccp_routes *r, uint32_t from, uint32_t from_sector, uint32_t to,
                            uint32_t to_sector, double most, iccp_way *way)
{
    way->from = from;
    way->to = to;
    way->length = most;
    way->n = 0;
    if (way->room == 0) {
        way->corner = iccp_alloc(&r->memory, 1, sizeof *way->corner);
        if (way->corner == NULL)
            return ICC_ERR_MEMORY;
        way->room = 1;
    }
    ++r->search;
    mark_goals(r, to, to_sector, 1);
    const uint32_t first = first_at(r, from, from_sector);
    for (uint32_t at = first; at != NONE; at = next_at(r, at, first, from_sector)) {
        find_straight(r, at, way);
        offer(r, at, NONE, point_at(r, at), 0, way->length);
    }
    const uint32_t last = search(r, way);
    mark_goals(r, to, to_sector, 0);
    if (last == NONE && way->n == 0)
        way->length = HUGE_VAL;
    return last != NONE ? keep_way(r, last, way) : ICC_OK;
}

/* ---- laying ---- */

static icc_status enlarge_vertices(iccp_routes *r, size_t room)
{
    const iccp_memory *memory = &r->memory;
    const size_t n = r->n_vertices, n_bare = r->scene->n;
    if (!iccp_enlarge(memory, &r->points, n, room, 2 * sizeof *r->points) ||
        !iccp_enlarge(memory, &r->corner, n, room, sizeof *r->corner) ||
        !iccp_enlarge(memory, &r->crossing, n - n_bare, room - n_bare, sizeof *r->crossing))
        return ICC_ERR_MEMORY;
    r->vertex_room = room;
    return ICC_OK;
}

static icc_status enlarge_triangles(iccp_routes *r, size_t room)
{
    const iccp_memory *memory = &r->memory;
    const size_t n = 3 * r->mesh.n_triangles, m = 3 * room;
    if (!iccp_enlarge(memory, &r->mesh.vertex, n, m, sizeof *r->mesh.vertex) ||
        !iccp_enlarge(memory, &r->mesh.twin, n, m, sizeof *r->mesh.twin) ||
        !iccp_enlarge(memory, &r->distance, 0, m, sizeof *r->distance) ||
        !iccp_enlarge(memory, &r->previous, 0, m, sizeof *r->previous) ||
        !iccp_enlarge(memory, &r->stamp, 0, m, sizeof *r->stamp) ||
        !iccp_enlarge(memory, &r->is_goal, 0, m, sizeof *r->is_goal))
        return ICC_ERR_MEMORY;
    memset(r->stamp, 0, m * sizeof *r->stamp);
    memset(r->is_goal, 0, m);
    r->search = 0;
    iccp_heap_free(&r->queue, &r->memory);
    r->triangle_room = room;
    return iccp_heap_create(&r->queue, m, &r->memory) ? ICC_OK : ICC_ERR_MEMORY;
}

/* The smaller of the two corners that face an edge between vertices of the bare triangulation. */
static uint32_t bare_edge(const iccp_routes *r, uint32_t a, uint32_t b)
{
    const iccp_corners *bare = &r->scene->mesh[r->side];
    const uint32_t begin = r->bare_corner[a];
    uint32_t at = begin, facing, twin;
    while (bare->vertex[iccp_after(at)] != b && bare->vertex[iccp_before(at)] != b) {
        twin = bare->twin[iccp_after(at)];
        if (twin == NONE)
            break;
        at = iccp_after(twin);
        if (at == begin)
            break;
    }
    while (bare->vertex[iccp_after(at)] != b && bare->vertex[iccp_before(at)] != b)
        at = iccp_before(bare->twin[iccp_before(at)]);
    facing = bare->vertex[iccp_after(at)] == b ? iccp_before(at) : iccp_after(at);
    twin = bare->twin[facing];
    return twin < facing ? twin : facing;
}

static bool is_end_of(const iccp_routes *r, uint32_t v, uint32_t edge)
{
    const uint32_t *vertex = r->scene->mesh[r->side].vertex;
    return v == vertex[iccp_after(edge)] || v == vertex[iccp_before(edge)];
}

/* The edge of the bare triangulation of which a b is a piece, or NONE. */
static uint32_t whole_edge(const iccp_routes *r, uint32_t a, uint32_t b)
{
    const uint32_t n = (uint32_t)r->scene->n;
    if (a < n && b < n)
        return bare_edge(r, a, b);
    const uint32_t own = a >= n ? a : b, other = a >= n ? b : a, edge = r->crossing[own - n].edge;
    if (edge == NONE)
        return NONE;
    const bool is_piece =
        other >= n ? r->crossing[other - n].edge == edge : is_end_of(r, other, edge);
    return is_piece ? edge : NONE;
}

/* Enters a crossing of the edge between a, on the path's right, and b into the list of the whole
 * edge. */
static void enter_crossing(iccp_routes *r, uint32_t m, uint32_t a, uint32_t b)
{
    const uint32_t n = (uint32_t)r->scene->n, edge = whole_edge(r, a, b);
    iccp_crossing *c = &r->crossing[m - n];
    c->edge = edge;
    c->next = NONE;
    if (edge == NONE)
        return;
    const uint32_t begin = r->scene->mesh[r->side].vertex[iccp_after(edge)];
    const uint32_t after_a = a >= n ? r->crossing[a - n].next : NONE;
    c->is_forward = a == begin || (b != begin && a >= n && after_a == (b >= n ? b : NONE));
    const uint32_t before = c->is_forward ? a : b;
    uint32_t *link = before >= n ? &r->crossing[before - n].next : &r->first[edge];
    c->next = *link;
    *link = m;
}

/* Puts a vertex of a new path on the edge that a corner faces. */
static icc_status cut(iccp_routes *r, uint32_t corner, uint32_t place)
{
    icc_status status = ICC_OK;
    if (r->n_vertices == r->vertex_room)
        status = enlarge_vertices(r, 2 * r->vertex_room);
    if (status == ICC_OK && r->mesh.n_triangles + 2 > r->triangle_room)
        status = enlarge_triangles(r, 2 * r->triangle_room);
    if (status != ICC_OK)
        return status;
    const uint32_t m = (uint32_t)r->n_vertices++, twin = r->mesh.twin[corner];
    const uint32_t a = r->mesh.vertex[iccp_after(corner)], b = r->mesh.vertex[iccp_before(corner)];
    middle_of(r, corner, r->points + 2 * (size_t)m);
    r->crossing[m - r->scene->n] = (iccp_crossing){.path = (uint32_t)r->n_paths, .place = place};
    enter_crossing(r, m, a, b);
    const uint32_t fresh = 3 * (uint32_t)r->mesh.n_triangles;
    iccp_cut_edge(&r->mesh, corner, m);
    const uint32_t triangles[4] = {3 * (corner / 3), 3 * (twin / 3), fresh, fresh + 3};
    for (int t = 0; t < 4; ++t)
        for (uint32_t c = triangles[t]; c < triangles[t] + 3; ++c)
            r->corner[r->mesh.vertex[c]] = c;
    return ICC_OK;
}

/* After a cut, what lay behind it to one side is in a new triangle. */
icc_status iccp_routes_lay(iccp_routes *r, const iccp_way *way)
{
    icc_status status = ICC_OK;
    const iccp_path_ends path = {
        {way->from, way->to}, (uint32_t)r->n_vertices, (uint32_t)way->n, way->is_straight};
    uint32_t corner = way->corner[0];
    for (size_t k = 0; status == ICC_OK && k < way->n; ++k) {
        const uint32_t twin = r->mesh.twin[corner];
        status = cut(r, corner, (uint32_t)k);
        if (k + 1 < way->n)
            corner = way->corner[k + 1] == iccp_before(twin)
                         ? way->corner[k + 1]
                         : 3 * ((uint32_t)r->mesh.n_triangles - 1) + 1;
    }
    if (status == ICC_OK)
        r->path[r->n_paths++] = path;
    return status;
}

/* ---- all of it ---- */

void iccp_routes_reset(iccp_routes *r)
{
    const iccp_corners *bare = &r->scene->mesh[r->side];
    r->n_vertices = r->scene->n;
    r->n_paths = 0;
    r->mesh.n_triangles = bare->n_triangles;
    memcpy(r->mesh.vertex, bare->vertex, 3 * bare->n_triangles * sizeof *bare->vertex);
    memcpy(r->mesh.twin, bare->twin, 3 * bare->n_triangles * sizeof *bare->twin);
    memcpy(r->corner, r->bare_corner, r->n_vertices * sizeof *r->corner);
    memset(r->first, 0xff, 3 * bare->n_triangles * sizeof *r->first);
}

icc_status iccp_routes_create(iccp_routes *r, const iccp_scene *scene, int side,
                              const iccp_env *env)
{
    const iccp_corners *bare = &scene->mesh[side];
    const iccp_memory *memory = &env->memory;
    *r = (iccp_routes){.memory = env->memory, .scene = scene, .side = side, .n_vertices = scene->n};
    r->bare_corner = iccp_alloc(memory, scene->n, sizeof *r->bare_corner);
    r->first = iccp_alloc(memory, bare->n_triangles, 3 * sizeof *r->first);
    r->path = iccp_alloc(memory, scene->n_components, sizeof *r->path);
    icc_status status = r->bare_corner != NULL && r->first != NULL && r->path != NULL
                            ? enlarge_vertices(r, 2 * scene->n)
                            : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = enlarge_triangles(r, 2 * bare->n_triangles);
    if (status != ICC_OK) {
        iccp_routes_free(r);
        return status;
    }
    memcpy(r->points, scene->domain[side]->vertices, 2 * scene->n * sizeof *r->points);
    for (uint32_t c = 0; c < 3 * bare->n_triangles; ++c)
        r->bare_corner[bare->vertex[c]] = c;
    iccp_routes_reset(r);
    return ICC_OK;
}

void iccp_routes_free(iccp_routes *r)
{
    const iccp_memory *memory = &r->memory;
    iccp_free(memory, r->mesh.vertex);
    iccp_free(memory, r->mesh.twin);
    iccp_free(memory, r->points);
    iccp_free(memory, r->corner);
    iccp_free(memory, r->bare_corner);
    iccp_free(memory, r->crossing);
    iccp_free(memory, r->first);
    iccp_free(memory, r->path);
    iccp_heap_free(&r->queue, memory);
    iccp_free(memory, r->distance);
    iccp_free(memory, r->stamp);
    iccp_free(memory, r->previous);
    iccp_free(memory, r->is_goal);
    *r = (iccp_routes){.memory = r->memory};
}

void iccp_way_free(iccp_way *way, const iccp_memory *memory)
{
    iccp_free(memory, way->corner);
    *way = (iccp_way){0};
}

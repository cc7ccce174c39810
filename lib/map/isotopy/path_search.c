/* Finds shortest paths by way of the middles of the edges of a triangulation: E. W. Dijkstra, A
 * note on two problems in connexion with graphs, 1959. A laid path splits the edges that it crosses
 * and so becomes edges itself. The rest is again made of triangles for later paths. It stays
 * connected as long as the paths close no ring. Only combinatorics count, so no exact positions are
 * needed. */
#include "map/isotopy/path_search.h"

#include "math/elementary.h"

#include <math.h>
#include <string.h>

static const uint32_t NONE = ICCP_NO_NEIGHBOUR;

/* ---- walls and sectors ---- */

/* The name of the edge from u to x as a border of sectors at u; ICCP_WHOLE_SECTOR if paths may
 * cross it. */
static uint32_t name_of(const iccp_path_search *r, uint32_t u, uint32_t x)
{
    const uint32_t n = (uint32_t)r->domains->n;
    if (x < n)
        return iccp_walls_have(&r->domains->walls, u, x) ? x : ICCP_WHOLE_SECTOR;
    const iccp_crossing *c = &r->crossing[x - n];
    const iccp_path_ends *path = &r->path[c->path];
    if (c->place == 0 && path->vertex[0] == u)
        return n + 2 * c->path;
    return c->place + 1 == path->n && path->vertex[1] == u ? n + 2 * c->path + 1
                                                           : ICCP_WHOLE_SECTOR;
}

/* Returns true if a wall or a path runs along the edge between two vertices. */
static bool is_blocked(const iccp_path_search *r, uint32_t a, uint32_t b)
{
    const uint32_t n = (uint32_t)r->domains->n;
    if (a < n)
        return name_of(r, a, b) != ICCP_WHOLE_SECTOR;
    if (b < n)
        return name_of(r, b, a) != ICCP_WHOLE_SECTOR;
    const iccp_crossing *c = &r->crossing[a - n], *d = &r->crossing[b - n];
    return c->path == d->path && (c->place + 1 == d->place || d->place + 1 == c->place);
}

static bool is_open(const iccp_path_search *r, uint32_t corner)
{
    const uint32_t *v = r->mesh.vertex;
    return r->mesh.twin[corner] != NONE &&
           !is_blocked(r, v[iccp_after(corner)], v[iccp_before(corner)]);
}

/* Returns the sector of a corner. *first becomes the sector's first corner, counter-clockwise. */
static uint32_t sector_of(const iccp_path_search *r, uint32_t corner, uint32_t *first)
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

/* first_at() and next_at() list the corners at a vertex counter-clockwise, either all or those of
 * one sector. NONE ends the list. */
static void next_at(const iccp_path_search *r, iccp_turn *turn, uint32_t sector)
{
    if (sector != ICCP_ANY_SECTOR && !is_open(r, iccp_after(turn->corner)))
        turn->corner = NONE;
    else
        iccp_turn_next(turn, &r->fans, &r->mesh);
}

static iccp_turn first_at(const iccp_path_search *r, uint32_t u, uint32_t sector)
{
    iccp_turn turn = iccp_turn_begin(&r->fans, &r->mesh, u);
    if (sector == ICCP_ANY_SECTOR || sector == ICCP_WHOLE_SECTOR)
        return turn;
    while (turn.corner != NONE && name_of(r, u, r->mesh.vertex[iccp_after(turn.corner)]) != sector)
        next_at(r, &turn, ICCP_ANY_SECTOR);
    turn.first = turn.corner;
    return turn;
}

/* ---- searching ---- */

static double distance_between(const double *p, const double *q)
{
    return iccp_hypot(q[0] - p[0], q[1] - p[1]);
}

static const double *point_at(const iccp_path_search *r, uint32_t corner)
{
    return r->points + 2 * (size_t)r->mesh.vertex[corner];
}

/* The middle of the edge that a corner faces. */
static void middle_of(const iccp_path_search *r, uint32_t corner, double m[2])
{
    const double *a = point_at(r, iccp_after(corner)), *b = point_at(r, iccp_before(corner));
    m[0] = 0.5 * (a[0] + b[0]);
    m[1] = 0.5 * (a[1] + b[1]);
}

/* Offers a path to the middle of the edge that `corner` faces. The path goes on across that
 * edge. */
static void offer(iccp_path_search *r, uint32_t corner, uint32_t previous, const double from[2],
                  double distance, double most)
{
    double m[2];
    if (!is_open(r, corner))
        return;
    middle_of(r, corner, m);
    distance += distance_between(from, m);
    if (distance >= most || (r->stamp[corner] == r->current && distance >= r->distance[corner]))
        return;
    r->stamp[corner] = r->current;
    r->distance[corner] = distance;
    r->previous[corner] = previous;
    iccp_heap_put(&r->queue, corner, distance);
}

/* Finds the straight path along an edge, if there is one. */
static void find_straight(const iccp_path_search *r, uint32_t start, iccp_found_path *found)
{
    for (int k = 0; k < 2; ++k) {
        const uint32_t end = k == 0 ? iccp_after(start) : iccp_before(start);
        const uint32_t facing = k == 0 ? iccp_before(start) : iccp_after(start);
        if (r->mesh.vertex[end] != found->to || !r->is_goal[end] || !is_open(r, facing))
            continue;
        const double length = distance_between(point_at(r, start), point_at(r, end));
        if (length < found->length) {
            uint32_t first;
            found->length = length;
            found->is_straight = true;
            found->n = 1;
            found->corner[0] = facing;
            found->sector[0] = sector_of(r, start, &first);
            found->sector[1] = sector_of(r, end, &first);
        }
    }
}

static icc_status keep_path(const iccp_path_search *r, uint32_t last, iccp_found_path *found)
{
    size_t n = 0;
    uint32_t first, begin = last;
    for (uint32_t c = last; c != NONE; c = r->previous[c], ++n)
        begin = c;
    if (n > found->room) {
        uint32_t *corner = iccp_grow(&r->memory, found->corner, 0, 2 * n, sizeof *corner);
        if (corner == NULL)
            return ICC_ERR_MEMORY;
        found->corner = corner;
        found->room = 2 * n;
    }
    found->n = n;
    found->is_straight = false;
    for (uint32_t c = last; c != NONE; c = r->previous[c])
        found->corner[--n] = c;
    found->sector[0] = sector_of(r, begin, &first);
    found->sector[1] = sector_of(r, r->mesh.twin[last], &first);
    return ICC_OK;
}

/* Runs Dijkstra's algorithm from the start's corners until nothing shorter can follow. Returns the
 * last corner of the shortest path that crosses an edge. Returns NONE if the straight path is as
 * short. */
static uint32_t search(iccp_path_search *r, iccp_found_path *found)
{
    uint32_t last = NONE;
    while (r->queue.n_entries > 0) {
        const uint32_t c = iccp_heap_pop(&r->queue), apex = r->mesh.twin[c];
        double m[2];
        if (r->distance[c] >= found->length)
            break;
        middle_of(r, c, m);
        if (r->is_goal[apex]) {
            const double length = r->distance[c] + distance_between(m, point_at(r, apex));
            if (length < found->length) {
                found->length = length;
                last = c;
            }
        }
        offer(r, iccp_after(apex), c, m, r->distance[c], found->length);
        offer(r, iccp_before(apex), c, m, r->distance[c], found->length);
    }
    iccp_heap_clear(&r->queue);
    return last;
}

static void mark_goals(iccp_path_search *r, uint32_t to, uint32_t sector, uint8_t mark)
{
    iccp_turn turn = first_at(r, to, sector);
    for (; turn.corner != NONE; next_at(r, &turn, sector))
        r->is_goal[turn.corner] = mark;
}

icc_status iccp_path_search_find(iccp_path_search *r, uint32_t from, uint32_t from_sector,
                                 uint32_t to, uint32_t to_sector, double most,
                                 iccp_found_path *found)
{
    found->from = from;
    found->to = to;
    found->length = most;
    found->n = 0;
    if (found->room == 0) {
        found->corner = iccp_alloc(&r->memory, 1, sizeof *found->corner);
        if (found->corner == NULL)
            return ICC_ERR_MEMORY;
        found->room = 1;
    }
    ++r->current;
    mark_goals(r, to, to_sector, 1);
    iccp_turn turn = first_at(r, from, from_sector);
    for (; turn.corner != NONE; next_at(r, &turn, from_sector)) {
        find_straight(r, turn.corner, found);
        offer(r, turn.corner, NONE, point_at(r, turn.corner), 0, found->length);
    }
    const uint32_t last = search(r, found);
    mark_goals(r, to, to_sector, 0);
    if (last == NONE && found->n == 0)
        found->length = HUGE_VAL;
    return last != NONE ? keep_path(r, last, found) : ICC_OK;
}

/* ---- laying ---- */

static icc_status enlarge_vertices(iccp_path_search *r, size_t room)
{
    const iccp_memory *memory = &r->memory;
    const size_t n = r->n_vertices, n_bare = r->domains->n;
    if (!iccp_enlarge(memory, &r->points, n, room, 2 * sizeof *r->points) ||
        !iccp_enlarge(memory, &r->fans.corner, n, room, sizeof *r->fans.corner) ||
        !iccp_enlarge(memory, &r->crossing, n - n_bare, room - n_bare, sizeof *r->crossing))
        return ICC_ERR_MEMORY;
    r->vertex_room = room;
    return ICC_OK;
}

static icc_status enlarge_triangles(iccp_path_search *r, size_t room)
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
    r->current = 0;
    iccp_heap_free(&r->queue, &r->memory);
    r->triangle_room = room;
    return iccp_heap_create(&r->queue, m, &r->memory) ? ICC_OK : ICC_ERR_MEMORY;
}

static bool is_end_of(const iccp_path_search *r, uint32_t v, uint32_t edge)
{
    const uint32_t *vertex = r->domains->mesh[r->side].vertex;
    return v == vertex[iccp_after(edge)] || v == vertex[iccp_before(edge)];
}

/* Returns the edge of the bare triangulation that contains the edge from a to b, or NONE. */
static uint32_t whole_edge(const iccp_path_search *r, uint32_t a, uint32_t b)
{
    const uint32_t n = (uint32_t)r->domains->n;
    if (a < n && b < n)
        return iccp_fans_edge(&r->bare, &r->domains->mesh[r->side], a, b);
    const uint32_t own = a >= n ? a : b, other = a >= n ? b : a, edge = r->crossing[own - n].edge;
    if (edge == NONE)
        return NONE;
    const bool is_piece =
        other >= n ? r->crossing[other - n].edge == edge : is_end_of(r, other, edge);
    return is_piece ? edge : NONE;
}

/* Enters a crossing into the list of its whole edge. It lies on the edge between a and b, where a
 * is on the path's right. */
static void enter_crossing(iccp_path_search *r, uint32_t m, uint32_t a, uint32_t b)
{
    const uint32_t n = (uint32_t)r->domains->n, edge = whole_edge(r, a, b);
    iccp_crossing *c = &r->crossing[m - n];
    c->edge = edge;
    c->next = NONE;
    if (edge == NONE)
        return;
    const uint32_t begin = r->domains->mesh[r->side].vertex[iccp_after(edge)];
    const uint32_t after_a = a >= n ? r->crossing[a - n].next : NONE;
    c->is_forward = a == begin || (b != begin && a >= n && after_a == (b >= n ? b : NONE));
    const uint32_t before = c->is_forward ? a : b;
    uint32_t *link = before >= n ? &r->crossing[before - n].next : &r->first[edge];
    c->next = *link;
    *link = m;
}

/* Puts a vertex of a new path on the edge that a corner faces. */
static icc_status cut(iccp_path_search *r, uint32_t corner, uint32_t place)
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
    r->crossing[m - r->domains->n] = (iccp_crossing){.path = (uint32_t)r->n_paths, .place = place};
    enter_crossing(r, m, a, b);
    const uint32_t fresh = 3 * (uint32_t)r->mesh.n_triangles;
    iccp_cut_edge(&r->mesh, corner, m);
    const uint32_t triangles[4] = {3 * (corner / 3), 3 * (twin / 3), fresh, fresh + 3};
    for (int t = 0; t < 4; ++t)
        for (uint32_t c = triangles[t]; c < triangles[t] + 3; ++c)
            iccp_fans_note(&r->fans, &r->mesh, c);
    return ICC_OK;
}

/* Splitting an edge moves one of the two edges behind it to a new triangle, so the next corner is
 * looked up. */
icc_status iccp_path_search_lay(iccp_path_search *r, const iccp_found_path *found)
{
    icc_status status = ICC_OK;
    const iccp_path_ends path = {
        {found->from, found->to}, (uint32_t)r->n_vertices, (uint32_t)found->n, found->is_straight};
    uint32_t corner = found->corner[0];
    for (size_t k = 0; status == ICC_OK && k < found->n; ++k) {
        const uint32_t twin = r->mesh.twin[corner];
        status = cut(r, corner, (uint32_t)k);
        if (k + 1 < found->n)
            corner = found->corner[k + 1] == iccp_before(twin)
                         ? found->corner[k + 1]
                         : 3 * ((uint32_t)r->mesh.n_triangles - 1) + 1;
    }
    if (status == ICC_OK)
        r->path[r->n_paths++] = path;
    return status;
}

/* ---- all of it ---- */

void iccp_path_search_reset(iccp_path_search *r)
{
    const iccp_corners *bare = &r->domains->mesh[r->side];
    r->n_vertices = r->domains->n;
    r->n_paths = 0;
    r->mesh.n_triangles = bare->n_triangles;
    memcpy(r->mesh.vertex, bare->vertex, 3 * bare->n_triangles * sizeof *bare->vertex);
    memcpy(r->mesh.twin, bare->twin, 3 * bare->n_triangles * sizeof *bare->twin);
    memcpy(r->fans.corner, r->bare.corner, r->n_vertices * sizeof *r->fans.corner);
    memcpy(r->fans.start, r->bare.start, r->bare.first[r->bare.n] * sizeof *r->fans.start);
    memset(r->first, 0xff, 3 * bare->n_triangles * sizeof *r->first);
}

icc_status iccp_path_search_create(iccp_path_search *r, const iccp_domain_pair *domains, int side,
                                   const iccp_env *env)
{
    const iccp_corners *bare = &domains->mesh[side];
    const iccp_memory *memory = &env->memory;
    *r = (iccp_path_search){
        .memory = env->memory, .domains = domains, .side = side, .n_vertices = domains->n};
    icc_status status = iccp_fans_create(&r->bare, bare, domains->n, memory);
    if (status == ICC_OK)
        status = iccp_fans_create(&r->fans, bare, domains->n, memory);
    r->first = iccp_alloc(memory, bare->n_triangles, 3 * sizeof *r->first);
    r->path = iccp_alloc(memory, domains->n_components, sizeof *r->path);
    if (r->first == NULL || r->path == NULL)
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = enlarge_vertices(r, 2 * domains->n);
    if (status == ICC_OK)
        status = enlarge_triangles(r, 2 * bare->n_triangles);
    if (status != ICC_OK) {
        iccp_path_search_free(r);
        return status;
    }
    memcpy(r->points, domains->domain[side]->vertices, 2 * domains->n * sizeof *r->points);
    iccp_path_search_reset(r);
    return ICC_OK;
}

void iccp_path_search_free(iccp_path_search *r)
{
    const iccp_memory *memory = &r->memory;
    iccp_free(memory, r->mesh.vertex);
    iccp_free(memory, r->mesh.twin);
    iccp_free(memory, r->points);
    iccp_fans_free(&r->fans, memory);
    iccp_fans_free(&r->bare, memory);
    iccp_free(memory, r->crossing);
    iccp_free(memory, r->first);
    iccp_free(memory, r->path);
    iccp_heap_free(&r->queue, memory);
    iccp_free(memory, r->distance);
    iccp_free(memory, r->stamp);
    iccp_free(memory, r->previous);
    iccp_free(memory, r->is_goal);
    *r = (iccp_path_search){.memory = r->memory};
}

void iccp_found_path_free(iccp_found_path *found, const iccp_memory *memory)
{
    iccp_free(memory, found->corner);
    *found = (iccp_found_path){0};
}

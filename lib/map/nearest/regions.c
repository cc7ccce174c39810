/* Finds the regions of a folded map that must be mapped anew.
 *
 * A region whose rim has a simple image can be replaced without touching the rest. So each region
 * grows until that holds. One that is sound stays as it is until another one runs into it. */
#include "map/nearest/regions.h"

#include "base/minmax.h"
#include "base/sort.h"
#include "mesh/edge_set.h"

#include <string.h>

/* A triangle counts as folded, too, if its image's share of its own area is at most this part of
 * the median. A rim through such triangles would leave no room beside it. */
static const double NEARLY_FOLDED = 0.02;

/* FIRST_RINGS: rings around folded triangles at first. A region that is not sound grows by one
 * ring, and by one more after every MORE_AFTER rounds. TYPICAL_ROUNDS: half of the progress. */
enum { FIRST_RINGS = 2, MORE_AFTER = 3, TYPICAL_ROUNDS = 4 };

/* NONE: the triangle is in no region. NEW: it is in a region that has no number yet. */
static const uint32_t NONE = UINT32_MAX, NEW = UINT32_MAX - 1;

/* ---- set-up ---- */

static icc_status reserve(iccp_regions *r, const iccp_plmap *map, const iccp_memory *memory)
{
    const size_t n = map->n_vertices, n_triangles = map->corners.n_triangles;
    *r = (iccp_regions){.memory = *memory,
                        .map = map,
                        .item = iccp_alloc(memory, n_triangles, sizeof *r->item),
                        .order = iccp_alloc(memory, n_triangles, sizeof *r->order),
                        .region = iccp_alloc(memory, n_triangles, sizeof *r->region),
                        .chosen = iccp_alloc(memory, n_triangles, sizeof *r->chosen),
                        .settled = iccp_alloc_zero(memory, n_triangles, sizeof *r->settled),
                        .begin = iccp_alloc_zero(memory, n + 1, sizeof *r->begin),
                        .star = iccp_alloc(memory, 3 * n_triangles, sizeof *r->star),
                        .link = iccp_alloc(memory, n, sizeof *r->link),
                        .seen = iccp_alloc_zero(memory, n, sizeof *r->seen),
                        .visited = iccp_alloc_zero(memory, n_triangles, sizeof *r->visited)};
    if (r->item == NULL || r->order == NULL || r->region == NULL || r->chosen == NULL ||
        r->settled == NULL || r->begin == NULL || r->star == NULL || r->link == NULL ||
        r->seen == NULL || r->visited == NULL)
        return ICC_ERR_MEMORY;
    memset(r->region, 0xff, n_triangles * sizeof *r->region);
    memset(r->link, 0xff, n * sizeof *r->link);
    return ICC_OK;
}

void iccp_regions_free(iccp_regions *regions)
{
    iccp_regions *r = regions;
    const iccp_memory memory = r->memory;
    iccp_free(&memory, r->item);
    iccp_free(&memory, r->order);
    iccp_free(&memory, r->region);
    iccp_free(&memory, r->chosen);
    iccp_free(&memory, r->settled);
    iccp_free(&memory, r->begin);
    iccp_free(&memory, r->star);
    iccp_free(&memory, r->link);
    iccp_free(&memory, r->seen);
    iccp_free(&memory, r->visited);
}

/* Twice the area of a triangle whose corners have these coordinates. */
static double twice_area(const iccp_plmap *map, const double *at, size_t triangle)
{
    const uint32_t *v = map->corners.vertex + 3 * triangle;
    const double *a = at + 2 * (size_t)v[0], *b = at + 2 * (size_t)v[1], *c = at + 2 * (size_t)v[2];
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static void choose(iccp_regions *r, uint32_t triangle)
{
    r->chosen[r->n_chosen++] = triangle;
    r->region[triangle] = NEW;
}

static icc_status choose_folded(iccp_regions *r)
{
    const size_t n = r->map->corners.n_triangles;
    double *ratio = iccp_alloc(&r->memory, n, 2 * sizeof *ratio);
    if (ratio == NULL)
        return ICC_ERR_MEMORY;
    for (size_t t = 0; t < n; ++t)
        ratio[t] = ratio[n + t] =
            twice_area(r->map, r->map->images, t) / twice_area(r->map, r->map->points, t);
    const double least = NEARLY_FOLDED * iccp_select(ratio + n, n, n / 2);
    for (uint32_t t = 0; t < n; ++t)
        if (!(ratio[t] > least) || !iccp_plmap_positive_image(r->map, t))
            choose(r, t);
    iccp_free(&r->memory, ratio);
    return ICC_OK;
}

/* ---- growth ---- */

/* Chooses the triangles within some rings around the vertices in `front`, which has room for all
 * vertices. Those of other regions are passed over, but belong to the rings. */
static void choose_rings(iccp_regions *r, uint32_t *front, size_t n_front, size_t rings)
{
    size_t done = 0;
    for (size_t k = 0; k < rings; ++k)
        for (const size_t end = n_front; done < end; ++done)
            for (uint32_t s = r->begin[front[done]]; s < r->begin[front[done] + 1]; ++s) {
                const uint32_t t = r->star[s];
                if (r->visited[t] == r->search)
                    continue;
                r->visited[t] = r->search;
                if (r->region[t] == NONE)
                    choose(r, t);
                for (size_t i = 0; i < 3; ++i) {
                    const uint32_t v = r->map->corners.vertex[3 * (size_t)t + i];
                    if (r->seen[v] != r->search)
                        front[n_front++] = v;
                    r->seen[v] = r->search;
                }
            }
}

/* Adds rings around some triangles. */
static icc_status grow(iccp_regions *r, size_t n, const uint32_t *triangles, size_t rings)
{
    uint32_t *front = iccp_alloc(&r->memory, r->map->n_vertices, sizeof *front);
    size_t n_front = 0;
    if (front == NULL)
        return ICC_ERR_MEMORY;
    ++r->search;
    for (size_t i = 0; i < n; ++i) {
        r->visited[triangles[i]] = r->search;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t v = r->map->corners.vertex[3 * (size_t)triangles[i] + k];
            if (r->seen[v] != r->search)
                front[n_front++] = v;
            r->seen[v] = r->search;
        }
    }
    choose_rings(r, front, n_front, rings);
    iccp_free(&r->memory, front);
    return ICC_OK;
}

icc_status iccp_regions_create(iccp_regions *regions, const iccp_plmap *map, const iccp_env *env)
{
    icc_status status = reserve(regions, map, &env->memory);
    if (status == ICC_OK) {
        iccp_list_groups(regions->star, regions->begin, map->n_vertices, map->corners.vertex,
                         map->corners.n_triangles, 3);
        status = choose_folded(regions);
    }
    return status == ICC_OK ? grow(regions, regions->n_chosen, regions->chosen, FIRST_RINGS)
                            : status;
}

/* ---- which triangles are in which region ---- */

static uint32_t neighbour(const iccp_regions *r, size_t corner)
{
    const uint32_t twin = r->map->corners.twin[corner];
    return twin == ICCP_NO_NEIGHBOUR ? NONE : twin / 3;
}

/* Regions are listed by the triangle that was chosen first. If a region has the same first triangle
 * and the same size as before, it has not changed. */
static void tell_apart(iccp_regions *r)
{
    size_t n = 0, done = 0;
    r->n = 0;
    for (size_t i = 0; i < r->n_chosen; ++i)
        r->region[r->chosen[i]] = NEW;
    for (size_t i = 0; i < r->n_chosen; ++i) {
        const uint32_t first = r->chosen[i], own = (uint32_t)r->n;
        if (r->region[first] != NEW)
            continue;
        const size_t begin = n;
        r->region[first] = own;
        r->order[n++] = first;
        for (; done < n; ++done)
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t t = neighbour(r, 3 * (size_t)r->order[done] + k);
                if (t == NONE || r->region[t] != NEW)
                    continue;
                r->region[t] = own;
                r->order[n++] = t;
            }
        r->item[r->n++] = (iccp_region){first, begin, n - begin};
    }
}

/* ---- rims ---- */

static bool is_border(const iccp_regions *r, size_t region, size_t corner)
{
    const uint32_t beyond = neighbour(r, corner);
    return beyond == NONE || r->region[beyond] != region;
}

static size_t corner_at(const iccp_regions *r, const iccp_region *own, size_t i)
{
    return 3 * (size_t)r->order[own->begin + i / 3] + i % 3;
}

static uint32_t from(const iccp_regions *r, size_t corner)
{
    return r->map->corners.vertex[iccp_after((uint32_t)corner)];
}

static bool is_before(const double *p, const double *q)
{
    return p[0] < q[0] || (!(q[0] < p[0]) && p[1] < q[1]);
}

/* Links the vertices of the rim. Returns their number, or 0 if one of them is met twice. *first is
 * the lowest one, which is on the outer ring. */
static size_t link_rim(iccp_regions *r, size_t region, uint32_t *first)
{
    const iccp_region *own = &r->item[region];
    size_t n = 0;
    *first = NONE;
    for (size_t i = 0; i < 3 * own->n; ++i) {
        const size_t c = corner_at(r, own, i);
        if (!is_border(r, region, c))
            continue;
        const uint32_t v = from(r, c);
        if (r->link[v] != NONE)
            return 0;
        r->link[v] = (uint32_t)c;
        ++n;
        if (*first == NONE ||
            is_before(r->map->points + 2 * (size_t)v, r->map->points + 2 * (size_t)*first))
            *first = v;
    }
    return n;
}

static void unlink_rim(iccp_regions *r, size_t region)
{
    const iccp_region *own = &r->item[region];
    for (size_t i = 0; i < 3 * own->n; ++i)
        r->link[r->map->corners.vertex[corner_at(r, own, i)]] = NONE;
}

/* Lists one ring and unlinks it. */
static void take_ring(iccp_rim *rim, iccp_regions *r, uint32_t first)
{
    const size_t begin = rim->n_points;
    size_t n = begin;
    for (uint32_t v = first; r->link[v] != NONE;) {
        const uint32_t c = r->link[v];
        r->link[v] = NONE;
        r->seen[v] = r->search;
        rim->vertex[n] = v;
        rim->corner[n++] = c;
        v = r->map->corners.vertex[iccp_before(c)];
    }
    rim->ring[rim->n_rings++] = (iccp_chain){(uint32_t)begin, (uint32_t)(n - begin), true};
    rim->vertex[n] = first;
    rim->corner[n] = rim->corner[begin];
    rim->n_points = n + 1;
}

/* Lists the vertices inside: held ones, then others. */
static void list_inside(iccp_rim *rim, iccp_regions *r, const iccp_region *own)
{
    for (int turn = 0; turn < 2; ++turn) {
        for (size_t i = 0; i < 3 * own->n; ++i) {
            const uint32_t v = r->map->corners.vertex[corner_at(r, own, i)];
            if (r->seen[v] == r->search || (turn == 0 && r->map->fixed[v] == ICCP_FREE))
                continue;
            r->seen[v] = r->search;
            rim->vertex[rim->n_points + rim->n_inside++] = v;
        }
        if (turn == 0)
            rim->n_held = rim->n_inside;
    }
}

static icc_status copy_coordinates(iccp_rim *rim, const iccp_plmap *map, const iccp_memory *memory)
{
    const size_t n = rim->n_points + rim->n_held;
    rim->points = iccp_alloc(memory, n, 2 * sizeof *rim->points);
    rim->images = iccp_alloc(memory, n, 2 * sizeof *rim->images);
    if (rim->points == NULL || rim->images == NULL)
        return ICC_ERR_MEMORY;
    for (size_t k = 0; k < n; ++k) {
        memcpy(rim->points + 2 * k, map->points + 2 * (size_t)rim->vertex[k], 2 * sizeof(double));
        memcpy(rim->images + 2 * k, map->images + 2 * (size_t)rim->vertex[k], 2 * sizeof(double));
    }
    for (size_t k = 0; k < rim->n_held; ++k)
        rim->ring[rim->n_rings + k] = (iccp_chain){(uint32_t)(rim->n_points + k), 1, false};
    return ICC_OK;
}

/* Numbers the vertices of the rim and the held ones by their places, or forgets the numbers. */
static void number_places(iccp_regions *r, const iccp_rim *rim, bool forget)
{
    for (size_t i = 0; i < rim->n_rings + rim->n_held; ++i)
        for (uint32_t k = rim->ring[i].first; k < rim->ring[i].first + rim->ring[i].n; ++k)
            r->link[rim->vertex[k]] = forget ? NONE : k;
}

/* Lists the held edges inside a region. */
static icc_status list_edges(iccp_rim *rim, iccp_regions *r, size_t region,
                             const iccp_memory *memory)
{
    const iccp_region *own = &r->item[region];
    if (r->map->held == NULL)
        return ICC_OK;
    rim->edges = iccp_alloc(memory, own->n, 3 * sizeof *rim->edges);
    if (rim->edges == NULL)
        return ICC_ERR_MEMORY;
    number_places(r, rim, false);
    for (size_t i = 0; i < 3 * own->n; ++i) {
        const uint32_t c = (uint32_t)corner_at(r, own, i), a = from(r, c),
                       b = r->map->corners.vertex[iccp_before(c)];
        if (is_border(r, region, c) || r->map->corners.twin[c] < c || r->link[a] == NONE ||
            r->link[b] == NONE || !iccp_edge_set_has(r->map->held, a, b))
            continue;
        rim->edges[2 * rim->n_edges] = r->link[a];
        rim->edges[2 * rim->n_edges++ + 1] = r->link[b];
    }
    number_places(r, rim, true);
    return ICC_OK;
}

/* Lists the rim of a region. It has no rings if the rim meets itself in a vertex. */
icc_status iccp_rim_create(iccp_rim *rim, iccp_regions *regions, size_t region,
                           const iccp_memory *memory)
{
    iccp_regions *r = regions;
    const iccp_region *own = &r->item[region];
    uint32_t first;
    const size_t n = link_rim(r, region, &first);
    *rim = (iccp_rim){0};
    if (n == 0) {
        unlink_rim(r, region);
        return ICC_OK;
    }
    /* A triangle brings at most one vertex that is not on the rim, besides the first two. */
    const size_t room = n + n / 3 + own->n + 2;
    rim->ring = iccp_alloc(memory, n / 3 + own->n + 2, sizeof *rim->ring);
    rim->vertex = iccp_alloc(memory, room, sizeof *rim->vertex);
    rim->corner = iccp_alloc(memory, n + n / 3, sizeof *rim->corner);
    if (rim->ring == NULL || rim->vertex == NULL || rim->corner == NULL) {
        unlink_rim(r, region);
        return ICC_ERR_MEMORY;
    }
    ++r->search;
    take_ring(rim, r, first);
    for (size_t i = 0; i < 3 * own->n; ++i) {
        const uint32_t v = r->map->corners.vertex[corner_at(r, own, i)];
        if (r->link[v] != NONE)
            take_ring(rim, r, v);
    }
    list_inside(rim, r, own);
    const icc_status status = copy_coordinates(rim, r->map, memory);
    return status == ICC_OK ? list_edges(rim, r, region, memory) : status;
}

void iccp_rim_free(iccp_rim *rim, const iccp_memory *memory)
{
    iccp_free(memory, rim->ring);
    iccp_free(memory, rim->vertex);
    iccp_free(memory, rim->corner);
    iccp_free(memory, rim->points);
    iccp_free(memory, rim->images);
    iccp_free(memory, rim->edges);
}

/* ---- rounds ---- */

/* Whether the images of the rim and of the held vertices lie as they must. */
static icc_status test(bool *is_sound, const iccp_rim *rim, const iccp_env *env)
{
    const iccp_chains chains = {rim->n_points + rim->n_held, rim->images,
                                rim->n_rings + rim->n_held, rim->ring};
    iccp_chain_place *place = iccp_alloc(&env->memory, chains.n, sizeof *place);
    iccp_defect found = {0};
    *is_sound = false;
    if (place == NULL)
        return ICC_ERR_MEMORY;
    const icc_status status = iccp_sweep_chains(&found, place, &chains, env);
    if (status == ICC_OK && found.kind == 0) {
        *is_sound = place[0].orientation > 0 && place[0].around == ICCP_NO_CHAIN;
        for (size_t k = 1; k < chains.n; ++k)
            *is_sound &= place[k].around == 0 && (k >= rim->n_rings || place[k].orientation < 0);
    }
    iccp_free(&env->memory, place);
    return status;
}

/* Chooses the triangles that a ring shuts off from the outer ring. Returns false if there are none,
 * because the ring goes around a hole of the mesh. */
static bool fill_ring(iccp_regions *r, const iccp_rim *rim, const iccp_chain *ring)
{
    const size_t begin = r->n_chosen;
    for (uint32_t k = ring->first; k < ring->first + ring->n; ++k) {
        const uint32_t t = neighbour(r, rim->corner[k]);
        if (t != NONE && r->region[t] == NONE)
            choose(r, t);
    }
    for (size_t done = begin; done < r->n_chosen; ++done)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t t = neighbour(r, 3 * (size_t)r->chosen[done] + k);
            if (t != NONE && r->region[t] == NONE)
                choose(r, t);
        }
    return r->n_chosen > begin;
}

/* Looks at a region. *changed becomes true if it grows or is filled. */
static icc_status look_at(iccp_regions *r, size_t k, size_t rings, bool *changed,
                          const iccp_env *env)
{
    const iccp_region *own = &r->item[k];
    iccp_rim rim;
    bool is_filled = false, is_sound = false;
    icc_status status = iccp_rim_create(&rim, r, k, &env->memory);
    for (size_t i = 1; status == ICC_OK && i < rim.n_rings; ++i)
        is_filled |= fill_ring(r, &rim, &rim.ring[i]);
    if (status == ICC_OK && !is_filled && rim.n_rings > 0)
        status = test(&is_sound, &rim, env);
    iccp_rim_free(&rim, &env->memory);
    *changed |= !is_sound;
    if (status != ICC_OK || is_filled)
        return status;
    if (is_sound)
        r->settled[own->first] = (uint32_t)own->n;
    else if (own->n == r->map->corners.n_triangles)
        r->is_stuck = true;
    else
        status = grow(r, own->n, r->order + own->begin, rings);
    return status;
}

icc_status iccp_regions_settle(iccp_regions *regions, const iccp_env *env)
{
    iccp_regions *r = regions;
    icc_status status = ICC_OK;
    bool changed = true;
    for (size_t round = 1; status == ICC_OK && changed && !r->is_stuck; ++round) {
        const iccp_env part = iccp_round(env, round - 1, TYPICAL_ROUNDS);
        status = iccp_progress(&part, "repair", 0);
        tell_apart(r);
        changed = false;
        for (size_t k = 0; status == ICC_OK && k < r->n; ++k)
            if (r->settled[r->item[k].first] != r->item[k].n)
                status = look_at(r, k, 1 + round / MORE_AFTER, &changed, &part);
    }
    return status;
}

void iccp_regions_take_all(iccp_regions *regions)
{
    iccp_regions *r = regions;
    r->is_stuck = false;
    r->n_chosen = 0;
    for (uint32_t t = 0; t < r->map->corners.n_triangles; ++t) {
        r->settled[t] = 0;
        choose(r, t);
    }
}

icc_status iccp_regions_widen(iccp_regions *regions, size_t region)
{
    iccp_regions *r = regions;
    const iccp_region *own = &r->item[region];
    r->settled[own->first] = 0;
    if (own->n == r->map->corners.n_triangles) {
        r->is_stuck = true;
        return ICC_OK;
    }
    return grow(r, own->n, r->order + own->begin, 1);
}

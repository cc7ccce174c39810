/* Every triangle positive before and after, a disc by Euler's formula, and both boundaries simple:
 * then the map of the closed polygons is a homeomorphism (docs/theory.md, the mesh map). */
#include "map/plmap_certificate.h"

#include "base/error.h"
#include "base/threads.h"
#include "domain/polygon_check.h"
#include "domain/sweep.h"

#include <stdatomic.h>
#include <string.h>

/* Triangles that a thread looks at at once. */
enum { GRAIN = 512 };

/* ---- outlines ---- */

/* The vertex after each one of the boundary, UINT32_MAX elsewhere. False when a vertex is followed
 * by two. */
static bool link_boundary(const iccp_corners *corners, size_t n_vertices, uint32_t *next)
{
    bool is_clear = true;
    memset(next, 0xff, n_vertices * sizeof *next);
    for (uint32_t c = 0; c < 3 * corners->n_triangles; ++c)
        if (corners->twin[c] == ICCP_NO_NEIGHBOUR) {
            const uint32_t from = corners->vertex[iccp_after(c)];
            is_clear &= next[from] == UINT32_MAX;
            next[from] = corners->vertex[iccp_before(c)];
        }
    return is_clear;
}

/* Takes the ring through a vertex out of `next` and lists it; 0 when it does not close. */
static size_t take_ring(uint32_t *next, uint32_t first, uint32_t *ring)
{
    size_t n = 0;
    uint32_t v = first;
    while (next[v] != UINT32_MAX) {
        const uint32_t after = next[v];
        next[v] = UINT32_MAX;
        ring[n++] = v;
        v = after;
    }
    return v == first ? n : 0;
}

/* The boundary's vertices ring by ring. */
typedef struct outlines {
    size_t n;
    iccp_chain *ring;        /* room for n_vertices / 3 + 1 */
    uint32_t *vertex;        /* of all rings, each with its first vertex once more */
    double *points;          /* and their places, on either side; `room` on each */
    iccp_chain_place *place; /* as many as rings, on either side */
    size_t room, ring_room;
    const double *all[2]; /* the places of all vertices */
} outlines;

/* False when the half-edges without twins do not form rings. */
static bool list_rings(outlines *o, const iccp_plmap *map, uint32_t *next)
{
    uint32_t n = 0;
    if (!link_boundary(&map->corners, map->n_vertices, next))
        return false;
    for (uint32_t v = 0; v < map->n_vertices; ++v) {
        if (next[v] == UINT32_MAX)
            continue;
        const size_t n_own = take_ring(next, v, o->vertex + n);
        if (n_own < 3)
            return false;
        o->ring[o->n++] = (iccp_chain){n, (uint32_t)n_own, true};
        n += (uint32_t)n_own;
        o->vertex[n++] = v;
    }
    return o->n > 0;
}

/* ICC_ERR_BOUNDARY unless the rings are simple, apart from each other, and one, with the inside on
 * its left, is round the others, which have it on their left, too. */
static icc_status check_rings(void *argument, size_t side, const iccp_env *env, icc_error *err)
{
    const outlines *o = argument;
    iccp_chain_place *place = o->place + side * o->ring_room;
    double *own = o->points + 2 * side * o->room;
    const double *points = o->all[side];
    (void)err;
    const iccp_chain *last = &o->ring[o->n - 1];
    const size_t n = last->first + last->n + 1;
    iccp_defect found;
    size_t n_outer = 0;
    if (o->n == 1)
        return iccp_polygon_check_points(last->n, points, o->vertex, &iccp_frame_identity, env,
                                         NULL);
    for (size_t k = 0; k < n; ++k)
        memcpy(own + 2 * k, points + 2 * (size_t)o->vertex[k], 2 * sizeof *points);
    const iccp_chains chains = {n, own, o->n, o->ring};
    icc_status status = iccp_sweep_chains(&found, place, &chains, env);
    if (status == ICC_OK && found.kind != 0)
        status = ICC_ERR_BOUNDARY;
    for (size_t k = 0; status == ICC_OK && k < o->n; ++k) {
        const bool is_outer = place[k].around == ICCP_NO_CHAIN;
        n_outer += is_outer;
        if (place[k].orientation != (is_outer ? 1 : -1) ||
            (!is_outer && place[place[k].around].around != ICCP_NO_CHAIN))
            status = ICC_ERR_BOUNDARY;
    }
    return status == ICC_OK && n_outer != 1 ? ICC_ERR_BOUNDARY : status;
}

static icc_status check_outlines(const iccp_plmap *map, size_t *n_rings, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const size_t n = map->n_vertices;
    uint32_t *next = iccp_alloc(memory, n, sizeof *next);
    outlines o = {.room = n + n / 3 + 1, .ring_room = n / 3 + 1, .all = {map->points, map->images}};
    o.ring = iccp_alloc(memory, o.ring_room, sizeof *o.ring);
    o.place = iccp_alloc(memory, o.ring_room, 2 * sizeof *o.place);
    o.vertex = iccp_alloc(memory, o.room, sizeof *o.vertex);
    o.points = iccp_alloc(memory, o.room, 4 * sizeof *o.points);
    icc_status status = ICC_ERR_MEMORY;
    if (next != NULL && o.place != NULL && o.ring != NULL && o.vertex != NULL && o.points != NULL)
        status = list_rings(&o, map, next) ? ICC_OK : ICC_ERR_BOUNDARY;
    if (status == ICC_OK)
        status = iccp_side_by_side(env, 2, check_rings, &o, NULL);
    *n_rings = o.n;
    iccp_free(memory, next);
    iccp_free(memory, o.place);
    iccp_free(memory, o.ring);
    iccp_free(memory, o.vertex);
    iccp_free(memory, o.points);
    return status;
}

/* ---- triangles ---- */

/* What is good is counted, so that what was not looked at counts as a fault. */
typedef struct count {
    const iccp_plmap *map;
    atomic_size_t n_good, n_open;
} count;

/* Triangles that are positive before and after, their edges that have one side or two that agree,
 * and those with one. */
static icc_status count_some(void *argument, size_t begin, size_t end)
{
    count *all = argument;
    const iccp_plmap *map = all->map;
    size_t n_good = 0, n_open = 0;
    for (uint32_t t = (uint32_t)begin; t < end; ++t)
        n_good += iccp_plmap_positive_point(map, t) && iccp_plmap_positive_image(map, t);
    for (uint32_t c = 3 * (uint32_t)begin; c < 3 * end; ++c) {
        const uint32_t twin = map->corners.twin[c];
        n_open += twin == ICCP_NO_NEIGHBOUR;
        n_good += twin == ICCP_NO_NEIGHBOUR ||
                  (map->corners.twin[twin] == c &&
                   map->corners.vertex[iccp_after(twin)] == map->corners.vertex[iccp_before(c)] &&
                   map->corners.vertex[iccp_before(twin)] == map->corners.vertex[iccp_after(c)]);
    }
    atomic_fetch_add(&all->n_good, n_good);
    atomic_fetch_add(&all->n_open, n_open);
    return ICC_OK;
}

icc_status iccp_plmap_certify(const iccp_plmap *map, const iccp_env *env, icc_error *err)
{
    const size_t n_triangles = map->corners.n_triangles;
    iccp_env quiet = *env;
    count all = {.map = map};
    quiet.progress = NULL;
    (void)iccp_for_chunks(&quiet, "check", n_triangles, GRAIN, count_some, &all);
    const size_t n_faults = 4 * n_triangles - atomic_load(&all.n_good);
    const size_t n_open = atomic_load(&all.n_open);
    if (n_faults > 0)
        return iccp_fail(err, ICC_ERR_CERTIFICATE, "the mesh map cannot be certified: %zu faults",
                         n_faults);
    size_t n_rings = 0;
    const icc_status status = check_outlines(map, &n_rings, env);
    if (status == ICC_ERR_BOUNDARY)
        return iccp_fail(err, ICC_ERR_CERTIFICATE,
                         "the boundary of the mesh or of its image is not simple");
    /* One piece with n_rings - 1 holes. */
    if (status == ICC_OK && 2 * map->n_vertices + 2 * n_rings != n_triangles + n_open + 4)
        return iccp_fail(err, ICC_ERR_CERTIFICATE,
                         "the mesh map cannot be certified: its mesh is "
                         "not in one piece");
    return status;
}

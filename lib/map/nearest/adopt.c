/* Moves new vertices of a region's map onto vertices that the region had. */
#include "map/nearest/adopt.h"

#include "map/compatible/triangle_quality.h"
#include "math/predicates.h"

#include <string.h>

/* A move makes no triangle of the source flatter than this, unless one is at least as flat. See
 * iccp_roundness(). */
static const double LEAST_ROUNDNESS = 0.05;

static const uint32_t NONE = UINT32_MAX;

typedef struct adoption {
    iccp_plmap *map;
    const iccp_lost *lost;
    uint32_t *corner; /* of each vertex: a corner at it */
    uint8_t *is_used; /* of each lost vertex */
} adoption;

/* The least roundness before the map of the triangles around a vertex if it is at a point; 0 if one
 * of them is not positive. */
static double roundness_at(const adoption *a, uint32_t v, const double *point)
{
    const iccp_corners *c = &a->map->corners;
    const uint32_t first = a->corner[v];
    double least = HUGE_VAL;
    uint32_t at = first;
    do {
        const double *p = iccp_plmap_point(a->map, iccp_after(at)),
                     *q = iccp_plmap_point(a->map, iccp_before(at));
        if (iccp_orient2d(point, p, q) <= 0)
            return 0;
        least = iccp_min(least, iccp_roundness(point, p, q));
        at = iccp_after(c->twin[iccp_after(at)]);
    } while (at != first);
    return least;
}

/* Whether a vertex can move to a point of the source. */
static bool can_move(const adoption *a, uint32_t v, const double *point)
{
    const double now = roundness_at(a, v, a->map->points + 2 * (size_t)v);
    const double then = roundness_at(a, v, point);
    return then > 0 && then >= iccp_min(now, LEAST_ROUNDNESS);
}

static bool is_free(const adoption *a, uint32_t given)
{
    const uint32_t place = a->lost->place[given];
    return place < a->lost->n && a->lost->inside[place] == given && !a->is_used[place];
}

/* Finds the nearest free vertex of the old triangle around vertex v to which v can move, or
 * NONE. */
static uint32_t find_place(const adoption *a, uint32_t v)
{
    const iccp_finder *given = a->lost->given;
    const double *own = a->map->points + 2 * (size_t)v;
    uint32_t best = NONE;
    double least = HUGE_VAL;
    iccp_found found;
    if (iccp_finder_find(given, own, &found) != ICC_OK)
        return NONE;
    for (size_t k = 0; k < 3; ++k) {
        const uint32_t other = given->triangles[3 * (size_t)found.triangle + k];
        const double *point = given->points + 2 * (size_t)other;
        const double distance = iccp_vec_distance2(2, own, point);
        if (distance < least && is_free(a, other) && can_move(a, v, point)) {
            best = other;
            least = distance;
        }
    }
    return best;
}

icc_status iccp_adopt_vertices(iccp_plmap *map, uint32_t *number, const iccp_lost *lost,
                               const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    adoption a = {map, lost, iccp_alloc(memory, map->n_vertices, sizeof *a.corner),
                  iccp_alloc_zero(memory, lost->n, 1)};
    const bool is_there = a.corner != NULL && a.is_used != NULL;
    for (uint32_t c = 0; is_there && c < 3 * map->corners.n_triangles; ++c)
        a.corner[map->corners.vertex[c]] = c;
    for (uint32_t v = 0; is_there && v < map->n_vertices; ++v) {
        const bool is_new = number[v] == NONE && map->fixed[v] == ICCP_FREE;
        const uint32_t place = is_new ? find_place(&a, v) : NONE;
        if (place == NONE)
            continue;
        number[v] = place;
        a.is_used[lost->place[place]] = 1;
        memcpy(map->points + 2 * (size_t)v, lost->given->points + 2 * (size_t)place,
               2 * sizeof(double));
    }
    iccp_free(memory, a.corner);
    iccp_free(memory, a.is_used);
    return is_there ? ICC_OK : ICC_ERR_MEMORY;
}

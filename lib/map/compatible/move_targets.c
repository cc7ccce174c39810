/* Moves the fixed vertices of a plane map to another target by continuation. Where the way is
 * blocked, the mesh changes near triangles that are tense.
 *
 * Triangles with far more energy than others are about to lock: the vertices that they hold cannot
 * move on, however much room there is around them. So their edges are cut, which gives the map more
 * freedom. Edges flip where that lowers the energy, and nearby points and images move by turns. In
 * a mesh with many triangles, vertices that matter little merge. */
#include "map/compatible/move_targets.h"

#include "map/compatible/coarsen.h"
#include "map/compatible/flips.h"
#include "map/compatible/moving_part.h"
#include "map/energy/continuation.h"
#include "map/energy/descent.h"
#include "map/energy/dirichlet.h"
#include "map/energy/newton.h"

#include <string.h>

/* A triangle is tense if its energy density (4 for an isometry) is at least TENSE and TENSE_TO_MEAN
 * times the mean. It is extreme if its density is EXTREME times that. Where points have gone around
 * one another, many triangles stay tense. So tense triangles alone are no reason to change the
 * mesh. */
static const double TENSE = 100, TENSE_TO_MEAN = 3, EXTREME = 40;

/* Room for so many motions is enough. With 2, energies grow a hundredfold before the mesh changes.
 * With 10, it changes in nearly every frame (tests/bench/bench_drag.c). */
static const double ENOUGH_ROOM = 5;

/* Edges shorter than this share of the longest allowed are not cut. Around a point, energy grows
 * without bound as triangles shrink. */
static const double SHORTEST = 0.3;

/* Vertices farther than so many triangles from tense ones stay where they are. */
enum { RINGS = 2 };

/* Vertices merge if the energy nearby rises by at most this share. In a crowded mesh it may rise
 * more. */
static const double RISE = 0.06;

/* Steps on each side of the map. */
static const iccp_descent RELAXATION = {0, 1, 1e-2, 0, false};

static double density_of(const iccp_simplicial_map *map, size_t triangle)
{
    const double *image[3];
    double element[ICCP_ELEMENT(2)];
    iccp_simplicial_images(2, map, triangle, image);
    iccp_simplicial_element(map, triangle, element);
    return iccp_dirichlet_energy2(element, image) / element[0];
}

/* Returns the corner that faces the longest edge of a triangle. */
static uint32_t longest_of(const iccp_plmap *map, uint32_t triangle, double *length2)
{
    const uint32_t *v = map->corners.vertex;
    uint32_t best = 3 * triangle;
    *length2 = -1;
    for (uint32_t c = 3 * triangle; c < 3 * triangle + 3; ++c) {
        const double own = iccp_plmap_length2(map, v[iccp_after(c)], v[iccp_before(c)]);
        if (own > *length2) {
            *length2 = own;
            best = c;
        }
    }
    return best;
}

/* Whether any triangle is extreme, among those long enough to be cut. */
static bool any_is_extreme(const iccp_plmap *map, double tense, double shortest)
{
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
    for (uint32_t t = 0; t < map->corners.n_triangles; ++t) {
        double length2;
        if (!(density_of(&simplicial, t) > EXTREME * tense))
            continue;
        (void)longest_of(map, t, &length2);
        if (length2 > shortest * shortest)
            return true;
    }
    return false;
}

static icc_status cut_tense(iccp_plmap *map, double tense, double shortest)
{
    const size_t n = map->corners.n_triangles;
    icc_status status = ICC_OK;
    for (uint32_t t = 0; status == ICC_OK && t < n; ++t) {
        const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
        bool done;
        double length2;
        if (!(density_of(&simplicial, t) > tense))
            continue;
        const uint32_t corner = longest_of(map, t, &length2);
        if (length2 > shortest * shortest)
            status = iccp_plmap_cut(map, corner, &done);
    }
    return status;
}

/* Marks the vertices that stay: fixed ones, and those far from tense triangles. While it runs,
 * marks count the triangles to the nearest tense one. */
static void mark_still(const iccp_plmap *map, double tense, uint8_t *still)
{
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
    const uint32_t *v = map->corners.vertex;
    const size_t n = map->corners.n_triangles;
    memset(still, RINGS + 1, map->n_vertices);
    for (size_t t = 0; t < n; ++t)
        if (density_of(&simplicial, t) > 0.5 * tense)
            still[v[3 * t]] = still[v[3 * t + 1]] = still[v[3 * t + 2]] = 0;
    for (uint8_t ring = 0; ring < RINGS; ++ring)
        for (size_t c = 0; c < 3 * n; ++c)
            for (size_t k = 0; k < 3 && still[v[c]] == ring; ++k) {
                uint8_t *other = &still[v[c - c % 3 + k]];
                if (*other > ring)
                    *other = (uint8_t)(ring + (v[c - c % 3 + k] != v[c]));
            }
    for (size_t i = 0; i < map->n_vertices; ++i)
        still[i] = map->fixed[i] != ICCP_FREE || still[i] > RINGS;
}

/* Moves the points of unmarked vertices, then their images. Both have the same unknowns on the same
 * mesh, so one plan serves both. */
static icc_status relax(iccp_plmap *map, double tense, iccp_work *work, const iccp_env *env)
{
    uint8_t *still = iccp_alloc(&env->memory, map->n_vertices, 1);
    iccp_newton_plan *plan = NULL;
    icc_status status = still != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        mark_still(map, tense, still);
    for (int side = 0; status == ICC_OK && side < 2; ++side) {
        iccp_plmap inverse = *map;
        if (side == 0)
            iccp_plmap_swap(&inverse);
        iccp_simplicial_map simplicial = iccp_plmap_simplicial(&inverse);
        simplicial.fixed = still;
        if (plan == NULL)
            status = iccp_newton_plan_create(&plan, &simplicial, env);
        simplicial.plan = plan;
        if (status == ICC_OK)
            status = iccp_take_steps(&simplicial, &RELAXATION, work, NULL, env);
    }
    iccp_newton_plan_release(plan);
    iccp_free(&env->memory, still);
    return status;
}

/* How crowded a mesh is: the square of its triangles over limits->most_triangles, at least 1. In a
 * crowded mesh only tenser triangles are cut, and merging may cost more. */
static double crowding(const iccp_plmap *map, const iccp_mesh_limits *limits)
{
    const double n = (double)(map->corners.n_triangles + limits->n_elsewhere);
    const double times = n / (double)limits->most_triangles;
    return iccp_max(1, times * times);
}

icc_status iccp_improve_moving(iccp_plmap *map, const iccp_mesh_limits *limits, double room,
                               iccp_work *work, const iccp_env *env)
{
    const double tense = iccp_max(TENSE, TENSE_TO_MEAN * iccp_plmap_energy(map));
    const double shortest = SHORTEST * limits->longest_edge;
    size_t n_flips, n_gone;
    if (room > ENOUGH_ROOM && !any_is_extreme(map, tense, shortest))
        return ICC_OK;
    map->plan = NULL;
    icc_status status = cut_tense(map, tense * crowding(map, limits), shortest);
    if (status == ICC_OK)
        status = iccp_flip_edges(map, &n_flips, env);
    const double crowded = crowding(map, limits);
    if (status == ICC_OK && crowded > 1)
        status = iccp_coarsen_within(map, RISE * crowded, limits->longest_edge, &n_gone, env);
    return status == ICC_OK ? relax(map, tense, work, env) : status;
}

/* ---- moving ---- */

/* The way counts as blocked if a part goes less than this share of it. */
static const double BLOCKED = 0.35;

typedef struct tended {
    iccp_plmap *map;
    const icc_domain *old_target; /* or NULL */
    const iccp_mesh_limits *limits;
} tended;

void iccp_target_place(const iccp_plmap *map, const icc_domain *target, size_t vertex,
                       double place[2])
{
    const double bary[2] = {1 - map->along[vertex], map->along[vertex]};
    iccp_domain_facet_point(target, map->facet[vertex], bary, place);
}

static iccp_simplicial_map see(const void *map)
{
    const tended *t = map;
    return iccp_plmap_simplicial(t->map);
}

static void place(const void *map, const icc_domain *target, size_t point, double *place)
{
    const tended *t = map;
    if (t->old_target == NULL || !iccp_stays(t->map, point, t->old_target, target))
        iccp_target_place(t->map, target, point, place);
}

static icc_status mend(void *map, iccp_work *work, const iccp_env *env)
{
    const tended *t = map;
    return iccp_improve_moving(t->map, t->limits, 0, work, env);
}

icc_status iccp_move_targets(iccp_plmap *map, const icc_domain *old_target,
                             const icc_domain *target, const iccp_mesh_limits *limits,
                             size_t patience, iccp_work *work, bool *reached, double *room,
                             const iccp_env *env)
{
    static const iccp_continuation PLANE = {see, place, BLOCKED, mend};
    tended t = {map, old_target, limits};
    return iccp_continue(&PLANE, &t, target, patience, work, reached, room, env);
}

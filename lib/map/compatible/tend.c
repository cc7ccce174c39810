/* Triangles that carry far more energy than others are about to lock: what they hold between them
 * cannot move on, however much room there is round about. So edges are cut there, which gives the
 * map more freedom; edges flip where that lowers the energy; and near by, points and images move by
 * turns. Where a mesh has many triangles, vertices merge that matter little. */
#include "map/compatible/tend.h"

#include "map/compatible/coarsen.h"
#include "map/compatible/descent.h"
#include "map/compatible/flips.h"
#include "map/energy/dirichlet.h"
#include "map/energy/newton.h"

#include <string.h>

/* A triangle is tense from so much energy over its area on, of which an isometry has 4, or from so
 * many times the mean; and all too tense from some times that on. Where points have gone round one
 * another many triangles are tense for good: that alone is no reason to change the mesh. */
static const double TENSE = 100, TENSE_TO_MEAN = 3, ALL_TOO = 40;

/* Room for so many motions is enough. With 2 energies grow a hundredfold before the mesh is tended,
 * with 10 it changes in nearly every frame (tests/bench/bench_drag.c). */
static const double ENOUGH_ROOM = 5;

/* No edge is cut that is shorter than this share of the longest: round a point, energy grows
 * without end as triangles shrink. */
static const double SHORTEST = 0.3;

/* What is not so many triangles away from tense ones stays where it is. */
enum { RINGS = 2 };

/* Vertices merge where the energy near by rises by no more than this share, and more where the mesh
 * is crowded. */
static const double RISE = 0.06;

/* On each side. */
static const iccp_descent RELAXATION = {0, 1, 1e-2, 0, false};

static double density_of(const iccp_simplicial_map *map, size_t triangle)
{
    const double *image[3];
    double element[ICCP_ELEMENT(2)];
    iccp_simplicial_images(2, map, triangle, image);
    iccp_simplicial_element(map, triangle, element);
    return iccp_dirichlet_energy2(element, image) / element[0];
}

/* The corner that faces the longest edge. */
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

/* Whether a triangle that may be cut is all too tense. */
static bool any_all_too_tense(const iccp_plmap *map, double tense, double shortest)
{
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
    for (uint32_t t = 0; t < map->corners.n_triangles; ++t) {
        double length2;
        if (!(density_of(&simplicial, t) > ALL_TOO * tense))
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

/* Marks what is to stay: all that is fixed or far from tense triangles. Until the end, marks count
 * triangles to the next tense one. */
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

/* The points of what is not still, then the images: the same unknowns on the same mesh, so one plan
 * serves both. */
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
            status = iccp_improve_images(&simplicial, &RELAXATION, work, NULL, env);
    }
    iccp_newton_plan_release(plan);
    iccp_free(&env->memory, still);
    return status;
}

/* How crowded a mesh is: the square of how many times too many triangles there are, at least 1.
 * What is cut must be the tenser for it, and merging may cost the more. */
static double crowding(const iccp_plmap *map, const iccp_grain *grain)
{
    const double times = (double)map->corners.n_triangles / (double)grain->many;
    return iccp_max(1, times * times);
}

icc_status iccp_tend(iccp_plmap *map, const iccp_grain *grain, double room, iccp_work *work,
                     const iccp_env *env)
{
    const double tense = iccp_max(TENSE, TENSE_TO_MEAN * iccp_plmap_energy(map));
    const double shortest = SHORTEST * grain->longest;
    size_t n_flips, n_gone;
    if (room > ENOUGH_ROOM && !any_all_too_tense(map, tense, shortest))
        return ICC_OK;
    map->plan = NULL;
    icc_status status = cut_tense(map, tense * crowding(map, grain), shortest);
    if (status == ICC_OK)
        status = iccp_flip_edges(map, &n_flips, env);
    const double crowded = crowding(map, grain);
    if (status == ICC_OK && crowded > 1)
        status = iccp_coarsen_within(map, RISE * crowded, grain->longest, &n_gone, env);
    return status == ICC_OK ? relax(map, tense, work, env) : status;
}

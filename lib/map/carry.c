/* A predictor and a corrector, as in E. L. Allgower, K. Georg, Introduction to numerical
 * continuation methods, 1990: what is free answers the motion by the energy's own model, and both
 * go together as far as no triangle flips. Where nothing is in the way, so does the step to rest.
 * Without the predictor handles run into their own triangles, which then have hardly any room left.
 *
 * Where the way is blocked all the same, the mesh is in the way, not the map: a mesh that fits what
 * has been reached lets it go on. */
#include "map/carry.h"

#include "base/minmax.h"
#include "map/descent.h"
#include "map/newton.h"

#include <math.h>
#include <string.h>

/* Of the way to the first flip. */
static const double SHARE_OF_FLIP = 0.7;

/* Parts that get less far than this are blocked. */
static const double BLOCKED = 0.35;

enum { MOST_HALVINGS = 30 };

/* After each part. */
static const iccp_descent CORRECTION = {0, 2, 1e-2, 0, false};

typedef struct carry {
    iccp_plmap *map;
    const icc_domain *target;
    double *motion, *rest, *images; /* 2 n_vertices each */
    size_t room;
} carry;

void iccp_carry_place(const iccp_plmap *map, const icc_domain *target, size_t vertex,
                      double place[2])
{
    const double bary[2] = {1 - map->along[vertex], map->along[vertex]};
    iccp_domain_facet_point(target, map->facet[vertex], bary, place);
}

static icc_status make_room(carry *c, const iccp_env *env)
{
    const size_t n = c->map->n_vertices;
    if (n <= c->room)
        return ICC_OK;
    iccp_free(&env->memory, c->motion);
    iccp_free(&env->memory, c->rest);
    iccp_free(&env->memory, c->images);
    c->room = n + n / 2;
    c->motion = iccp_alloc(&env->memory, c->room, 2 * sizeof *c->motion);
    c->rest = iccp_alloc(&env->memory, c->room, 2 * sizeof *c->rest);
    c->images = iccp_alloc(&env->memory, c->room, 2 * sizeof *c->images);
    return c->motion != NULL && c->rest != NULL && c->images != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

/* What is left to go for fixed vertices; 0 for others. Returns whether anything is. */
static bool find_motion(carry *c)
{
    bool is_left = false;
    for (size_t v = 0; v < c->map->n_vertices; ++v) {
        double place[2] = {c->map->images[2 * v], c->map->images[2 * v + 1]};
        if (c->map->fixed[v] != ICCP_FREE)
            iccp_carry_place(c->map, c->target, v, place);
        for (size_t d = 0; d < 2; ++d) {
            c->motion[2 * v + d] = place[d] - c->map->images[2 * v + d];
            is_left |= place[d] < c->map->images[2 * v + d] || place[d] > c->map->images[2 * v + d];
        }
    }
    return is_left;
}

static bool all_positive(const iccp_plmap *map)
{
    for (uint32_t t = 0; t < map->corners.n_triangles; ++t)
        if (!iccp_plmap_positive_image(map, t))
            return false;
    return true;
}

/* Goes a share of the motion from `images`; all of it ends exactly where it should. */
static void go(carry *c, double share)
{
    iccp_plmap *map = c->map;
    for (size_t i = 0; i < 2 * map->n_vertices; ++i)
        map->images[i] = c->images[i] + share * c->motion[i];
    for (size_t v = 0; share >= 1 && v < map->n_vertices; ++v)
        if (map->fixed[v] != ICCP_FREE)
            iccp_carry_place(map, c->target, v, map->images + 2 * v);
}

/* As far along the motion as nothing flips, but at most `length`. */
static double go_along(carry *c, double length)
{
    for (int k = 0; k < MOST_HALVINGS; ++k, length *= 0.5) {
        go(c, length);
        if (all_positive(c->map))
            return length;
    }
    go(c, 0);
    return 0;
}

/* One part: to the end and to rest, where nothing is in the way of that; else as far as nothing
 * flips. *limit: where something would. */
static icc_status advance(carry *c, double *share, double *limit, const iccp_env *env)
{
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(c->map);
    const size_t n = 2 * c->map->n_vertices;
    iccp_newton newton;
    *share = *limit = 0;
    icc_status status = iccp_newton_create(&newton, &simplicial, NULL, env);
    if (status != ICC_OK)
        return status;
    status = iccp_newton_answer(&newton, c->motion, c->rest, env);
    iccp_newton_free(&newton);
    if (status != ICC_OK)
        return status == ICC_ERR_SOLVER ? ICC_OK : status;
    memcpy(c->images, c->map->images, n * sizeof *c->images);
    for (size_t i = 0; i < n; ++i)
        c->rest[i] += c->motion[i];
    *limit = iccp_newton_limit(&simplicial, c->rest);
    if (SHARE_OF_FLIP * *limit >= 1) {
        double *const motion = c->motion;
        c->motion = c->rest;
        c->rest = motion;
    } else {
        *limit = iccp_newton_limit(&simplicial, c->motion);
    }
    *share = go_along(c, iccp_min(1, SHARE_OF_FLIP * *limit));
    return ICC_OK;
}

static icc_status correct(iccp_plmap *map, iccp_work *work, const iccp_env *env)
{
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
    iccp_improvement ignored = {0};
    return iccp_improve_images(&simplicial, &CORRECTION, work, &ignored, env);
}

icc_status iccp_carry(iccp_plmap *map, const icc_domain *target, const iccp_grain *grain,
                      size_t patience, iccp_work *work, bool *reached, double *room,
                      const iccp_env *env)
{
    carry c = {.map = map, .target = target};
    size_t n_blocked = 0;
    icc_status status = make_room(&c, env);
    *reached = status == ICC_OK && !find_motion(&c);
    *room = HUGE_VAL;
    while (status == ICC_OK && !*reached && n_blocked <= patience &&
           iccp_work_take(work, 2 * map->corners.n_triangles)) {
        double share;
        status = advance(&c, &share, room, env);
        *reached = share >= 1;
        n_blocked = share < BLOCKED ? n_blocked + 1 : 0;
        if (status != ICC_OK || *reached || n_blocked > patience)
            break;
        status = n_blocked > 0 ? iccp_tend(map, grain, 0, work, env) : correct(map, work, env);
        if (status == ICC_OK)
            status = make_room(&c, env);
        if (status == ICC_OK)
            *reached = !find_motion(&c);
    }
    iccp_free(&env->memory, c.motion);
    iccp_free(&env->memory, c.rest);
    iccp_free(&env->memory, c.images);
    return status;
}

/* A predictor and a corrector, as in E. L. Allgower, K. Georg, Introduction to numerical
 * continuation methods, 1990: what is free answers the motion by the energy's own model, and both
 * go together as far as no triangle flips. Where nothing is in the way, so does the step to rest.
 * Without the predictor handles run into their own triangles, which then have hardly any room left.
 *
 * Where the way is blocked all the same, the mesh is in the way, not the map: a mesh that fits what
 * has been reached lets it go on. */
#include "map/compatible/carry.h"

#include "base/minmax.h"
#include "map/compatible/descent.h"
#include "map/energy/newton.h"

#include <math.h>
#include <string.h>

/* Of the way to the first flip. */
static const double SHARE_OF_FLIP = 0.7;

/* Parts that get less far than this are blocked in the plane. */
static const double BLOCKED = 0.35;

enum { MOST_HALVINGS = 30 };

/* After each part. */
static const iccp_descent CORRECTION = {0, 2, 1e-2, 0, false};

typedef struct carry {
    const iccp_carriage *as;
    void *map;
    const icc_domain *target;
    double *motion, *rest, *images; /* dim for each point; `rest` in the plane only */
    size_t room;
} carry;

static icc_status make_room(carry *c, const iccp_env *env)
{
    const iccp_simplicial_map map = c->as->see(c->map);
    const size_t n = map.n_points, size = map.dim * sizeof(double);
    if (n <= c->room)
        return ICC_OK;
    iccp_free(&env->memory, c->motion);
    iccp_free(&env->memory, c->rest);
    iccp_free(&env->memory, c->images);
    c->room = n + n / 2;
    c->motion = iccp_alloc(&env->memory, c->room, size);
    c->rest = map.dim == 2 ? iccp_alloc(&env->memory, c->room, size) : NULL;
    c->images = iccp_alloc(&env->memory, c->room, size);
    return c->motion != NULL && c->images != NULL && (map.dim == 3 || c->rest != NULL)
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

/* What is left to go for fixed points; 0 for others. Returns whether anything is. */
static bool find_motion(carry *c)
{
    const iccp_simplicial_map map = c->as->see(c->map);
    bool is_left = false;
    for (uint32_t v = 0; v < map.n_points; ++v) {
        const double *image = map.images + map.dim * v;
        double place[3];
        memcpy(place, image, map.dim * sizeof *place);
        if (iccp_simplicial_is_fixed(&map, v))
            c->as->place(c->map, c->target, v, place);
        for (size_t d = 0; d < map.dim; ++d) {
            c->motion[map.dim * v + d] = place[d] - image[d];
            is_left |= place[d] < image[d] || place[d] > image[d];
        }
    }
    return is_left;
}

static bool all_positive(const iccp_simplicial_map *map)
{
    for (size_t s = 0; s < map->n_simplices; ++s)
        if (!iccp_simplicial_is_positive(map, s))
            return false;
    return true;
}

/* Goes a share of the motion from `images`; all of it ends exactly where it should. */
static void go(carry *c, const iccp_simplicial_map *map, double share)
{
    for (size_t i = 0; i < map->dim * map->n_points; ++i)
        map->images[i] = c->images[i] + share * c->motion[i];
    if (map->dim == 3)
        iccp_simplicial_round(3 * map->n_points, map->images);
    for (uint32_t v = 0; share >= 1 && v < map->n_points; ++v)
        if (iccp_simplicial_is_fixed(map, v))
            c->as->place(c->map, c->target, v, map->images + map->dim * v);
}

/* As far along the motion as nothing flips, but at most `length`. */
static double go_along(carry *c, const iccp_simplicial_map *map, double length)
{
    for (int k = 0; k < MOST_HALVINGS; ++k, length *= 0.5) {
        go(c, map, length);
        if (all_positive(map))
            return length;
    }
    memcpy(map->images, c->images, map->dim * map->n_points * sizeof *c->images);
    return 0;
}

/* To rest as well, where nothing is in the way of that; *limit: where something would flip. In
 * space the answer does so anyway. */
static void choose_motion(carry *c, const iccp_simplicial_map *map, double *limit)
{
    if (map->dim == 2) {
        for (size_t i = 0; i < 2 * map->n_points; ++i)
            c->rest[i] += c->motion[i];
        *limit = iccp_newton_limit(map, c->rest);
        if (SHARE_OF_FLIP * *limit >= 1) {
            double *const motion = c->motion;
            c->motion = c->rest;
            c->rest = motion;
            return;
        }
    }
    *limit = iccp_newton_limit(map, c->motion);
}

/* One part: to the end and to rest, where nothing is in the way of that; else as far as nothing
 * flips. */
static icc_status advance(carry *c, double *share, double *limit, const iccp_env *env)
{
    const iccp_simplicial_map map = c->as->see(c->map);
    iccp_newton newton;
    *share = *limit = 0;
    icc_status status = iccp_newton_create(&newton, &map, NULL, NULL, env);
    if (status != ICC_OK)
        return status;
    status = iccp_newton_answer(&newton, c->motion, c->rest, env);
    iccp_newton_free(&newton);
    if (status != ICC_OK)
        return status == ICC_ERR_SOLVER ? ICC_OK : status;
    memcpy(c->images, map.images, map.dim * map.n_points * sizeof *c->images);
    choose_motion(c, &map, limit);
    *share = go_along(c, &map, iccp_min(1, SHARE_OF_FLIP * *limit));
    return ICC_OK;
}

static icc_status correct(const carry *c, iccp_work *work, const iccp_env *env)
{
    const iccp_simplicial_map simplicial = c->as->see(c->map);
    return iccp_improve_images(&simplicial, &CORRECTION, work, NULL, env);
}

icc_status iccp_carry_by(const iccp_carriage *carriage, void *map, const icc_domain *target,
                         size_t patience, iccp_work *work, bool *reached, double *room,
                         const iccp_env *env)
{
    carry c = {.as = carriage, .map = map, .target = target};
    size_t n_blocked = 0;
    icc_status status = make_room(&c, env);
    *reached = status == ICC_OK && !find_motion(&c);
    *room = HUGE_VAL;
    while (status == ICC_OK && !*reached && n_blocked <= patience &&
           iccp_work_take(work, 2 * carriage->see(map).n_simplices)) {
        double share;
        status = advance(&c, &share, room, env);
        *reached = share >= 1;
        n_blocked = share < carriage->blocked ? n_blocked + 1 : 0;
        if (status != ICC_OK || *reached || n_blocked > patience)
            break;
        status = n_blocked > 0 ? carriage->mend(map, work, env) : correct(&c, work, env);
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

/* ---- in the plane ---- */

typedef struct tended {
    iccp_plmap *map;
    const iccp_grain *grain;
} tended;

void iccp_carry_place(const iccp_plmap *map, const icc_domain *target, size_t vertex,
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
    iccp_carry_place(t->map, target, point, place);
}

static icc_status mend(void *map, iccp_work *work, const iccp_env *env)
{
    const tended *t = map;
    return iccp_tend(t->map, t->grain, 0, work, env);
}

icc_status iccp_carry(iccp_plmap *map, const icc_domain *target, const iccp_grain *grain,
                      size_t patience, iccp_work *work, bool *reached, double *room,
                      const iccp_env *env)
{
    static const iccp_carriage PLANE = {see, place, BLOCKED, mend};
    tended t = {map, grain};
    return iccp_carry_by(&PLANE, &t, target, patience, work, reached, room, env);
}

/* Moves a map along with its fixed points by a predictor and a corrector: E. L. Allgower, K. Georg,
 * Introduction to numerical continuation methods, 1990.
 *
 * The predictor moves the free points as the energy's quadratic model answers the motion of the
 * fixed ones. All points go together, as far as no simplex flips. The step to the energy's minimum
 * is added if nothing blocks it. Without the predictor, fixed points would run into their own
 * triangles.
 *
 * If the way is blocked, the mesh blocks it, not the map. A mesh that suits the present map lets it
 * go on. */
#include "map/energy/continuation.h"

#include "base/minmax.h"
#include "map/energy/descent.h"
#include "map/energy/newton.h"

#include <math.h>
#include <string.h>

/* A part goes this share of the way to the first flip. */
static const double SHARE_OF_FLIP = 0.7;

enum { MOST_HALVINGS = 30 };

/* Steps after each part. */
static const iccp_descent CORRECTION = {0, 2, 1e-2, 0, false};

typedef struct motion {
    const iccp_continuation *as;
    void *map;
    const icc_domain *target;
    /* dim for each point: the motion, the step to the energy's minimum (in the plane only), and the
     * images before the motion */
    double *way, *rest, *images;
    size_t room;
} motion;

static icc_status make_room(motion *m, const iccp_env *env)
{
    const iccp_simplicial_map map = m->as->see(m->map);
    const size_t n = map.n_points, size = map.dim * sizeof(double);
    if (n <= m->room)
        return ICC_OK;
    iccp_free(&env->memory, m->way);
    iccp_free(&env->memory, m->rest);
    iccp_free(&env->memory, m->images);
    m->room = n + n / 2;
    m->way = iccp_alloc(&env->memory, m->room, size);
    m->rest = map.dim == 2 ? iccp_alloc(&env->memory, m->room, size) : NULL;
    m->images = iccp_alloc(&env->memory, m->room, size);
    return m->way != NULL && m->images != NULL && (map.dim == 3 || m->rest != NULL)
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

/* Finds how far each fixed point still has to go; 0 for free points. Returns true if any has to. */
static bool find_motion(motion *m)
{
    const iccp_simplicial_map map = m->as->see(m->map);
    bool is_left = false;
    for (uint32_t v = 0; v < map.n_points; ++v) {
        const double *image = map.images + map.dim * v;
        double place[3];
        memcpy(place, image, map.dim * sizeof *place);
        if (iccp_simplicial_is_fixed(&map, v))
            m->as->place(m->map, m->target, v, place);
        for (size_t d = 0; d < map.dim; ++d) {
            m->way[map.dim * v + d] = place[d] - image[d];
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

/* Moves points by a share of the way from `images`. The whole way ends exactly at the target. */
static void go(motion *m, const iccp_simplicial_map *map, double share)
{
    for (size_t i = 0; i < map->dim * map->n_points; ++i)
        map->images[i] = m->images[i] + share * m->way[i];
    if (map->dim == 3)
        iccp_simplicial_round(3 * map->n_points, map->images);
    for (uint32_t v = 0; share >= 1 && v < map->n_points; ++v)
        if (iccp_simplicial_is_fixed(map, v))
            m->as->place(m->map, m->target, v, map->images + map->dim * v);
}

/* Moves points as far as nothing flips, by at most the share `length`. Returns the share. */
static double go_along(motion *m, const iccp_simplicial_map *map, double length)
{
    for (int k = 0; k < MOST_HALVINGS; ++k, length *= 0.5) {
        go(m, map, length);
        if (all_positive(map))
            return length;
    }
    memcpy(map->images, m->images, map->dim * map->n_points * sizeof *m->images);
    return 0;
}

/* Adds the step to the energy's minimum if nothing would flip on it. *limit: the share at which a
 * simplex would flip. In space the model's answer includes that step. */
static void choose_motion(motion *m, const iccp_simplicial_map *map, double *limit)
{
    if (map->dim == 2) {
        for (size_t i = 0; i < 2 * map->n_points; ++i)
            m->rest[i] += m->way[i];
        *limit = iccp_newton_limit(map, m->rest);
        if (SHARE_OF_FLIP * *limit >= 1) {
            double *const way = m->way;
            m->way = m->rest;
            m->rest = way;
            return;
        }
    }
    *limit = iccp_newton_limit(map, m->way);
}

/* Makes one part of the way: all of it if nothing flips, otherwise as much as possible. */
static icc_status advance(motion *m, double *share, double *limit, const iccp_env *env)
{
    const iccp_simplicial_map map = m->as->see(m->map);
    iccp_newton newton;
    *share = *limit = 0;
    icc_status status = iccp_newton_create(&newton, &map, NULL, NULL, env);
    if (status != ICC_OK)
        return status;
    status = iccp_newton_answer(&newton, m->way, m->rest, env);
    iccp_newton_free(&newton);
    if (status != ICC_OK)
        return status == ICC_ERR_SOLVER ? ICC_OK : status;
    memcpy(m->images, map.images, map.dim * map.n_points * sizeof *m->images);
    choose_motion(m, &map, limit);
    *share = go_along(m, &map, iccp_min(1, SHARE_OF_FLIP * *limit));
    return ICC_OK;
}

static icc_status correct(const motion *m, iccp_work *work, const iccp_env *env)
{
    const iccp_simplicial_map simplicial = m->as->see(m->map);
    return iccp_take_steps(&simplicial, &CORRECTION, work, NULL, env);
}

icc_status iccp_continue(const iccp_continuation *carriage, void *map, const icc_domain *target,
                         size_t patience, iccp_work *work, bool *reached, double *room,
                         const iccp_env *env)
{
    motion m = {.as = carriage, .map = map, .target = target};
    size_t n_blocked = 0;
    icc_status status = make_room(&m, env);
    *reached = status == ICC_OK && !find_motion(&m);
    *room = HUGE_VAL;
    while (status == ICC_OK && !*reached && n_blocked <= patience &&
           iccp_work_take(work, 2 * carriage->see(map).n_simplices)) {
        double share;
        status = advance(&m, &share, room, env);
        *reached = share >= 1;
        n_blocked = share < carriage->blocked ? n_blocked + 1 : 0;
        if (status != ICC_OK || *reached || n_blocked > patience)
            break;
        status = n_blocked > 0 ? carriage->mend(map, work, env) : correct(&m, work, env);
        if (status == ICC_OK)
            status = make_room(&m, env);
        if (status == ICC_OK)
            *reached = !find_motion(&m);
    }
    iccp_free(&env->memory, m.way);
    iccp_free(&env->memory, m.rest);
    iccp_free(&env->memory, m.images);
    return status;
}

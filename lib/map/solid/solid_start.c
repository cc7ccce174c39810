/* Tries strategies for a first map in turn: docs/theory/solid-maps.md. A map that cannot be
 * repaired on one of the two meshes often can on the other. A convex target has room for
 * everything, but the mesh of a ball has no points where the limbs of an animal must come from.
 * The inverse of a map is a map. */
#include "map/solid/solid_start.h"

#include "base/clock.h"
#include "map/solid/coat_map.h"
#include "map/solid/solid_ball.h"
#include "map/solid/solid_edit.h"
#include "map/solid/solid_pockets.h"
#include "map/solid/solid_ways.h"
#include "math/elementary.h"
#include "method/chart_create.h"

#include <math.h>

/* Inverts a map. Both meshes have the same boundary, with the same numbers. */
static icc_status invert(iccp_solid_map *map, iccp_solid_map *other)
{
    const icc_status status = iccp_solid_own(other);
    if (status != ICC_OK)
        return status;
    double *points = other->own->points;
    other->own->points = other->images;
    iccp_solid_take(map, other->own, points);
    other->own = NULL;
    other->images = NULL;
    return ICC_OK;
}

/* ---- one strategy after the other, in turn on the source's mesh and on the target's ---- */

/* What a map is for: the whole, the way by a ball, or a pocket. */
typedef enum use { WHOLE = 1, ROUND = 2, POCKET = 4 } use;

static iccp_solid_strategy go_round, mend_pockets;

/* The strategies in the order in which they are tried. Points were only seen to help in pockets:
 * without them there is no map from a body of 702 vertices onto its drawing on a sphere. */
static const struct {
    iccp_solid_way way;
    iccp_solid_strategy *run;
    unsigned uses;
} STRATEGIES[] = {{ICCP_SOLID_BY_CHARTS, iccp_solid_fit, WHOLE | ROUND | POCKET},
                  {ICCP_SOLID_BY_BALL, go_round, WHOLE},
                  {ICCP_SOLID_BY_POCKETS, mend_pockets, WHOLE | ROUND},
                  {ICCP_SOLID_BY_POINTS, iccp_solid_refit, POCKET},
                  {ICCP_SOLID_BY_POINTS_ANEW, iccp_solid_refit_anew, POCKET}};

enum { N_STRATEGIES = sizeof STRATEGIES / sizeof *STRATEGIES };

/* A map, and one in the other direction. */
typedef struct map_pair {
    iccp_solid_map *map[2];
    iccp_direction ways[2];
    size_t fewest; /* the least number of inverted tetrahedra */
} map_pair;

/* Runs a strategy on both sides, unless there is a map already. A map in the other direction is
 * inverted. */
static icc_status take_turns(map_pair *p, size_t k, iccp_map_facts *info, const iccp_env *env)
{
    iccp_env part[2];
    icc_status status = ICC_OK;
    iccp_split(part, 2, (const double[]){1, 1}, env);
    for (size_t side = 0; status == ICC_OK && p->fewest > 0 && side < 2; ++side) {
        info->n_unrepaired = SIZE_MAX;
        status = STRATEGIES[k].run(p->map[side], p->ways[side], info, &part[side]);
        if (status == ICC_OK && info->n_unrepaired > 0 && info->n_unrepaired < SIZE_MAX)
            iccp_log(env, "%zu tetrahedra are left of the %s's", info->n_unrepaired,
                     side == 0 ? "source" : "target");
        p->fewest = info->n_unrepaired < p->fewest ? info->n_unrepaired : p->fewest;
        if (status == ICC_OK && p->fewest == 0 && side == 1)
            status = invert(p->map[0], p->map[1]);
    }
    return status;
}

/* Finds an empty map by the strategies for a use. info->n_unrepaired is then the least number of
 * inverted tetrahedra. */
static icc_status find(iccp_solid_map *map, iccp_direction way, use purpose, iccp_map_facts *info,
                       const iccp_env *env)
{
    iccp_env part[N_STRATEGIES];
    iccp_solid_map other = {
        .memory = map->memory, .mesh = way.target->domain->mesh, .stretch = 1 / map->stretch};
    map_pair p = {{map, &other}, {way, {way.target, way.source}}, SIZE_MAX};
    icc_status status = ICC_OK;
    map->mesh = way.source->domain->mesh;
    iccp_split(part, N_STRATEGIES, (const double[N_STRATEGIES]){28, 6, 2, 2, 2}, env);
    for (size_t k = 0; status == ICC_OK && p.fewest > 0 && k < N_STRATEGIES; ++k) {
        if ((STRATEGIES[k].uses & purpose) == 0)
            continue;
        status = take_turns(&p, k, info, &part[k]);
        map->way = STRATEGIES[k].way;
    }
    info->n_unrepaired = p.fewest;
    iccp_simplices_free(other.own);
    iccp_free(&env->memory, other.images);
    return status;
}

/* ---- pockets ---- */

/* Solves a pocket with charts of its two domains. */
static icc_status solve(iccp_simplices **mesh, double **images, const icc_domain *from,
                        const icc_domain *to, const iccp_env *env)
{
    static const icc_chart_options options = {.size = sizeof options};
    icc_chart *chart[2] = {NULL, NULL};
    iccp_map_facts info = {0};
    iccp_solid_map map = {.memory = env->memory};
    iccp_env part[3];
    *mesh = NULL;
    *images = NULL;
    map.stretch = iccp_cbrt(fabs(to->measure) / fabs(from->measure));
    iccp_split(part, 3, (const double[]){1, 1, 6}, env);
    icc_status status = iccp_chart_create(&chart[0], from, &options, &part[0], NULL);
    if (status == ICC_OK)
        status = iccp_chart_create(&chart[1], to, &options, &part[1], NULL);
    if (status == ICC_OK)
        status = find(&map, (iccp_direction){chart[0], chart[1]}, POCKET, &info, &part[2]);
    if (status == ICC_OK && info.n_unrepaired == 0)
        status = iccp_solid_own(&map);
    if (status == ICC_OK && info.n_unrepaired == 0) {
        *mesh = map.own;
        *images = map.images;
    } else {
        iccp_simplices_free(map.own);
        iccp_free(&env->memory, map.images);
    }
    iccp_chart_release(chart[0]);
    iccp_chart_release(chart[1]);
    return status == ICC_ERR_MEMORY || status == ICC_ERR_CANCELLED ? status : ICC_OK;
}

static icc_status mend_pockets(iccp_solid_map *map, iccp_direction way, iccp_map_facts *info,
                               const iccp_env *env)
{
    const double began = iccp_seconds();
    icc_status status = iccp_solid_own(map);
    if (status == ICC_OK)
        status = iccp_solid_mend_pockets(map, way.source->domain, solve, env);
    if (status == ICC_OK)
        info->n_unrepaired = iccp_solid_count_inverted(map);
    info->seconds_repair += iccp_seconds() - began;
    return status;
}

/* ---- by way of a ball ---- */

/* Makes a map from one onto the ball, which is used up. */
static icc_status put_on(iccp_solid_map *map, iccp_solid_map *round, iccp_direction way,
                         const double apex[3], iccp_map_facts *info, const iccp_env *env)
{
    const icc_domain *from = way.source->domain, *to = way.target->domain;
    bool done = false;
    icc_status status = iccp_solid_own(round);
    if (status == ICC_OK)
        status = iccp_coat_put_on(&round->own, &round->images, to->vertices, apex, &done, env);
    round->mesh = round->own;
    if (status == ICC_OK && done)
        status = iccp_solid_check(round, from, env);
    if (status != ICC_OK || !done || iccp_solid_count_inverted(round) > 0)
        return status;
    iccp_solid_take(map, round->own, round->images);
    round->own = NULL;
    round->images = NULL;
    info->n_unrepaired = 0;
    return ICC_OK;
}

/* Makes a map by way of a ball with the target's directions, if there is one. Otherwise the map and
 * n_unrepaired do not change. */
static icc_status go_round(iccp_solid_map *map, iccp_direction way, iccp_map_facts *info,
                           const iccp_env *env)
{
    icc_chart *ball;
    iccp_map_facts found = *info;
    double apex[3];
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 4}, env);
    const icc_domain *from = way.source->domain;
    icc_status status = iccp_solid_ball(&ball, apex, from, way.target->domain, &part[0]);
    if (status != ICC_OK || ball == NULL)
        return status;
    iccp_solid_map round = {.memory = env->memory};
    round.stretch = iccp_cbrt(fabs(ball->domain->measure) / fabs(from->measure));
    status = find(&round, (iccp_direction){way.source, ball}, ROUND, &found, &part[1]);
    if (status == ICC_OK && found.n_unrepaired == 0)
        status = put_on(map, &round, way, apex, info, env);
    info->seconds_repair = found.seconds_repair;
    info->seconds_certify = found.seconds_certify;
    iccp_simplices_free(round.own);
    iccp_free(&env->memory, round.images);
    iccp_chart_release(ball);
    return status;
}

/* ---- all of it ---- */

icc_status iccp_solid_start(iccp_solid_map *map, const icc_chart *source, const icc_chart *target,
                            iccp_map_facts *info, const iccp_env *env)
{
    return find(map, (iccp_direction){source, target}, WHOLE, info, env);
}

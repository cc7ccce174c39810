/* Tries strategies for a first map in turn: docs/theory.md, the mesh map in space. A map that
 * cannot be repaired on one of the two meshes often can on the other. A convex target has room for
 * everything, but the mesh of a ball has no points where the limbs of an animal must come from. The
 * inverse of a map is a map. */
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

/* ---- one stage after the other, in turn on the source's mesh and on the target's ---- */

typedef enum stage { FIT, POCKETS, BALL, UNFOLD, MEND, MEND_ANEW } stage;

static iccp_solid_solve solve;

/* A map, and one in the other direction. */
typedef struct both {
    iccp_solid_map *map[2];
    iccp_direction ways[2];
    size_t fewest; /* the least number of inverted tetrahedra */
} both;

static both both_of(iccp_solid_map *map, iccp_solid_map *other, iccp_direction way)
{
    const both b = {{map, other}, {way, {way.target, way.source}}, SIZE_MAX};
    *other = (iccp_solid_map){
        .memory = map->memory, .mesh = way.target->domain->mesh, .stretch = 1 / map->stretch};
    map->mesh = way.source->domain->mesh;
    return b;
}

/* Records the result of a stage on one side. A map in the other direction is inverted. */
static icc_status conclude(both *b, size_t side, iccp_map_facts *info)
{
    b->fewest = info->n_unrepaired < b->fewest ? info->n_unrepaired : b->fewest;
    return info->n_unrepaired == 0 && side == 1 ? invert(b->map[0], b->map[1]) : ICC_OK;
}

static icc_status mend_pockets(iccp_solid_map *map, const icc_domain *source, iccp_map_facts *info,
                               const iccp_env *env)
{
    const double began = iccp_seconds();
    icc_status status = iccp_solid_own(map);
    if (status == ICC_OK)
        status = iccp_solid_mend_pockets(map, source, solve, env);
    info->n_unrepaired = iccp_solid_count_inverted(map);
    info->seconds_repair += iccp_seconds() - began;
    return status;
}

/* Runs a stage on both sides, unless there is a map already. */
static icc_status take_turns(both *b, stage now, iccp_map_facts *info, const iccp_env *env)
{
    iccp_env part[2];
    icc_status status = ICC_OK;
    iccp_split(part, 2, (const double[]){1, 1}, env);
    for (size_t side = 0; status == ICC_OK && b->fewest > 0 && side < 2; ++side) {
        iccp_solid_map *const m = b->map[side];
        status = now == FIT       ? iccp_solid_fit(m, b->ways[side], info, &part[side])
                 : now == POCKETS ? mend_pockets(m, b->ways[side].source->domain, info, &part[side])
                 : now == UNFOLD
                     ? iccp_solid_unfold(m, b->ways[side], info, &part[side])
                     : iccp_solid_refit(m, b->ways[side], now == MEND_ANEW, info, &part[side]);
        if (status == ICC_OK && info->n_unrepaired > 0 && now != UNFOLD)
            iccp_log(env, "%zu tetrahedra are left of the %s's", info->n_unrepaired,
                     side == 0 ? "source" : "target");
        if (status == ICC_OK)
            status = conclude(b, side, info);
    }
    return status;
}

/* Quick strategies, for pockets. */
static icc_status solve(iccp_simplices **mesh, double **images, const icc_domain *from,
                        const icc_domain *to, const iccp_env *env)
{
    static const icc_chart_options options = {.size = sizeof options};
    static const stage STAGES[] = {FIT, MEND, MEND_ANEW, UNFOLD};
    enum { N_STAGES = sizeof STAGES / sizeof *STAGES };
    icc_chart *chart[2] = {NULL, NULL};
    iccp_map_facts info = {0};
    *mesh = NULL;
    *images = NULL;
    iccp_env part[2 + N_STAGES];
    iccp_split(part, 2 + N_STAGES, (const double[]){1, 1, 4, 1, 1, 1}, env);
    icc_status status = iccp_chart_create(&chart[0], from, &options, &part[0], NULL);
    if (status == ICC_OK)
        status = iccp_chart_create(&chart[1], to, &options, &part[1], NULL);
    iccp_solid_map other = {0}, map = {.memory = env->memory};
    map.stretch = iccp_cbrt(fabs(to->measure) / fabs(from->measure));
    if (status == ICC_OK) {
        both b = both_of(&map, &other, (iccp_direction){chart[0], chart[1]});
        for (size_t k = 0; status == ICC_OK && b.fewest > 0 && k < N_STAGES; ++k)
            status = take_turns(&b, STAGES[k], &info, &part[2 + k]);
        if (status == ICC_OK && b.fewest == 0)
            status = iccp_solid_own(&map);
        if (status == ICC_OK && b.fewest == 0) {
            *mesh = map.own;
            *images = map.images;
            map.own = NULL;
            map.images = NULL;
        }
    }
    iccp_simplices_free(map.own);
    iccp_free(&env->memory, map.images);
    iccp_simplices_free(other.own);
    iccp_free(&env->memory, other.images);
    iccp_chart_release(chart[0]);
    iccp_chart_release(chart[1]);
    return status == ICC_ERR_MEMORY || status == ICC_ERR_CANCELLED ? status : ICC_OK;
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

/* Makes a map by way of a ball with the target's directions, if there is one. Otherwise the map is
 * empty and `info` does not change. */
static icc_status go_round(iccp_solid_map *map, iccp_direction way, iccp_map_facts *info,
                           const iccp_env *env)
{
    static const stage STAGES[] = {FIT, POCKETS, MEND, MEND_ANEW};
    enum { N_STAGES = sizeof STAGES / sizeof *STAGES };
    icc_chart *ball;
    iccp_map_facts told = *info;
    double apex[3];
    iccp_env part[1 + N_STAGES];
    iccp_split(part, 1 + N_STAGES, (const double[]){2, 6, 1, 1, 1}, env);
    const icc_domain *from = way.source->domain;
    icc_status status = iccp_solid_ball(&ball, apex, from, way.target->domain, &part[0]);
    if (status != ICC_OK || ball == NULL)
        return status;
    iccp_solid_map other, round = {.memory = env->memory};
    round.stretch = iccp_cbrt(fabs(ball->domain->measure) / fabs(from->measure));
    both b = both_of(&round, &other, (iccp_direction){way.source, ball});
    for (size_t k = 0; status == ICC_OK && k < N_STAGES; ++k)
        status = take_turns(&b, STAGES[k], &told, &part[1 + k]);
    if (status == ICC_OK && b.fewest == 0)
        status = put_on(map, &round, way, apex, info, env);
    info->seconds_repair = told.seconds_repair;
    info->seconds_certify = told.seconds_certify;
    iccp_simplices_free(round.own);
    iccp_free(&env->memory, round.images);
    iccp_simplices_free(other.own);
    iccp_free(&env->memory, other.images);
    iccp_chart_release(ball);
    return status;
}

static icc_status take_turns_round(both *b, iccp_map_facts *info, const iccp_env *env)
{
    iccp_env part[2];
    icc_status status = ICC_OK;
    iccp_split(part, 2, (const double[]){1, 1}, env);
    for (size_t side = 0; status == ICC_OK && b->fewest > 0 && side < 2; ++side) {
        status = go_round(b->map[side], b->ways[side], info, &part[side]);
        if (status == ICC_OK)
            status = conclude(b, side, info);
    }
    return status;
}

/* ---- all stages ---- */

/* Runs the stages until one finds a map. Other members of `info` describe the last stage. */
icc_status iccp_solid_start(iccp_solid_map *map, const icc_chart *source, const icc_chart *target,
                            bool *unfolded, iccp_map_facts *info, const iccp_env *env)
{
    static const stage STAGES[] = {FIT, BALL, POCKETS, UNFOLD, MEND, MEND_ANEW};
    enum { N_STAGES = sizeof STAGES / sizeof *STAGES };
    iccp_env part[N_STAGES];
    iccp_split(part, N_STAGES, (const double[]){28, 6, 2, 2, 2, 2}, env);
    iccp_solid_map other;
    both b = both_of(map, &other, (iccp_direction){source, target});
    icc_status status = ICC_OK;
    *unfolded = false;
    for (size_t k = 0; status == ICC_OK && b.fewest > 0 && k < N_STAGES; ++k) {
        status = STAGES[k] == BALL ? take_turns_round(&b, info, &part[k])
                                   : take_turns(&b, STAGES[k], info, &part[k]);
        *unfolded = b.fewest == 0 && (STAGES[k] == BALL || STAGES[k] == UNFOLD);
    }
    info->n_unrepaired = b.fewest;
    iccp_simplices_free(other.own);
    iccp_free(&env->memory, other.images);
    return status;
}

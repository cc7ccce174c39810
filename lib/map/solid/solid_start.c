/* Tries strategies for a first map in turn: docs/theory/solid-maps.md. A map that cannot be
 * repaired on one of the two meshes often can on the other. A convex target has room for
 * everything, but the mesh of a ball has no points where the limbs of an animal must come from.
 * The inverse of a map is a map. */
#include "map/solid/solid_start.h"

#include "base/clock.h"
#include "fill/filled_pair.h"
#include "map/solid/solid_chain.h"
#include "map/solid/solid_edit.h"
#include "map/solid/solid_pockets.h"
#include "map/solid/solid_ways.h"
#include "math/elementary.h"

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

static iccp_solid_strategy mend_pockets;

/* The strategies in the order in which they are tried. Pockets use only the first. */
static const struct {
    iccp_solid_way way;
    iccp_solid_strategy *run;
} STRATEGIES[] = {{ICCP_SOLID_DIRECTLY, iccp_solid_fit},
                  {ICCP_SOLID_BY_POCKETS, mend_pockets},
                  {ICCP_SOLID_BY_CHAIN, iccp_solid_chain}};

enum { N_STRATEGIES = sizeof STRATEGIES / sizeof *STRATEGIES };

/* A map, and one in the other direction. */
typedef struct map_pair {
    iccp_solid_map *map[2];
    iccp_direction ways[2];
    icc_domain *filled; /* the target with a mesh, for the other direction, or NULL */
    size_t fewest;      /* the least number of inverted tetrahedra */
} map_pair;

/* Makes sure that the target has a mesh. *has is false if it cannot be filled. */
static icc_status fill_target(map_pair *p, bool *has, const iccp_env *env)
{
    icc_status status = ICC_OK;
    if (p->filled == NULL)
        status = iccp_fill_side(&p->filled, p->ways[1].source, 1, env, NULL);
    *has = status == ICC_OK;
    if (*has) {
        p->ways[1].source = p->ways[0].target = p->filled;
        p->map[1]->mesh = p->filled->mesh;
    }
    return status == ICC_ERR_MEMORY || status == ICC_ERR_CANCELLED ? status : ICC_OK;
}

/* Runs a strategy on both sides, unless there is a map already. A map in the other direction is
 * inverted. */
static icc_status take_turns(map_pair *p, size_t k, iccp_map_facts *info, const iccp_env *env)
{
    iccp_env part[2];
    icc_status status = ICC_OK;
    bool has_mesh = true;
    iccp_split(part, 2, (const double[]){1, 1}, env);
    for (size_t side = 0; status == ICC_OK && p->fewest > 0 && side < 2; ++side) {
        if (side == 1)
            status = fill_target(p, &has_mesh, env);
        if (status != ICC_OK || !has_mesh)
            break;
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

/* Finds an empty map by the first `n` strategies. info->n_unrepaired is then the least number of
 * inverted tetrahedra. */
static icc_status find(iccp_solid_map *map, iccp_direction way, size_t n, iccp_map_facts *info,
                       const iccp_env *env)
{
    iccp_env part[N_STRATEGIES];
    iccp_solid_map other = {.memory = map->memory, .stretch = 1 / map->stretch};
    map_pair p = {{map, &other}, {way, {way.target, way.source}}, NULL, SIZE_MAX};
    icc_status status = ICC_OK;
    map->mesh = way.source->mesh;
    iccp_split(part, N_STRATEGIES, (const double[N_STRATEGIES]){8, 1, 8}, env);
    for (size_t k = 0; status == ICC_OK && p.fewest > 0 && k < n; ++k) {
        status = take_turns(&p, k, info, &part[k]);
        map->way = STRATEGIES[k].way;
    }
    info->n_unrepaired = p.fewest;
    iccp_simplices_free(other.own);
    iccp_free(&env->memory, other.images);
    iccp_domain_release(p.filled);
    return status;
}

/* ---- pockets ---- */

/* Solves a pocket, a pair of filled domains. */
static icc_status solve(iccp_simplices **mesh, double **images, const icc_domain *from,
                        const icc_domain *to, const iccp_env *env)
{
    iccp_map_facts info = {0};
    iccp_solid_map map = {.memory = env->memory};
    *mesh = NULL;
    *images = NULL;
    map.stretch = iccp_cbrt(fabs(to->measure) / fabs(from->measure));
    icc_status status = find(&map, (iccp_direction){from, to}, 1, &info, env);
    if (status == ICC_OK && info.n_unrepaired == 0)
        status = iccp_solid_own(&map);
    if (status == ICC_OK && info.n_unrepaired == 0) {
        *mesh = map.own;
        *images = map.images;
    } else {
        iccp_simplices_free(map.own);
        iccp_free(&env->memory, map.images);
    }
    return status == ICC_ERR_MEMORY || status == ICC_ERR_CANCELLED ? status : ICC_OK;
}

static icc_status mend_pockets(iccp_solid_map *map, iccp_direction way, iccp_map_facts *info,
                               const iccp_env *env)
{
    const double began = iccp_seconds();
    if (way.source->features != NULL) /* a pocket is a ball with nothing in it */
        return ICC_OK;
    icc_status status = iccp_solid_own(map);
    if (status == ICC_OK)
        status = iccp_solid_mend_pockets(map, way.source, solve, env);
    if (status == ICC_OK)
        info->n_unrepaired = iccp_solid_count_inverted(map);
    info->seconds_repair += iccp_seconds() - began;
    return status;
}

/* ---- all of it ---- */

icc_status iccp_solid_start(iccp_solid_map *map, const icc_domain *source, const icc_domain *target,
                            iccp_map_facts *info, const iccp_env *env)
{
    return find(map, (iccp_direction){source, target}, N_STRATEGIES, info, env);
}

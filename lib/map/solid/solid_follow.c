/* Moves a map to a target that has moved: docs/theory/solid-maps.md. If the surface moves mostly
 * by one affine map, the inside moves by the same map. The rest of the motion is answered as in
 * map/energy/continuation.c. */
#include "map/solid/solid_follow.h"

#include "base/clock.h"
#include "map/energy/affine.h"
#include "map/energy/continuation.h"
#include "map/energy/mesh_repair.h"
#include "map/energy/untangle.h"
#include "map/solid/solid_improve.h"
#include "math/vec.h"

#include <math.h>
#include <string.h>

/* Steps after a small motion of the target. They end earlier if there is less to gain. */
enum { FOLLOW_ITERATIONS = 8 };
static const double FOLLOW_TOLERANCE = 1e-3;

/* If the way is blocked: how often the mesh is mended before all vertices jump to the target at
 * once and are untangled, and how often after that. */
enum { PATIENCE = 0, LAST_PATIENCE = 3 };

/* A part of the way shorter than this counts as blocked. After longer parts, steps make more room
 * than changes of the mesh. */
static const double BLOCKED = 0.05;

/* Limits on the cost of moving the map and of untangling, in steps. */
static const double CARRY_STEPS = 60, UNTANGLE_STEPS = 12;

/* If the share of inverted tetrahedra is larger, they are not untangled. */
static const double FEW = 0.01;

/* Limit on the tetrahedra of a mended mesh, as a multiple of the source's. */
static const double MOST_GROWTH = 2;

/* The affine map is used if it leaves at most this share of the squared motion. */
static const double LEAST_LEFT = 0.25;

typedef struct journey {
    iccp_solid_map *map;
    const icc_domain *source, *target;
} journey;

/* ---- the affine part of the motion ---- */

/* Applies the affine map if it is most of the motion and rounding permits it. */
static icc_status move_in_common(journey *j, const iccp_env *env)
{
    const iccp_simplices *mesh = j->map->mesh;
    const double *places = j->target->vertices;
    const iccp_simplicial_map now = iccp_solid_simplicial(j->map);
    const iccp_simplicial_map surface = {.dim = 3,
                                         .n_points = mesh->n_boundary,
                                         .n_fixed = mesh->n_boundary,
                                         .points = now.images,
                                         .images = j->target->vertices};
    double before = 0, after = 0, place[3];
    iccp_affine a;
    if (!iccp_affine_fit(&a, &surface))
        return ICC_OK;
    for (size_t v = 0; v < mesh->n_boundary; ++v) {
        iccp_affine_apply(&a, now.images + 3 * v, place);
        before += iccp_vec_distance2(3, now.images + 3 * v, places + 3 * v);
        after += iccp_vec_distance2(3, place, places + 3 * v);
    }
    if (!(after < LEAST_LEFT * before))
        return ICC_OK;
    iccp_simplicial_map then = now;
    then.images = iccp_alloc(&j->map->memory, mesh->n_points, 3 * sizeof *then.images);
    if (then.images == NULL)
        return ICC_ERR_MEMORY;
    for (size_t v = 0; v < mesh->n_points; ++v)
        iccp_affine_apply(&a, now.images + 3 * v, then.images + 3 * v);
    iccp_simplicial_round(3 * mesh->n_points, then.images);
    const bool good = iccp_simplicial_count_at_once(&then, env) == 0;
    iccp_free(&j->map->memory, good ? now.images : then.images);
    j->map->images = good ? then.images : now.images;
    return ICC_OK;
}

/* ---- the way ---- */

static iccp_simplicial_map see(const void *map)
{
    const journey *j = map;
    return iccp_solid_simplicial(j->map);
}

static void place(const void *map, const icc_domain *target, size_t point, double *place)
{
    const journey *j = map;
    const iccp_simplices *mesh = j->map->mesh;
    if (point < mesh->n_boundary) {
        memcpy(place, target->vertices + 3 * point, 3 * sizeof *place);
        return;
    }
    const iccp_on_line *p = &mesh->on_line[point - mesh->n_boundary];
    iccp_frame_between(&target->frame, target->vertices + 3 * (size_t)p->a,
                       target->vertices + 3 * (size_t)p->b, p->share, place);
}

static icc_status mend(void *map, iccp_work *work, const iccp_env *env)
{
    const journey *j = map;
    static const iccp_descent REST = {0, 3, 1e-2, 0, false};
    const bool cuts =
        (double)j->map->mesh->n_simplices < MOST_GROWTH * (double)j->source->mesh->n_simplices;
    size_t n_changes;
    const icc_status status = iccp_solid_refine(j->map, j->source, cuts, &n_changes, env);
    const iccp_simplicial_map simplicial = see(map);
    return status == ICC_OK ? iccp_take_steps(&simplicial, &REST, work, NULL, env) : status;
}

static icc_status carry(journey *j, size_t patience, bool *reached, const iccp_env *env)
{
    static const iccp_continuation SPACE = {see, place, BLOCKED, mend};
    iccp_work work = {.left = CARRY_STEPS * (double)j->map->mesh->n_simplices};
    double room;
    return iccp_continue(&SPACE, j, j->target, patience, &work, reached, &room, env);
}

/* Moves all of the surface at once, then repairs the inverted tetrahedra if they are few. If this
 * fails, the images are as they were. */
static icc_status jump(journey *j, size_t *n_left, const iccp_env *env)
{
    const iccp_simplices *mesh = j->map->mesh;
    const iccp_simplicial_map simplicial = iccp_solid_simplicial(j->map);
    iccp_work work = {.left = UNTANGLE_STEPS * (double)mesh->n_simplices};
    const size_t n = 3 * mesh->n_points;
    double *before = iccp_alloc(&env->memory, n, sizeof *before);
    icc_status status = before != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status != ICC_OK)
        return status;
    memcpy(before, simplicial.images, n * sizeof *before);
    iccp_solid_place_fixed(mesh, j->target, simplicial.images);
    *n_left = iccp_simplicial_count_at_once(&simplicial, env);
    if (*n_left > 0 && (double)*n_left < FEW * (double)mesh->n_simplices + 1) {
        status = iccp_untangle(&simplicial, &work, n_left, env);
        iccp_mesh_round(mesh, simplicial.images);
        *n_left = iccp_simplicial_count_at_once(&simplicial, env);
    }
    if (status != ICC_OK || *n_left > 0)
        memcpy(simplicial.images, before, n * sizeof *before);
    iccp_free(&env->memory, before);
    return status;
}

static icc_status go_there(journey *j, size_t *n_left, const iccp_env *env)
{
    static const size_t TURNS[] = {PATIENCE, LAST_PATIENCE};
    const iccp_simplicial_map here = iccp_solid_simplicial(j->map);
    iccp_simplicial_map there = here; /* of the surface alone */
    there.images = j->target->vertices;
    icc_status status = ICC_OK;
    if (iccp_simplicial_count_at_once(&here, env) > 0)
        return jump(j, n_left, env); /* inverted by rounding in the new frame */
    *n_left = 1;
    if (iccp_simplicial_is_hopeless(&there)) {
        size_t n;
        status = iccp_solid_refine(j->map, j->source, true, &n, env);
    }
    if (status == ICC_OK)
        status = move_in_common(j, env);
    for (int k = 0; k < 2 && status == ICC_OK && *n_left > 0; ++k) {
        bool reached;
        status = carry(j, TURNS[k], &reached, env);
        if (status == ICC_OK && !reached)
            status = jump(j, n_left, env);
        else
            *n_left = 0;
    }
    return status;
}

/* ---- all of it ---- */

/* Finds the vertex that is farthest from its target. */
static size_t farthest(const iccp_solid_map *map, const icc_domain *target)
{
    double most = -1;
    size_t found = 0;
    for (size_t v = 0; v < map->mesh->n_boundary; ++v) {
        const double own = iccp_vec_distance2(3, map->images + 3 * v, target->vertices + 3 * v);
        if (own > most) {
            most = own;
            found = v;
        }
    }
    return found;
}

icc_status iccp_solid_map_follow(iccp_solid_map **out, const iccp_solid_map *map,
                                 const icc_domain *source, const icc_domain *old_target,
                                 const icc_domain *target, int32_t iterations, iccp_map_facts *info,
                                 size_t *vertex, const iccp_env *env)
{
    const double began = iccp_seconds();
    const icc_improve_options options = {.iterations =
                                             iterations == 0 ? FOLLOW_ITERATIONS : iterations,
                                         .levels = -1,
                                         .tolerance = iterations == 0 ? FOLLOW_TOLERANCE : 0};
    journey j = {.source = source, .target = target};
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 1}, env);
    *out = NULL;
    icc_status status = iccp_solid_map_copy(&j.map, map, source, target, &env->memory);
    if (status != ICC_OK)
        return status;
    iccp_frame_change(&old_target->frame, &target->frame, 3, j.map->mesh->n_points, j.map->images);
    iccp_mesh_round(j.map->mesh, j.map->images);
    const iccp_env way = iccp_part(&part[0], "repair", 0, 1);
    status = go_there(&j, &info->n_unrepaired, &way);
    info->seconds_repair = iccp_seconds() - began;
    *vertex = farthest(j.map, target);
    if (status == ICC_OK && info->n_unrepaired == 0)
        status = iccp_solid_map_relax(j.map, source, &options, info, &part[1]);
    if (status == ICC_OK && info->n_unrepaired == 0)
        status = iccp_solid_map_finish(j.map, info, env);
    if (status == ICC_OK && info->n_unrepaired == 0)
        *out = j.map;
    else
        iccp_solid_map_free(j.map);
    return status;
}

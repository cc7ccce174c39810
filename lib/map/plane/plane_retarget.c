/* Moves a mesh map to another target (docs/theory/plane-maps.md, docs/theory/features.md). Cages
 * move at once if that inverts no triangle. Otherwise, and with features, they move by
 * continuation. */
#include "map/plane/plane_retarget.h"

#include "base/clock.h"
#include "base/error.h"
#include "domain/features.h"
#include "map/compatible/density.h"
#include "map/compatible/move_targets.h"
#include "map/plane/feature_start.h"
#include "map/plane/plane_improve.h"

#include <math.h>
#include <string.h>

/* Improvement steps after a motion. A frame of an animation has no time for more, and the next
 * frame continues from here. Features have made steps on the way, so they take none at the end. */
enum { CAGE_ITERATIONS = 8, FEATURE_ITERATIONS = -1 };

/* A very coarse mesh cannot follow a motion. So a mesh with fewer triangles than ENOUGH is refined
 * until no edge is longer than a cell of a square with CELLS cells along a side. With more
 * triangles than MANY, and MANY_EACH for each given vertex, it is thinned out. */
enum { ENOUGH = 1000, CELLS = 15, MANY = 1400, MANY_EACH = 8 };

/* How many times in turn a blocked motion may change the mesh. PATIENCE: before rebuild().
 * LAST_PATIENCE: after rebuild() failed, and for cages, which are not rebuilt. */
enum { PATIENCE = 0, LAST_PATIENCE = 1 };

/* Moves the images of fixed vertices to where another target wants them. */
static void move_boundary(iccp_plmap *pl, const icc_domain *target)
{
    for (size_t v = 0; v < pl->n_vertices; ++v)
        if (pl->fixed[v] != ICCP_FREE)
            iccp_target_place(pl, target, v, pl->images + 2 * v);
}

/* Copies the map. The images stay where they were, but in the frame of the new target. */
static icc_status begin(iccp_plmap *pl, const iccp_plmap *old, const icc_domain *source,
                        const icc_domain *old_target, const icc_domain *target,
                        const iccp_newton_plan *plan, const iccp_memory *memory)
{
    const icc_status status = iccp_plmap_copy(pl, old, memory);
    if (status != ICC_OK)
        return status;
    iccp_frame_change(&old_target->frame, &target->frame, 2, pl->n_vertices, pl->images);
    pl->plan = plan;
    pl->stretch = sqrt(target->measure / source->measure);
    return ICC_OK;
}

/* The domains of a motion. */
typedef struct journey {
    const iccp_isotopy *isotopy;
    const icc_domain *source, *old_target, *target;
} journey;

/* Makes a new map in the isotopy class that the moved map would have. *made: whether that worked.
 * Otherwise the map stays as it is. */
static icc_status rebuild(iccp_plmap *pl, const journey *j, double longest, iccp_work *work,
                          bool *made, const iccp_env *env)
{
    iccp_cuts cuts;
    iccp_plmap fresh = {.memory = env->memory};
    icc_status status =
        iccp_isotopy_move(&cuts, made, j->isotopy, j->source, j->old_target, j->target, env);
    if (status == ICC_OK && *made)
        status = iccp_feature_start_from(&fresh, j->source, j->target, &cuts, work, env);
    if (status == ICC_OK && *made)
        status = iccp_refine_longest(&fresh, longest, ENOUGH, env);
    iccp_cuts_free(&cuts);
    *made = *made && status == ICC_OK;
    if (*made) {
        iccp_plmap_free(pl);
        *pl = fresh;
    } else {
        iccp_plmap_free(&fresh);
    }
    return status == ICC_ERR_RESOLUTION ? ICC_OK : status;
}

/* Moves a map with features to another target, part by part. If the way is blocked, the map is
 * rebuilt in its class. Every state on the way is one-to-one, so the class is kept. */
static icc_status move_features(iccp_mesh_map *map, const journey *j,
                                const icc_improve_options *options, iccp_allowance *work,
                                iccp_map_facts *info, const iccp_env *env, icc_error *err)
{
    const double begin = iccp_seconds(), stretch = map->pl.stretch;
    const iccp_mesh_limits limits = {iccp_planar_step(j->target, CELLS),
                                     MANY + MANY_EACH * j->source->features->n_places};
    bool reached = false;
    double room = 0;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){3, 1}, env);
    icc_status status = ICC_OK;
    if (map->pl.corners.n_triangles < ENOUGH)
        status = iccp_limit_edges(&map->pl, limits.longest_edge, &part[0]);
    if (status == ICC_OK)
        status = iccp_move_targets(&map->pl, j->target, &limits, PATIENCE, &work->search, &reached,
                                   &room, &part[0]);
    if (status == ICC_OK && !reached)
        status = rebuild(&map->pl, j, limits.longest_edge, &work->overlay, &reached, &part[0]);
    if (status == ICC_OK && !reached)
        status = iccp_move_targets(&map->pl, j->target, &limits, LAST_PATIENCE, &work->search,
                                   &reached, &room, &part[0]);
    if (status == ICC_OK && reached)
        status = iccp_improve_moving(&map->pl, &limits, room, &work->improvement, &part[0]);
    map->pl.stretch = stretch;
    info->seconds_repair = iccp_seconds() - begin;
    if (status == ICC_OK && !reached)
        return iccp_fail(err, ICC_ERR_CERTIFICATE,
                         "features moved straight to their new places would meet or come too "
                         "close: go there another way, in several steps, or make a new map");
    if (status == ICC_OK)
        status = iccp_plane_complete(map, options, &iccp_schedule_plain, &work->improvement, info,
                                     &part[1]);
    return status;
}

static bool same_memory(const iccp_memory *a, const iccp_memory *b)
{
    return a->user == b->user && a->alloc == b->alloc && a->dealloc == b->dealloc;
}

/* Finds the plan of Newton's method for the map's mesh. The maps that follow a map share it, and
 * the first of them makes it. *plan is NULL if the two maps use different allocators. */
static icc_status plan_of(iccp_newton_plan **plan, const iccp_mesh_map *map, const iccp_env *env)
{
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(&map->pl);
    iccp_newton_plan *fresh;
    *plan = NULL;
    if (!same_memory(&map->pl.memory, &env->memory))
        return ICC_OK;
    *plan = iccp_once_get(&map->plan);
    if (*plan != NULL)
        return ICC_OK;
    const icc_status status = iccp_newton_plan_create(&fresh, &simplicial, env);
    if (status != ICC_OK)
        return status;
    *plan = iccp_once_keep(&map->plan, fresh);
    if (*plan != fresh)
        iccp_newton_plan_release(fresh);
    return ICC_OK;
}

/* Moves the boundary's images to the new target at once if that inverts no triangle, otherwise in
 * parts. *reached: whether they are there. */
static icc_status move_cage(iccp_plmap *pl, const icc_domain *target, iccp_work *work,
                            bool *reached, iccp_map_facts *info, const iccp_env *env)
{
    const iccp_mesh_limits limits = {iccp_planar_step(target, CELLS), SIZE_MAX};
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(pl);
    const size_t n = 2 * pl->n_vertices;
    double room, *before = iccp_alloc(&env->memory, n, sizeof *before);
    if (before == NULL)
        return ICC_ERR_MEMORY;
    memcpy(before, pl->images, n * sizeof *before);
    move_boundary(pl, target);
    info->n_inverted = iccp_simplicial_count_at_once(&simplicial, env);
    *reached = info->n_inverted == 0;
    if (!*reached)
        memcpy(pl->images, before, n * sizeof *before);
    iccp_free(&env->memory, before);
    return *reached
               ? ICC_OK
               : iccp_move_targets(pl, target, &limits, LAST_PATIENCE, work, reached, &room, env);
}

/* Moves the map of a cage to another target, and improves it. If the way is blocked, the result is
 * ICC_OK, and info->n_unrepaired is not 0. */
static icc_status retarget_cage(iccp_mesh_map *map, const icc_domain *target,
                                const icc_improve_options *options, iccp_allowance *work,
                                iccp_map_facts *info, const iccp_env *env)
{
    const double begin = iccp_seconds();
    bool reached = false;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 5}, env);
    icc_status status = move_cage(&map->pl, target, &work->search, &reached, info, &part[0]);
    info->seconds_repair = iccp_seconds() - begin;
    info->n_unrepaired = reached ? 0 : info->n_inverted;
    if (status == ICC_OK && reached)
        status = iccp_cut_chords(&map->pl);
    if (status == ICC_OK && reached)
        status = iccp_plane_complete(map, options, &iccp_schedule_plain, &work->improvement, info,
                                     &part[1]);
    return status;
}

icc_status iccp_mesh_map_retarget(iccp_mesh_map **out, const iccp_mesh_map *map,
                                  const icc_domain *source, const icc_domain *old_target,
                                  const icc_domain *target, int32_t iterations,
                                  iccp_map_facts *info, const iccp_env *env, icc_error *err)
{
    iccp_mesh_map *next = iccp_mesh_map_new(source, target, &env->memory);
    *out = NULL;
    if (next == NULL)
        return ICC_ERR_MEMORY;
    iccp_newton_plan *plan = NULL;
    icc_status status = iterations >= 0 ? plan_of(&plan, map, env) : ICC_OK;
    if (status == ICC_OK)
        status = begin(&next->pl, &map->pl, source, old_target, target, plan, &env->memory);
    if (status == ICC_OK) {
        const icc_improve_options options = {.iterations = iterations != 0 ? iterations
                                                           : source->features != NULL
                                                               ? FEATURE_ITERATIONS
                                                               : CAGE_ITERATIONS,
                                             .levels = -1};
        iccp_allowance work = iccp_allow(source->n_facets);
        work.improvement = iccp_work_unlimited();
        work.overlay.left = work.relaxing;
        work.all = HUGE_VAL;
        status = source->features == NULL
                     ? retarget_cage(next, target, &options, &work, info, env)
                     : move_features(next, &(journey){map->isotopy, source, old_target, target},
                                     &options, &work, info, env, err);
        next->work = iccp_spent(&work);
        iccp_plane_keep_plan(next, plan);
    }
    if (status == ICC_OK && info->n_unrepaired == 0)
        *out = next;
    else
        iccp_mesh_map_free(next, &env->memory);
    return status;
}

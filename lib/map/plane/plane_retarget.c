/* Moves a mesh map to another target (docs/theory/plane-maps.md, docs/theory/features.md). Cages
 * move at once if that inverts no triangle. Otherwise, and with features, they move by
 * continuation. */
#include "map/plane/plane_retarget.h"

#include "base/clock.h"
#include "base/error.h"
#include "domain/features.h"
#include "map/compatible/density.h"
#include "map/compatible/move_targets.h"
#include "map/compatible/moving_part.h"
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

/* How many times in turn a blocked motion may change the mesh. PATIENCE: a whole map with features,
 * before rebuild(). LAST_PATIENCE: all other motions. */
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
                        const iccp_memory *memory)
{
    const icc_status status = iccp_plmap_copy(pl, old, memory);
    if (status != ICC_OK)
        return status;
    iccp_frame_change(&old_target->frame, &target->frame, 2, pl->n_vertices, pl->images);
    pl->stretch = sqrt(target->measure / source->measure);
    return ICC_OK;
}

static bool same_memory(const iccp_memory *a, const iccp_memory *b)
{
    return a->user == b->user && a->alloc == b->alloc && a->dealloc == b->dealloc;
}

/* Finds the plan of Newton's method for a mesh that follows a map. The first map that follows makes
 * the plan, and later ones with the same mesh share it. *plan is NULL if the two maps use different
 * allocators. The caller releases it. */
static icc_status plan_of(iccp_newton_plan **plan, const iccp_mesh_map *map, const iccp_plmap *mesh,
                          const iccp_env *env)
{
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(mesh);
    *plan = NULL;
    if (!same_memory(&map->pl.memory, &env->memory))
        return ICC_OK;
    iccp_newton_plan *const known = iccp_once_get(&map->plan);
    if (known != NULL && iccp_newton_plan_fits(known, &simplicial)) {
        *plan = iccp_newton_plan_retain(known);
        return ICC_OK;
    }
    const icc_status status = iccp_newton_plan_create(plan, &simplicial, env);
    if (status == ICC_OK && known == NULL &&
        iccp_once_keep(&map->plan, iccp_newton_plan_retain(*plan)) != *plan)
        iccp_newton_plan_release(*plan);
    return status;
}

/* A motion: the map that is moved, its domains, and the target that it shall reach. */
typedef struct journey {
    const iccp_mesh_map *map;
    const icc_domain *source, *old_target, *target;
    bool has_plan; /* Newton's plan is shared with other frames */
} journey;

/* Makes a new map in the isotopy class that the moved map would have. All faces change. *made:
 * whether that worked. Otherwise the map stays as it is. */
static icc_status rebuild(iccp_plmap *pl, const journey *j, double longest, iccp_work *work,
                          bool *made, const iccp_env *env)
{
    iccp_cuts cuts;
    iccp_plmap fresh = {.memory = env->memory};
    icc_status status =
        iccp_isotopy_move(&cuts, made, j->map->isotopy, j->source, j->old_target, j->target, env);
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

/* What moves: the mesh of a whole map, or of a part of it. */
typedef struct traveller {
    iccp_mesh_map *map;
    iccp_plmap *mesh;
    const icc_domain *old_target; /* vertices that have the same place there stay; NULL: none */
    iccp_mesh_limits limits;
    bool reached; /* the target */
    double room;  /* see iccp_move_targets() */
} traveller;

static icc_status go(traveller *t, const journey *j, size_t patience, iccp_allowance *work,
                     const iccp_env *env)
{
    return iccp_move_targets(t->mesh, t->old_target, j->target, &t->limits, patience, &work->search,
                             &t->reached, &t->room, env);
}

/* Moves to the target. If the way is blocked, the whole map is rebuilt in its class. For a part,
 * its mesh is changed once before that. */
static icc_status go_or_rebuild(traveller *t, const journey *j, iccp_allowance *work,
                                const iccp_env *env)
{
    const bool is_whole = t->mesh == &t->map->pl;
    icc_status status = go(t, j, is_whole ? PATIENCE : LAST_PATIENCE, work, env);
    if (status != ICC_OK || t->reached)
        return status;
    status = rebuild(&t->map->pl, j, t->limits.longest_edge, &work->overlay, &t->reached, env);
    if (status == ICC_OK && !t->reached)
        return go(t, j, LAST_PATIENCE, work, env);
    t->mesh = &t->map->pl;
    t->limits.n_elsewhere = 0;
    return status;
}

/* Moves the part of a map with features that changes. */
static icc_status move_part(iccp_mesh_map *map, iccp_moving_part *part, const journey *j,
                            iccp_allowance *work, bool *reached, const iccp_env *env)
{
    iccp_plmap *const mesh = part->is_whole ? &map->pl : &part->map;
    const size_t n = map->pl.corners.n_triangles;
    traveller t = {.map = map,
                   .mesh = mesh,
                   .old_target = part->is_whole ? NULL : j->old_target,
                   .limits = {iccp_planar_step(j->target, CELLS),
                              MANY + MANY_EACH * j->source->features->n_places,
                              n - mesh->corners.n_triangles}};
    iccp_newton_plan *plan = NULL;
    icc_status status = ICC_OK;
    if (n < ENOUGH)
        status = iccp_limit_edges(mesh, t.limits.longest_edge, env);
    if (status == ICC_OK && j->has_plan)
        status = plan_of(&plan, j->map, mesh, env);
    mesh->plan = plan;
    if (status == ICC_OK)
        status = go_or_rebuild(&t, j, work, env);
    if (status == ICC_OK && t.reached)
        status = iccp_improve_moving(t.mesh, &t.limits, t.room, &work->improvement, env);
    iccp_plane_keep_plan(map, plan, t.mesh);
    iccp_newton_plan_release(plan);
    if (status == ICC_OK && t.reached && t.mesh == &part->map)
        status = iccp_moving_part_put_back(part, &map->pl, env);
    *reached = t.reached;
    return status;
}

/* Moves a map with features to another target. Only the faces that change are moved. Every state on
 * the way is one-to-one, so the class is kept. */
static icc_status move_features(iccp_mesh_map *map, const journey *j,
                                const icc_improve_options *options, iccp_allowance *work,
                                iccp_map_facts *info, const iccp_env *env, icc_error *err)
{
    const double begin = iccp_seconds(), stretch = map->pl.stretch;
    iccp_moving_part part;
    iccp_env own[2];
    iccp_split(own, 2, (const double[]){3, 1}, env);
    icc_status status = iccp_moving_part_create(&part, &map->pl, j->old_target, j->target, &own[0]);
    bool reached = status == ICC_OK && !part.is_whole && part.n_triangles == 0;
    if (status == ICC_OK && !reached)
        status = move_part(map, &part, j, work, &reached, &own[0]);
    iccp_moving_part_free(&part);
    map->pl.stretch = stretch;
    info->seconds_repair = iccp_seconds() - begin;
    if (status == ICC_OK && !reached)
        return iccp_fail(err, ICC_ERR_CERTIFICATE,
                         "features moved straight to their new places would meet or come too "
                         "close: go there another way, in several steps, or make a new map");
    map->pl.plan = iccp_once_get(&map->plan);
    if (status == ICC_OK)
        status = iccp_plane_complete(map, options, &iccp_schedule_plain, &work->improvement, info,
                                     &own[1]);
    map->pl.plan = NULL;
    return status;
}

/* Moves the boundary's images to the new target at once if that inverts no triangle, otherwise in
 * parts. *reached: whether they are there. */
static icc_status move_cage(iccp_plmap *pl, const icc_domain *target, iccp_work *work,
                            bool *reached, iccp_map_facts *info, const iccp_env *env)
{
    const iccp_mesh_limits limits = {iccp_planar_step(target, CELLS), SIZE_MAX, 0};
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
    return *reached ? ICC_OK
                    : iccp_move_targets(pl, NULL, target, &limits, LAST_PATIENCE, work, reached,
                                        &room, env);
}

/* Moves the map of a cage to another target, and improves it. If the way is blocked, the result is
 * ICC_OK, and info->n_unrepaired is not 0. */
static icc_status retarget_cage(iccp_mesh_map *map, const journey *j,
                                const icc_improve_options *options, iccp_allowance *work,
                                iccp_map_facts *info, const iccp_env *env)
{
    const double begin = iccp_seconds();
    bool reached = false;
    iccp_env part[2];
    iccp_newton_plan *plan = NULL;
    iccp_split(part, 2, (const double[]){1, 5}, env);
    icc_status status = j->has_plan ? plan_of(&plan, j->map, &map->pl, env) : ICC_OK;
    map->pl.plan = plan;
    if (status == ICC_OK)
        status = move_cage(&map->pl, j->target, &work->search, &reached, info, &part[0]);
    info->seconds_repair = iccp_seconds() - begin;
    info->n_unrepaired = reached ? 0 : info->n_inverted;
    if (status == ICC_OK && reached)
        status = iccp_cut_chords(&map->pl);
    if (status == ICC_OK && reached)
        status = iccp_plane_complete(map, options, &iccp_schedule_plain, &work->improvement, info,
                                     &part[1]);
    iccp_plane_keep_plan(map, plan, &map->pl);
    iccp_newton_plan_release(plan);
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
    icc_status status = begin(&next->pl, &map->pl, source, old_target, target, &env->memory);
    if (status == ICC_OK) {
        const icc_improve_options options = {.iterations = iterations != 0 ? iterations
                                                           : source->features != NULL
                                                               ? FEATURE_ITERATIONS
                                                               : CAGE_ITERATIONS,
                                             .levels = -1};
        const journey j = {map, source, old_target, target, iterations >= 0};
        iccp_allowance work = iccp_allow(source->n_facets);
        work.improvement = iccp_work_unlimited();
        work.overlay.left = work.relaxing;
        work.all = HUGE_VAL;
        status = source->features == NULL
                     ? retarget_cage(next, &j, &options, &work, info, env)
                     : move_features(next, &j, &options, &work, info, env, err);
        next->work = iccp_spent(&work);
    }
    if (status == ICC_OK && info->n_unrepaired == 0)
        *out = next;
    else
        iccp_mesh_map_free(next, &env->memory);
    return status;
}

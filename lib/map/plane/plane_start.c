/* Makes a mesh map in the plane (docs/theory/plane-maps.md). Huynh and Gingold, section 9: a
 * one-to-one map is the start of one with low distortion.
 *
 * Without features the start is the mesh of the source's chart, with images by the two charts.
 * Overlays replace its inverted parts. With features the start is the overlay of two domains that
 * are cut open (feature_start.h). */
#include "map/plane/plane_start.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/minmax.h"
#include "base/threads.h"
#include "chart/encode_points.h"
#include "domain/features.h"
#include "map/compatible/overlay_patches.h"
#include "map/compatible/overlay_start.h"
#include "map/energy/movable.h"
#include "map/plane/feature_start.h"
#include "map/plane/plane_improve.h"

#include <math.h>
#include <stdatomic.h>

/* A start with features counts as entangled if its energy is higher. */
static const double ENTANGLED = 20;

/* The whole map is overlaid if the borders of all patches have more than 1 / PATCHES of the
 * boundary's vertices. Then it is as cheap, and on spirals of hundreds of turns it has less than
 * half of the energy. */
enum { PATCHES = 4 };

/* ---- start ---- */

/* Finds the image of a mesh vertex. The charts give it, except for boundary vertices, which have
 * corresponding points on the other cage. */
static icc_status vertex_image(const icc_chart *source, const icc_chart *target,
                               const iccp_planar *mesh, size_t v, double image[2], iccp_path *path)
{
    iccp_coords coords;
    if (v < mesh->n_boundary) {
        const uint32_t k = (uint32_t)v;
        const double along = iccp_planar_along(mesh, source->domain, k, 0);
        const double bary[2] = {1 - along, along};
        iccp_domain_facet_point(target->domain, mesh->facet[k], bary, image);
        return ICC_OK;
    }
    const icc_status status = iccp_chart_encode_vertex(source, v, &coords);
    return status == ICC_OK ? iccp_chart_decode(target, &coords, image, NULL, path) : status;
}

typedef struct charts {
    const icc_chart *source, *target;
    const iccp_memory *memory;
    double *images;
    atomic_size_t first_lost; /* the first vertex that has no image */
} charts;

static icc_status find_images(void *argument, size_t begin, size_t end)
{
    charts *c = argument;
    iccp_path path;
    iccp_path_init(&path, c->memory);
    icc_status status = ICC_OK;
    for (size_t v = begin; status == ICC_OK && v < end; ++v) {
        status = vertex_image(c->source, c->target, c->source->mesh, v, c->images + 2 * v, &path);
        size_t first = atomic_load(&c->first_lost);
        while (status != ICC_OK && v < first &&
               !atomic_compare_exchange_weak(&c->first_lost, &first, v))
            continue;
    }
    iccp_path_clear(&path);
    return status;
}

/* Two jobs that run side by side if there are threads: finding the images, and making Newton's plan
 * of the mesh. */
typedef struct start_job {
    const icc_chart *source, *target;
    iccp_plmap *pl;
    iccp_newton_plan *plan;
} start_job;

/* Prepares for finding images: makes a chart ready, and allocates room. */
static icc_status prepare(void *argument, size_t k, const iccp_env *env, icc_error *err)
{
    const start_job *job = argument;
    (void)err;
    return k == 0 ? iccp_chart_ready(job->target, true)
                  : iccp_plmap_create(
                        job->pl, job->source->mesh, job->source->domain, NULL,
                        sqrt(job->target->domain->measure / job->source->domain->measure),
                        &env->memory);
}

static icc_status find_all_images(start_job *job, const iccp_env *env, icc_error *err)
{
    icc_status status = iccp_side_by_side(env, 2, prepare, job, err);
    charts c = {job->source, job->target, &env->memory, job->pl->images, SIZE_MAX};
    if (status == ICC_OK)
        status = iccp_for_chunks(env, "trace", job->source->mesh->n_vertices, 256, find_images, &c);
    if (iccp_is_point_status(status) && status != ICC_OK)
        (void)iccp_fail(err, status, "the charts give no image to vertex %zu of the mesh",
                        atomic_load(&c.first_lost));
    return status;
}

static icc_status run_start(void *argument, size_t k, const iccp_env *env, icc_error *err)
{
    start_job *job = argument;
    const iccp_planar *mesh = job->source->mesh;
    if (k == 0)
        return find_all_images(job, env, err);
    const iccp_simplicial_map map = {.dim = 2,
                                     .n_points = mesh->n_vertices,
                                     .n_simplices = mesh->n_triangles,
                                     .corners = mesh->triangles,
                                     .n_fixed = mesh->n_boundary};
    return iccp_newton_plan_create(&job->plan, &map, env);
}

/* Maps the mesh of the source's chart by the two charts. The result may be inverted in places.
 * *plan: Newton's plan of that mesh if it could be made meanwhile, or NULL. */
static icc_status start(iccp_plmap *pl, iccp_newton_plan **plan, const icc_chart *source,
                        const icc_chart *target, bool is_improved, const iccp_env *env,
                        icc_error *err)
{
    const iccp_planar *mesh = source->mesh;
    start_job job = {source, target, pl, NULL};
    const bool plans = is_improved && iccp_has_threads(env) && env->budget == NULL &&
                       iccp_all_are_movable(mesh->n_triangles);
    const icc_status status = iccp_side_by_side(env, plans ? 2 : 1, run_start, &job, err);
    pl->plan = *plan = job.plan;
    return status;
}

/* Replaces the inverted parts of a start by overlays: patches around them, or the whole if that
 * costs less. Returns ICC_ERR_RESOLUTION if the overlay would be too large, and ICC_ERR_CERTIFICATE
 * if rounding spoils it. */
static icc_status overlay(iccp_plmap *pl, const icc_domain *source, const icc_domain *target,
                          iccp_allowance *work, const iccp_env *env)
{
    size_t n_left, n_boundary = 0;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 2}, env);
    for (size_t v = 0; v < pl->n_vertices; ++v)
        n_boundary += pl->fixed[v] != ICCP_FREE;
    iccp_work patches = {.left = work->relaxing};
    icc_status status = iccp_overlay_patches(pl, n_boundary / PATCHES, &patches, &n_left, &part[0]);
    iccp_work_charge(&work->overlay, patches.spent);
    if (status == ICC_OK && n_left > 0) {
        iccp_plmap_free(pl);
        status = iccp_overlay_start(pl, source, target, work->relaxing,
                                    iccp_bound(&work->overlay, work), &part[1]);
    }
    if (status == ICC_ERR_RESOLUTION)
        iccp_log(env, "the two triangulations cross too often");
    return status == ICC_OK ? iccp_cut_chords(pl) : status;
}

/* Makes the start one-to-one. It stays as the charts give it if nothing is inverted. */
static icc_status make_positive(iccp_mesh_map *map, const icc_domain *source,
                                const icc_domain *target, iccp_allowance *work,
                                iccp_map_facts *info, const iccp_env *env)
{
    const double begin = iccp_seconds();
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(&map->pl);
    info->n_inverted = iccp_simplicial_count_at_once(&simplicial, env);
    if (info->n_inverted == 0)
        return iccp_cut_chords(&map->pl);
    iccp_log(env, "%zu triangles are inverted: making an overlay there", info->n_inverted);
    const icc_status status = overlay(&map->pl, source, target, work, env);
    info->seconds_repair = iccp_seconds() - begin;
    return status;
}

icc_status iccp_mesh_map_create(iccp_mesh_map **out, const icc_chart *source,
                                const icc_chart *target, int32_t iterations, iccp_map_facts *info,
                                const iccp_env *env, icc_error *err)
{
    iccp_mesh_map *map = iccp_mesh_map_new(source->domain, target->domain, &env->memory);
    *out = NULL;
    if (map == NULL)
        return ICC_ERR_MEMORY;
    const icc_improve_options options = {.iterations = iterations};
    iccp_allowance work = iccp_allow(source->domain->n_facets);
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){1, 2, 5}, env);
    iccp_newton_plan *plan;
    icc_status status = start(&map->pl, &plan, source, target, iterations >= 0, &part[0], err);
    if (status == ICC_OK)
        status = make_positive(map, source->domain, target->domain, &work, info, &part[1]);
    const bool none = status == ICC_ERR_RESOLUTION || status == ICC_ERR_CERTIFICATE;
    if (status == ICC_OK)
        status = iccp_plane_complete(map, &options, &iccp_schedule_plain,
                                     iccp_bound(&work.improvement, &work), info, &part[2]);
    iccp_plane_keep_plan(map, plan, &map->pl);
    iccp_newton_plan_release(plan);
    map->work = iccp_spent(&work);
    if (status == ICC_OK)
        *out = map;
    else
        iccp_mesh_map_free(map, &env->memory);
    info->n_unrepaired = none ? info->n_inverted : 0;
    return none ? ICC_OK : status;
}

/* Moves points as well as images if the energy is high, with half of the work. Then features go far
 * around one another, and points have as far to go as images. */
static icc_status disentangle(iccp_plmap *pl, const icc_improve_options *options, iccp_work *work,
                              const iccp_env *env)
{
    iccp_work half = {.left = work->left / 2};
    iccp_improvement ignored;
    bool cancelled = false;
    icc_status status = ICC_OK;
    const double energy = iccp_plmap_energy(pl);
    if (energy > ENTANGLED)
        status = iccp_plane_improve(pl, energy, options, &iccp_schedule_moving_points, &half,
                                    &cancelled, &ignored, env);
    work->left -= half.spent;
    work->spent += half.spent;
    return cancelled ? ICC_ERR_CANCELLED : status;
}

icc_status iccp_mesh_map_create_features(iccp_mesh_map **out, const icc_domain *source,
                                         const icc_domain *target, const icc_map_options *options,
                                         iccp_map_facts *info, const iccp_env *env, icc_error *err)
{
    const double begin = iccp_seconds();
    iccp_mesh_map *map = iccp_mesh_map_new(source, target, &env->memory);
    *out = NULL;
    if (map == NULL)
        return ICC_ERR_MEMORY;
    const icc_improve_options improvement = {.iterations = options->iterations};
    iccp_allowance work = iccp_allow(source->features->n_places);
    iccp_feature_report report;
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){2, 1, 3}, env);
    work.overlay.left = work.relaxing;
    icc_status status =
        iccp_feature_start(&map->pl, source, target, options, &work, &report, &part[0], err);
    info->seconds_repair = iccp_seconds() - begin;
    if (status == ICC_OK && options->iterations >= 0)
        status = disentangle(&map->pl, &improvement, &work.improvement, &part[1]);
    map->pl.stretch = sqrt(target->measure / source->measure); /* swapping may have rounded it */
    if (status == ICC_OK)
        status = iccp_plane_complete(map, &improvement, &iccp_schedule_relaxed, &work.improvement,
                                     info, &part[2]);
    bool kept = false;
    if (status == ICC_OK)
        status = iccp_isotopy_has_cuts(&kept, &map->pl, &report.scene, &report.cuts, env);
    info->class_kept = kept;
    info->n_trees = (int32_t)report.n_trees;
    iccp_feature_report_free(&report);
    map->work = iccp_spent(&work);
    if (status == ICC_OK)
        *out = map;
    else
        iccp_mesh_map_free(map, &env->memory);
    return status;
}

/* Images by charts, and their repair. */
#include "map/solid/solid_ways.h"

#include "base/clock.h"
#include "base/threads.h"
#include "map/curves/curves.h"
#include "map/energy/mesh_repair.h"
#include "map/solid/solid_chords.h"
#include "map/solid/solid_edit.h"
#include "map/solid/solid_mend.h"

#include <string.h>

/* Vertices for each task. */
enum { GRAIN = 64 };

/* Limit of a repair, in steps on all tetrahedra. On pairs of all kinds, repairs that succeeded took
 * at most 68 steps. Other strategies are better for the rest. */
static const double MOST_STEPS = 80;

typedef struct start {
    iccp_direction way;
    const iccp_simplices *mesh;
    const iccp_memory *memory;
    double *images;
} start;

/* Computes images. A vertex without an image gets NaN, and the repair then places it. */
static icc_status find_images(void *argument, size_t begin, size_t end)
{
    const start *s = argument;
    const iccp_frame *from = &s->way.source->domain->frame, *to = &s->way.target->domain->frame;
    icc_status status = ICC_OK;
    iccp_path path;
    iccp_path_init(&path, s->memory);
    for (size_t i = begin; i < end && status != ICC_ERR_MEMORY; ++i) {
        const size_t v = s->mesh->n_boundary + i;
        double point[3], image[3];
        iccp_frame_out(from, 3, s->mesh->points + 3 * v, point);
        status = iccp_curves_point(s->way.source, s->way.target, point, image, NULL, &path);
        iccp_frame_in(to, 3, image, s->images + 3 * v);
    }
    iccp_path_clear(&path);
    return status == ICC_ERR_MEMORY ? status : ICC_OK;
}

static icc_status find_start(iccp_solid_map *map, iccp_direction way, const iccp_env *env)
{
    const iccp_simplices *mesh = map->mesh;
    start s = {way, mesh, &env->memory, NULL};
    iccp_free(&env->memory, map->images);
    map->images = iccp_alloc(&env->memory, mesh->n_points, 3 * sizeof *map->images);
    if (map->images == NULL)
        return ICC_ERR_MEMORY;
    s.images = map->images;
    memcpy(map->images, way.target->domain->vertices, 3 * mesh->n_boundary * sizeof *map->images);
    return iccp_for_chunks(env, "trace", mesh->n_points - mesh->n_boundary, GRAIN, find_images, &s);
}

size_t iccp_solid_count_inverted(const iccp_solid_map *map)
{
    const iccp_simplicial_map simplicial = iccp_solid_simplicial(map);
    return iccp_simplicial_count_inverted(&simplicial);
}

icc_status iccp_solid_own(iccp_solid_map *map)
{
    const icc_status status =
        map->own != NULL ? ICC_OK : iccp_simplices_copy(&map->own, map->mesh, &map->memory);
    if (status == ICC_OK)
        map->mesh = map->own;
    return status;
}

void iccp_solid_take(iccp_solid_map *map, iccp_simplices *mesh, double *images)
{
    iccp_simplices_free(map->own);
    iccp_free(&map->memory, map->images);
    map->own = mesh;
    map->mesh = mesh;
    map->images = images;
}

static icc_status repair(iccp_solid_map *map, iccp_map_facts *info, const iccp_env *env)
{
    const iccp_simplices *mesh = map->mesh;
    const double began = iccp_seconds();
    info->n_inverted = iccp_solid_count_inverted(map);
    if (info->n_inverted > 0) {
        const icc_status status = iccp_mesh_repair(mesh, map->images, MOST_STEPS, env);
        if (status != ICC_OK)
            return status;
    }
    iccp_mesh_round(mesh, map->images);
    const double repaired = iccp_seconds();
    info->n_unrepaired = iccp_solid_count_inverted(map);
    info->seconds_certify += iccp_seconds() - repaired;
    info->seconds_repair += repaired - began;
    return ICC_OK;
}

/* Starts anew on a mesh with points in the middle of chords. *done tells if that was possible. */
static icc_status begin_without_chords(iccp_solid_map *map, iccp_direction way, bool *done,
                                       const iccp_env *env)
{
    icc_status status =
        iccp_solid_cut_chords(&map->own, way.source->domain->mesh, way.source->domain->facets, env);
    *done = map->own != NULL;
    if (status != ICC_OK || map->own == NULL)
        return status;
    iccp_log(env, "tetrahedra between boundary vertices cannot be repaired: points are added");
    map->mesh = map->own;
    return find_start(map, way, env);
}

icc_status iccp_solid_fit(iccp_solid_map *map, iccp_direction way, iccp_map_facts *info,
                          const iccp_env *env)
{
    bool cut = false;
    iccp_env part[4];
    iccp_split(part, 4, (const double[]){3, 1, 3, 1}, env);
    icc_status status = find_start(map, way, &part[0]);
    const iccp_simplicial_map simplicial = iccp_solid_simplicial(map);
    if (status == ICC_OK && iccp_simplicial_is_hopeless(&simplicial))
        status = begin_without_chords(map, way, &cut, &part[1]);
    if (status == ICC_OK)
        status = repair(map, info, &part[2]);
    if (status != ICC_OK || info->n_unrepaired == 0 || cut)
        return status;
    status = begin_without_chords(map, way, &cut, &part[3]);
    return status == ICC_OK && cut ? repair(map, info, &part[3]) : status;
}

static icc_status refit(iccp_solid_map *map, iccp_direction way, bool anew, iccp_map_facts *info,
                        const iccp_env *env)
{
    const double began = iccp_seconds();
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 4}, env);
    icc_status status = iccp_solid_own(map);
    if (status == ICC_OK && anew)
        status = find_start(map, way, &part[0]);
    if (status == ICC_OK)
        status = iccp_mesh_place(map->mesh, map->images, env);
    if (status == ICC_OK)
        status = iccp_solid_mend(map, way.source->domain, &info->n_unrepaired, &part[1]);
    info->seconds_repair += iccp_seconds() - began;
    return status;
}

icc_status iccp_solid_refit(iccp_solid_map *map, iccp_direction way, iccp_map_facts *info,
                            const iccp_env *env)
{
    return refit(map, way, false, info, env);
}

icc_status iccp_solid_refit_anew(iccp_solid_map *map, iccp_direction way, iccp_map_facts *info,
                                 const iccp_env *env)
{
    return refit(map, way, true, info, env);
}

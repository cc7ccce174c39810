/* Harmonic images, and their repair. */
#include "map/solid/solid_ways.h"

#include "base/clock.h"
#include "map/energy/harmonic_images.h"
#include "map/energy/mesh_repair.h"
#include "map/energy/untangle.h"
#include "map/solid/solid_chords.h"
#include "map/solid/solid_edit.h"

#include <string.h>

/* Limit of a repair, in steps on all tetrahedra. On pairs of all kinds, repairs that succeeded took
 * at most 68 steps. Other strategies are better for the rest. */
static const double MOST_STEPS = 80;

/* Gives the vertices of the boundary their images. */
static icc_status set_boundary(iccp_solid_map *map, const icc_domain *target)
{
    const iccp_simplices *mesh = map->mesh;
    iccp_free(&map->memory, map->images);
    map->images = iccp_alloc_zero(&map->memory, mesh->n_points, 3 * sizeof *map->images);
    if (map->images == NULL)
        return ICC_ERR_MEMORY;
    memcpy(map->images, target->vertices, 3 * mesh->n_boundary * sizeof *map->images);
    return ICC_OK;
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
    const double began = iccp_seconds();
    const iccp_simplicial_map simplicial = iccp_solid_simplicial(map);
    iccp_work work = {.left = MOST_STEPS * (double)map->mesh->n_simplices};
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 4}, env);
    icc_status status = iccp_harmonic_images(&simplicial, &part[0]);
    iccp_mesh_round(map->mesh, map->images);
    info->n_inverted = info->n_unrepaired = iccp_simplicial_count_at_once(&simplicial, env);
    if (status == ICC_OK && info->n_inverted > 0) {
        status = iccp_untangle(&simplicial, &work, &info->n_unrepaired, &part[1]);
        iccp_mesh_round(map->mesh, map->images);
        info->n_unrepaired = iccp_simplicial_count_at_once(&simplicial, env);
    }
    info->seconds_repair += iccp_seconds() - began;
    return status;
}

/* Replaces the source's mesh by one with points in the middle of chords. *done tells if that was
 * possible. */
static icc_status leave_chords(iccp_solid_map *map, iccp_direction way, bool *done,
                               const iccp_env *env)
{
    const iccp_solid_marks marks = {.n_boundary = way.source->n_vertices,
                                    .n_facets = way.source->n_facets,
                                    .facets = way.source->facets};
    icc_status status = iccp_solid_cut_chords(&map->own, way.source->mesh, &marks, env);
    *done = map->own != NULL;
    if (status != ICC_OK || map->own == NULL)
        return status;
    status = iccp_simplices_join(map->own, way.source->n_facets, way.source->facets, NULL);
    if (status != ICC_OK)
        return status;
    iccp_log(env, "tetrahedra between boundary vertices cannot be repaired: points are added");
    map->mesh = map->own;
    return set_boundary(map, way.target);
}

icc_status iccp_solid_fit(iccp_solid_map *map, iccp_direction way, iccp_map_facts *info,
                          const iccp_env *env)
{
    bool cut = false;
    iccp_env part[4];
    iccp_split(part, 4, (const double[]){1, 6, 1, 6}, env);
    icc_status status = set_boundary(map, way.target);
    const iccp_simplicial_map simplicial = iccp_solid_simplicial(map);
    if (status == ICC_OK && iccp_simplicial_is_hopeless(&simplicial))
        status = leave_chords(map, way, &cut, &part[0]);
    if (status == ICC_OK)
        status = repair(map, info, &part[1]);
    if (status != ICC_OK || info->n_unrepaired == 0 || cut)
        return status;
    status = leave_chords(map, way, &cut, &part[2]);
    return status == ICC_OK && cut ? repair(map, info, &part[3]) : status;
}

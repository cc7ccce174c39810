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

/* Gives the fixed points their images. */
static icc_status set_fixed(iccp_solid_map *map, const icc_domain *target)
{
    const iccp_simplices *mesh = map->mesh;
    iccp_free(&map->memory, map->images);
    map->images = iccp_alloc_zero(&map->memory, mesh->n_points, 3 * sizeof *map->images);
    if (map->images != NULL)
        iccp_solid_place_fixed(mesh, target, map->images);
    return map->images != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

static void round_free(const iccp_simplicial_map *map)
{
    iccp_simplicial_round(3 * (map->n_points - map->n_fixed), map->images + 3 * map->n_fixed);
}

/* ---- points on lines ---- */

static void exchange(iccp_simplices *mesh, uint32_t *number, size_t a, size_t b)
{
    const uint32_t other = number[a];
    number[a] = number[b];
    number[b] = other;
    for (size_t k = 0; k < 3; ++k) {
        const double point = mesh->points[3 * a + k];
        mesh->points[3 * a + k] = mesh->points[3 * b + k];
        mesh->points[3 * b + k] = point;
    }
}

/* Numbers the points on lines after the vertices of the domain, in a mesh of the map's own. */
static icc_status order_lines(iccp_solid_map *map)
{
    const size_t n_boundary = map->mesh->n_boundary;
    if (iccp_solid_is_ordered(map->mesh))
        return ICC_OK;
    /* place[v]: which point is at v now. number[p]: where point p of the old mesh is. */
    uint32_t *place = iccp_alloc(&map->memory, map->mesh->n_points, sizeof *place);
    uint32_t *number = iccp_alloc(&map->memory, map->mesh->n_points, sizeof *number);
    icc_status status = place != NULL && number != NULL ? iccp_solid_own(map) : ICC_ERR_MEMORY;
    iccp_simplices *mesh = map->own;
    if (status == ICC_OK) {
        for (uint32_t v = 0; v < mesh->n_points; ++v)
            place[v] = number[v] = v;
        for (size_t k = 0; k < mesh->n_on_lines; ++k) {
            const size_t from = number[mesh->on_line[k].point], to = n_boundary + k;
            number[place[to]] = (uint32_t)from;
            number[place[from]] = (uint32_t)to;
            exchange(mesh, place, from, to);
            mesh->on_line[k].point = (uint32_t)to;
        }
        for (size_t c = 0; c < 4 * mesh->n_simplices; ++c)
            mesh->corners[c] = number[mesh->corners[c]];
    }
    iccp_free(&map->memory, place);
    iccp_free(&map->memory, number);
    return status;
}

/* ---- images and their repair ---- */

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
    round_free(&simplicial);
    info->n_inverted = info->n_unrepaired = iccp_simplicial_count_at_once(&simplicial, env);
    if (status == ICC_OK && info->n_inverted > 0) {
        status = iccp_untangle(&simplicial, &work, &info->n_unrepaired, &part[1]);
        round_free(&simplicial);
        info->n_unrepaired = iccp_simplicial_count_at_once(&simplicial, env);
    }
    info->seconds_repair += iccp_seconds() - began;
    return status;
}

/* Moves the points on lines to a mesh in which points keep their numbers. */
static void hand_over(iccp_simplices *to, iccp_simplices *from)
{
    to->on_line = from->on_line;
    to->n_on_lines = from->n_on_lines;
    from->on_line = NULL;
    from->n_on_lines = 0;
}

/* Replaces the map's mesh by one with points in the middle of chords and necks. *done tells if that
 * was possible. */
static icc_status leave_chords(iccp_solid_map *map, iccp_direction way, bool *done,
                               const iccp_env *env)
{
    iccp_solid_marks marks;
    iccp_simplices *cut = NULL;
    icc_status status = iccp_solid_own(map);
    if (status == ICC_OK)
        status = iccp_solid_marks_create(&marks, way.source, map->mesh, &env->memory);
    if (status != ICC_OK)
        return status;
    status = iccp_solid_cut_chords(&cut, map->mesh, &marks, env);
    iccp_solid_marks_free(&marks);
    *done = cut != NULL;
    if (status != ICC_OK || cut == NULL)
        return status;
    iccp_log(env, "tetrahedra between boundary vertices cannot be repaired: points are added");
    hand_over(cut, map->own);
    iccp_simplices_free(map->own);
    map->mesh = map->own = cut;
    status = iccp_solid_check(map, way.source, env);
    return status == ICC_OK ? set_fixed(map, way.target) : status;
}

icc_status iccp_solid_fit(iccp_solid_map *map, iccp_direction way, iccp_map_facts *info,
                          const iccp_env *env)
{
    bool cut = false;
    iccp_env part[4];
    iccp_split(part, 4, (const double[]){1, 6, 1, 6}, env);
    icc_status status = order_lines(map);
    if (status == ICC_OK)
        status = set_fixed(map, way.target);
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

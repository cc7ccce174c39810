/* docs/theory/solid-maps.md: the object, and how a new one is made. */
#include "map/solid/solid_map.h"

#include "base/clock.h"
#include "domain/domain_file.h"
#include "domain/solid_file.h"
#include "map/energy/schedule.h"
#include "map/solid/solid_improve.h"
#include "map/solid/solid_start.h"
#include "math/elementary.h"
#include "math/vec.h"

#include <math.h>
#include <string.h>

/* Most steps that lower the energy of a new map. A start with nearly flat tetrahedra needs about
 * 12. */
enum { ITERATIONS_OF_NEW = 20 };

/* How far outside its tetrahedron, in barycentric coordinates, rounding may put a point. */
static const double ROUNDING = 1e-9;

static icc_status plant(iccp_solid_map *map, const iccp_env *env)
{
    const iccp_simplices *mesh = map->mesh;
    iccp_facet_tree_create_solid(&map->before, 3, mesh->points, mesh->n_simplices, mesh->corners,
                                 &env->memory);
    iccp_facet_tree_create_solid(&map->after, 3, map->images, mesh->n_simplices, mesh->corners,
                                 &env->memory);
    return map->before.boxes != NULL && map->after.boxes != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

void iccp_solid_place_fixed(const iccp_simplices *mesh, const icc_domain *target, double *images)
{
    memcpy(images, target->vertices, 3 * mesh->n_boundary * sizeof *images);
    for (size_t k = 0; k < mesh->n_on_lines; ++k) {
        const iccp_on_line *p = &mesh->on_line[k];
        iccp_frame_between(&target->frame, target->vertices + 3 * (size_t)p->a,
                           target->vertices + 3 * (size_t)p->b, p->share,
                           images + 3 * (size_t)p->point);
    }
}

bool iccp_solid_is_ordered(const iccp_simplices *mesh)
{
    for (size_t k = 0; k < mesh->n_on_lines; ++k)
        if (mesh->on_line[k].point != mesh->n_boundary + k)
            return false;
    return true;
}

/* Makes a map without mesh and images. */
static iccp_solid_map *new_map(const icc_domain *source, const icc_domain *target,
                               const iccp_memory *memory)
{
    iccp_solid_map *map = iccp_alloc_zero(memory, 1, sizeof *map);
    if (map != NULL) {
        map->memory = *memory;
        map->stretch = iccp_cbrt(fabs(target->measure) / fabs(source->measure));
    }
    return map;
}

icc_status iccp_solid_map_relax(iccp_solid_map *map, const icc_domain *source,
                                const icc_improve_options *options, iccp_map_facts *info,
                                const iccp_env *env)
{
    const double began = iccp_seconds();
    const iccp_schedule schedule = iccp_schedule_of(options, &iccp_schedule_plain, HUGE_VAL);
    const iccp_simplicial_map simplicial = iccp_solid_simplicial(map);
    const iccp_env part = iccp_part(env, "improve", 0, 1);
    iccp_work work = iccp_work_unlimited();
    iccp_improvement improvement = {0};
    icc_status status = ICC_OK;
    info->energy = info->energy_start = iccp_simplicial_energy_at_once(&simplicial, env);
    if (options->iterations >= 0) {
        status = iccp_solid_improve(map, source, &schedule, &work, &improvement, &part);
        info->energy = improvement.energy;
        info->n_iterations = improvement.n_iterations;
    }
    info->seconds_improve = iccp_seconds() - began;
    return status;
}

/* Refines a new map with a high energy, until two refinements in turn do not halve it. Its start
 * has tetrahedra that are positive, but nearly flat, and no step can give them room, because most
 * of their corners are fixed. */
static icc_status unlock(iccp_solid_map *map, const icc_domain *source,
                         const icc_improve_options *options, iccp_map_facts *info,
                         const iccp_env *env)
{
    const iccp_map_facts first = *info;
    size_t n_iterations = 0, n_changes = 1, n_in_vain = 0;
    double seconds = 0;
    icc_status status = ICC_OK;
    while (status == ICC_OK && n_changes > 0 && info->energy > ICCP_HIGH_ENERGY && n_in_vain < 2) {
        const double began = iccp_seconds(), before = info->energy;
        n_iterations += info->n_iterations;
        seconds += info->seconds_improve;
        status = iccp_solid_refine(map, source, true, &n_changes, env);
        seconds += iccp_seconds() - began;
        if (status == ICC_OK)
            status = iccp_solid_map_relax(map, source, options, info, env);
        n_in_vain = info->energy < 0.5 * before ? 0 : n_in_vain + 1;
    }
    info->energy_start = first.energy_start;
    info->n_iterations += n_iterations;
    info->seconds_improve += seconds;
    return status;
}

/* Takes the steps of every new map. */
static icc_status improve_new(iccp_solid_map *map, const icc_domain *source, int32_t iterations,
                              iccp_map_facts *info, const iccp_env *env)
{
    const icc_improve_options options = {
        .iterations = iterations == 0 ? ITERATIONS_OF_NEW : iterations, .levels = -1};
    const icc_status status = iccp_solid_map_relax(map, source, &options, info, env);
    return status == ICC_OK && iterations == 0 ? unlock(map, source, &options, info, env) : status;
}

icc_status iccp_solid_map_finish(iccp_solid_map *map, iccp_map_facts *info, const iccp_env *env)
{
    info->n_vertices = map->mesh->n_points;
    info->n_simplices = map->mesh->n_simplices;
    return plant(map, env);
}

icc_status iccp_solid_map_replant(iccp_solid_map *map, const iccp_env *env)
{
    iccp_facet_tree_free(&map->before, &map->memory);
    iccp_facet_tree_free(&map->after, &map->memory);
    return plant(map, env);
}

icc_status iccp_solid_map_create(iccp_solid_map **out, const icc_domain *source,
                                 const icc_domain *target, int32_t iterations, iccp_map_facts *info,
                                 const iccp_env *env)
{
    iccp_solid_map *map = new_map(source, target, &env->memory);
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){3, 1}, env);
    *out = NULL;
    if (map == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = iccp_solid_start(map, source, target, info, &part[0]);
    if (status == ICC_OK && info->n_unrepaired == 0)
        status = improve_new(map, source, iterations, info, &part[1]);
    if (status == ICC_OK && info->n_unrepaired == 0)
        status = iccp_solid_map_finish(map, info, env);
    if (status != ICC_OK || info->n_unrepaired > 0) {
        iccp_solid_map_free(map);
        return status;
    }
    *out = map;
    return ICC_OK;
}

/* ---- improving ---- */

/* The domain keeps its mesh. */
static icc_status copy_map(iccp_solid_map *copy, const iccp_solid_map *map)
{
    if (map->own != NULL)
        return iccp_solid_copy(copy, map);
    const size_t n = 3 * map->mesh->n_points;
    copy->mesh = map->mesh;
    copy->images = iccp_alloc(&copy->memory, n, sizeof *copy->images);
    if (copy->images != NULL)
        memcpy(copy->images, map->images, n * sizeof *copy->images);
    return copy->images != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

icc_status iccp_solid_map_copy(iccp_solid_map **out, const iccp_solid_map *map,
                               const icc_domain *source, const icc_domain *target,
                               const iccp_memory *memory)
{
    iccp_solid_map *copy = new_map(source, target, memory);
    const icc_status status = copy != NULL ? copy_map(copy, map) : ICC_ERR_MEMORY;
    *out = NULL;
    if (status != ICC_OK) {
        iccp_solid_map_free(copy);
        return status;
    }
    copy->way = map->way;
    *out = copy;
    return ICC_OK;
}

icc_status iccp_solid_map_improve(iccp_solid_map **out, const iccp_solid_map *map,
                                  const icc_domain *source, const icc_domain *target,
                                  const icc_improve_options *options, icc_improve_report *report,
                                  const iccp_env *env)
{
    iccp_solid_map *better;
    icc_status status = iccp_solid_map_copy(&better, map, source, target, &env->memory);
    *out = NULL;
    if (status != ICC_OK)
        return status;
    iccp_work work = iccp_schedule_work(options, source->n_facets);
    const iccp_schedule schedule = iccp_schedule_of(
        options, &iccp_schedule_plain, iccp_schedule_most(&work, map->mesh->n_simplices));
    const iccp_env part = iccp_part(env, "improve", 0, 1);
    iccp_improvement improvement = {0};
    const iccp_simplicial_map simplicial = iccp_solid_simplicial(better);
    report->energy_start = iccp_simplicial_energy_at_once(&simplicial, env);
    status = iccp_solid_improve(better, source, &schedule, &work, &improvement, &part);
    report->cancelled = status == ICC_ERR_CANCELLED;
    const iccp_env quiet = iccp_quiet(env);
    if (status == ICC_OK || status == ICC_ERR_CANCELLED)
        status = plant(better, &quiet);
    if (status != ICC_OK) {
        iccp_solid_map_free(better);
        return status;
    }
    report->energy = improvement.energy;
    report->n_iterations = improvement.n_iterations;
    report->n_simplices = better->mesh->n_simplices;
    report->n_levels = (int32_t)improvement.n_levels;
    *out = better;
    return ICC_OK;
}

/* ---- reading and writing ---- */

/* The images of the boundary are the target's vertices. */
static icc_status visit(iccp_blob *b, iccp_solid_map *map, const icc_domain *source,
                        const icc_domain *target, const iccp_env *env)
{
    const icc_status status = source->features != NULL
                                  ? iccp_solid_filling_visit(b, &map->own, source, env)
                                  : iccp_filling_visit(b, &map->own, source);
    if (status != ICC_OK)
        return status;
    if (b->reads)
        map->mesh = map->own != NULL ? map->own : source->mesh;
    iccp_blob_require(b, iccp_solid_is_ordered(map->mesh));
    const size_t n_rim = map->mesh->n_boundary, n = map->mesh->n_points - n_rim;
    iccp_blob_require(b, iccp_blob_has(b, n, 3 * ICCP_F64));
    if (b->reads)
        map->images = iccp_blob_alloc(b, map->mesh->n_points, 3 * sizeof *map->images);
    if (b->status != ICC_OK)
        return b->status;
    if (b->reads)
        memcpy(map->images, target->vertices, 3 * n_rim * sizeof *map->images);
    iccp_blob_f64(b, 3 * n, map->images + 3 * n_rim);
    return b->status;
}

/* Exact signs need that. */
static bool are_images_local(const iccp_solid_map *map)
{
    const size_t n_rim = map->mesh->n_boundary, n = map->mesh->n_points - n_rim;
    return iccp_are_local(3, 3 * n, map->images + 3 * n_rim);
}

icc_status iccp_solid_map_visit(iccp_blob *b, iccp_solid_map **map, const icc_domain *source,
                                const icc_domain *target, iccp_map_facts *info, const iccp_env *env)
{
    if (!b->reads)
        return visit(b, *map, source, target, env);
    *map = NULL;
    if (source->mesh == NULL)
        return ICC_ERR_FORMAT;
    iccp_solid_map *read = new_map(source, target, &env->memory);
    if (read == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = visit(b, read, source, target, env);
    if (status == ICC_OK && !are_images_local(read))
        status = ICC_ERR_FORMAT;
    if (status == ICC_OK)
        status = plant(read, env);
    if (status != ICC_OK) {
        iccp_solid_map_free(read);
        return status;
    }
    info->n_vertices = read->mesh->n_points;
    info->n_simplices = read->mesh->n_simplices;
    *map = read;
    return ICC_OK;
}

void iccp_solid_map_free(iccp_solid_map *map)
{
    if (map == NULL)
        return;
    const iccp_memory memory = map->memory;
    iccp_facet_tree_free(&map->before, &memory);
    iccp_facet_tree_free(&map->after, &memory);
    iccp_simplices_free(map->own);
    iccp_free(&memory, map->images);
    iccp_free(&memory, map);
}

/* The corners of a simplex before or after the map. */
static void set_corners(const iccp_solid_map *map, bool after, uint32_t t, const double *corner[4])
{
    const double *points = after ? map->images : map->mesh->points;
    for (size_t k = 0; k < 4; ++k)
        corner[k] = points + 3 * map->mesh->corners[4 * (size_t)t + k];
}

/* Computes barycentric coordinates. Returns the least one. */
static double barycentric(const double *const corner[4], const double *point, double *bary)
{
    double edge[3][3], normal[3], from[3], least = HUGE_VAL, det = 0;
    for (size_t k = 0; k < 3; ++k) {
        from[k] = point[k] - corner[0][k];
        for (size_t e = 0; e < 3; ++e)
            edge[e][k] = corner[e + 1][k] - corner[0][k];
    }
    bary[0] = 1;
    for (size_t e = 0; e < 3; ++e) {
        iccp_vec_cross(edge[(e + 1) % 3], edge[(e + 2) % 3], normal);
        det = e == 0 ? iccp_vec_dot(3, edge[0], normal) : det;
        bary[e + 1] = iccp_vec_dot(3, from, normal) / det;
        bary[0] -= bary[e + 1];
    }
    for (size_t k = 0; k < 4; ++k)
        least = bary[k] < least ? bary[k] : least;
    return least;
}

/* Finds the simplex that contains a point, or, up to rounding, the one that it is least outside
 * of. */
static bool find(const iccp_solid_map *map, bool inverse, const double *point, uint32_t *simplex,
                 double *bary)
{
    double box[6] = {point[0], point[1], point[2], point[0], point[1], point[2]};
    double best = -ROUNDING, tried[4];
    iccp_facet_query query;
    uint32_t t;
    bool found = false;
    iccp_facet_query_start(&query, inverse ? &map->after : &map->before, box);
    while (best < 0 && iccp_facet_query_next(&query, &t)) {
        const double *corner[4];
        set_corners(map, inverse, t, corner);
        const double least = barycentric(corner, point, tried);
        if (!(least > best))
            continue;
        found = true;
        best = least;
        *simplex = t;
        memcpy(bary, tried, sizeof tried);
    }
    return found;
}

icc_status iccp_solid_map_point(const iccp_solid_map *map, bool inverse, const double *point,
                                double *image, double *jacobian)
{
    uint32_t simplex;
    double bary[4];
    const double *from[4], *to[4];
    if (!find(map, inverse, point, &simplex, bary))
        return ICC_ERR_TRACE;
    set_corners(map, inverse, simplex, from);
    set_corners(map, !inverse, simplex, to);
    for (size_t k = 0; k < 3; ++k)
        image[k] = to[0][k] + (bary[1] * (to[1][k] - to[0][k]) + bary[2] * (to[2][k] - to[0][k]) +
                               bary[3] * (to[3][k] - to[0][k]));
    /* A vertex goes to its image exactly. */
    for (size_t v = 0; v < 4; ++v)
        if (from[v][0] == point[0] && from[v][1] == point[1] && from[v][2] == point[2])
            memcpy(image, to[v], 3 * sizeof *image);
    if (jacobian != NULL) {
        const iccp_simplicial_map simplicial = iccp_simplicial_map_of(map->mesh, map->images);
        iccp_simplicial_jacobian(&simplicial, inverse, simplex, jacobian);
    }
    return ICC_OK;
}

/* The object, and how a new one is made: one mesh, placed on both sides.
 *
 * Meshes are tried in this order: the source's own, the target's own, the cells of the source's
 * mask, those of the target's, and cones. For the first four a place is known on one side. On the
 * other, inner vertices follow the affine map that fits the boundary best, and are then untangled.
 * The cone's vertex goes to a point of the kernel on both sides. If there is none, the cone gets
 * collars, whose vertices are untangled on both sides. */
#include "map/higher/higher_map.h"

#include "base/clock.h"
#include "base/error.h"
#include "domain/domain_file.h"
#include "map/energy/affine.h"
#include "map/energy/schedule.h"
#include "map/higher/fill_higher.h"
#include "map/higher/kernel_point.h"
#include "map/higher/relocate.h"
#include "math/elementary.h"
#include "math/inverse.h"
#include "math/vec.h"

#include <math.h>
#include <string.h>

enum { MAX = ICC_MAX_DIM };

static icc_status plant(iccp_higher_map *map, const iccp_env *env)
{
    const iccp_simplices *mesh = map->mesh;
    iccp_facet_tree_create_solid(&map->before, mesh->dim, mesh->points, mesh->n_simplices,
                                 mesh->corners, &env->memory);
    iccp_facet_tree_create_solid(&map->after, mesh->dim, map->images, mesh->n_simplices,
                                 mesh->corners, &env->memory);
    return map->before.boxes != NULL && map->after.boxes != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

icc_status iccp_higher_map_replant(iccp_higher_map *map, const iccp_env *env)
{
    iccp_facet_tree_free(&map->before, &map->memory);
    iccp_facet_tree_free(&map->after, &map->memory);
    return plant(map, env);
}

/* Makes a map without mesh and images. */
static iccp_higher_map *new_map(const icc_domain *source, const icc_domain *target,
                                const iccp_memory *memory)
{
    iccp_higher_map *map = iccp_alloc_zero(memory, 1, sizeof *map);
    if (map != NULL) {
        map->memory = *memory;
        map->stretch =
            iccp_pow(fabs(target->measure) / fabs(source->measure), 1.0 / (double)source->dim);
    }
    return map;
}

void iccp_higher_map_free(iccp_higher_map *map)
{
    if (map == NULL)
        return;
    const iccp_memory memory = map->memory;
    iccp_facet_tree_free(&map->before, &memory);
    iccp_facet_tree_free(&map->after, &memory);
    iccp_simplices_free(map->mesh);
    iccp_free(&memory, map->images);
    iccp_free(&memory, map);
}

/* ---- one mesh, placed twice ---- */

/* Gives a mesh images whose boundary is that of a domain. The inside is not written. */
static icc_status bound(iccp_higher_map *map, const icc_domain *target)
{
    const iccp_simplices *mesh = map->mesh;
    map->images = iccp_alloc_zero(&map->memory, mesh->n_points, mesh->dim * sizeof *map->images);
    if (map->images == NULL)
        return ICC_ERR_MEMORY;
    memcpy(map->images, target->vertices, mesh->dim * mesh->n_boundary * sizeof *map->images);
    return ICC_OK;
}

/* Images of inner vertices by the affine map that fits the boundary best. */
static void start(const iccp_simplicial_map *map)
{
    iccp_affine affine;
    (void)iccp_affine_fit(&affine, map);
    for (size_t v = map->n_fixed; v < map->n_points; ++v) {
        double *image = map->images + map->dim * v;
        iccp_affine_apply(&affine, map->points + map->dim * v, image);
        iccp_simplicial_round(map->dim, image);
    }
}

/* Moves inner images until all simplices are positive, if that is possible. */
static icc_status settle(const iccp_higher_map *map, double edge, iccp_work *work, size_t *n_left,
                         const iccp_env *env)
{
    const iccp_simplicial_map simplicial = iccp_higher_simplicial(map);
    iccp_stars stars;
    icc_status status = iccp_stars_create(&stars, map->mesh, &env->memory);
    if (status != ICC_OK)
        return status;
    status = iccp_relocate_untangle(&simplicial, &stars, edge, work, n_left, env);
    iccp_stars_free(&stars, &env->memory);
    return status;
}

/* Takes a mesh that is positive on one side, and finds its place on the other. */
static icc_status place(iccp_higher_map *map, const icc_domain *other, iccp_map_facts *info,
                        const iccp_env *env)
{
    iccp_work work = iccp_work_unlimited();
    icc_status status = bound(map, other);
    const iccp_simplicial_map simplicial = iccp_higher_simplicial(map);
    if (status != ICC_OK)
        return status;
    start(&simplicial);
    info->n_inverted = info->n_unrepaired = iccp_simplicial_count_at_once(&simplicial, env);
    if (info->n_unrepaired == 0 || iccp_simplicial_is_hopeless(&simplicial))
        return ICC_OK;
    return settle(map, 0, &work, &info->n_unrepaired, env);
}

/* Exchanges both sides. */
static void invert(iccp_higher_map *map)
{
    double *points = map->mesh->points;
    map->mesh->points = map->images;
    map->images = points;
    map->stretch = 1 / map->stretch;
}

/* Frees the mesh and the images, for another try. */
static void clear(iccp_higher_map *map)
{
    iccp_simplices_free(map->mesh);
    iccp_free(&map->memory, map->images);
    map->mesh = NULL;
    map->images = NULL;
}

/* Where the layers of a cone with collars begin: evenly spaced on the way to the apex. */
static void place_layers(const iccp_simplices *mesh, size_t n_collars, double *points)
{
    const size_t n = mesh->dim * mesh->n_boundary;
    const double *apex = points + n * (n_collars + 1);
    for (size_t k = 1; k <= n_collars; ++k)
        for (size_t i = 0; i < n; ++i)
            points[n * k + i] =
                points[i] + (double)k / (double)(n_collars + 1) * (apex[i % mesh->dim] - points[i]);
}

/* The edge length of regular simplices with the volume of a domain in all. */
static double regular_edge(const icc_domain *domain, size_t n_simplices)
{
    const size_t n = (size_t)domain->dim;
    double volume = sqrt((double)(n + 1) / (double)((size_t)1 << n));
    for (size_t k = 2; k <= n; ++k)
        volume /= (double)k;
    return iccp_pow(fabs(domain->measure) / (volume * (double)n_simplices), 1.0 / (double)n);
}

/* Finds the place of a cone in a domain: the apex goes to the kernel if there is one. Layers are
 * untangled, compared with regular simplices. */
static icc_status place_cone(const iccp_higher_map *map, double *points, const icc_domain *domain,
                             size_t n_collars, iccp_work *work, size_t *n_left, const iccp_env *env)
{
    const iccp_simplices *mesh = map->mesh;
    const iccp_higher_map placed = {
        .memory = map->memory, .mesh = map->mesh, .images = points, .stretch = 1};
    const iccp_simplicial_map simplicial = iccp_higher_simplicial(&placed);
    const icc_status status =
        iccp_kernel_point(domain, points + mesh->dim * (mesh->n_points - 1), env);
    if (status != ICC_OK)
        return status;
    place_layers(mesh, n_collars, points);
    iccp_simplicial_round(mesh->dim * (mesh->n_points - mesh->n_boundary),
                          points + mesh->dim * mesh->n_boundary);
    *n_left = iccp_simplicial_count_at_once(&simplicial, env);
    return n_collars > 0
               ? settle(&placed, regular_edge(domain, mesh->n_simplices), work, n_left, env)
               : ICC_OK;
}

/* Tries a cone with collars on both sides. */
static icc_status try_cone(iccp_higher_map *map, const icc_domain *const domains[2],
                           size_t n_collars, iccp_work *work, iccp_map_facts *info,
                           const iccp_env *env)
{
    clear(map);
    icc_status status = iccp_fill_cone(&map->mesh, domains[0], n_collars, env);
    if (status == ICC_OK)
        status = bound(map, domains[1]);
    if (status == ICC_OK)
        status = place_cone(map, map->mesh->points, domains[0], n_collars, work,
                            &info->n_unrepaired, env);
    if (status == ICC_OK && info->n_unrepaired == 0)
        status =
            place_cone(map, map->images, domains[1], n_collars, work, &info->n_unrepaired, env);
    return status;
}

/* Tries cones with more and more collars, as long as there is work for a sweep. */
static icc_status try_cones(iccp_higher_map *map, const icc_domain *const domains[2],
                            iccp_map_facts *info, const iccp_env *env)
{
    const size_t n = domains[0]->n_facets, dim = (size_t)domains[0]->dim;
    iccp_work work = iccp_allow(n).search;
    icc_status status = try_cone(map, domains, 0, &work, info, env);
    for (size_t k = 1;
         status == ICC_OK && info->n_unrepaired > 0 && iccp_work_fits(&work, (k * dim + 1) * n);
         ++k)
        status = try_cone(map, domains, k, &work, info, env);
    return status;
}

/* Tries the mesh that is known on one side: the domain's own, or the cells of its mask. */
static icc_status try_side(iccp_higher_map *map, const icc_domain *const domains[2], int side,
                           bool cells, iccp_map_facts *info, const iccp_env *env)
{
    const icc_domain *known = domains[side];
    icc_status status = ICC_OK;
    clear(map);
    if (cells ? known->mask != NULL : known->mesh != NULL)
        status = cells ? iccp_fill_mask(&map->mesh, known, env)
                       : iccp_simplices_copy(&map->mesh, known->mesh, &map->memory);
    if (status != ICC_OK || map->mesh == NULL)
        return status;
    if (side == 1)
        map->stretch = 1 / map->stretch;
    status = place(map, domains[1 - side], info, env);
    if (status == ICC_OK && side == 1)
        invert(map);
    return status;
}

/* True if each vertex has facets. Others would belong to no simplex. */
static icc_status check_vertices(const icc_domain *domain, bool *all_used, const iccp_env *env)
{
    const size_t dim = (size_t)domain->dim;
    bool *used = iccp_alloc_zero(&env->memory, domain->n_vertices, sizeof *used);
    if (used == NULL)
        return ICC_ERR_MEMORY;
    for (size_t i = 0; i < dim * domain->n_facets; ++i)
        used[domain->facets[i]] = true;
    *all_used = true;
    for (size_t v = 0; v < domain->n_vertices; ++v)
        *all_used = *all_used && used[v];
    iccp_free(&env->memory, used);
    return ICC_OK;
}

/* Finds a mesh and its places. */
static icc_status find(iccp_higher_map *map, const icc_domain *source, const icc_domain *target,
                       iccp_map_facts *info, const iccp_env *env)
{
    const icc_domain *const domains[2] = {source, target};
    bool all_used;
    info->n_unrepaired = SIZE_MAX;
    icc_status status = check_vertices(source, &all_used, env);
    if (status != ICC_OK || !all_used)
        return status;
    for (int k = 0; k < 4 && status == ICC_OK && info->n_unrepaired > 0; ++k)
        status = try_side(map, domains, k % 2, k >= 2, info, env);
    if (status != ICC_OK || info->n_unrepaired == 0)
        return status;
    const size_t fewest = info->n_unrepaired;
    status = try_cones(map, domains, info, env);
    if (info->n_unrepaired > fewest)
        info->n_unrepaired = fewest;
    return status;
}

static icc_status improve(const iccp_higher_map *map, const icc_improve_options *options,
                          iccp_work *work, iccp_improvement *improvement, const iccp_env *env)
{
    const iccp_schedule schedule = iccp_schedule_of(options, &iccp_schedule_plain, HUGE_VAL);
    const iccp_descent descent = {.iterations = schedule.iterations,
                                  .tolerance = schedule.tolerance};
    const iccp_simplicial_map simplicial = iccp_higher_simplicial(map);
    iccp_stars stars;
    icc_status status = iccp_stars_create(&stars, map->mesh, &env->memory);
    if (status != ICC_OK)
        return status;
    status = iccp_relocate_improve(&simplicial, &stars, &descent, work, improvement, env);
    iccp_stars_free(&stars, &env->memory);
    return status;
}

/* Improves a new map and makes its points findable. */
static icc_status finish(iccp_higher_map *map, int32_t iterations, iccp_map_facts *info,
                         const iccp_env *env)
{
    const double began = iccp_seconds();
    const icc_improve_options options = {.iterations = iterations};
    const iccp_simplicial_map simplicial = iccp_higher_simplicial(map);
    iccp_work work = iccp_work_unlimited();
    iccp_improvement improvement = {0};
    icc_status status = ICC_OK;
    info->energy = info->energy_start = iccp_simplicial_energy_at_once(&simplicial, env);
    if (iterations >= 0) {
        status = improve(map, &options, &work, &improvement, env);
        info->energy = improvement.energy;
        info->n_iterations = improvement.n_iterations;
    }
    info->seconds_improve = iccp_seconds() - began;
    info->n_vertices = map->mesh->n_points;
    info->n_simplices = map->mesh->n_simplices;
    return status == ICC_OK ? plant(map, env) : status;
}

/* Ends the making of a map: hands it out if all its simplices are positive. */
static icc_status conclude(iccp_higher_map **out, iccp_higher_map *map, icc_status status,
                           int32_t iterations, iccp_map_facts *info, const iccp_env *env)
{
    if (status == ICC_OK && info->n_unrepaired == 0)
        status = finish(map, iterations, info, env);
    if (status == ICC_OK && info->n_unrepaired == 0)
        *out = map;
    else
        iccp_higher_map_free(map);
    return status;
}

icc_status iccp_higher_map_create(iccp_higher_map **out, const icc_domain *source,
                                  const icc_domain *target, int32_t iterations,
                                  iccp_map_facts *info, const iccp_env *env)
{
    const double began = iccp_seconds();
    iccp_higher_map *map = new_map(source, target, &env->memory);
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){3, 1}, env);
    *out = NULL;
    if (map == NULL)
        return ICC_ERR_MEMORY;
    const icc_status status = find(map, source, target, info, &part[0]);
    info->seconds_repair = iccp_seconds() - began;
    return conclude(out, map, status, iterations, info, &part[1]);
}

/* ---- from a map ---- */

static icc_status copy_map(iccp_higher_map **out, const iccp_higher_map *map,
                           const icc_domain *source, const icc_domain *target,
                           const iccp_memory *memory)
{
    const size_t n = map->mesh->dim * map->mesh->n_points;
    iccp_higher_map *copy = *out = new_map(source, target, memory);
    if (copy == NULL)
        return ICC_ERR_MEMORY;
    const icc_status status = iccp_simplices_copy(&copy->mesh, map->mesh, memory);
    copy->images = iccp_alloc(memory, n, sizeof *copy->images);
    if (status == ICC_OK && copy->images != NULL) {
        memcpy(copy->images, map->images, n * sizeof *copy->images);
        return ICC_OK;
    }
    iccp_higher_map_free(copy);
    *out = NULL;
    return ICC_ERR_MEMORY;
}

icc_status iccp_higher_map_improve(iccp_higher_map **out, const iccp_higher_map *map,
                                   const icc_domain *source, const icc_domain *target,
                                   const icc_improve_options *options, icc_improve_report *report,
                                   const iccp_env *env)
{
    iccp_higher_map *better;
    icc_status status = copy_map(&better, map, source, target, &env->memory);
    *out = NULL;
    if (status != ICC_OK)
        return status;
    const iccp_simplicial_map simplicial = iccp_higher_simplicial(better);
    iccp_work work = iccp_schedule_work(options, source->n_facets);
    iccp_improvement improvement = {0};
    report->energy_start = iccp_simplicial_energy_at_once(&simplicial, env);
    status = improve(better, options, &work, &improvement, env);
    report->cancelled = status == ICC_ERR_CANCELLED;
    const iccp_env quiet = iccp_quiet(env);
    if (status == ICC_OK || status == ICC_ERR_CANCELLED)
        status = plant(better, &quiet);
    if (status != ICC_OK) {
        iccp_higher_map_free(better);
        return status;
    }
    report->energy = improvement.energy;
    report->n_iterations = improvement.n_iterations;
    report->n_simplices = better->mesh->n_simplices;
    *out = better;
    return ICC_OK;
}

icc_status iccp_higher_map_follow(iccp_higher_map **out, const iccp_higher_map *map,
                                  const icc_domain *source, const icc_domain *old_target,
                                  const icc_domain *target, int32_t iterations,
                                  iccp_map_facts *info, const iccp_env *env)
{
    const double began = iccp_seconds();
    iccp_higher_map *next;
    iccp_work work = iccp_work_unlimited();
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 1}, env);
    icc_status status = copy_map(&next, map, source, target, &env->memory);
    *out = NULL;
    if (status != ICC_OK)
        return status;
    const iccp_simplices *mesh = next->mesh;
    iccp_frame_change(&old_target->frame, &target->frame, (int32_t)mesh->dim, mesh->n_points,
                      next->images);
    iccp_simplicial_round(mesh->dim * mesh->n_points, next->images);
    memcpy(next->images, target->vertices, mesh->dim * mesh->n_boundary * sizeof *next->images);
    status = settle(next, 0, &work, &info->n_unrepaired, &part[0]);
    info->seconds_repair = iccp_seconds() - began;
    return conclude(out, next, status, iterations, info, &part[1]);
}

/* ---- reading and writing ---- */

/* The images of the boundary are the target's vertices. */
static icc_status visit(iccp_blob *b, iccp_higher_map *map, const icc_domain *source,
                        const icc_domain *target)
{
    icc_status status = iccp_filling_visit(b, &map->mesh, source);
    if (status == ICC_OK && map->mesh == NULL)
        status = ICC_ERR_FORMAT;
    if (status != ICC_OK)
        return status;
    const size_t dim = map->mesh->dim, n_rim = map->mesh->n_boundary;
    const size_t n = map->mesh->n_points - n_rim;
    iccp_blob_require(b, iccp_blob_has(b, n, dim * ICCP_F64));
    if (b->reads)
        map->images = iccp_blob_alloc(b, map->mesh->n_points, dim * sizeof *map->images);
    if (b->status != ICC_OK)
        return b->status;
    if (b->reads)
        memcpy(map->images, target->vertices, dim * n_rim * sizeof *map->images);
    iccp_blob_f64(b, dim * n, map->images + dim * n_rim);
    if (b->reads && b->status == ICC_OK && !iccp_are_local(dim, dim * n, map->images + dim * n_rim))
        return ICC_ERR_FORMAT;
    return b->status;
}

icc_status iccp_higher_map_visit(iccp_blob *b, iccp_higher_map **map, const icc_domain *source,
                                 const icc_domain *target, iccp_map_facts *info,
                                 const iccp_env *env)
{
    if (!b->reads)
        return visit(b, *map, source, target);
    iccp_higher_map *read = new_map(source, target, &env->memory);
    *map = NULL;
    if (read == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = visit(b, read, source, target);
    if (status == ICC_OK)
        status = plant(read, env);
    if (status != ICC_OK) {
        iccp_higher_map_free(read);
        return status;
    }
    info->n_vertices = read->mesh->n_points;
    info->n_simplices = read->mesh->n_simplices;
    *map = read;
    return ICC_OK;
}

/* ---- mapping points ---- */

/* The corners of a simplex before or after the map. */
static void set_corners(const iccp_higher_map *map, bool after, uint32_t simplex,
                        const double *corner[MAX + 1])
{
    const size_t dim = map->mesh->dim;
    const double *points = after ? map->images : map->mesh->points;
    for (size_t k = 0; k <= dim; ++k)
        corner[k] = points + dim * map->mesh->corners[(dim + 1) * (size_t)simplex + k];
}

/* Computes barycentric coordinates. Returns the least one. */
static double barycentric(size_t dim, const double *const *corner, const double *point,
                          double *bary)
{
    double edge[MAX * MAX], inverse[MAX * MAX], from[MAX], determinant, least = HUGE_VAL;
    for (size_t k = 0; k < dim; ++k) {
        from[k] = point[k] - corner[0][k];
        for (size_t e = 0; e < dim; ++e)
            edge[dim * k + e] = corner[e + 1][k] - corner[0][k];
    }
    if (!iccp_invert(dim, edge, inverse, &determinant))
        return -HUGE_VAL;
    bary[0] = 1;
    for (size_t e = 0; e < dim; ++e) {
        bary[e + 1] = iccp_vec_dot(dim, inverse + dim * e, from);
        bary[0] -= bary[e + 1];
    }
    for (size_t k = 0; k <= dim; ++k)
        least = bary[k] < least ? bary[k] : least;
    return least;
}

/* Finds the simplex that contains a point, or, up to rounding, the one that it is least outside
 * of. */
static bool locate(const iccp_higher_map *map, bool inverse, const double *point, uint32_t *simplex,
                   double *bary)
{
    const size_t dim = map->mesh->dim;
    double box[2 * MAX], best = -HUGE_VAL, tried[MAX + 1];
    iccp_facet_query query;
    uint32_t s;
    bool found = false;
    for (size_t k = 0; k < dim; ++k)
        box[k] = box[dim + k] = point[k];
    iccp_facet_query_start(&query, inverse ? &map->after : &map->before, box);
    while (best < 0 && iccp_facet_query_next(&query, &s)) {
        const double *corner[MAX + 1];
        set_corners(map, inverse, s, corner);
        const double least = barycentric(dim, corner, point, tried);
        if (!(least > best))
            continue;
        found = true;
        best = least;
        *simplex = s;
        memcpy(bary, tried, sizeof tried);
    }
    return found;
}

icc_status iccp_higher_map_point(const iccp_higher_map *map, bool inverse, const double *point,
                                 double *image, double *jacobian)
{
    const size_t dim = map->mesh->dim;
    uint32_t simplex;
    double bary[MAX + 1];
    const double *to[MAX + 1];
    if (!locate(map, inverse, point, &simplex, bary))
        return ICC_ERR_TRACE;
    set_corners(map, !inverse, simplex, to);
    for (size_t k = 0; k < dim; ++k) {
        double sum = 0;
        for (size_t i = 1; i <= dim; ++i)
            sum += bary[i] * (to[i][k] - to[0][k]);
        image[k] = to[0][k] + sum;
    }
    if (jacobian != NULL) {
        const iccp_simplicial_map simplicial = iccp_simplicial_map_of(map->mesh, map->images);
        iccp_simplicial_jacobian(&simplicial, inverse, simplex, jacobian);
    }
    return ICC_OK;
}

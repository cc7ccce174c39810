/* Checks the arguments of the map functions. */
#include "api/check.h"
#include "base/error.h"
#include "base/options.h"
#include "domain/features.h"
#include "map/apply.h"
#include "map/certify.h"
#include "map/map_file.h"
#include "map/rounded.h"

#include <stddef.h>
#include <string.h>

ICCP_END(map)

static icc_status read_options(icc_map_options *full, const icc_map_options *options,
                               icc_error *err)
{
    const icc_status status = iccp_read_struct(full, sizeof *full, options, "icc_map_options", err);
    if (status == ICC_OK && full->iterations < -1)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_map_options.iterations is %ld; it must be at least -1",
                         (long)full->iterations);
    if (status == ICC_OK && (full->slide < ICC_SLIDE_NONE || full->slide > ICC_SLIDE_ALL))
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_map_options.slide is %ld; it must be 0, 1 or 2", (long)full->slide);
    if (status == ICC_OK && full->slide != ICC_SLIDE_NONE && full->iterations < 0)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_map_options.iterations is -1, but vertices slide only if the map is "
                         "improved");
    return status;
}

static icc_status create(icc_map **out, const icc_domain *source, const icc_domain *target,
                         const icc_map_options *options, const iccp_env *env, icc_error *err)
{
    icc_map_options full;
    icc_chart_options chart;
    icc_status status = read_options(&full, options, err);
    if (status == ICC_OK)
        status = iccp_read_chart_options(&chart, full.chart, source->dim, err);
    if (status == ICC_OK)
        status = iccp_check_maximum(full.target_maximum, target->dim, err);
    if (status == ICC_OK && chart.method == ICC_METHOD_DISC && full.target_maximum != NULL)
        status = iccp_fail(err, ICC_ERR_ARGUMENT,
                           "method disc has its own maximum: icc_map_options.target_maximum must "
                           "be NULL");
    if (status != ICC_OK)
        return status;
    icc_chart_options charts[2] = {chart, chart};
    charts[1].maximum = full.target_maximum;
    return iccp_map_create(out, source, target, &full, charts, env, err);
}

icc_status icc_map_create(icc_map **out, const icc_domain *source, const icc_domain *target,
                          const icc_map_options *options, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    const char *missing = out == NULL      ? "out"
                          : source == NULL ? "source"
                          : target == NULL ? "target"
                                           : NULL;
    iccp_env full;
    const icc_status status = iccp_begin(&full, env, missing, err);
    if (status != ICC_OK)
        return status;
    return iccp_end_map(create(out, source, target, options, &full, err), out, &full, err);
}

/* Creates a map of two polygons. Their domains take the first 5 % of the progress. */
static icc_status create_from_polygons(icc_map **out, size_t n, const double *const vertices[2],
                                       const iccp_env *env, icc_error *err)
{
    icc_domain *domains[2] = {NULL, NULL};
    icc_status status = ICC_OK;
    for (int side = 0; side < 2 && status == ICC_OK; side++) {
        const iccp_env part = iccp_part(env, NULL, side * 0.025, (side + 1) * 0.025);
        status = iccp_domain_create(&domains[side], 2, n, vertices[side], 0, NULL, &part, err);
        if (status != ICC_OK)
            iccp_fail_side(err, status, side + 1);
    }
    const iccp_env rest = iccp_part(env, NULL, 0.05, 1);
    if (status == ICC_OK)
        status = create(out, domains[0], domains[1], NULL, &rest, err);
    iccp_domain_release(domains[0]);
    iccp_domain_release(domains[1]);
    return status;
}

icc_status icc_map_create_polygons(icc_map **out, size_t n, const double *before,
                                   const double *after, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    const char *missing = out == NULL      ? "out"
                          : before == NULL ? "before"
                          : after == NULL  ? "after"
                                           : NULL;
    const double *const vertices[2] = {before, after};
    iccp_env full;
    icc_status status = iccp_begin(&full, env, missing, err);
    if (status == ICC_OK && n > ICCP_MAX_COUNT)
        status = iccp_fail(err, ICC_ERR_ARGUMENT, "%zu vertices are too many; at most %zu", n,
                           ICCP_MAX_COUNT);
    if (status != ICC_OK)
        return status;
    return iccp_end_map(create_from_polygons(out, n, vertices, &full, err), out, &full, err);
}

icc_status icc_map_create_from_charts(icc_map **out, const icc_chart *source,
                                      const icc_chart *target, const icc_map_options *options,
                                      const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    const char *missing = out == NULL      ? "out"
                          : source == NULL ? "source"
                          : target == NULL ? "target"
                                           : NULL;
    iccp_env full_env;
    icc_map_options full;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status == ICC_OK)
        status = read_options(&full, options, err);
    return status == ICC_OK ? iccp_end_map(iccp_map_create_from_charts(out, source, target, &full,
                                                                       &full_env, err),
                                           out, &full_env, err)
                            : status;
}

void icc_map_free(icc_map *map)
{
    iccp_map_release(map);
}

icc_status icc_map_get_info(const icc_map *map, icc_map_info *info)
{
    ICCP_ENTER;
    if (map == NULL || info == NULL)
        return ICC_ERR_ARGUMENT;
    const iccp_map_facts *f = &map->info;
    const iccp_features *features = map->source_domain->features;
    const icc_map_info full = {.dim = f->dim,
                               .kind = f->kind,
                               .certified = f->certified,
                               .reason = f->reason,
                               .reason_side = f->reason_side,
                               .class_kept = f->class_kept,
                               .n_vertices = f->n_vertices,
                               .n_simplices = f->n_simplices,
                               .energy = f->energy,
                               .n_holes = features != NULL ? features->n_holes : 0,
                               .n_lines = features != NULL ? features->n_lines : 0,
                               .n_points = features != NULL ? features->n_points : 0,
                               .n_ties = f->n_ties,
                               .detour = f->detour,
                               .n_slid = f->n_slid};
    return iccp_write_struct(info, &full, sizeof full, "icc_map_info", NULL);
}

icc_status icc_map_get_report(const icc_map *map, icc_map_report *report)
{
    ICCP_ENTER;
    if (map == NULL || report == NULL)
        return ICC_ERR_ARGUMENT;
    const iccp_map_facts *f = &map->info;
    icc_map_report full = {.seconds = f->seconds,
                           .seconds_repair = f->seconds_repair,
                           .seconds_improve = f->seconds_improve,
                           .seconds_certify = f->seconds_certify,
                           .energy_start = f->energy_start,
                           .n_inverted = f->n_inverted,
                           .n_unrepaired = f->n_unrepaired,
                           .n_iterations = f->n_iterations,
                           .n_levels = f->n_levels,
                           .n_trees = f->n_trees,
                           .n_samples = f->n_samples,
                           .n_lost = f->n_lost,
                           .n_flat = f->n_flat};
    if (report->size > offsetof(icc_map_report, n_spoilt))
        full.n_spoilt = iccp_map_count_spoilt(map);
    return iccp_write_struct(report, &full, sizeof full, "icc_map_report", NULL);
}

icc_status icc_map_get_tie(const icc_map *map, size_t tie, icc_tie_info *info, double *source,
                           double *target)
{
    ICCP_ENTER;
    if (map == NULL || info == NULL)
        return ICC_ERR_ARGUMENT;
    icc_tie_info full;
    const icc_status status = iccp_map_get_tie(map, tie, &full, target);
    (void)source; /* the source's ties are straight, so they have no bends */
    if (status != ICC_OK)
        return status;
    return iccp_write_struct(info, &full, sizeof full, "icc_tie_info", NULL);
}

const icc_chart *icc_map_source_chart(const icc_map *map)
{
    return map != NULL ? map->source : NULL;
}

const icc_chart *icc_map_target_chart(const icc_map *map)
{
    return map != NULL ? map->target : NULL;
}

static icc_status apply(const icc_map *map, bool inverse, size_t n, const double *points,
                        double *images, icc_status *status, size_t *n_failed, const icc_env *env)
{
    if (map == NULL || (n > 0 && (points == NULL || images == NULL)))
        return ICC_ERR_ARGUMENT;
    iccp_env full_env;
    const icc_status read = iccp_env_read(&full_env, env, NULL);
    return read == ICC_OK ? iccp_finish(&full_env, iccp_map_apply(map, inverse, n, points, images,
                                                                  status, n_failed, &full_env))
                          : read;
}

icc_status icc_map_apply(const icc_map *map, size_t n, const double *points, double *images,
                         icc_status *status, size_t *n_failed, const icc_env *env)
{
    ICCP_ENTER;
    return apply(map, false, n, points, images, status, n_failed, env);
}

icc_status icc_map_apply_inverse(const icc_map *map, size_t n, const double *points, double *images,
                                 icc_status *status, size_t *n_failed, const icc_env *env)
{
    ICCP_ENTER;
    return apply(map, true, n, points, images, status, n_failed, env);
}

icc_status icc_map_jacobian(const icc_map *map, size_t n, const double *points, double *jacobians,
                            icc_status *status, size_t *n_failed, const icc_env *env)
{
    ICCP_ENTER;
    if (map == NULL || (n > 0 && (points == NULL || jacobians == NULL)))
        return ICC_ERR_ARGUMENT;
    iccp_env full_env;
    const icc_status read = iccp_env_read(&full_env, env, NULL);
    return read == ICC_OK ? iccp_finish(&full_env, iccp_map_jacobian(map, n, points, jacobians,
                                                                     status, n_failed, &full_env))
                          : read;
}

static icc_status read_improve_options(icc_improve_options *full,
                                       const icc_improve_options *options, icc_error *err)
{
    const icc_status status =
        iccp_read_struct(full, sizeof *full, options, "icc_improve_options", err);
    if (status != ICC_OK)
        return status;
    if (full->iterations < 0)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_improve_options.iterations is %ld; it must not be negative",
                         (long)full->iterations);
    if (full->levels < -1)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_improve_options.levels is %ld; it must be at least -1",
                         (long)full->levels);
    if (!(full->tolerance >= 0 && full->tolerance < 1))
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_improve_options.tolerance is %g; it must lie in [0, 1)",
                         full->tolerance);
    return ICC_OK;
}

icc_status icc_map_improve(icc_map **out, const icc_map *map, const icc_improve_options *options,
                           icc_improve_report *report, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    const char *missing = out == NULL ? "out" : map == NULL ? "map" : NULL;
    iccp_env full_env;
    icc_improve_options full;
    icc_improve_report full_report = {0};
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status == ICC_OK)
        status = read_improve_options(&full, options, err);
    if (status == ICC_OK)
        status = iccp_map_improve(out, map, &full, &full_report, &full_env, err);
    if (status == ICC_OK && full_report.cancelled == 0)
        full_report.cancelled = iccp_finish(&full_env, ICC_OK) != ICC_OK;
    if (status != ICC_OK || report == NULL)
        return status;
    status = iccp_write_struct(report, &full_report, sizeof full_report, "icc_improve_report", err);
    if (status != ICC_OK) {
        iccp_map_release(*out);
        *out = NULL;
    }
    return status;
}

icc_status icc_map_retarget(icc_map **out, const icc_map *map, const icc_domain *target,
                            const icc_retarget_options *options, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    iccp_env full_env;
    icc_retarget_options full;
    const char *missing = out == NULL      ? "out"
                          : map == NULL    ? "map"
                          : target == NULL ? "target"
                                           : NULL;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status == ICC_OK)
        status = iccp_read_struct(&full, sizeof full, options, "icc_retarget_options", err);
    if (status == ICC_OK && full.iterations < -1)
        status = iccp_fail(err, ICC_ERR_ARGUMENT,
                           "icc_retarget_options.iterations is %ld; it must be at least -1",
                           (long)full.iterations);
    return status == ICC_OK
               ? iccp_end_map(iccp_map_retarget(out, map, target, full.iterations, &full_env, err),
                              out, &full_env, err)
               : status;
}

icc_status icc_map_get_mesh(const icc_map *map, icc_mesh *mesh, double *images)
{
    ICCP_ENTER;
    if (map == NULL || mesh == NULL)
        return ICC_ERR_ARGUMENT;
    double *vertices;
    uint32_t *cells;
    icc_status status = iccp_map_get_mesh(map, NULL, NULL, NULL); /* whether there is one */
    if (status == ICC_OK)
        status = iccp_size_mesh(&vertices, &cells, mesh, map->info.dim, map->info.n_vertices,
                                map->info.n_simplices);
    return status == ICC_OK ? iccp_map_get_mesh(map, vertices, images, cells) : status;
}

icc_status icc_map_get_regions(const icc_map *map, uint32_t *regions, icc_error *err)
{
    ICCP_ENTER;
    const char *missing = map == NULL ? "map" : regions == NULL ? "regions" : NULL;
    iccp_env none;
    icc_status status = iccp_begin(&none, NULL, missing, err);
    if (status != ICC_OK)
        return status;
    status = iccp_map_get_regions(map, regions);
    if (status == ICC_ERR_UNSUPPORTED)
        return iccp_fail(err, status, "a curve map has no mesh, so it has no regions");
    return iccp_explain(err, status);
}

/* Reads the caller's mesh for a map. */
static icc_status read_mesh(icc_mesh *mesh, const icc_map *map, const icc_mesh *given,
                            icc_error *err)
{
    const size_t dim = (size_t)map->source_domain->dim;
    const char *name = dim == 2 ? "triangle" : "tetrahedron";
    if (dim != 2 && dim != 3)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED,
                         "dim is %zu; only meshes in 2 or 3 dimensions can be mapped", dim);
    const icc_status status = iccp_read_mesh(mesh, given, err);
    if (status != ICC_OK)
        return status;
    if (mesh->dim != map->source_domain->dim)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_mesh.dim is %ld, that of the map is %zu",
                         (long)mesh->dim, dim);
    if (mesh->n_vertices <= dim || mesh->n_vertices > ICCP_MAX_COUNT)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "%zu vertices and %zu simplices", mesh->n_vertices,
                         mesh->n_cells);
    for (size_t k = 0; k < (dim + 1) * mesh->n_cells; ++k)
        if (mesh->cells[k] >= mesh->n_vertices)
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_SIMPLEX, (int64_t)(k / (dim + 1)),
                                "%s %zu has vertex %lu of %zu", name, k / (dim + 1),
                                (unsigned long)mesh->cells[k], mesh->n_vertices);
    return ICC_OK;
}

/* Carries a caller's mesh along, with or without repair. */
static icc_status carry_mesh(const icc_map *map, const icc_mesh *mesh, bool repaired,
                             double *images, icc_certificate *certificate, const icc_env *env,
                             icc_error *err)
{
    iccp_env full_env;
    icc_mesh m;
    icc_certificate full = {0};
    const char *missing = map == NULL                  ? "map"
                          : mesh == NULL               ? "mesh"
                          : repaired && images == NULL ? "images"
                          : certificate == NULL        ? "certificate"
                                                       : NULL;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status == ICC_OK)
        status = read_mesh(&m, map, mesh, err);

    if (status != ICC_OK)
        return status;
    const size_t size = (size_t)m.dim * sizeof *images;
    double *own = images != NULL ? NULL : iccp_alloc(&full_env.memory, m.n_vertices, size);
    if (images == NULL && own == NULL)
        return iccp_fail_memory(err);
    status = iccp_map_certify(map, m.n_vertices, m.vertices, m.n_cells, m.cells, repaired,
                              images != NULL ? images : own, &full, &full_env, err);
    iccp_free(&full_env.memory, own);
    if (status == ICC_OK)
        status = iccp_explain(err, iccp_finish(&full_env, ICC_OK));
    return status == ICC_OK
               ? iccp_write_struct(certificate, &full, sizeof full, "icc_certificate", err)
               : status;
}

icc_status icc_map_certify(const icc_map *map, const icc_mesh *mesh, double *images,
                           icc_certificate *certificate, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    return carry_mesh(map, mesh, false, images, certificate, env, err);
}

icc_status icc_map_repair(const icc_map *map, const icc_mesh *mesh, double *images,
                          icc_certificate *certificate, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    return carry_mesh(map, mesh, true, images, certificate, env, err);
}

icc_status icc_map_save(const icc_map *map, size_t capacity, void *data, size_t *n_bytes)
{
    ICCP_ENTER;
    if (map == NULL || n_bytes == NULL || (capacity > 0 && data == NULL))
        return ICC_ERR_ARGUMENT;
    iccp_map_save(map, capacity, data, n_bytes);
    return ICC_OK;
}

icc_status icc_map_load(icc_map **out, size_t n_bytes, const void *data, const icc_env *env,
                        icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    const char *missing = out == NULL ? "out" : data == NULL ? "data" : NULL;
    iccp_env full_env;
    const icc_status status = iccp_begin(&full_env, env, missing, err);
    return status == ICC_OK ? iccp_end_map(iccp_map_load(out, n_bytes, data, &full_env, err), out,
                                           &full_env, err)
                            : status;
}

#include "map/map_file.h"

#include "base/blob.h"
#include "base/budget.h"
#include "base/clock.h"
#include "chart/load.h"
#include "domain/domain_file.h"
#include "map/plmap_file.h"

static const char KIND[] = "MAP_";
static const uint32_t VERSION = 1;

void iccp_map_save(const icc_map *map, size_t capacity, void *data, size_t *n_bytes)
{
    const icc_map_info *info = &map->info;
    const uint32_t head[2] = {(uint32_t)info->kind, map->source != NULL};
    iccp_blob_writer w;
    iccp_blob_begin(&w, data, capacity, KIND, VERSION);
    iccp_blob_u32(&w, 2, head);
    iccp_domain_write(map->source_domain, &w);
    iccp_domain_write(map->target_domain, &w);
    if (map->source != NULL) {
        iccp_chart_write(map->source, &w);
        iccp_chart_write(map->target, &w);
    }
    iccp_blob_u64(&w, (uint64_t)info->n_levels);
    iccp_blob_u64(&w, info->n_inverted);
    iccp_blob_u64(&w, info->n_unrepaired);
    iccp_blob_u64(&w, info->n_iterations);
    iccp_blob_f64(&w, 1, &info->energy_start);
    iccp_blob_f64(&w, 1, &info->energy);
    if (map->mesh != NULL)
        iccp_plmap_write(&map->mesh->pl, &w);
    if (map->solid != NULL)
        iccp_solid_map_write(map->solid, &w);
    iccp_blob_end(&w, n_bytes);
}

/* ---- back ---- */

/* The domains, which the map then keeps. */
static icc_status read_domains(icc_map **out, iccp_blob_reader *r, const iccp_env *env)
{
    icc_domain *source = NULL, *target = NULL;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 1}, env);
    icc_status status = iccp_domain_read(&source, r, &part[0]);
    if (status == ICC_OK)
        status = iccp_domain_read(&target, r, &part[1]);
    if (status == ICC_OK)
        status = iccp_map_begin(out, source, target, env, NULL);
    iccp_domain_release(source);
    iccp_domain_release(target);
    return status;
}

static icc_status read_charts(icc_map *map, int32_t kind, iccp_blob_reader *r, const iccp_env *env,
                              icc_error *err)
{
    icc_chart *source = NULL, *target = NULL;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 1}, env);
    icc_status status = iccp_chart_read(&source, map->source_domain, r, &part[0], err);
    if (status == ICC_OK)
        status = iccp_chart_read(&target, map->target_domain, r, &part[1], err);
    if (status == ICC_OK)
        status = iccp_map_choose_kind(&kind, source, target, NULL);
    if (status == ICC_OK)
        iccp_map_add_charts(map, source, target);
    iccp_chart_release(source);
    iccp_chart_release(target);
    return status;
}

/* What tells how the map was made; nothing depends on it. */
static bool read_story(icc_map_info *info, iccp_blob_reader *r)
{
    const uint64_t n_levels = iccp_blob_read_u64(r), n_inverted = iccp_blob_read_u64(r);
    const uint64_t n_unrepaired = iccp_blob_read_u64(r), n_iterations = iccp_blob_read_u64(r);
    iccp_blob_read_f64(r, 1, &info->energy_start);
    iccp_blob_read_f64(r, 1, &info->energy);
    if (r->failed || n_levels > INT32_MAX || n_inverted > SIZE_MAX || n_unrepaired > SIZE_MAX ||
        n_iterations > SIZE_MAX)
        return false;
    info->n_levels = (int32_t)n_levels;
    info->n_inverted = (size_t)n_inverted;
    info->n_unrepaired = (size_t)n_unrepaired;
    info->n_iterations = (size_t)n_iterations;
    return true;
}

static icc_status read_plane_mesh(icc_map *map, iccp_blob_reader *r, const iccp_env *env)
{
    map->mesh = iccp_alloc_zero(&env->memory, 1, sizeof *map->mesh);
    if (map->mesh == NULL)
        return ICC_ERR_MEMORY;
    const icc_status status =
        iccp_plmap_read(&map->mesh->pl, map->source_domain, map->target_domain, r, env);
    return status == ICC_OK ? iccp_mesh_map_finish(map->mesh, &map->info, env, NULL) : status;
}

/* In space it takes charts to make one. */
static icc_status read_mesh(icc_map *map, iccp_blob_reader *r, const iccp_env *env)
{
    icc_status status = ICC_ERR_FORMAT;
    if (map->info.dim == 2)
        status = read_plane_mesh(map, r, env);
    else if (map->info.dim == 3 && map->source != NULL)
        status = iccp_solid_map_read(&map->solid, map->source_domain, map->target_domain,
                                     &map->info, r, env);
    map->info.kind = ICC_MAP_MESH;
    if (map->source == NULL)
        map->info.certified = status == ICC_OK;
    return status;
}

static icc_status read_map(icc_map **out, iccp_blob_reader *r, const iccp_env *env, icc_error *err)
{
    uint32_t head[2];
    const iccp_env whole = iccp_part(env, "load", 0, 1);
    iccp_env part[4];
    iccp_split(part, 4, (const double[]){1, 6, 2, 1}, &whole);
    iccp_blob_read_u32(r, 2, head);
    const bool has_mesh = head[0] == ICC_MAP_MESH, has_charts = head[1] == 1;
    if (!(has_mesh || head[0] == ICC_MAP_CURVES) || head[1] > 1 || !(has_mesh || has_charts))
        return ICC_ERR_FORMAT;
    icc_status status = read_domains(out, r, &part[0]);
    if (status == ICC_OK && has_charts)
        status = read_charts(*out, (int32_t)head[0], r, &part[1], err);
    if (status == ICC_OK)
        status = read_story(&(*out)->info, r) ? ICC_OK : ICC_ERR_FORMAT;
    if (status == ICC_OK && has_mesh)
        status = read_mesh(*out, r, &part[2]);
    if (status == ICC_OK)
        status = iccp_map_check_digits(*out, &part[3]);
    return status == ICC_OK && !iccp_blob_done(r) ? ICC_ERR_FORMAT : status;
}

icc_status iccp_map_load(icc_map **out, size_t n_bytes, const void *data, const iccp_env *env,
                         icc_error *err)
{
    const double start = iccp_seconds();
    iccp_blob_reader r;
    *out = NULL;
    icc_status status = iccp_blob_open(&r, data, n_bytes, KIND, VERSION, err);
    if (status != ICC_OK)
        return status;
    iccp_budget budget;
    const iccp_env limited = iccp_budget_begin(&budget, env);
    status = read_map(out, &r, &limited, err);
    if (status == ICC_OK) {
        (*out)->info.seconds = iccp_seconds() - start;
        return ICC_OK;
    }
    iccp_map_release(*out);
    *out = NULL;
    return iccp_budget_end(&budget, iccp_blob_blame(err, status, "map"), err);
}

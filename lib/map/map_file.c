/* Saves and reads maps: the domains, the charts, how the map was made, and the state of its kind. A
 * map that was read must pass its certificate again. */
#include "map/map_file.h"

#include "base/blob.h"
#include "base/budget.h"
#include "base/clock.h"
#include "domain/domain_file.h"
#include "map/compatible/plmap_file.h"
#include "map/correspondence.h"
#include "map/slide/added_vertices.h"
#include "map/slide/sliding.h"
#include "method/load.h"

static const char KIND[] = "MAP_";
/* Versions of the format: 5 for maps whose chains slide, 4 for other maps with features, 3 for maps
 * with a chart whose format came with version 2 of charts, 1 for all others. So a map is saved in
 * one way only. Version 2 was for maps with features that do not touch. */
enum {
    PLAIN_VERSION = 1,
    APART_VERSION,
    CHARTS_VERSION,
    FEATURES_VERSION = ICCP_VERSION_NETWORKS,
    SLIDING_VERSION = ICCP_VERSION_SLIDING
};

static bool has_features(const iccp_blob *b)
{
    return b->version >= FEATURES_VERSION || b->version == APART_VERSION;
}

static icc_status visit_domain(iccp_blob *b, icc_domain **domain, const iccp_env *env)
{
    if (!has_features(b))
        return iccp_domain_visit(b, domain, env);
    const icc_status status = iccp_domain_visit_any(b, domain, env);
    if (status != ICC_OK || (*domain)->features != NULL)
        return status;
    iccp_domain_release(*domain);
    *domain = NULL;
    return ICC_ERR_FORMAT;
}

/* Reads the knots along which chains slide. Begins the map between the domains with these knots. */
static icc_status read_slide(iccp_blob *b, icc_map **map, const icc_domain *source,
                             const icc_domain *target, const iccp_env *env)
{
    iccp_slide *slide = NULL;
    icc_domain *larger[2] = {NULL, NULL};
    icc_status status = iccp_check_correspondence(source, target, NULL);
    if (status == ICC_OK)
        status = iccp_slide_visit(b, &slide, source, target, &env->memory);
    for (int side = 0; side < 2 && status == ICC_OK; ++side)
        status = iccp_domain_with_knots(&larger[side], slide, side, env, NULL);
    if (status == ICC_OK)
        status = iccp_map_begin(map, larger[0], larger[1], env, NULL);
    if (status == ICC_OK)
        iccp_map_set_slide(*map, slide);
    else
        iccp_slide_free(slide);
    iccp_domain_release(larger[0]);
    iccp_domain_release(larger[1]);
    return status;
}

/* Reads or writes the domains. When it reads, it begins the map with them. */
static icc_status visit_domains(iccp_blob *b, icc_map **map, const iccp_env *env)
{
    const bool slides = b->version == SLIDING_VERSION;
    icc_domain *source = b->reads ? NULL : slides ? (*map)->slide->given[0] : (*map)->source_domain;
    icc_domain *target = b->reads ? NULL : slides ? (*map)->slide->given[1] : (*map)->target_domain;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 1}, env);
    icc_status status = visit_domain(b, &source, &part[0]);
    if (status == ICC_OK)
        status = visit_domain(b, &target, &part[1]);
    if (!b->reads)
        return status != ICC_OK || !slides
                   ? status
                   : iccp_slide_visit(b, &(*map)->slide, source, target, &env->memory);
    if (status == ICC_OK)
        status = slides ? read_slide(b, map, source, target, &part[1])
                        : iccp_map_begin(map, source, target, env, NULL);
    iccp_domain_release(source);
    iccp_domain_release(target);
    return status;
}

/* The version of a map with these charts. */
static uint32_t version_of(const icc_chart *source, const icc_chart *target)
{
    return source->ops->is_later || target->ops->is_later ? CHARTS_VERSION : PLAIN_VERSION;
}

static icc_status read_charts(iccp_blob *b, icc_map *map, int32_t kind, const iccp_env *env,
                              icc_error *err)
{
    icc_chart *source = NULL, *target = NULL;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 1}, env);
    icc_status status = iccp_chart_read(&source, map->source_domain, b, &part[0], err);
    if (status == ICC_OK)
        status = iccp_chart_read(&target, map->target_domain, b, &part[1], err);
    const iccp_map_kind *allowed;
    if (status == ICC_OK && version_of(source, target) != b->version)
        status = ICC_ERR_FORMAT;
    if (status == ICC_OK)
        status = iccp_map_choose_kind(&allowed, kind, source, target, NULL);
    if (status == ICC_OK)
        iccp_map_add_charts(map, source, target);
    iccp_chart_release(source);
    iccp_chart_release(target);
    return status;
}

static icc_status visit_charts(iccp_blob *b, icc_map *map, int32_t kind, const iccp_env *env,
                               icc_error *err)
{
    if (b->reads)
        return read_charts(b, map, kind, env, err);
    iccp_chart_write(map->source, b);
    iccp_chart_write(map->target, b);
    return ICC_OK;
}

/* Reads or writes how the map was made, which is only information. */
static icc_status visit_facts(iccp_blob *b, iccp_map_facts *info)
{
    iccp_blob_i32(b, ICCP_U64, 0, INT32_MAX, &info->n_levels);
    iccp_blob_size(b, &info->n_inverted);
    iccp_blob_size(b, &info->n_unrepaired);
    iccp_blob_size(b, &info->n_iterations);
    iccp_blob_f64(b, 1, &info->energy_start);
    iccp_blob_f64(b, 1, &info->energy);
    if (has_features(b)) {
        iccp_blob_i32(b, ICCP_U32, 0, 1, &info->class_kept);
        iccp_blob_i32(b, ICCP_U32, 0, INT32_MAX, &info->n_trees);
    }
    return b->status;
}

static icc_status visit_state(iccp_blob *b, icc_map *map, int32_t number, const iccp_env *env)
{
    const iccp_map_kind *kind = iccp_map_kind_of(number, map->source_domain);
    if (kind == NULL)
        return ICC_ERR_FORMAT;
    map->kind = kind;
    map->info.kind = number;
    return kind->visit != NULL ? kind->visit(b, map, env) : ICC_OK;
}

/* Reads or writes a map. When it writes, *map is a shallow copy of the caller's map. */
static icc_status visit(iccp_blob *b, icc_map **map, const iccp_env *part, icc_error *err)
{
    int32_t kind = b->reads ? 0 : (*map)->info.kind;
    int32_t has_charts = !b->reads && (*map)->source != NULL;
    iccp_blob_i32(b, ICCP_U32, ICC_MAP_CURVES, ICC_MAP_MESH, &kind);
    iccp_blob_i32(b, ICCP_U32, 0, 1, &has_charts);
    iccp_blob_require(b, kind == ICC_MAP_MESH || has_charts);
    iccp_blob_require(b,
                      b->version == PLAIN_VERSION || has_charts == (b->version == CHARTS_VERSION));
    iccp_blob_require(b, !has_features(b) || kind == ICC_MAP_MESH);
    icc_status status = b->status;
    if (status == ICC_OK)
        status = visit_domains(b, map, &part[0]);
    if (status == ICC_OK && has_charts)
        status = visit_charts(b, *map, kind, &part[1], err);
    if (status == ICC_OK)
        status = visit_facts(b, &(*map)->info);
    if (status == ICC_OK)
        status = visit_state(b, *map, kind, &part[2]);
    return status;
}

void iccp_map_save(const icc_map *map, size_t capacity, void *data, size_t *n_bytes)
{
    const iccp_env part[3] = {0};
    icc_map copy = *map, *written = &copy;
    iccp_blob b;
    iccp_blob_begin(&b, data, capacity, KIND,
                    map->slide != NULL                     ? SLIDING_VERSION
                    : map->source_domain->features != NULL ? FEATURES_VERSION
                    : map->source != NULL                  ? version_of(map->source, map->target)
                                                           : PLAIN_VERSION);
    (void)visit(&b, &written, part, NULL);
    iccp_blob_end(&b, n_bytes);
}

static icc_status read_map(icc_map **out, iccp_blob *b, const iccp_env *env, icc_error *err)
{
    const iccp_env whole = iccp_part(env, "load", 0, 1);
    iccp_env part[4];
    iccp_split(part, 4, (const double[]){1, 6, 2, 1}, &whole);
    icc_status status = visit(b, out, part, err);
    if (status == ICC_OK)
        status = iccp_map_conclude(*out, &part[3], NULL);
    return status == ICC_OK && !iccp_blob_done(b) ? ICC_ERR_FORMAT : status;
}

icc_status iccp_map_load(icc_map **out, size_t n_bytes, const void *data, const iccp_env *env,
                         icc_error *err)
{
    const double start = iccp_seconds();
    iccp_blob b;
    *out = NULL;
    icc_status status = iccp_blob_open(&b, data, n_bytes, KIND, SLIDING_VERSION, &env->memory, err);
    if (status != ICC_OK)
        return status;
    iccp_budget budget;
    const iccp_env limited = iccp_budget_begin(&budget, env);
    status = read_map(out, &b, &limited, err);
    if (status == ICC_OK) {
        (*out)->info.seconds = iccp_seconds() - start;
        return ICC_OK;
    }
    iccp_map_release(*out);
    *out = NULL;
    return iccp_budget_end(&budget, iccp_blob_blame(err, status, "map"), err);
}

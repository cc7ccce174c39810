/* Makes, improves and retargets maps.
 *
 * The table KINDS lists what can be made. A new map gets its domains and charts first, and then the
 * state of its kind. iccp_map_conclude() certifies it before it is handed out. */
#include "map/map.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/minmax.h"
#include "base/threads.h"
#include "fill/filled_pair.h"
#include "map/correspondence.h"
#include "map/curves/curves_kind.h"
#include "map/energy/affine.h"
#include "map/higher/higher_kind.h"
#include "map/plane/plane_kind.h"
#include "map/slide/added_vertices.h"
#include "map/slide/sliding.h"
#include "map/solid/solid_kind.h"
#include "map/topology/no_map.h"
#include "method/chart_create.h"

#include <string.h>

/* Cells along the longest side in the meshes of the charts that a mesh map starts from. Coarse
 * meshes are enough, because they are finer where the boundary is. */
enum { MESH_CELLS = 20 };

/* All kinds, the best first. The last one accepts any two charts. */
static const iccp_map_kind *const KINDS[] = {&iccp_plane_kind, &iccp_solid_kind, &iccp_higher_kind,
                                             &iccp_curves_kind};
enum { N_KINDS = sizeof KINDS / sizeof *KINDS };

const iccp_map_kind *iccp_map_kind_of(int32_t number, const icc_domain *source)
{
    for (size_t k = 0; k < N_KINDS; ++k)
        if (KINDS[k]->number == number && KINDS[k]->suits(source))
            return KINDS[k];
    return NULL;
}

icc_status iccp_map_choose_kind(const iccp_map_kind **kind, int32_t number, const icc_chart *source,
                                const icc_chart *target, icc_error *err)
{
    *kind = NULL;
    if (source->info.method != target->info.method)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED, "the charts use different methods (%ld and %ld)",
                         (long)source->info.method, (long)target->info.method);
    for (size_t k = 0; k < N_KINDS && *kind == NULL; ++k)
        if ((number == 0 || KINDS[k]->number == number) && KINDS[k]->takes(source))
            *kind = KINDS[k];
    return *kind != NULL
               ? ICC_OK
               : iccp_fail(err, ICC_ERR_UNSUPPORTED,
                           "icc_map_options.kind %ld is not available for charts of method %ld",
                           (long)number, (long)source->info.method);
}

static icc_status new_map(icc_map **out, const icc_domain *source, const icc_domain *target,
                          const iccp_env *env)
{
    icc_map *map = iccp_alloc_zero(&env->memory, 1, sizeof *map);
    *out = map;
    if (map == NULL)
        return ICC_ERR_MEMORY;
    map->memory = env->memory;
    map->kind = &iccp_curves_kind;
    map->source_domain = iccp_domain_retain(source);
    map->target_domain = iccp_domain_retain(target);
    map->info.dim = source->dim;
    map->info.kind = map->kind->number;
    return ICC_OK;
}

icc_status iccp_map_begin(icc_map **out, const icc_domain *source, const icc_domain *target,
                          const iccp_env *env, icc_error *err)
{
    *out = NULL;
    const icc_status status = iccp_check_correspondence(source, target, err);
    return status == ICC_OK ? new_map(out, source, target, env) : status;
}

void iccp_map_add_charts(icc_map *map, const icc_chart *source, const icc_chart *target)
{
    map->source = iccp_chart_retain(source);
    map->target = iccp_chart_retain(target);
}

static icc_status certify(icc_map *map, const iccp_env *env, icc_error *err)
{
    const double start = iccp_seconds();
    const icc_status status = map->kind->certify(map, env, err);
    map->info.seconds_certify += iccp_seconds() - start;
    return status;
}

icc_status iccp_map_conclude(icc_map *map, const iccp_env *env, icc_error *err)
{
    const icc_status status = certify(map, env, err);
    return status == ICC_OK && map->kind->describe != NULL ? map->kind->describe(map, env) : status;
}

/* Makes a map affine inside if its boundary is affine, unless that would change the isotopy class
 * of its features. */
static icc_status make_affine(icc_map *map, int32_t iterations, double *energy, const iccp_env *env,
                              icc_error *err)
{
    const iccp_env quiet = iccp_quiet(env);
    if (iterations < 0 || map->kind->mesh == NULL)
        return ICC_OK;
    const iccp_simplicial_map simplicial = map->kind->mesh(map);
    double *before;
    icc_status status =
        iccp_affine_extend(&simplicial, map->source_domain, map->target_domain, &before, &quiet);
    if (status != ICC_OK || before == NULL)
        return status;
    bool kept;
    status = map->kind->renew(map, &kept, &quiet);
    if (!kept) {
        memcpy(simplicial.images, before, simplicial.dim * simplicial.n_points * sizeof *before);
    } else {
        /* An affine map has the least energy. If this sum is larger, the difference is rounding. */
        *energy = iccp_min(*energy, iccp_simplicial_energy_at_once(&simplicial, &quiet));
    }
    iccp_free(&env->memory, before);
    return status == ICC_OK && kept ? certify(map, &quiet, err) : status;
}

/* Sets class_kept of `next`, which was made from `map`: whether the isotopy class of the features
 * is the one that it should be. */
static icc_status set_class_kept(icc_map *next, const icc_map *map, bool moved, const iccp_env *env)
{
    bool kept = false;
    const icc_status status = map->info.class_kept && next->kind->keeps_class != NULL
                                  ? next->kind->keeps_class(&kept, next, map, moved, env)
                                  : ICC_OK;
    next->info.class_kept = kept;
    return status;
}

/* True for solids with handles, voids or features. They have no charts, so no curve maps either. */
static bool has_no_charts(const icc_domain *domain)
{
    return domain->dim == 3 &&
           (domain->features != NULL || domain->genus > 0 || domain->n_voids > 0);
}

/* Makes the state of the kind. If no mesh map is found, kind 0 becomes kind curves, provided that
 * there are charts, and a caller who asked for kind mesh gets an error. */
static icc_status fill_in(icc_map *map, const iccp_map_kind *kind, const icc_map_options *options,
                          const iccp_env *env, icc_error *err)
{
    const char *const items = map->info.dim == 2   ? "triangles"
                              : map->info.dim == 3 ? "tetrahedra"
                                                   : "simplices";
    map->kind = kind;
    icc_status status = kind->create(map, options, env, err);
    const bool has_none = status == ICC_OK && kind->mesh != NULL && map->state == NULL;
    if (has_none && options->kind == ICC_MAP_MESH)
        status =
            iccp_fail(err, ICC_ERR_CERTIFICATE, "no mesh map was found: %zu %s stay inverted%s",
                      map->info.n_unrepaired, items,
                      has_no_charts(map->source_domain) ? "" : "; with kind 0 you get a curve map");
    if (has_none && options->kind == 0) {
        iccp_log(env, "%zu %s stay inverted, so the map becomes a curve map",
                 map->info.n_unrepaired, items);
        if (map->source != NULL)
            map->kind = &iccp_curves_kind;
    }
    map->info.kind = map->kind->number;
    return status;
}

/* Makes a map of the given kind. `charts` belong to the two domains, or are NULL for maps without.
 * *n_left is then the number of simplices that stay inverted. If there are any, *out is NULL, with
 * ICC_OK, for kind 0. */
static icc_status create_of_kind(icc_map **out, const icc_domain *source, const icc_domain *target,
                                 const icc_chart *const charts[2], const iccp_map_kind *kind,
                                 const icc_map_options *options, size_t *n_left,
                                 const iccp_env *env, icc_error *err)
{
    const double start = iccp_seconds();
    icc_map *map = NULL;
    icc_status status = iccp_map_begin(&map, source, target, env, err);
    if (status == ICC_OK && charts != NULL)
        iccp_map_add_charts(map, charts[0], charts[1]);
    if (status == ICC_OK)
        status = fill_in(map, kind, options, env, err);
    *n_left = status == ICC_OK ? map->info.n_unrepaired : 0;
    const bool has_none = status == ICC_OK && map->kind->mesh != NULL && map->state == NULL;
    if (status == ICC_OK && !has_none)
        status = iccp_map_conclude(map, env, err);
    if (status == ICC_OK && !has_none)
        status = make_affine(map, options->iterations, &map->info.energy, env, err);
    if (status != ICC_OK || has_none) {
        iccp_map_release(map);
        return iccp_explain(err, status);
    }
    map->info.seconds = iccp_seconds() - start;
    *out = map;
    return ICC_OK;
}

static icc_status refuse_sliding(icc_error *err)
{
    return iccp_fail(err, ICC_ERR_UNSUPPORTED,
                     "icc_map_options.slide: only lines, holes and regions of a domain with "
                     "features can slide");
}

static icc_status create_from(icc_map **out, const icc_chart *source, const icc_chart *target,
                              const icc_map_options *options, const iccp_env *env, icc_error *err)
{
    const icc_chart *const charts[2] = {source, target};
    const iccp_map_kind *kind;
    size_t n_left;
    if (options->slide != ICC_SLIDE_NONE)
        return refuse_sliding(err);
    const icc_status status = iccp_map_choose_kind(&kind, options->kind, source, target, err);
    return status == ICC_OK ? create_of_kind(out, source->domain, target->domain, charts, kind,
                                             options, &n_left, env, err)
                            : iccp_explain(err, status);
}

icc_status iccp_map_create_from_charts(icc_map **out, const icc_chart *source,
                                       const icc_chart *target, const icc_map_options *options,
                                       const iccp_env *env, icc_error *err)
{
    iccp_team team;
    iccp_env with;
    iccp_with_team(&with, &team, env);
    const icc_status status = create_from(out, source, target, options, &with, err);
    iccp_without_team(&with, env);
    return status;
}

/* Completes the charts' options in the plane if a mesh map starts from them. Method disc is the
 * better start, but its charts have no maximum of the caller's choice. So a given maximum means
 * method foliation. With kind 0, meshes of the caller's are left to method/chart_create.c, which
 * chooses foliation for them. */
static void complete(icc_chart_options chart_options[2], const icc_domain *const domains[2],
                     int32_t kind)
{
    const bool has_maximum = chart_options[0].maximum != NULL || chart_options[1].maximum != NULL;
    const bool has_mesh = domains[0]->mesh != NULL && domains[1]->mesh != NULL;
    const bool curves = kind == ICC_MAP_CURVES || (kind == 0 && has_mesh);
    for (int k = 0; k < 2 && !curves && domains[0]->dim == 2; ++k) {
        if (chart_options[k].method == 0)
            chart_options[k].method = has_maximum ? ICC_METHOD_FOLIATION : ICC_METHOD_DISC;
        if (chart_options[k].cells == 0 && chart_options[k].method != ICC_METHOD_GRADIENT &&
            chart_options[k].method != ICC_METHOD_FIELD)
            chart_options[k].cells = MESH_CELLS;
    }
}

/* True if the options ask for charts of a method or with a maximum. */
static bool has_wishes(const icc_chart_options chart_options[2])
{
    return chart_options[0].method != 0 || chart_options[0].maximum != NULL ||
           chart_options[1].maximum != NULL;
}

/* Returns an error if these domains cannot have what the options ask for. */
static icc_status check_request(const icc_domain *source, const icc_map_options *options,
                                const icc_chart_options chart_options[2], icc_error *err)
{
    if (options->kind == ICC_MAP_MESH && source->dim == 3 && source->mask != NULL)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED,
                         "a mesh map is not available for masks of dimension 3");
    if (options->kind == ICC_MAP_MESH && source->dim > 3 && has_wishes(chart_options))
        return iccp_fail(err, ICC_ERR_UNSUPPORTED,
                         "a mesh map of dimension %ld is made without charts, so there is no "
                         "method or maximum to choose",
                         (long)source->dim);
    if (source->dim == 3 && (options->kind == ICC_MAP_CURVES || has_wishes(chart_options))) {
        const icc_status status =
            iccp_domain_require_ball(source, "the domain of a map through charts", err);
        if (status != ICC_OK)
            return status;
    }
    if (source->dim == 3 && options->n_ties > 0)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED,
                         "ties are for the plane: in space all ways around a feature lead to the "
                         "same map");
    if ((source->features == NULL || source->dim != 2) && options->slide != ICC_SLIDE_NONE)
        return refuse_sliding(err);
    if (source->features == NULL)
        return options->n_ties == 0
                   ? ICC_OK
                   : iccp_fail(err, ICC_ERR_ARGUMENT,
                               "ties are between features, of which there are none");
    if (options->kind == ICC_MAP_CURVES || has_wishes(chart_options))
        return iccp_fail(
            err, ICC_ERR_UNSUPPORTED,
            "holes, lines or points inside need a mesh map that is made without charts");
    return ICC_OK;
}

static icc_status create_with_features(icc_map **out, const icc_domain *source,
                                       const icc_domain *target, const icc_map_options *options,
                                       const iccp_env *env, icc_error *err)
{
    size_t n_left;
    return create_of_kind(out, source, target, NULL, &iccp_plane_kind, options, &n_left, env, err);
}

static icc_status create_without_features(icc_map **out, const icc_domain *const domains[2],
                                          const icc_map_options *options,
                                          const icc_chart_options chart_options[2],
                                          const iccp_env *env, icc_error *err)
{
    icc_chart_options full[2] = {chart_options[0], chart_options[1]};
    icc_chart *charts[2] = {NULL, NULL};
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 2}, env);
    complete(full, domains, options->kind);
    icc_status status = iccp_chart_create_pair(charts, domains, full, &part[0], err);
    if (status == ICC_OK)
        status = create_from(out, charts[0], charts[1], options, &part[1], err);
    iccp_chart_release(charts[0]);
    iccp_chart_release(charts[1]);
    return status;
}

/* Fills the source with tetrahedra, unless it has some, and makes a mesh map in space without
 * charts. */
static icc_status create_solid(icc_map **out, const icc_domain *source, const icc_domain *target,
                               const icc_map_options *options, size_t *n_left, const iccp_env *env,
                               icc_error *err)
{
    icc_domain *filled, *filled_target = NULL;
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){2, 1, 4}, env);
    icc_status status = iccp_fill_side(&filled, source, 0, &part[0], err);
    if (status == ICC_OK)
        status = iccp_solid_has_map(&filled_target, filled, target, &part[1], err);
    /* A mesh has no vertices but those of its simplices. */
    if (status == ICC_OK && filled_target == NULL && filled->n_vertices != target->n_vertices)
        status = iccp_fill_side(&filled_target, target, 1, &part[1], err);
    if (status == ICC_OK)
        status = create_of_kind(out, filled, filled_target != NULL ? filled_target : target, NULL,
                                &iccp_solid_kind, options, n_left, &part[2], err);
    iccp_domain_release(filled_target);
    iccp_domain_release(filled);
    return status;
}

/* Makes a mesh map without charts, from 3-D on. *n_left is as in create_of_kind(). */
static icc_status create_without_charts(icc_map **out, const icc_domain *source,
                                        const icc_domain *target, const icc_map_options *options,
                                        size_t *n_left, const iccp_env *env, icc_error *err)
{
    return source->dim == 3 ? create_solid(out, source, target, options, n_left, env, err)
                            : create_of_kind(out, source, target, NULL, &iccp_higher_kind, options,
                                             n_left, env, err);
}

/* True if the options leave it to libicc how a map is made, and a mesh map without charts is
 * possible. */
static bool needs_no_charts(const icc_domain *const domains[2], const icc_map_options *options,
                            const icc_chart_options chart_options[2])
{
    const bool has_mask = domains[0]->mask != NULL || domains[1]->mask != NULL;
    return domains[0]->dim >= (has_mask ? 4 : 3) && options->kind != ICC_MAP_CURVES &&
           !has_wishes(chart_options);
}

/* Whether both domains are surfaces in space, at least one of them has no mesh, and the options ask
 * for no method on a grid. Then both are filled with tetrahedra first. */
static bool are_to_be_filled(const icc_domain *const domains[2],
                             const icc_chart_options chart_options[2])
{
    const int32_t method = chart_options[0].method;
    return domains[0]->dim == 3 && domains[0]->mask == NULL && domains[1]->mask == NULL &&
           (domains[0]->mesh == NULL || domains[1]->mesh == NULL) &&
           (method == 0 || method == ICC_METHOD_FOLIATION);
}

static icc_status create_filled(icc_map **out, const icc_domain *const domains[2],
                                const icc_map_options *options,
                                const icc_chart_options chart_options[2], const iccp_env *env,
                                icc_error *err)
{
    icc_domain *filled[2];
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 2}, env);
    icc_status status = iccp_fill_pair(filled, domains, &part[0], err);
    if (status != ICC_OK)
        return status;
    const icc_domain *const meshed[2] = {filled[0], filled[1]};
    status = create_without_features(out, meshed, options, chart_options, &part[1], err);
    iccp_domain_release(filled[0]);
    iccp_domain_release(filled[1]);
    return status;
}

static icc_status create(icc_map **out, const icc_domain *source, const icc_domain *target,
                         const icc_map_options *options, const icc_chart_options chart_options[2],
                         const iccp_env *env, icc_error *err)
{
    const double start = iccp_seconds();
    const icc_domain *const domains[2] = {source, target};
    icc_status status = iccp_check_correspondence(source, target, err);
    if (status == ICC_OK)
        status = check_request(source, options, chart_options, err);
    if (status != ICC_OK)
        return status;
    size_t n_left = 0;
    if (source->features != NULL && source->dim == 2)
        return options->slide != ICC_SLIDE_NONE
                   ? iccp_map_create_sliding(out, source, target, options, create_with_features,
                                             env, err)
                   : create_with_features(out, source, target, options, env, err);
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 1}, env);
    icc_map_options rest = *options;
    if (has_no_charts(source))
        rest.kind = ICC_MAP_MESH;
    if (needs_no_charts(domains, options, chart_options)) {
        status = create_without_charts(out, source, target, &rest, &n_left, &part[0], err);
        if (status == ICC_OK && n_left == 0)
            (*out)->info.seconds = iccp_seconds() - start;
        if (status != ICC_OK || n_left == 0)
            return status;
        env = &part[1];
        rest.kind = ICC_MAP_CURVES;
    }
    if (are_to_be_filled(domains, chart_options))
        status = create_filled(out, domains, &rest, chart_options, env, err);
    else
        status = create_without_features(out, domains, &rest, chart_options, env, err);
    if (status == ICC_OK)
        (*out)->info.seconds = iccp_seconds() - start;
    if (status == ICC_OK && n_left > 0)
        (*out)->info.n_unrepaired = n_left;
    return status;
}

icc_status iccp_map_create(icc_map **out, const icc_domain *source, const icc_domain *target,
                           const icc_map_options *options, const icc_chart_options chart_options[2],
                           const iccp_env *env, icc_error *err)
{
    iccp_team team;
    iccp_env with;
    iccp_with_team(&with, &team, env);
    const icc_status status = create(out, source, target, options, chart_options, &with, err);
    iccp_without_team(&with, env);
    return status;
}

icc_status iccp_map_improve(icc_map **out, const icc_map *map, const icc_improve_options *options,
                            icc_improve_report *report, const iccp_env *env, icc_error *err)
{
    const double start = iccp_seconds();
    icc_map *better = NULL;
    if (map->kind->improve == NULL)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED, "only mesh maps can be improved");
    /* An affine map has the least energy, so a finer mesh would gain nothing. */
    static const icc_improve_options NO_MORE = {.iterations = 1, .levels = -1};
    const iccp_simplicial_map simplicial = map->kind->mesh(map);
    if (iccp_is_affine(&simplicial, map->source_domain, map->target_domain))
        options = &NO_MORE;
    iccp_team team;
    iccp_env with;
    iccp_with_team(&with, &team, env);
    icc_status status = new_map(&better, map->source_domain, map->target_domain, env);
    if (status == ICC_OK && map->source != NULL)
        iccp_map_add_charts(better, map->source, map->target);
    if (status == ICC_OK) {
        better->kind = map->kind;
        better->info = map->info;
        status = map->kind->improve(better, map, options, report, &with, err);
    }
    if (status == ICC_OK)
        status = iccp_map_keep_slide(better, map, NULL);
    iccp_env quiet = iccp_quiet(&with);
    if (status == ICC_OK)
        status = iccp_map_conclude(better, &quiet, err);
    iccp_without_team(&with, env);
    quiet = iccp_quiet(env);
    if (status == ICC_OK)
        status = make_affine(better, 0, &report->energy, &quiet, err);
    if (status == ICC_OK)
        status = set_class_kept(better, map, false, &quiet);
    if (status != ICC_OK) {
        iccp_map_release(better);
        return iccp_explain(err, status);
    }
    better->info.n_vertices = better->kind->mesh(better).n_points;
    better->info.n_simplices = report->n_simplices;
    better->info.energy = report->energy;
    better->info.n_iterations += report->n_iterations;
    better->info.n_levels += report->n_levels;
    better->info.seconds = iccp_seconds() - start;
    *out = better;
    return ICC_OK;
}

/* Stands for no vertex. */
static const size_t NO_VERTEX = SIZE_MAX;

/* Makes a map from the domains alone after retarget() was blocked. Maps with features do not come
 * here, so there is no isotopy class to keep. The map takes the state of the new map without its
 * charts, and in space the target that was filled for it. `vertex`: where the way was blocked, or
 * NO_VERTEX. */
static icc_status begin_anew(icc_map *map, int32_t iterations, size_t vertex, const iccp_env *env,
                             icc_error *err)
{
    const icc_map_options options = {.kind = ICC_MAP_MESH, .iterations = iterations};
    const icc_chart_options any[2] = {{0}, {0}};
    icc_map *fresh = NULL;
    if (vertex != NO_VERTEX)
        iccp_log(env, "the way is blocked at vertex %zu: making a new map", vertex);
    else
        iccp_log(env, "the way is blocked: making a new map");
    const icc_status status =
        create(&fresh, map->source_domain, map->target_domain, &options, any, env, err);
    if (status == ICC_ERR_CERTIFICATE && vertex != NO_VERTEX)
        return iccp_fail_at(err, status, ICC_ITEM_VERTEX, (int64_t)vertex,
                            "the way from the previous target is blocked at vertex %zu, and no new "
                            "mesh map was found: move there in several steps",
                            vertex);
    if (status != ICC_OK)
        return status;
    map->info = fresh->info;
    map->kind = fresh->kind;
    map->state = fresh->state;
    fresh->state = NULL;
    icc_domain *const target = map->target_domain;
    map->target_domain = fresh->target_domain;
    fresh->target_domain = target;
    iccp_map_release(fresh);
    return ICC_OK;
}

static icc_status retarget(icc_map *next, const icc_map *map, int32_t iterations,
                           const iccp_env *env, icc_error *err)
{
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 2}, env);
    size_t vertex = NO_VERTEX;
    next->kind = map->kind;
    const icc_status status = map->kind->retarget(next, map, iterations, &vertex, &part[0], err);
    return status == ICC_OK && next->state == NULL
               ? begin_anew(next, iterations, vertex, &part[1], err)
               : status;
}

/* Begins a map to a moved target. If chains slide, they keep their knots. */
static icc_status begin_moved(icc_map **next, const icc_map *map, const icc_domain *target,
                              const iccp_env *env, icc_error *err)
{
    icc_domain *larger;
    if (map->slide == NULL)
        return iccp_map_begin(next, map->source_domain, target, env, err);
    const iccp_env quiet = iccp_quiet(env);
    iccp_slide *slide = NULL;
    icc_status status = iccp_check_correspondence(map->slide->given[0], target, err);
    if (status == ICC_OK)
        status = iccp_slide_copy(&slide, map->slide, target, &env->memory);
    if (status == ICC_OK)
        status = iccp_domain_with_knots(&larger, slide, 1, &quiet, err);
    if (status == ICC_OK) {
        status = iccp_map_begin(next, map->source_domain, larger, env, err);
        iccp_domain_release(larger);
    }
    iccp_slide_free(slide);
    return status;
}

icc_status iccp_map_retarget(icc_map **out, const icc_map *map, const icc_domain *target,
                             int32_t iterations, const iccp_env *env, icc_error *err)
{
    const double start = iccp_seconds();
    icc_map *next = NULL;
    if (map->kind->retarget == NULL)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED, "only mesh maps can follow a moving target");
    iccp_team team;
    iccp_env with;
    iccp_with_team(&with, &team, env);
    icc_status status = begin_moved(&next, map, target, env, err);
    if (status == ICC_OK)
        status = retarget(next, map, iterations, &with, err);
    if (status == ICC_OK)
        status = iccp_map_conclude(next, &with, err);
    iccp_without_team(&with, env);
    if (status == ICC_OK)
        status = make_affine(next, iterations, &next->info.energy, env, err);
    if (status == ICC_OK)
        status = set_class_kept(next, map, true, env);
    if (status == ICC_OK)
        status = iccp_map_keep_slide(next, map, target);
    if (status != ICC_OK) {
        iccp_map_release(next);
        return iccp_explain(err, status);
    }
    next->info.kind = next->kind->number;
    next->info.seconds = iccp_seconds() - start;
    *out = next;
    return ICC_OK;
}

icc_status iccp_map_get_tie(const icc_map *map, size_t tie, icc_tie_info *info, double *target)
{
    if (map->kind->tie == NULL)
        return ICC_ERR_ARGUMENT;
    const icc_status status = map->kind->tie(map, tie, info, target);
    return status == ICC_OK && map->slide != NULL ? iccp_slide_given_tie(map->slide, info) : status;
}

static void hand_out(const iccp_frame *frame, size_t dim, size_t n, const double *local,
                     double *points)
{
    for (size_t v = 0; points != NULL && v < n; ++v)
        iccp_frame_out(frame, (int32_t)dim, local + dim * v, points + dim * v);
}

icc_status iccp_map_get_mesh(const icc_map *map, double *vertices, double *images,
                             uint32_t *corners)
{
    if (map->kind->mesh == NULL)
        return ICC_ERR_UNSUPPORTED;
    const iccp_simplicial_map m = map->kind->mesh(map);
    hand_out(&map->source_domain->frame, m.dim, m.n_points, m.points, vertices);
    hand_out(&map->target_domain->frame, m.dim, m.n_points, m.images, images);
    if (corners != NULL)
        memcpy(corners, m.corners, (m.dim + 1) * m.n_simplices * sizeof *corners);
    return ICC_OK;
}

icc_status iccp_map_get_regions(const icc_map *map, uint32_t *regions)
{
    if (map->kind->mesh == NULL)
        return ICC_ERR_UNSUPPORTED;
    if (map->kind->regions != NULL)
        return map->kind->regions(map, regions);
    for (size_t s = 0; s < map->info.n_simplices; ++s)
        regions[s] = 0;
    return ICC_OK;
}

void iccp_map_release(icc_map *map)
{
    if (map == NULL)
        return;
    if (map->state != NULL)
        map->kind->free_state(map);
    iccp_slide_free(map->slide);
    iccp_chart_release(map->source);
    iccp_chart_release(map->target);
    iccp_domain_release(map->source_domain);
    iccp_domain_release(map->target_domain);
    const iccp_memory memory = map->memory;
    iccp_free(&memory, map);
}

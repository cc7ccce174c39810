/* Checks the arguments of the domain functions. */
#include "api/check.h"
#include "base/env.h"
#include "base/error.h"
#include "base/options.h"
#include "base/threads.h"
#include "domain/domain.h"
#include "domain/features.h"
#include "domain/mesh_domain.h"
#include "fill/fill_domain.h"
#include "geometry/polygon_check.h"
#include "geometry/simplices.h"

#include <math.h>
#include <string.h>

ICCP_END(domain)

static icc_status check_counts(size_t n_vertices, const double *vertices, size_t n_facets,
                               const uint32_t *facets, icc_error *err)
{
    if (vertices == NULL && n_vertices > 0)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "vertices is NULL");
    if (n_vertices > ICCP_MAX_COUNT)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "%zu vertices are too many; at most %zu",
                         n_vertices, ICCP_MAX_COUNT);
    if (facets != NULL && n_facets > ICCP_MAX_COUNT)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "%zu facets are too many; at most %zu", n_facets,
                         ICCP_MAX_COUNT);
    return ICC_OK;
}

icc_status icc_domain_create(icc_domain **out, int32_t dim, size_t n_vertices,
                             const double *vertices, size_t n_facets, const uint32_t *facets,
                             const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out == NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "out is NULL");
    *out = NULL;
    if (dim < 1 || dim > ICC_MAX_DIM)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "dim is %ld; it must lie in 1..%d", (long)dim,
                         ICC_MAX_DIM);
    if (dim != 2 && facets == NULL && n_facets > 0)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "facets is NULL; only those of a polygon can be left out");
    iccp_env full;
    icc_status status = iccp_env_read(&full, env, err);
    if (status == ICC_OK)
        status = check_counts(n_vertices, vertices, n_facets, facets, err);
    if (status != ICC_OK)
        return status;
    return iccp_end_domain(
        iccp_domain_create(out, dim, n_vertices, vertices, n_facets, facets, &full, err), out,
        &full, err);
}

icc_status icc_domain_create_mesh(icc_domain **out, const icc_mesh *mesh, size_t n_facets,
                                  const uint32_t *facets, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    const char *missing = out == NULL ? "out" : mesh == NULL ? "mesh" : NULL;
    iccp_env full;
    icc_mesh m;
    icc_status status = iccp_begin(&full, env, missing, err);
    if (status == ICC_OK)
        status = iccp_read_mesh(&m, mesh, err);
    if (status == ICC_OK)
        status = check_counts(m.n_vertices, m.vertices, n_facets, facets, err);
    if (status != ICC_OK)
        return status;
    return iccp_end_domain(iccp_domain_create_mesh(out, m.dim, m.n_vertices, m.vertices, m.n_cells,
                                                   m.cells, n_facets, facets, &full, err),
                           out, &full, err);
}

icc_status icc_domain_fill(icc_domain **out, const icc_domain *surface,
                           const icc_fill_options *options, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    iccp_env full;
    icc_fill_options given;
    if (out != NULL)
        *out = NULL;
    const char *missing = out == NULL ? "out" : surface == NULL ? "surface" : NULL;
    icc_status status = iccp_begin(&full, env, missing, err);
    if (status == ICC_OK)
        status = iccp_read_struct(&given, sizeof given, options, "icc_fill_options", err);
    if (status != ICC_OK)
        return status;
    if (surface->dim != 3 || surface->mesh != NULL)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED,
                         "only surfaces in 3-D without a mesh can be filled");
    if (!(given.ratio == 0.0 || given.ratio >= 1.2))
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_fill_options.ratio is %g; it must be 0 or at "
                         "least 1.2",
                         given.ratio);
    const iccp_fill_options own = {given.ratio == 0.0 ? ICCP_FILL_RATIO : given.ratio,
                                   given.max_points == 0 ? UINT64_MAX : given.max_points};
    return iccp_end_domain(iccp_domain_fill(out, surface, &own, &full, err), out, &full, err);
}

static icc_status check_feature(size_t f, const icc_feature *feature, icc_error *err)
{
    static const char *const counts[] = {"a hole has at least 3 vertices",
                                         "a line has at least 2 vertices", "a point has 1 vertex"};
    if (feature->kind < ICC_FEATURE_HOLE || feature->kind > ICC_FEATURE_POINT)
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_FEATURE, (int64_t)f,
                            "feature %zu: there is no kind %ld", f, (long)feature->kind);
    if (!iccp_feature_allows(feature->kind, feature->n_vertices))
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_FEATURE, (int64_t)f,
                            "feature %zu: %s, not %zu", f, counts[feature->kind - 1],
                            feature->n_vertices);
    if (feature->vertices == NULL)
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_FEATURE, (int64_t)f,
                            "the vertices of feature %zu are NULL", f);
    if (!(feature->radius >= 0 && isfinite(feature->radius)) ||
        (feature->radius > 0 && feature->kind != ICC_FEATURE_POINT))
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_FEATURE, (int64_t)f,
                            "feature %zu: the radius is %g; it must be finite and at least 0, and "
                            "only a point may have one",
                            f, feature->radius);
    if (feature->n_facets > 0 || feature->facets != NULL)
        return iccp_fail_at(err, ICC_ERR_UNSUPPORTED, ICC_ITEM_FEATURE, (int64_t)f,
                            "feature %zu has facets: surfaces inside are not supported", f);
    return ICC_OK;
}

/* Reads the caller's features and checks their numbers. The caller's struct may be of any
 * version, so its size gives the distance between features. */
static icc_status read_features(icc_feature *full, size_t n_outer, size_t n,
                                const icc_feature *features, icc_error *err)
{
    const size_t stride = n > 0 ? features->size : 0;
    size_t n_vertices = n_outer;
    for (size_t f = 0; f < n; ++f) {
        const icc_feature *given = (const icc_feature *)((const char *)features + f * stride);
        icc_status status = iccp_read_struct(&full[f], sizeof full[f], given, "icc_feature", err);
        if (status == ICC_OK && full[f].size != stride)
            status = iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_FEATURE, (int64_t)f,
                                  "icc_feature.size of feature %zu is not that of feature 0", f);
        if (status == ICC_OK)
            status = check_feature(f, &full[f], err);
        if (status != ICC_OK)
            return status;
        const size_t n_rim = full[f].radius > 0 ? ICCP_RIM : 0;
        if (full[f].n_vertices + n_rim > ICCP_MAX_COUNT - n_vertices)
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_FEATURE, (int64_t)f,
                                "too many vertices up to feature %zu; at most %zu in all", f,
                                ICCP_MAX_COUNT);
        n_vertices += full[f].n_vertices + n_rim;
    }
    return ICC_OK;
}

icc_status icc_domain_create_features(icc_domain **out, size_t n_outer, const double *outer,
                                      size_t n_features, const icc_feature *features,
                                      const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out == NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "out is NULL");
    *out = NULL;
    if (features == NULL && n_features > 0)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "features is NULL");
    iccp_env env_read;
    icc_status status = iccp_env_read(&env_read, env, err);
    if (status == ICC_OK)
        status = check_counts(n_outer, outer, 0, NULL, err);
    if (status == ICC_OK && n_features > ICCP_MAX_COUNT)
        status = iccp_fail(err, ICC_ERR_ARGUMENT, "%zu features are too many; at most %zu",
                           n_features, ICCP_MAX_COUNT);
    if (status != ICC_OK)
        return status;
    icc_feature *full = iccp_alloc(&env_read.memory, n_features, sizeof *full);
    if (full == NULL)
        return iccp_fail_memory(err);
    status = read_features(full, n_outer, n_features, features, err);
    if (status == ICC_OK)
        status = iccp_domain_create_features(out, n_outer, outer, n_features, full, &env_read, err);
    iccp_free(&env_read.memory, full);
    return status == ICC_OK ? iccp_end_domain(status, out, &env_read, err) : status;
}

void icc_domain_free(icc_domain *domain)
{
    iccp_domain_release(domain);
}

icc_status icc_domain_get_info(const icc_domain *domain, icc_domain_info *info)
{
    ICCP_ENTER;
    if (domain == NULL || info == NULL)
        return ICC_ERR_ARGUMENT;
    const iccp_frame *frame = &domain->frame;
    icc_domain_info full = {0};
    full.dim = domain->dim;
    full.orientation = domain->orientation;
    full.n_vertices = domain->n_vertices;
    full.n_facets = domain->n_facets;
    full.n_features = domain->features != NULL ? domain->features->n : 0;
    full.n_mesh_vertices = domain->mesh != NULL ? domain->mesh->n_points : 0;
    full.n_mesh_simplices = domain->mesh != NULL ? domain->mesh->n_simplices : 0;
    iccp_frame_out(frame, domain->dim, domain->lower, full.lower);
    iccp_frame_out(frame, domain->dim, domain->upper, full.upper);
    full.measure = domain->measure;
    for (int32_t k = 0; k < domain->dim; ++k)
        full.measure = full.measure * frame->out[0] * frame->out[1];
    return iccp_write_struct(info, &full, sizeof full, "icc_domain_info", NULL);
}

icc_status icc_domain_get_feature(const icc_domain *domain, size_t feature, icc_feature_info *info)
{
    ICCP_ENTER;
    if (domain == NULL || info == NULL || domain->features == NULL ||
        feature >= domain->features->n)
        return ICC_ERR_ARGUMENT;
    const iccp_feature *item = &domain->features->item[feature];
    icc_feature_info full = {0};
    full.kind = item->kind;
    full.orientation = item->orientation;
    full.first_vertex = item->first;
    full.n_vertices = item->n;
    full.first_facet = item->kind == ICC_FEATURE_HOLE ? item->first_facet : 0;
    return iccp_write_struct(info, &full, sizeof full, "icc_feature_info", NULL);
}

icc_status icc_domain_get_boundary(const icc_domain *domain, double *vertices, uint32_t *facets)
{
    ICCP_ENTER;
    if (domain == NULL)
        return ICC_ERR_ARGUMENT;
    const size_t dim = (size_t)domain->dim;
    if (vertices != NULL)
        for (size_t v = 0; v < domain->n_vertices; ++v)
            iccp_domain_given(domain, v, vertices + dim * v);
    if (facets != NULL)
        memcpy(facets, domain->facets, domain->n_facets * dim * sizeof *facets);
    return ICC_OK;
}

icc_status icc_domain_get_mesh(const icc_domain *domain, icc_mesh *mesh)
{
    ICCP_ENTER;
    if (domain == NULL || mesh == NULL)
        return ICC_ERR_ARGUMENT;
    if (domain->mesh == NULL)
        return ICC_ERR_UNSUPPORTED;
    const iccp_simplices *const own = domain->mesh;
    const size_t dim = own->dim;
    double *vertices;
    uint32_t *cells;
    const icc_status status =
        iccp_size_mesh(&vertices, &cells, mesh, domain->dim, own->n_points, own->n_simplices);
    if (status != ICC_OK)
        return status;
    for (size_t v = 0; v < own->n_points && vertices != NULL; ++v)
        if (v < own->n_boundary)
            iccp_domain_given(domain, v, vertices + dim * v);
        else
            iccp_frame_restore(&domain->frame, domain->dim, own->points + dim * v,
                               vertices + dim * v);
    if (cells != NULL)
        memcpy(cells, own->corners, own->n_simplices * (dim + 1) * sizeof *cells);
    return ICC_OK;
}

typedef struct locate_call {
    const icc_domain *domain;
    const double *points;
    int32_t *where;
    uint32_t *facet;
    double *bary;
} locate_call;

static void locate_point(const locate_call *call, size_t i)
{
    const size_t dim = (size_t)call->domain->dim;
    double local[ICC_MAX_DIM], bary[ICC_MAX_DIM];
    uint32_t facet = 0;
    iccp_frame_in(&call->domain->frame, call->domain->dim, call->points + dim * i, local);
    const bool nearest = call->facet != NULL || call->bary != NULL;
    call->where[i] =
        iccp_domain_locate(call->domain, local, !nearest, nearest ? &facet : NULL, bary);
    if (call->facet != NULL)
        call->facet[i] = facet;
    if (call->bary != NULL)
        memcpy(call->bary + dim * i, bary, dim * sizeof *bary);
}

static icc_status locate_chunk(void *argument, size_t begin, size_t end)
{
    for (size_t i = begin; i < end; ++i)
        locate_point(argument, i);
    return ICC_OK;
}

icc_status icc_domain_locate(const icc_domain *domain, size_t n, const double *points,
                             int32_t *where, uint32_t *facet, double *bary, const icc_env *env)
{
    ICCP_ENTER;
    if (domain == NULL || (n > 0 && (points == NULL || where == NULL)))
        return ICC_ERR_ARGUMENT;
    iccp_env full;
    const icc_status status = iccp_env_read(&full, env, NULL);
    if (status != ICC_OK)
        return status;
    locate_call call = {domain, points, where, facet, bary};
    return iccp_finish(&full, iccp_for_chunks(&full, "trace", n, 1024, locate_chunk, &call));
}

icc_status icc_boundary_defects(size_t n_vertices, const double *vertices, size_t capacity,
                                int32_t *kinds, uint32_t *items, size_t *n_defects,
                                const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (n_defects == NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "n_defects is NULL");
    *n_defects = 0;
    if (capacity > 0 && (kinds == NULL || items == NULL))
        return iccp_fail(err, ICC_ERR_ARGUMENT, "kinds or items is NULL");
    iccp_env full;
    icc_status status = iccp_env_read(&full, env, err);
    if (status == ICC_OK)
        status = check_counts(n_vertices, vertices, 0, NULL, err);
    if (status != ICC_OK)
        return status;
    status =
        iccp_boundary_defects(n_vertices, vertices, capacity, kinds, items, n_defects, &full, err);
    return status == ICC_OK ? iccp_explain(err, iccp_finish(&full, ICC_OK)) : status;
}

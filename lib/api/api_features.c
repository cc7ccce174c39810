/* Checks the arguments of the functions that make domains with features. */
#include "api/check.h"
#include "base/env.h"
#include "base/error.h"
#include "base/options.h"
#include "domain/features.h"
#include "domain/solid_domain.h"

#include <math.h>

ICCP_END(domain)

static icc_status check_count(int32_t dim, size_t f, const icc_feature *feature, icc_error *err)
{
    static const char *const counts[] = {"a hole has at least 3 vertices",
                                         "a line has at least 2 vertices",
                                         "a point has 1 vertex",
                                         "a region has at least 3 vertices",
                                         "a void has at least 4 vertices",
                                         NULL,
                                         NULL,
                                         "a region has at least 4 vertices"};
    if (feature->kind < ICC_FEATURE_HOLE || feature->kind > ICC_FEATURE_REGION)
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_FEATURE, (int64_t)f,
                            "feature %zu: there is no kind %ld", f, (long)feature->kind);
    if (!iccp_feature_allows(dim, feature->kind, feature->n_vertices)) {
        const bool is_surface = dim == 3 && iccp_feature_is_ring(feature->kind);
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_FEATURE, (int64_t)f,
                            "feature %zu: %s, not %zu", f,
                            counts[feature->kind - 1 + (is_surface ? 4 : 0)], feature->n_vertices);
    }
    return ICC_OK;
}

/* Checks whether a feature has facets where it must. */
static icc_status check_facets(int32_t dim, size_t f, const icc_feature *feature, icc_error *err)
{
    const bool has_facets = feature->n_facets > 0 || feature->facets != NULL;
    const bool is_surface = dim == 3 && iccp_feature_is_ring(feature->kind);
    if (dim == 2 && has_facets)
        return iccp_fail_at(err, ICC_ERR_UNSUPPORTED, ICC_ITEM_FEATURE, (int64_t)f,
                            "feature %zu has facets: icc_domain_create_solid() takes surfaces", f);
    if (!is_surface && has_facets)
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_FEATURE, (int64_t)f,
                            "feature %zu has facets, but lines and points have none", f);
    if (is_surface && (feature->n_facets == 0 || feature->facets == NULL))
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_FEATURE, (int64_t)f,
                            "feature %zu has no facets, but it is a surface", f);
    return ICC_OK;
}

static icc_status check_feature(int32_t dim, size_t f, const icc_feature *feature, icc_error *err)
{
    const icc_status status = check_count(dim, f, feature, err);
    if (status != ICC_OK)
        return status;
    if (feature->vertices == NULL)
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_FEATURE, (int64_t)f,
                            "the vertices of feature %zu are NULL", f);
    if (!(feature->radius >= 0 && isfinite(feature->radius)) ||
        (feature->radius > 0 && (feature->kind != ICC_FEATURE_POINT || dim != 2)))
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_FEATURE, (int64_t)f,
                            "feature %zu: the radius is %g; it must be finite and at least 0, and "
                            "only a point of the plane may have one",
                            f, feature->radius);
    return check_facets(dim, f, feature, err);
}

/* Adds a number of vertices or facets. Returns an error if there are too many. */
static icc_status add(size_t *sum, size_t n, const char *name, size_t f, icc_error *err)
{
    if (n > ICCP_MAX_COUNT - *sum)
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_FEATURE, (int64_t)f,
                            "too many %s up to feature %zu; at most %zu in all", name, f,
                            ICCP_MAX_COUNT);
    *sum += n;
    return ICC_OK;
}

/* Reads the caller's features and checks their numbers. The caller's struct may be of any
 * version, so its size gives the distance between features. */
static icc_status read_features(icc_feature *full, int32_t dim, size_t n_outer,
                                size_t n_outer_facets, size_t n, const icc_feature *features,
                                icc_error *err)
{
    const size_t stride = n > 0 ? features->size : 0;
    size_t n_vertices = n_outer, n_facets = n_outer_facets;
    for (size_t f = 0; f < n; ++f) {
        const icc_feature *given = (const icc_feature *)((const char *)features + f * stride);
        icc_status status = iccp_read_struct(&full[f], sizeof full[f], given, "icc_feature", err);
        if (status == ICC_OK && full[f].size != stride)
            status = iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_FEATURE, (int64_t)f,
                                  "icc_feature.size of feature %zu is not that of feature 0", f);
        if (status == ICC_OK)
            status = check_feature(dim, f, &full[f], err);
        if (status == ICC_OK)
            status = add(&n_vertices, full[f].n_vertices, "vertices", f, err);
        if (status == ICC_OK)
            status = add(&n_vertices, full[f].radius > 0 ? ICCP_RIM : 0, "vertices", f, err);
        if (status == ICC_OK)
            status = add(&n_facets, full[f].n_facets, "facets", f, err);
        if (status != ICC_OK)
            return status;
    }
    return ICC_OK;
}

/* What both functions check of the features first. */
static icc_status check_number(size_t n, const icc_feature *features, icc_error *err)
{
    if (features == NULL && n > 0)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "features is NULL");
    if (n > ICCP_MAX_COUNT)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "%zu features are too many; at most %zu", n,
                         ICCP_MAX_COUNT);
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
    iccp_env env_read;
    icc_status status = iccp_env_read(&env_read, env, err);
    if (status == ICC_OK)
        status = iccp_check_counts(n_outer, outer, 0, NULL, err);
    if (status == ICC_OK)
        status = check_number(n_features, features, err);
    if (status != ICC_OK)
        return status;
    icc_feature *full = iccp_alloc(&env_read.memory, n_features, sizeof *full);
    if (full == NULL)
        return iccp_fail_memory(err);
    status = read_features(full, 2, n_outer, 0, n_features, features, err);
    if (status == ICC_OK)
        status = iccp_domain_create_features(out, n_outer, outer, n_features, full, &env_read, err);
    iccp_free(&env_read.memory, full);
    return iccp_end_domain(status, out, &env_read, err);
}

/* Reads the features and makes the solid. */
static icc_status create_solid(icc_domain **out, const iccp_outer *outer, size_t n_features,
                               const icc_feature *features, const iccp_env *env, icc_error *err)
{
    icc_feature *full = iccp_alloc(&env->memory, n_features, sizeof *full);
    if (full == NULL)
        return iccp_fail_memory(err);
    icc_status status =
        read_features(full, 3, outer->n_vertices, outer->n_facets, n_features, features, err);
    if (status == ICC_OK)
        status = iccp_domain_create_solid(out, outer, n_features, full, env, err);
    iccp_free(&env->memory, full);
    return status;
}

icc_status icc_domain_create_solid(icc_domain **out, size_t n_vertices, const double *vertices,
                                   size_t n_facets, const uint32_t *facets, size_t n_features,
                                   const icc_feature *features, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    iccp_env full;
    const char *missing = out == NULL        ? "out"
                          : vertices == NULL ? "vertices"
                          : facets == NULL   ? "facets"
                                             : NULL;
    const iccp_outer outer = {n_vertices, n_facets, vertices, facets};
    icc_status status = iccp_begin(&full, env, missing, err);
    if (status == ICC_OK)
        status = iccp_check_counts(n_vertices, vertices, n_facets, facets, err);
    if (status == ICC_OK)
        status = check_number(n_features, features, err);
    if (status != ICC_OK)
        return status;
    status = n_features == 0
                 ? iccp_domain_create(out, 3, n_vertices, vertices, n_facets, facets, &full, err)
                 : create_solid(out, &outer, n_features, features, &full, err);
    return iccp_end_domain(status, out, &full, err);
}

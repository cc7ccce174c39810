/* Checks the arguments of the function that makes a domain with features. */
#include "api/check.h"
#include "base/env.h"
#include "base/error.h"
#include "base/options.h"
#include "domain/features.h"

#include <math.h>

ICCP_END(domain)

static icc_status check_feature(size_t f, const icc_feature *feature, icc_error *err)
{
    static const char *const counts[] = {"a hole has at least 3 vertices",
                                         "a line has at least 2 vertices", "a point has 1 vertex",
                                         "a region has at least 3 vertices"};
    if (feature->kind < ICC_FEATURE_HOLE || feature->kind > ICC_FEATURE_REGION)
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
        status = iccp_check_counts(n_outer, outer, 0, NULL, err);
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

/* Reads the features that a caller gives. */
#include "api/read_features.h"

#include "base/error.h"
#include "base/options.h"
#include "domain/features.h"

#include <math.h>

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

/* The caller's struct may be of any version, so its size gives the distance between features. */
static icc_status read_all(icc_feature *full, int32_t dim, size_t n_outer, size_t n_outer_facets,
                           size_t n, const icc_feature *features, icc_error *err)
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

icc_status iccp_read_features(icc_feature **full, int32_t dim, size_t n_outer,
                              size_t n_outer_facets, size_t n, const icc_feature *features,
                              const iccp_memory *memory, icc_error *err)
{
    *full = NULL;
    if (features == NULL && n > 0)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "features is NULL");
    if (n > ICCP_MAX_COUNT)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "%zu features are too many; at most %zu", n,
                         ICCP_MAX_COUNT);
    *full = iccp_alloc(memory, n, sizeof **full);
    if (*full == NULL)
        return iccp_fail_memory(err);
    return read_all(*full, dim, n_outer, n_outer_facets, n, features, err);
}

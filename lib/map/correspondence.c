/* Checks that the boundaries and features of two domains correspond, and says what does not. */
#include "map/correspondence.h"

#include "base/error.h"
#include "domain/features_check.h"
#include "domain/nesting_same.h"
#include "domain/network_same.h"

static const char *turn_of(const icc_domain *domain)
{
    if (domain->dim == 2)
        return domain->orientation > 0 ? "counter-clockwise" : "clockwise";
    return domain->orientation > 0 ? "oriented outward" : "oriented inward";
}

/* Reports the first feature of the longer list that is not like the one in its place in the other
 * list. */
static icc_status fail_count(int32_t dim, const iccp_features *source, const iccp_features *target,
                             icc_error *err)
{
    const size_t n = source != NULL ? source->n : 0, m = target != NULL ? target->n : 0;
    const iccp_features *more = n > m ? source : target;
    size_t i = 0;
    for (; i < n && i < m; ++i) {
        const iccp_feature *a = &source->item[i], *b = &target->item[i];
        if (a->kind != b->kind || a->n != b->n || a->n_facets != b->n_facets)
            break;
    }
    const icc_status status =
        iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_FEATURE, (int64_t)i,
                     "feature %zu (%s) has no partner in the %s, which has %zu features instead "
                     "of %zu: list the features of both in the same order",
                     i, iccp_feature_name(dim, more->item[i].kind), n > m ? "target" : "source",
                     n > m ? m : n, n > m ? n : m);
    return iccp_fail_side(err, status, n > m ? 1 : 2);
}

static bool has_outer(const iccp_features *features)
{
    return features == NULL || features->n_outer > 0;
}

/* Checks that feature i of both domains has one kind and the same number of vertices, and that
 * rings turn the same way. */
static icc_status check_features(int32_t dim, const iccp_features *source,
                                 const iccp_features *target, icc_error *err)
{
    const size_t n = source != NULL ? source->n : 0, m = target != NULL ? target->n : 0;
    if (has_outer(source) != has_outer(target))
        return iccp_fail(err, ICC_ERR_BOUNDARY,
                         "the source has %s, the target %s: both need the same parts",
                         has_outer(source) ? "an outer ring" : "only regions",
                         has_outer(target) ? "an outer ring" : "only regions");
    if (n != m)
        return fail_count(dim, source, target, err);
    for (size_t i = 0; i < n; ++i) {
        const iccp_feature *a = &source->item[i], *b = &target->item[i];
        if (a->kind != b->kind || a->n != b->n)
            return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_FEATURE, (int64_t)i,
                                "feature %zu is %s of %lu vertices, but in the source %s of "
                                "%lu: list the features of both in the same order, and vertex i "
                                "must correspond to vertex i",
                                i, iccp_feature_name(dim, b->kind), (unsigned long)b->n,
                                iccp_feature_name(dim, a->kind), (unsigned long)a->n);
        if (a->n_facets != b->n_facets)
            return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_FEATURE, (int64_t)i,
                                "feature %zu has %lu facets, but in the source %lu", i,
                                (unsigned long)b->n_facets, (unsigned long)a->n_facets);
        if (a->orientation != b->orientation)
            return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_FEATURE, (int64_t)i,
                                "feature %zu (%s) is %s, but in the source %s: both must turn "
                                "the same way",
                                i, iccp_feature_name(dim, b->kind),
                                b->orientation > 0 ? "counter-clockwise" : "clockwise",
                                a->orientation > 0 ? "counter-clockwise" : "clockwise");
    }
    return ICC_OK;
}

icc_status iccp_check_correspondence(const icc_domain *source, const icc_domain *target,
                                     icc_error *err)
{
    icc_status status = ICC_OK;
    const size_t n_ends = iccp_domain_n_listed(source) * (size_t)source->dim;
    if (source->dim != target->dim)
        status = iccp_fail(err, ICC_ERR_BOUNDARY, "the source has dimension %ld, the target %ld",
                           (long)source->dim, (long)target->dim);
    else if ((status = check_features(source->dim, source->features, target->features, err)) !=
             ICC_OK)
        return iccp_fail_side(err, status, 2);
    else if (source->n_vertices != target->n_vertices)
        status = iccp_fail(err, ICC_ERR_BOUNDARY,
                           "the source has %zu vertices, the target %zu: vertex i must "
                           "correspond to vertex i",
                           source->n_vertices, target->n_vertices);
    else if (source->n_facets != target->n_facets)
        status = iccp_fail(err, ICC_ERR_BOUNDARY, "the source has %zu facets, the target %zu",
                           source->n_facets, target->n_facets);
    else if (source->orientation != target->orientation)
        status = iccp_fail(
            err, ICC_ERR_BOUNDARY, "the source is %s, the target %s: both must turn the same way%s",
            turn_of(source), turn_of(target),
            source->dim == 2 ? "; negate y where it points down, else match the outlines" : "");
    for (size_t i = 0; status == ICC_OK && i < n_ends; ++i)
        if (source->facets[i] != target->facets[i])
            status = iccp_fail_at(
                err, ICC_ERR_BOUNDARY, ICC_ITEM_FACET, (int64_t)(i / (size_t)source->dim),
                "facet %zu does not join the same vertices in the target", i / (size_t)source->dim);
    if (status != ICC_OK)
        return iccp_fail_side(err, status, 2);
    if (source->features == NULL)
        return ICC_OK;
    return source->dim == 2 ? iccp_network_same(source, target, err)
                            : iccp_nesting_same(source, target, err);
}

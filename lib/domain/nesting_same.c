/* Compares the regions in which the features of two solids lie. solid_check.c has found them. */
#include "domain/nesting_same.h"

#include "base/error.h"
#include "domain/features_check.h"

#include <stdio.h>

/* Writes where a region is, by its number. */
static const char *name_place(const iccp_features *features, uint32_t region, char *text)
{
    uint32_t f = 0, n = 0;
    if (region == 0)
        return "outside all regions";
    while ((n += features->item[f].kind == ICC_FEATURE_REGION) < region)
        ++f;
    (void)snprintf(text, ICCP_FEATURE_TEXT, "in feature %lu (%s)", (unsigned long)f,
                   iccp_feature_name(3, ICC_FEATURE_REGION));
    return text;
}

static icc_status fail_place(icc_error *err, const iccp_features *features, const char *what,
                             int32_t item, int64_t index, uint32_t source, uint32_t target)
{
    char places[2][ICCP_FEATURE_TEXT];
    return iccp_fail_at(err, ICC_ERR_TOPOLOGY, item, index,
                        "%s is %s in the source, but %s in the target: move it, or list the "
                        "features of both in the same order",
                        what, name_place(features, source, places[0]),
                        name_place(features, target, places[1]));
}

/* Returns the region at a facet of the outer surface. */
static uint32_t region_at(const iccp_features *features, size_t facet)
{
    const uint32_t *sides = features->sides + 2 * facet;
    return sides[0] != ICCP_NO_REGION ? sides[0] : sides[1];
}

/* The outer surface may have voids of its own, which may lie in regions. */
static icc_status compare_outer(const iccp_features *source, const iccp_features *target,
                                icc_error *err)
{
    for (size_t f = 0; f < source->n_outer_facets; ++f) {
        const uint32_t a = region_at(source, f), b = region_at(target, f);
        if (a != b)
            return fail_place(err, source, "a void of the outer surface", ICC_ITEM_FACET,
                              (int64_t)f, a, b);
    }
    return ICC_OK;
}

icc_status iccp_nesting_same(const icc_domain *source, const icc_domain *target, icc_error *err)
{
    const iccp_features *features = source->features;
    char name[ICCP_FEATURE_TEXT];
    for (uint32_t f = 0; f < features->n; ++f) {
        const uint32_t a = features->item[f].around, b = target->features->item[f].around;
        if (a != b)
            return fail_place(err, features, iccp_feature_text(features, f, name), ICC_ITEM_FEATURE,
                              f, a, b);
    }
    return compare_outer(features, target->features, err);
}

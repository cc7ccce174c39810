/* Assigns landmarks to the outer ring or to features. */
#include "match/feature_landmarks.h"

#include "base/error.h"
#include "domain/features_check.h"
#include "geometry/segment.h"

#include <math.h>
#include <string.h>

#define NONE ICCP_NO_FEATURE

/* Returns the nearest feature, or NONE if the outer ring is nearer or there are no features. Leaves
 * a point that is not finite to the first part, where it is refused. */
static uint32_t feature_near(const icc_domain *domain, const iccp_domain_parts *parts,
                             const double *point)
{
    const iccp_features *const all = domain->features;
    double local[2], share, least = HUGE_VAL;
    size_t nearest = 0;
    if (all == NULL || !isfinite(point[0]) || !isfinite(point[1]))
        return parts->part[0].ring;
    iccp_frame_in(&domain->frame, 2, point, local);
    for (size_t k = 0; k < all->n_places; ++k) {
        const uint32_t *const ends = domain->facets + 2 * k;
        const double d =
            iccp_segment_nearest(domain->vertices + 2 * (size_t)ends[0],
                                 domain->vertices + 2 * (size_t)ends[1], local, &share);
        if (d < least) {
            least = d;
            nearest = k;
        }
    }
    for (uint32_t f = 0; f < all->n; ++f)
        if (nearest >= all->item[f].first_facet &&
            nearest - all->item[f].first_facet < all->item[f].n_facets)
            return f;
    return NONE;
}

static const char *name_of(const icc_domain *domain, uint32_t feature)
{
    return feature == NONE ? "the outer ring"
                           : iccp_feature_name(2, domain->features->item[feature].kind);
}

static int32_t kind_of(const iccp_domain_parts *parts, uint32_t feature)
{
    return feature == NONE ? ICCP_KIND_OUTLINE : parts->kind[feature];
}

/* Checks that both sides' features may be partners, and that no earlier landmark gave them or their
 * parts others. */
static icc_status check(const iccp_sorted_landmarks *all, const iccp_feature_landmark *l,
                        const icc_domain *const *domains, const iccp_domain_parts *parts,
                        icc_error *err)
{
    const uint32_t f = l->feature[0], g = l->feature[1];
    if (kind_of(&parts[0], f) != kind_of(&parts[1], g))
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)l->number,
                            "landmark %zu lies on %s of the source, but on %s of the target",
                            l->number, name_of(domains[0], f), name_of(domains[1], g));
    for (size_t k = 0; k < all->n; ++k) {
        const iccp_feature_landmark *const m = &all->item[k];
        const uint32_t p = m->feature[0], q = m->feature[1];
        if ((p == f) != (q == g))
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)l->number,
                                "landmark %zu pairs %s with another one than landmark %zu does",
                                l->number, name_of(domains[0], f), m->number);
        if ((iccp_part_of(&parts[0], p) == iccp_part_of(&parts[0], f)) !=
            (iccp_part_of(&parts[1], q) == iccp_part_of(&parts[1], g)))
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)l->number,
                                "landmarks %zu and %zu lie on one part of the one side, but on two "
                                "of the other",
                                m->number, l->number);
    }
    return ICC_OK;
}

icc_status iccp_landmarks_sort(iccp_sorted_landmarks *out, size_t n, const double *given,
                               const icc_domain *const *domains, const iccp_domain_parts *parts,
                               const iccp_memory *memory, icc_error *err)
{
    *out = (iccp_sorted_landmarks){.given = given};
    out->item = iccp_alloc(memory, n, sizeof *out->item);
    if (out->item == NULL)
        return iccp_fail_memory(err);
    for (size_t k = 0; k < n; ++k) {
        const double *const p = given + 4 * k;
        const iccp_feature_landmark l = {
            k,
            {feature_near(domains[0], &parts[0], p), feature_near(domains[1], &parts[1], p + 2)}};
        const icc_status status = check(out, &l, domains, parts, err);
        if (status != ICC_OK)
            return status;
        out->item[out->n++] = l;
    }
    return ICC_OK;
}

size_t iccp_landmarks_on(const iccp_sorted_landmarks *landmarks, uint32_t feature, size_t *number,
                         double *given)
{
    size_t n = 0;
    for (size_t k = 0; k < landmarks->n; ++k)
        if (landmarks->item[k].feature[0] == feature) {
            number[n] = landmarks->item[k].number;
            memcpy(given + 4 * n++, landmarks->given + 4 * landmarks->item[k].number,
                   4 * sizeof *given);
        }
    return n;
}

void iccp_sorted_landmarks_free(iccp_sorted_landmarks *landmarks, const iccp_memory *memory)
{
    iccp_free(memory, landmarks->item);
}

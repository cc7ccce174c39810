/* Assigns landmarks to the outer ring or to features. */
#include "match/feature_landmarks.h"

#include "base/error.h"
#include "domain/features.h"
#include "domain/features_check.h"
#include "geometry/segment.h"
#include "match/feature_partners.h"

#include <math.h>
#include <string.h>

#define NONE UINT32_MAX

/* Returns the nearest feature, or NONE if the outer ring is nearer or there are no features. */
static uint32_t feature_near(const icc_domain *domain, const double *point)
{
    const iccp_features *const all = domain->features;
    double local[2], share, least = HUGE_VAL;
    size_t nearest = 0;
    if (all == NULL || !isfinite(point[0]) || !isfinite(point[1]))
        return NONE;
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
                           : iccp_feature_name(domain->features->item[feature].kind);
}

/* Checks that both sides' features may be partners, and that no earlier landmark gave them
 * others. */
static icc_status check(const iccp_parted_landmarks *all, const iccp_feature_landmark *l,
                        const icc_domain *source, const icc_domain *target, icc_error *err)
{
    const uint32_t f = l->feature[0], g = l->feature[1];
    if ((f == NONE) != (g == NONE) || (f != NONE && !iccp_features_may_pair(source, f, target, g)))
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)l->number,
                            "landmark %zu lies on %s of the source, but on %s of the target",
                            l->number, name_of(source, f), name_of(target, g));
    for (size_t k = 0; k < all->n_inside && f != NONE; ++k) {
        const iccp_feature_landmark *const m = &all->inside[k];
        if ((m->feature[0] == f) != (m->feature[1] == g))
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)l->number,
                                "landmark %zu pairs %s with another one than landmark %zu does",
                                l->number, name_of(source, f), m->number);
    }
    return ICC_OK;
}

icc_status iccp_landmarks_part(iccp_parted_landmarks *out, size_t n, const double *given,
                               const icc_domain *source, const icc_domain *target,
                               const iccp_memory *memory, icc_error *err)
{
    *out = (iccp_parted_landmarks){.given = given};
    out->number = iccp_alloc(memory, n, sizeof *out->number);
    out->ring = iccp_alloc(memory, n, 4 * sizeof *out->ring);
    out->inside = iccp_alloc(memory, n, sizeof *out->inside);
    if (out->number == NULL || out->ring == NULL || out->inside == NULL)
        return iccp_fail_memory(err);
    for (size_t k = 0; k < n; ++k) {
        const double *const p = given + 4 * k;
        const iccp_feature_landmark l = {k, {feature_near(source, p), feature_near(target, p + 2)}};
        const icc_status status = check(out, &l, source, target, err);
        if (status != ICC_OK)
            return status;
        if (l.feature[0] != NONE) {
            out->inside[out->n_inside++] = l;
            continue;
        }
        memcpy(out->ring + 4 * out->n_ring, p, 4 * sizeof *p);
        out->number[out->n_ring++] = k;
    }
    return ICC_OK;
}

void iccp_parted_landmarks_free(iccp_parted_landmarks *landmarks, const iccp_memory *memory)
{
    iccp_free(memory, landmarks->number);
    iccp_free(memory, landmarks->ring);
    iccp_free(memory, landmarks->inside);
}

/* Mean value coordinates of the outer rings predict where each feature should lie in the target and
 * how it is bent. The moved features are paired with those that are nearest on the whole. The
 * pairing of two holes or lines begins at their nearest points. */
#include "match/feature_pairing.h"

#include "base/error.h"
#include "domain/features.h"
#include "match/feature_partners.h"
#include "match/mean_value.h"
#include "match/outline/landmarks.h"
#include "match/outline/ring_pairing.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

#define NONE UINT32_MAX

typedef struct pairing {
    const icc_domain *domain[2];
    double *moved; /* the source's vertices, moved to where the target's should be */
    uint32_t *partner;
    const iccp_parted_landmarks *landmarks;
    size_t *number; /* of one feature's landmarks */
    double *given, *shares;
    const icc_match_options *options;
} pairing;

static void release(pairing *p, const iccp_memory *memory)
{
    iccp_free(memory, p->moved);
    iccp_free(memory, p->partner);
    iccp_free(memory, p->number);
    iccp_free(memory, p->given);
    iccp_free(memory, p->shares);
}

static icc_status reserve(pairing *p, const iccp_memory *memory, icc_error *err)
{
    const size_t n = p->landmarks->n_inside;
    p->moved = iccp_alloc(memory, p->domain[0]->n_vertices, 2 * sizeof *p->moved);
    p->partner = iccp_alloc(memory, p->domain[0]->features->n, sizeof *p->partner);
    p->number = iccp_alloc(memory, n, sizeof *p->number);
    p->given = iccp_alloc(memory, n, 4 * sizeof *p->given);
    p->shares = iccp_alloc(memory, n + 2, 2 * sizeof *p->shares);
    return p->moved != NULL && p->partner != NULL && p->number != NULL && p->given != NULL &&
                   p->shares != NULL
               ? ICC_OK
               : iccp_fail_memory(err);
}

/* Moves the inside of the source as the outer rings predict. */
static void move_inside(pairing *p, const iccp_outline *outer, const iccp_union_outline *common)
{
    iccp_mean_value at;
    const icc_domain *const source = p->domain[0];
    const size_t n_outer = source->features->n_outer;
    memcpy(p->moved, source->vertices, 2 * source->n_vertices * sizeof *p->moved);
    iccp_mean_value_sample(&at, common, &outer[0], &outer[1]);
    iccp_mean_value_move(&at, source->n_vertices - n_outer, p->moved + 2 * n_outer);
}

/* Collects the landmarks of one feature. Returns their number. */
static size_t collect(pairing *p, uint32_t feature)
{
    size_t n = 0;
    for (size_t k = 0; k < p->landmarks->n_inside; ++k)
        if (p->landmarks->inside[k].feature[0] == feature) {
            p->number[n] = p->landmarks->inside[k].number;
            memcpy(p->given + 4 * n++, p->landmarks->given + 4 * p->landmarks->inside[k].number,
                   4 * sizeof *p->given);
        }
    return n;
}

/* Returns true if a line's partner, walked from its first vertex, runs in the opposite direction.
 * The order of their n landmarks decides. With one landmark its place along both decides, and
 * without any, the ends. */
static bool runs_against(const pairing *p, const iccp_outline *lines, size_t n)
{
    double sum[2] = {0, 0}, product = 0, along = 0, against = 0, away;
    for (size_t k = 0; k < n; ++k) {
        const double a = iccp_landmark_share(&lines[0], p->given + 4 * k, &away);
        const double b = iccp_landmark_share(&lines[1], p->given + 4 * k + 2, &away);
        sum[0] += a;
        sum[1] += b;
        product += a * b;
        along += fabs(b - a);
        against += fabs(0.5 - b - a);
    }
    if (n > 1)
        return product < sum[0] * sum[1] / (double)n;
    for (size_t k = 0; k < 2 && n == 0; ++k) {
        const double *const a = p->moved + 2 * (size_t)lines[0].vertex[k * lines[0].end];
        const double *const b = lines[1].points + 2 * k * lines[1].end;
        const double *const c = lines[1].points + 2 * (1 - k) * lines[1].end;
        along += iccp_hypot(b[0] - a[0], b[1] - a[1]);
        against += iccp_hypot(c[0] - a[0], c[1] - a[1]);
    }
    return against < along;
}

/* Makes the ends of two lines landmarks, in order with n others. Returns the new number, or 0 if
 * not all can be obeyed. */
static size_t add_ends(pairing *p, const iccp_outline *lines, size_t n)
{
    const double end[2] = {lines[0].share[lines[0].end], lines[1].share[lines[1].end]};
    bool has_first = false, has_last = false;
    for (size_t k = 0; k < n; ++k) {
        const double *const s = p->shares + 2 * k;
        if ((s[0] == 0) != (s[1] == 0) || (s[0] == end[0]) != (s[1] == end[1]) || s[1] > end[1])
            return 0;
        has_first = has_first || s[0] == 0;
        has_last = has_last || s[0] == end[0];
    }
    if (!has_first) {
        memmove(p->shares + 2, p->shares, 2 * n++ * sizeof *p->shares);
        p->shares[0] = p->shares[1] = 0;
    }
    if (!has_last)
        memcpy(p->shares + 2 * n++, end, sizeof end);
    return n;
}

/* Moves the source's outline and n landmarks with it, unless the outline would collapse. */
static void move_outline(pairing *p, iccp_outline *outline, size_t n)
{
    for (size_t k = 0; k < n; ++k) {
        double along;
        const size_t edge = iccp_outline_edge(outline, p->shares[2 * k], &along);
        p->shares[2 * k] = (double)edge + along;
    }
    iccp_outline_place(outline, p->moved);
    if (!(outline->perimeter > 0))
        iccp_outline_place(outline, outline->domain->vertices);
    for (size_t k = 0; k < n; ++k) {
        const double edge = floor(p->shares[2 * k]), along = p->shares[2 * k] - edge;
        const double *const s = outline->share + (size_t)edge;
        p->shares[2 * k] = s[0] + along * (s[1] - s[0]);
    }
}

/* Pairs two holes or lines. */
static icc_status pair_outlines(pairing *p, iccp_union_outline *common, iccp_outline *outline,
                                uint32_t feature, const iccp_env *env, icc_error *err)
{
    const uint32_t partner = p->partner[feature];
    const iccp_memory *const memory = &env->memory;
    size_t n = collect(p, feature);
    icc_status status =
        iccp_outline_create_feature(&outline[0], p->domain[0], feature, false, memory);
    if (status == ICC_OK)
        status = iccp_outline_create_feature(&outline[1], p->domain[1], partner, false, memory);
    if (status == ICC_OK && outline[0].end > 0 && runs_against(p, outline, n)) {
        iccp_outline_free(&outline[1], memory);
        status = iccp_outline_create_feature(&outline[1], p->domain[1], partner, true, memory);
    }
    if (status != ICC_OK)
        return iccp_explain(err, status);
    status = iccp_landmarks_place(p->shares, n, p->given, p->number, &outline[0], &outline[1],
                                  memory, err);
    if (status != ICC_OK)
        return status;
    if (outline[0].end > 0 && (n = add_ends(p, outline, n)) == 0)
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)p->number[0],
                            "landmarks of feature %lu (a line) are not in order along it, or pair "
                            "one of its ends with a vertex that is no end",
                            (unsigned long)feature);
    move_outline(p, &outline[0], n);
    return iccp_pair_moved(common, &outline[0], &outline[1], n, p->shares, p->options, env, err);
}

static icc_status pair_feature(pairing *p, iccp_matched_domains *matched, uint32_t feature,
                               const iccp_env *env, icc_error *err)
{
    const iccp_feature *const a = &p->domain[0]->features->item[feature];
    const iccp_feature *const b = &p->domain[1]->features->item[p->partner[feature]];
    icc_status status = ICC_OK;
    if (a->kind == ICC_FEATURE_POINT || a->rim_of != NONE) {
        iccp_matched_domains_add_vertices(matched, p->domain,
                                          (const uint32_t[]){a->first, b->first}, a->n);
    } else {
        iccp_union_outline common = {0};
        iccp_outline outline[2] = {{0}, {0}};
        status = pair_outlines(p, &common, outline, feature, env, err);
        if (status == ICC_OK)
            iccp_matched_domains_add(matched, outline, &common);
        iccp_union_outline_free(&common, &env->memory);
        iccp_outline_free(&outline[0], &env->memory);
        iccp_outline_free(&outline[1], &env->memory);
    }
    iccp_matched_domains_end_feature(matched, a->kind);
    return status;
}

icc_status iccp_pair_features(iccp_matched_domains *matched, const iccp_outline *outer,
                              const iccp_union_outline *common,
                              const iccp_parted_landmarks *landmarks,
                              const icc_match_options *options, const iccp_env *env, icc_error *err)
{
    pairing p = {
        .domain = {outer[0].domain, outer[1].domain}, .landmarks = landmarks, .options = options};
    const size_t n = p.domain[0]->features != NULL ? p.domain[0]->features->n : 0;
    if (n == 0)
        return ICC_OK;
    icc_status status = reserve(&p, &env->memory, err);
    if (status == ICC_OK) {
        move_inside(&p, outer, common);
        for (size_t f = 0; f < n; ++f)
            p.partner[f] = NONE;
        for (size_t k = 0; k < landmarks->n_inside; ++k)
            p.partner[landmarks->inside[k].feature[0]] = landmarks->inside[k].feature[1];
        status = iccp_features_partner(p.partner, p.domain[0], p.domain[1], p.moved,
                                       iccp_least_sure(options), env, err);
    }
    for (uint32_t f = 0; f < n && status == ICC_OK; ++f) {
        const iccp_env part =
            iccp_part(env, NULL, (double)f / (double)n, (double)(f + 1) / (double)n);
        status = pair_feature(&p, matched, f, &part, err);
        if (status == ICC_OK)
            status = iccp_explain(err, iccp_progress(&part, NULL, 1));
    }
    release(&p, &env->memory);
    return status;
}

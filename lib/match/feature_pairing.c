/* Mean value coordinates of the outline around it predict where each feature should lie in the
 * target and how it is bent. The moved features are paired with those that are nearest on the
 * whole. The pairing of two holes or lines begins at their nearest points. */
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

#define NONE ICCP_NO_FEATURE

typedef struct pairing {
    const icc_domain *domain[2];
    const iccp_paired_parts *paired;
    double *moved; /* the source's vertices, moved to where the target's should be */
    uint32_t *partner;
    const iccp_sorted_landmarks *landmarks;
    size_t *number; /* of one feature's landmarks */
    double *given, *shares;
    const icc_match_options *options;
} pairing;

static void release(pairing *p, const iccp_memory *memory)
{
    iccp_free(memory, p->partner);
    iccp_free(memory, p->number);
    iccp_free(memory, p->given);
    iccp_free(memory, p->shares);
}

static icc_status reserve(pairing *p, const iccp_memory *memory, icc_error *err)
{
    const size_t n = p->landmarks->n;
    p->partner = iccp_alloc(memory, p->domain[0]->features->n, sizeof *p->partner);
    p->number = iccp_alloc(memory, n, sizeof *p->number);
    p->given = iccp_alloc(memory, n, 4 * sizeof *p->given);
    p->shares = iccp_alloc(memory, n + 2, 2 * sizeof *p->shares);
    return p->partner != NULL && p->number != NULL && p->given != NULL && p->shares != NULL
               ? ICC_OK
               : iccp_fail_memory(err);
}

/* Moves the inside of one part of the source as its outline predicts. */
static void move_inside(const pairing *p, uint32_t part)
{
    iccp_mean_value at;
    const iccp_part_pair *const pair = &p->paired->pair[part];
    const iccp_domain_parts *const parts = &p->paired->parts[0];
    const iccp_features *const all = p->domain[0]->features;
    iccp_mean_value_sample(&at, &pair->common, &pair->outline[0], &pair->outline[1]);
    for (size_t f = 0; f < all->n; ++f)
        if (parts->of[f] == part && parts->kind[f] != ICCP_KIND_OUTLINE)
            iccp_mean_value_move(&at, all->item[f].n, p->moved + 2 * (size_t)all->item[f].first);
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
    size_t n = iccp_landmarks_on(p->landmarks, feature, p->number, p->given);
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
    iccp_elastic_report report;
    return iccp_pair_moved(common, &report, &outline[0], &outline[1], n, p->shares, p->options, env,
                           err);
}

static icc_status pair_feature(pairing *p, iccp_matched_domains *matched, uint32_t feature,
                               const iccp_env *env, icc_error *err)
{
    const iccp_feature *const a = &p->domain[0]->features->item[feature];
    const iccp_feature *const b = &p->domain[1]->features->item[p->partner[feature]];
    if (a->kind == ICC_FEATURE_POINT || a->rim_of != NONE) {
        iccp_matched_domains_add_vertices(matched, p->domain,
                                          (const uint32_t[]){a->first, b->first}, a->n);
        return ICC_OK;
    }
    iccp_union_outline common = {0};
    iccp_outline outline[2] = {{0}, {0}};
    const icc_status status = pair_outlines(p, &common, outline, feature, env, err);
    if (status == ICC_OK)
        iccp_matched_domains_add(matched, outline, &common);
    if (status == ICC_OK && p->paired->parts[0].kind[feature] == ICCP_KIND_CLOSED)
        iccp_matched_domains_close(matched, a->first + a->n - 1);
    iccp_union_outline_free(&common, &env->memory);
    iccp_outline_free(&outline[0], &env->memory);
    iccp_outline_free(&outline[1], &env->memory);
    return status;
}

/* Finds the partners of all features but the outlines of parts. */
static icc_status find_partners(pairing *p, const iccp_env *env, icc_error *err)
{
    const iccp_domain_parts *const parts = p->paired->parts;
    uint32_t *const part_partner = iccp_alloc(&env->memory, parts[0].n, sizeof *part_partner);
    if (part_partner == NULL)
        return iccp_fail_memory(err);
    for (uint32_t k = 0; k < parts[0].n; ++k) {
        part_partner[k] = p->paired->pair[k].partner;
        move_inside(p, k);
    }
    for (size_t f = 0; f < p->domain[0]->features->n; ++f)
        p->partner[f] = NONE;
    for (size_t k = 0; k < p->landmarks->n; ++k) {
        const uint32_t *const feature = p->landmarks->item[k].feature;
        if (feature[0] != NONE && parts[0].kind[feature[0]] != ICCP_KIND_OUTLINE)
            p->partner[feature[0]] = feature[1];
    }
    const icc_status status =
        iccp_features_partner(p->partner, p->domain[0], p->domain[1], parts, part_partner, p->moved,
                              iccp_least_sure(p->options), env, err);
    iccp_free(&env->memory, part_partner);
    return status;
}

icc_status iccp_pair_features(iccp_matched_domains *matched, iccp_paired_parts *paired,
                              const iccp_sorted_landmarks *landmarks,
                              const icc_match_options *options, const iccp_env *env, icc_error *err)
{
    pairing p = {.domain = {paired->domain[0], paired->domain[1]},
                 .paired = paired,
                 .moved = paired->moved,
                 .landmarks = landmarks,
                 .options = options};
    const iccp_domain_parts *const source = &paired->parts[0];
    const size_t n = p.domain[0]->features != NULL ? p.domain[0]->features->n : 0;
    if (n == 0)
        return ICC_OK;
    icc_status status = reserve(&p, &env->memory, err);
    if (status == ICC_OK)
        status = find_partners(&p, env, err);
    for (uint32_t f = 0; f < n && status == ICC_OK; ++f) {
        const iccp_env part =
            iccp_part(env, NULL, (double)f / (double)n, (double)(f + 1) / (double)n);
        const iccp_part_pair *const pair = &paired->pair[source->of[f]];
        if (source->kind[f] == ICCP_KIND_OUTLINE)
            iccp_matched_domains_add(matched, pair->outline, &pair->common);
        else
            status = pair_feature(&p, matched, f, &part, err);
        iccp_matched_domains_end_feature(matched, p.domain[0]->features->item[f].kind);
        if (status == ICC_OK)
            status = iccp_explain(err, iccp_progress(&part, NULL, 1));
    }
    release(&p, &env->memory);
    return status;
}

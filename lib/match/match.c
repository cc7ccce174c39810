/* Creating and freeing a match: outlines in the plane, surfaces in space. */
#include "match/match.h"

#include "base/error.h"
#include "base/minmax.h"
#include "match/feature_pairing.h"
#include "match/match_apply.h"
#include "match/outline/ring_pairing.h"
#include "match/part_partners.h"
#include "match/surfaces.h"

#include <math.h>

void iccp_match_release(icc_match *match)
{
    if (match == NULL)
        return;
    for (int e = 0; e < 2; ++e) {
        iccp_facet_tree_free(&match->places[e], &match->memory);
        iccp_domain_release(match->domain[e]);
        iccp_free(&match->memory, match->origin[e]);
    }
    iccp_free(&match->memory, match);
}

static icc_status check(const icc_domain *domain, int32_t side, icc_error *err)
{
    if (domain->dim != 2 && domain->dim != 3) {
        iccp_fail(err, ICC_ERR_UNSUPPORTED,
                  "only domains of the plane and of space can be matched, not %ld-D",
                  (long)domain->dim);
        return iccp_fail_side(err, ICC_ERR_UNSUPPORTED, side);
    }
    if (domain->mesh != NULL) {
        iccp_fail(err, ICC_ERR_UNSUPPORTED, "a domain with a mesh cannot be matched");
        return iccp_fail_side(err, ICC_ERR_UNSUPPORTED, side);
    }
    static const char what[] = "a solid to be matched";
    if (domain->dim == 2)
        return ICC_OK;
    const icc_status status = iccp_domain_require_ball(domain, what, err);
    return status == ICC_OK ? ICC_OK : iccp_fail_side(err, status, side);
}

static icc_status check_both(const icc_domain *source, const icc_domain *target, icc_error *err)
{
    icc_status status = check(source, 1, err);
    if (status == ICC_OK)
        status = check(target, 2, err);
    if (status == ICC_OK && source->dim != target->dim)
        status = iccp_fail(err, ICC_ERR_UNSUPPORTED,
                           "a domain of %ld dimensions cannot be matched with one of %ld",
                           (long)source->dim, (long)target->dim);
    return status;
}

/* Makes the two domains. */
static icc_status make(icc_match *match, iccp_matched_domains *matched, const iccp_env *env,
                       icc_error *err)
{
    icc_status status = ICC_OK;
    match->n = matched->n;
    for (size_t e = 0; e < 2 && status == ICC_OK; ++e) {
        match->origin[e] = matched->origin[e];
        matched->origin[e] = NULL;
        status = iccp_matched_domains_get(&match->domain[e], matched, e, env, err);
    }
    return status;
}

/* Returns true if a part's pairing tells more about the whole than that of another part. Shapes say
 * more than what the whole decided; then what is less sure; then what costs more. */
static bool tells_more(const iccp_part_pair *a, const iccp_part_pair *b)
{
    if (a->is_placed != b->is_placed)
        return b->is_placed;
    return a->report.sure != b->report.sure ? a->report.sure < b->report.sure
                                            : a->report.cost > b->report.cost;
}

static void fill_in(icc_match_info *info, const iccp_paired_parts *paired,
                    const iccp_matched_domains *matched, size_t n_landmarks)
{
    info->dim = 2;
    info->least_slope = HUGE_VAL;
    info->n_vertices = matched->n;
    info->n_landmarks = n_landmarks;
    info->n_joined = matched->n_joined;
    const iccp_part_pair *shown = paired->pair;
    for (size_t k = 0; k < paired->parts[0].n; ++k) {
        const iccp_part_pair *const pair = &paired->pair[k];
        info->least_slope = iccp_min(info->least_slope, pair->common.least);
        info->most_slope = iccp_max(info->most_slope, pair->common.most);
        shown = tells_more(pair, shown) ? pair : shown;
    }
    info->cost = shown->report.cost;
    info->second = shown->report.second;
    info->sure = shown->report.sure;
    info->turn = 360 * shown->report.turn + 0.0; /* + 0.0 turns -0 into 0 */
    info->mirrored = shown->report.mirrored >= iccp_clearly_better;
}

/* Adds the common vertices of both domains: those of the outer ring, then those of the features. */
static icc_status collect(iccp_matched_domains *matched, iccp_paired_parts *paired,
                          const iccp_sorted_landmarks *landmarks, const icc_match_options *options,
                          const iccp_env *env, icc_error *err)
{
    const icc_status status =
        iccp_explain(err, iccp_matched_domains_create(matched, paired->domain[0], paired->domain[1],
                                                      landmarks->n, &env->memory));
    if (status != ICC_OK)
        return status;
    if (paired->parts[0].part[0].ring == ICCP_NO_FEATURE)
        iccp_matched_domains_add(matched, paired->pair[0].outline, &paired->pair[0].common);
    iccp_matched_domains_end_outer(matched);
    return iccp_pair_features(matched, paired, landmarks, options, env, err);
}

/* Pairs the outlines of all parts, then the features. */
static icc_status run(icc_match *match, const icc_domain *const *domains,
                      const iccp_domain_parts *parts, const iccp_sorted_landmarks *landmarks,
                      const icc_match_options *options, const iccp_env *env, icc_error *err)
{
    iccp_env share[3];
    iccp_split(share, 3, (const double[]){20, domains[0]->features != NULL ? 10 : 0, 1}, env);
    share[0].stage = share[1].stage = "match";
    iccp_paired_parts paired = {0};
    iccp_matched_domains matched = {0};
    icc_status status =
        iccp_pair_parts(&paired, domains, parts, landmarks, options, &share[0], err);
    if (status == ICC_OK)
        status = collect(&matched, &paired, landmarks, options, &share[1], err);
    if (status == ICC_OK)
        status = make(match, &matched, &share[2], err);
    if (status == ICC_OK)
        iccp_match_index(match);
    if (status == ICC_OK)
        fill_in(&match->info, &paired, &matched, landmarks->n);
    iccp_matched_domains_free(&matched, &env->memory);
    iccp_paired_parts_free(&paired, &env->memory);
    return status;
}

static icc_status find_parts(iccp_domain_parts *parts, const icc_domain *domain, int32_t side,
                             const iccp_memory *memory, icc_error *err)
{
    const icc_status status = iccp_domain_parts_check(domain, err);
    return status == ICC_OK ? iccp_explain(err, iccp_domain_parts_create(parts, domain, memory))
                            : iccp_fail_side(err, status, side);
}

static icc_status match_outlines(icc_match *match, const icc_domain *source,
                                 const icc_domain *target, size_t n_landmarks, const double *given,
                                 const icc_match_options *options, const iccp_env *env,
                                 icc_error *err)
{
    const icc_domain *const domains[2] = {source, target};
    const iccp_memory *const memory = &env->memory;
    iccp_domain_parts parts[2] = {{0}, {0}};
    iccp_sorted_landmarks landmarks = {0};
    icc_status status = ICC_OK;
    for (int e = 0; e < 2 && status == ICC_OK; ++e)
        status = find_parts(&parts[e], domains[e], e + 1, memory, err);
    if (status == ICC_OK)
        status = iccp_parts_count(&parts[0], &parts[1], err);
    if (status == ICC_OK)
        status = iccp_landmarks_sort(&landmarks, n_landmarks, given, domains, parts, memory, err);
    if (status == ICC_OK)
        status = run(match, domains, parts, &landmarks, options, env, err);
    iccp_sorted_landmarks_free(&landmarks, memory);
    for (int e = 0; e < 2; ++e)
        iccp_domain_parts_free(&parts[e], memory);
    return status;
}

icc_status iccp_match_create(icc_match **out, const icc_domain *source, const icc_domain *target,
                             size_t n_landmarks, const double *landmarks,
                             const icc_match_options *options, const iccp_env *env, icc_error *err)
{
    icc_status status = check_both(source, target, err);
    if (status != ICC_OK)
        return status;
    icc_match *const match = iccp_alloc_zero(&env->memory, 1, sizeof *match);
    if (match == NULL)
        return iccp_fail_memory(err);
    match->memory = env->memory;
    if (source->dim == 2)
        status = match_outlines(match, source, target, n_landmarks, landmarks, options, env, err);
    else
        status =
            iccp_match_surfaces(match, source, target, n_landmarks, landmarks, options, env, err);
    if (status == ICC_OK)
        *out = match;
    else
        iccp_match_release(match);
    return status;
}

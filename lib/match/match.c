/* Creating and freeing a match: outlines in the plane, surfaces in space. */
#include "match/match.h"

#include "base/error.h"
#include "match/feature_pairing.h"
#include "match/feature_partners.h"
#include "match/match_apply.h"
#include "match/outline/landmarks.h"
#include "match/outline/ring_pairing.h"
#include "match/surfaces.h"

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
    return ICC_OK;
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
    return status == ICC_OK ? iccp_features_count(source, target, err) : status;
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

static void fill_in(icc_match_info *info, const iccp_elastic_report *report,
                    const iccp_union_outline *outer, const iccp_matched_domains *matched,
                    size_t n_landmarks)
{
    info->dim = 2;
    info->cost = report->cost;
    info->second = report->second;
    info->sure = report->sure;
    info->turn = 360 * report->turn + 0.0; /* + 0.0 turns -0 into 0 */
    info->mirrored = report->mirrored >= iccp_clearly_better;
    info->n_vertices = matched->n;
    info->n_landmarks = n_landmarks;
    info->n_joined = matched->n_joined;
    info->least_slope = outer->least;
    info->most_slope = outer->most;
}

/* Pairs the outer rings, then the features. */
static icc_status run(icc_match *match, iccp_outline *outline, size_t n, const double *given,
                      const icc_match_options *options, const iccp_env *env, icc_error *err)
{
    const iccp_memory *const memory = &env->memory;
    const icc_domain *const source = outline[0].domain, *const target = outline[1].domain;
    iccp_env parts[3];
    iccp_split(parts, 3, (const double[]){20, source->features != NULL ? 10 : 0, 1}, env);
    parts[0].stage = parts[1].stage = "match";
    iccp_elastic_report report = {0};
    iccp_union_outline common = {0};
    iccp_matched_domains matched = {0};
    iccp_parted_landmarks landmarks = {0};
    double *const shares = iccp_alloc(memory, 2 * n, sizeof *shares);
    icc_status status = shares == NULL ? iccp_fail_memory(err) : ICC_OK;
    if (status == ICC_OK)
        status = iccp_landmarks_part(&landmarks, n, given, source, target, memory, err);
    if (status == ICC_OK)
        status = iccp_landmarks_place(shares, landmarks.n_ring, landmarks.ring, landmarks.number,
                                      &outline[0], &outline[1], memory, err);
    if (status == ICC_OK)
        status = iccp_pair_rings(&common, &report, &outline[0], &outline[1], landmarks.n_ring,
                                 shares, options, &parts[0], err);
    if (status == ICC_OK)
        status =
            iccp_explain(err, iccp_matched_domains_create(&matched, source, target, n, memory));
    if (status == ICC_OK) {
        iccp_matched_domains_add(&matched, outline, &common);
        iccp_matched_domains_end_outer(&matched);
        status =
            iccp_pair_features(&matched, outline, &common, &landmarks, options, &parts[1], err);
    }
    if (status == ICC_OK)
        status = make(match, &matched, &parts[2], err);
    if (status == ICC_OK)
        iccp_match_index(match);
    if (status == ICC_OK)
        fill_in(&match->info, &report, &common, &matched, n);
    iccp_matched_domains_free(&matched, memory);
    iccp_union_outline_free(&common, memory);
    iccp_parted_landmarks_free(&landmarks, memory);
    iccp_free(memory, shares);
    return status;
}

static icc_status match_outlines(icc_match *match, const icc_domain *source,
                                 const icc_domain *target, size_t n_landmarks,
                                 const double *landmarks, const icc_match_options *options,
                                 const iccp_env *env, icc_error *err)
{
    iccp_outline outline[2] = {{0}, {0}};
    icc_status status = iccp_outline_create(&outline[0], source, &env->memory, err);
    if (status == ICC_OK)
        status = iccp_outline_create(&outline[1], target, &env->memory, err);
    if (status == ICC_OK)
        status = run(match, outline, n_landmarks, landmarks, options, env, err);
    for (int e = 0; e < 2; ++e)
        iccp_outline_free(&outline[e], &env->memory);
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

#include "match/match.h"

#include "base/error.h"
#include "match/arc.h"
#include "match/common.h"
#include "match/landmarks.h"
#include "match/pins.h"
#include "match/vertices.h"

#include <math.h>
#include <string.h>

/* Below it a pairing is refused. Of the development pairs (tests/bench/bench_match.c) the right
 * answers have at least 1.13, the arbitrary ones of discs and squares at most 1.05. */
static const double least_sure = 1.06;

void iccp_match_release(icc_match *match)
{
    if (match == NULL)
        return;
    for (int e = 0; e < 2; ++e) {
        iccp_domain_release(match->domain[e]);
        iccp_free(&match->memory, match->origin[e]);
    }
    iccp_free(&match->memory, match);
}

static icc_status check(const icc_domain *domain, int32_t side, icc_error *err)
{
    if (domain->dim != 2) {
        iccp_fail(err, ICC_ERR_UNSUPPORTED, "only domains of the plane can be matched, not %ld-D",
                  (long)domain->dim);
        return iccp_fail_side(err, ICC_ERR_UNSUPPORTED, side);
    }
    if (domain->features != NULL) {
        iccp_fail(err, ICC_ERR_UNSUPPORTED,
                  "a domain with holes, lines or points inside cannot be matched");
        return iccp_fail_side(err, ICC_ERR_UNSUPPORTED, side);
    }
    if (domain->mesh != NULL) {
        iccp_fail(err, ICC_ERR_UNSUPPORTED, "a domain with a mesh cannot be matched");
        return iccp_fail_side(err, ICC_ERR_UNSUPPORTED, side);
    }
    return ICC_OK;
}

static icc_status refuse(const iccp_elastic_report *report, double sure, icc_error *err)
{
    return iccp_fail(err, ICC_ERR_AMBIGUOUS,
                     "source and target match almost equally well in more than one way (%.3f, less "
                     "than %.3f times as well as in the next): give a landmark, a pair of points",
                     report->sure, sure);
}

/* The pairing as knots that pass through all landmarks. */
static icc_status find_knots(iccp_pairing_knots *knots, iccp_elastic_report *report,
                             const iccp_outline *outline, size_t n, const double *landmarks,
                             const icc_match_options *options, const iccp_env *env, icc_error *err)
{
    if (options->between == ICC_BETWEEN_ARC) {
        const double start[2] = {0, n > 0 ? 0 : iccp_arc_start(&outline[0], &outline[1])};
        knots->n = n > 0 ? n : 1;
        memcpy(knots->knot, n > 0 ? landmarks : start, 2 * knots->n * sizeof *knots->knot);
        report->cost = report->second = report->sure = HUGE_VAL;
        return ICC_OK;
    }
    icc_status status;
    iccp_env parts[2];
    iccp_split(parts, 2, (const double[]){4, 1}, env);
    if (n > 0)
        status =
            iccp_elastic_between(knots, report, &outline[0], &outline[1], n, landmarks, &parts[0]);
    else
        status = iccp_elastic_search(knots, report, &outline[0], &outline[1],
                                     options->turning == ICC_TURNING_FREE, &parts[0]);
    const double sure = options->least_sure > 0 ? options->least_sure : least_sure;
    if (status == ICC_OK && report->sure < sure)
        return refuse(report, sure, err);
    if (status == ICC_OK)
        status = iccp_pin(knots, &outline[0], &outline[1], n, landmarks, env);
    if (status == ICC_OK)
        status = iccp_pair_vertices(knots, &outline[0], &outline[1], n, landmarks, &parts[1]);
    return iccp_explain(err, status);
}

/* A vertex as it was given, or a point of an edge. */
static void point_of(double *point, const iccp_outline *outline, uint32_t vertex, double share)
{
    if (vertex != UINT32_MAX) {
        iccp_domain_given(outline->domain, outline->vertex[vertex], point);
        return;
    }
    double along, p[2], q[2];
    const size_t k = iccp_outline_edge(outline, share, &along);
    iccp_domain_given(outline->domain, outline->vertex[k], p);
    iccp_domain_given(outline->domain, outline->vertex[(k + 1) % outline->n], q);
    for (int e = 0; e < 2; ++e)
        point[e] = p[e] + along * (q[e] - p[e]);
}

/* One of the two domains. They begin with the source's vertex 0, in the source's sense. */
static icc_status build(icc_match *match, size_t e, const iccp_outline *outline,
                        const iccp_common *common, const iccp_env *env, icc_error *err)
{
    const size_t n = common->n;
    double *const points = iccp_alloc(&env->memory, 2 * n, sizeof *points);
    if (points == NULL)
        return iccp_fail_memory(err);
    size_t first = 0;
    for (size_t k = 0; k < n; ++k)
        if (common->vertex[2 * k] == 0)
            first = k;
    for (size_t k = 0; k < n; ++k) {
        const size_t on = outline[0].domain->orientation > 0 || k == 0 ? k : n - k;
        const size_t at = (first + on) % n;
        const uint32_t vertex = common->vertex[2 * at + e];
        match->origin[e][k] = vertex == UINT32_MAX ? vertex : outline[e].vertex[vertex];
        point_of(points + 2 * k, &outline[e], vertex, common->share[2 * at + e]);
    }
    const icc_status status =
        iccp_domain_create(&match->domain[e], 2, n, points, n, NULL, env, err);
    iccp_free(&env->memory, points);
    return status == ICC_OK ? status : iccp_fail_side(err, status, (int32_t)e + 1);
}

static icc_status make(icc_match *match, const iccp_outline *outline, const iccp_common *common,
                       const iccp_env *env, icc_error *err)
{
    match->n = common->n;
    for (size_t e = 0; e < 2; ++e) {
        match->origin[e] = iccp_alloc(&match->memory, match->n, sizeof *match->origin[e]);
        if (match->origin[e] == NULL)
            return iccp_fail_memory(err);
    }
    for (size_t e = 0; e < 2; ++e) {
        const icc_status status = build(match, e, outline, common, env, err);
        if (status != ICC_OK)
            return status;
    }
    return ICC_OK;
}

static void fill_in(icc_match_info *info, const iccp_elastic_report *report,
                    const iccp_common *common, size_t n_landmarks)
{
    info->dim = 2;
    info->cost = report->cost;
    info->second = report->second;
    info->sure = report->sure;
    info->turn = 360 * report->turn + 0.0; /* which is not -0 */
    info->mirrored = report->is_mirrored;
    info->n_vertices = common->n;
    info->n_landmarks = n_landmarks;
    info->n_joined = common->n_joined;
    info->least_slope = common->least;
    info->most_slope = common->most;
}

static icc_status run(icc_match *match, iccp_outline *outline, size_t n, const double *given,
                      const icc_match_options *options, const iccp_env *env, icc_error *err)
{
    const iccp_memory *const memory = &env->memory;
    iccp_env parts[2];
    iccp_split(parts, 2, (const double[]){20, 1}, env);
    parts[0].stage = "match";
    iccp_elastic_report report = {0};
    iccp_common common = {0};
    iccp_pairing_knots knots = {0};
    double *const landmarks = iccp_alloc(memory, 2 * n, sizeof *landmarks);
    knots.knot =
        iccp_alloc(memory, 2 * (4 * (size_t)ICCP_MATCH_SAMPLES + 10 * n + 512), sizeof *knots.knot);
    icc_status status = landmarks == NULL || knots.knot == NULL ? iccp_fail_memory(err) : ICC_OK;
    if (status == ICC_OK)
        status = iccp_landmarks_place(landmarks, n, given, &outline[0], &outline[1], memory, err);
    if (status == ICC_OK)
        status = find_knots(&knots, &report, outline, n, landmarks, options, &parts[0], err);
    if (status == ICC_OK)
        status = iccp_explain(err, iccp_common_create(&common, &knots, &outline[0], &outline[1], n,
                                                      landmarks, options->drop, memory));
    if (status == ICC_OK)
        status = make(match, outline, &common, &parts[1], err);
    if (status == ICC_OK)
        fill_in(&match->info, &report, &common, n);
    iccp_common_free(&common, memory);
    iccp_free(memory, knots.knot);
    iccp_free(memory, landmarks);
    return status;
}

icc_status iccp_match_create(icc_match **out, const icc_domain *source, const icc_domain *target,
                             size_t n_landmarks, const double *landmarks,
                             const icc_match_options *options, const iccp_env *env, icc_error *err)
{
    const icc_domain *const domains[2] = {source, target};
    iccp_outline outline[2] = {{0}, {0}};
    icc_status status = check(source, 1, err);
    if (status == ICC_OK)
        status = check(target, 2, err);
    if (status != ICC_OK)
        return status;
    icc_match *const match = iccp_alloc_zero(&env->memory, 1, sizeof *match);
    if (match == NULL)
        return iccp_fail_memory(err);
    match->memory = env->memory;
    for (int e = 0; e < 2 && status == ICC_OK; ++e)
        status = iccp_outline_create(&outline[e], domains[e], &env->memory, err);
    if (status == ICC_OK)
        status = run(match, outline, n_landmarks, landmarks, options, env, err);
    for (int e = 0; e < 2; ++e)
        iccp_outline_free(&outline[e], &env->memory);
    if (status == ICC_OK)
        *out = match;
    else
        iccp_match_release(match);
    return status;
}

/* Pairs two outlines by all ways in turn, then makes their vertices common. */
#include "match/outline/ring_pairing.h"

#include "base/error.h"
#include "match/outline/arc.h"
#include "match/outline/one_to_one.h"
#include "match/outline/pins.h"
#include "match/outline/vertices.h"

#include <math.h>
#include <string.h>

/* The report of a pairing that compares no shapes. */
static const iccp_elastic_report none = {.cost = HUGE_VAL, .second = HUGE_VAL, .sure = HUGE_VAL};

double iccp_least_sure(const icc_match_options *options)
{
    return options->least_sure > 0 ? options->least_sure : iccp_clearly_better;
}

/* Makes knots by arc length between landmarks, or from a start. */
static void find_by_arc(iccp_pairing_knots *knots, size_t n, const double *landmarks,
                        const iccp_outline *source, const iccp_outline *target)
{
    const double start[2] = {0, n > 0 ? 0 : iccp_arc_start(source, target)};
    knots->n = n > 0 ? n : 1;
    memcpy(knots->knot, n > 0 ? landmarks : start, 2 * knots->n * sizeof *knots->knot);
}

static icc_status refuse(const iccp_elastic_report *report, double sure, icc_error *err)
{
    const char *const remedy = report->mirrored >= iccp_clearly_better
                                   ? "the mirror image fits better: is y down in one of them? If "
                                     "not, give a landmark, a pair of points"
                                   : "give a landmark, a pair of points";
    return iccp_fail(err, ICC_ERR_AMBIGUOUS,
                     "source and target match almost equally well in more than one way (%.3g, less "
                     "than %.3g times as well as in the next): %s",
                     report->sure, sure, remedy);
}

/* Makes the common vertices of two outlines that have a pairing. Before that, an elastic pairing
 * gets its corners and vertices paired, unless the vertices turn out to correspond already. */
static icc_status finish(iccp_union_outline *common, iccp_pairing_knots *knots, bool is_elastic,
                         const iccp_outline *source, const iccp_outline *target, size_t n,
                         const double *landmarks, const icc_match_options *options,
                         const iccp_env *env)
{
    icc_status status = ICC_OK;
    if (is_elastic)
        status = iccp_pin(knots, source, target, n, landmarks, env);
    if (is_elastic && status == ICC_OK)
        status = iccp_pair_vertices(knots, source, target, n, landmarks, env);
    if (status == ICC_OK)
        status = iccp_union_outline_create(common, knots, source, target, n, landmarks,
                                           options->drop, &env->memory);
    if (is_elastic && status == ICC_OK)
        iccp_one_to_one(common, source, target, n, landmarks);
    return status;
}

static double *reserve(size_t n_landmarks, const iccp_memory *memory)
{
    return iccp_alloc(memory, 2 * (4 * (size_t)ICCP_MATCH_SAMPLES + 10 * n_landmarks + 512),
                      sizeof(double));
}

icc_status iccp_pair_rings(iccp_union_outline *common, iccp_elastic_report *report,
                           const iccp_outline *source, const iccp_outline *target, size_t n,
                           const double *landmarks, const icc_match_options *options,
                           const iccp_env *env, icc_error *err)
{
    const bool is_elastic = options->between != ICC_BETWEEN_ARC;
    const double sure = iccp_least_sure(options);
    iccp_env parts[2];
    iccp_split(parts, 2, (const double[]){4, 1}, env);
    iccp_pairing_knots knots = {.knot = reserve(n, &env->memory)};
    icc_status status = knots.knot != NULL ? ICC_OK : ICC_ERR_MEMORY;
    *report = none;
    if (status == ICC_OK && !is_elastic)
        find_by_arc(&knots, n, landmarks, source, target);
    else if (status == ICC_OK && n > 0)
        status = iccp_elastic_between(&knots, report, source, target, n, landmarks, &parts[0]);
    else if (status == ICC_OK)
        status = iccp_elastic_search(&knots, report, source, target,
                                     options->turning == ICC_TURNING_FREE, &parts[0]);
    if (status == ICC_OK && is_elastic && n > 0)
        status = iccp_elastic_bend(&knots, source, target, n, landmarks, &env->memory);
    if (status == ICC_OK && report->sure < sure)
        status = refuse(report, sure, err);
    else if (status == ICC_OK)
        status =
            finish(common, &knots, is_elastic, source, target, n, landmarks, options, &parts[1]);
    iccp_free(&env->memory, knots.knot);
    return status == ICC_ERR_AMBIGUOUS ? status : iccp_explain(err, status);
}

icc_status iccp_pair_moved(iccp_union_outline *common, iccp_elastic_report *report,
                           const iccp_outline *source, const iccp_outline *target, size_t n,
                           const double *landmarks, const icc_match_options *options,
                           const iccp_env *env, icc_error *err)
{
    const bool is_elastic = options->between != ICC_BETWEEN_ARC;
    iccp_pairing_knots knots = {.knot = reserve(n, &env->memory)};
    icc_status status = knots.knot != NULL ? ICC_OK : ICC_ERR_MEMORY;
    *report = none;
    if (status == ICC_OK)
        find_by_arc(&knots, n, landmarks, source, target);
    if (status == ICC_OK && is_elastic)
        status =
            n > 0 ? iccp_elastic_between(&knots, report, source, target, n, landmarks, env)
                  : iccp_elastic_near(&knots, report, source, target, knots.knot[1], &env->memory);
    if (status == ICC_OK)
        status = finish(common, &knots, is_elastic, source, target, n, landmarks, options, env);
    iccp_free(&env->memory, knots.knot);
    return iccp_explain(err, status);
}

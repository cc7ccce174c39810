/* Finds the places of landmarks on two outlines, and checks their order. */
#include "match/outline/landmarks.h"

#include "base/error.h"
#include "base/sort.h"
#include "math/elementary.h"

#include <math.h>

/* Shares of the outline's diameter. vertex_reach: a vertex this close is meant, unless the landmark
 * lies on the outline up to `rounding`. */
static const double vertex_reach = 0.005, rounding = 1e-9;

typedef struct landmark {
    double share[2];
    size_t number;
} landmark;

static int by_source(const void *a, const void *b)
{
    const landmark *const p = a, *const q = b;
    if (p->share[0] != q->share[0])
        return p->share[0] < q->share[0] ? -1 : 1;
    return p->number < q->number ? -1 : 1;
}

/* Finds the nearest point of the outline, or the vertex that is meant. */
static double nearest(const iccp_outline *outline, const double *point, double *away)
{
    double share = 0, to_vertex = HUGE_VAL;
    size_t vertex = 0;
    *away = HUGE_VAL;
    for (size_t k = 0; k < outline->n; ++k) {
        const double *const p = outline->points + 2 * k;
        const double d[2] = {p[2] - p[0], p[3] - p[1]}, e[2] = {point[0] - p[0], point[1] - p[1]};
        double along = (d[0] * e[0] + d[1] * e[1]) / (d[0] * d[0] + d[1] * d[1]);
        along = along > 0 ? along < 1 ? along : 1 : 0;
        const double off = iccp_hypot(e[0] - along * d[0], e[1] - along * d[1]);
        if (off < *away) {
            *away = off;
            share = outline->share[k] + along * (outline->share[k + 1] - outline->share[k]);
        }
        const double straight = iccp_hypot(e[0], e[1]);
        if (straight < to_vertex) {
            to_vertex = straight;
            vertex = k;
        }
    }
    const bool is_on = *away <= rounding * outline->diameter;
    if (to_vertex <= (is_on ? rounding : vertex_reach) * outline->diameter)
        share = outline->share[vertex];
    *away /= outline->diameter;
    return iccp_outline_wrap(share);
}

double iccp_landmark_share(const iccp_outline *outline, const double *point, double *away)
{
    double local[2];
    iccp_frame_in(&outline->domain->frame, 2, point, local);
    const double share = nearest(outline, local, away);
    return outline->end > 0 && share > outline->share[outline->end] ? 1 - share : share;
}

static icc_status place(landmark *out, const double *given, const iccp_outline *const *outlines,
                        icc_error *err)
{
    for (int side = 0; side < 2; ++side) {
        const double *const p = given + 2 * side;
        double away;
        if (!isfinite(p[0]) || !isfinite(p[1]))
            return iccp_fail_side(err,
                                  iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT,
                                               (int64_t)out->number, "landmark %zu is not finite",
                                               out->number),
                                  side + 1);
        out->share[side] = iccp_landmark_share(outlines[side], p, &away);
        if (!(away <= iccp_farthest_landmark)) {
            iccp_fail_at(
                err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)out->number,
                "landmark %zu lies off the outline, by %.3g %% of its diameter; at most %g %% are "
                "allowed (a place inside is a point feature, not a landmark)",
                out->number, 100 * away, 100 * iccp_farthest_landmark);
            return iccp_fail_side(err, ICC_ERR_ARGUMENT, side + 1);
        }
    }
    return ICC_OK;
}

/* Checks that landmarks in order along the source are in order along the target, without
 * doubles. */
static icc_status check_order(landmark *all, size_t n, icc_error *err)
{
    for (size_t k = 0; k < n; ++k) {
        const landmark *const before = &all[(k + n - 1) % n];
        const bool is_double = n > 1 && before != &all[k] &&
                               (before->share[0] == all[k].share[0] ||
                                iccp_outline_wrap(before->share[1] - all[k].share[1]) == 0);
        if (is_double)
            return iccp_fail_at(
                err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT,
                (int64_t)(before->number > all[k].number ? before->number : all[k].number),
                "landmarks %zu and %zu are at the same place of the %s", before->number,
                all[k].number, before->share[0] == all[k].share[0] ? "source" : "target");
        if (k == 0)
            continue;
        all[k].share[1] = all[0].share[1] + iccp_outline_wrap(all[k].share[1] - all[0].share[1]);
        if (all[k].share[1] <= before->share[1])
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)all[k].number,
                                "landmark %zu follows landmark %zu round the source, but not round "
                                "the target",
                                all[k].number, before->number);
    }
    return ICC_OK;
}

icc_status iccp_landmarks_place(double *shares, size_t n, const double *landmarks,
                                const size_t *numbers, const iccp_outline *source,
                                const iccp_outline *target, const iccp_memory *memory,
                                icc_error *err)
{
    const iccp_outline *const outlines[2] = {source, target};
    landmark *const all = iccp_alloc(memory, n, sizeof *all);
    if (all == NULL)
        return iccp_fail_memory(err);
    icc_status status = ICC_OK;
    for (size_t k = 0; k < n && status == ICC_OK; ++k) {
        all[k].number = numbers != NULL ? numbers[k] : k;
        status = place(&all[k], landmarks + 4 * k, outlines, err);
    }
    if (status == ICC_OK) {
        iccp_sort(all, n, sizeof *all, by_source);
        status = check_order(all, n, err);
    }
    for (size_t k = 0; k < n && status == ICC_OK; ++k) {
        shares[2 * k] = all[k].share[0];
        shares[2 * k + 1] = all[k].share[1];
    }
    iccp_free(memory, all);
    return status;
}

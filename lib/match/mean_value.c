/* Mean value coordinates with respect to the outline: M. Floater, Mean value coordinates, 2003; for
 * outlines of any shape, K. Hormann and M. Floater, Mean value coordinates for arbitrary planar
 * polygons, 2006. They reproduce affine maps, and bend where the outlines bend. */
#include "match/mean_value.h"

#include "match/outline/pins.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

enum { N = ICCP_MATCH_SAMPLES };

void iccp_mean_value_sample(iccp_mean_value *out, const iccp_union_outline *common,
                            const iccp_outline *source, const iccp_outline *target)
{
    const iccp_pairing_knots knots = {common->n, common->share};
    for (int k = 0; k < N; ++k) {
        const double share = (double)k / N;
        iccp_outline_at(source, share, out->from + 2 * k);
        iccp_outline_at(target, iccp_knots_at(&knots, share), out->to + 2 * k);
    }
}

/* Moves a point by its weights. The weight of a vertex is a sum over its edges of tan(angle / 2)
 * divided by its distance. A point on the outline has no finite weights and stays where it is. */
static void move(const iccp_mean_value *at, double *point)
{
    double sum[2] = {0, 0}, weight = 0;
    double p[2] = {at->from[2 * N - 2] - point[0], at->from[2 * N - 1] - point[1]};
    double r = iccp_hypot(p[0], p[1]);
    const double *p_to = at->to + 2 * N - 2;
    for (int k = 0; k < N; ++k) {
        const double *const q_to = at->to + 2 * k;
        const double q[2] = {at->from[2 * k] - point[0], at->from[2 * k + 1] - point[1]};
        const double s = iccp_hypot(q[0], q[1]);
        const double sine = p[0] * q[1] - p[1] * q[0], cosine = p[0] * q[0] + p[1] * q[1];
        const double half = sine != 0 ? (r * s - cosine) / sine : 0;
        for (int e = 0; e < 2; ++e)
            sum[e] += half * (p_to[e] / r + q_to[e] / s);
        weight += half * (1 / r + 1 / s);
        memcpy(p, q, sizeof p);
        r = s;
        p_to = q_to;
    }
    const double x = sum[0] / weight, y = sum[1] / weight;
    if (isfinite(x) && isfinite(y)) {
        point[0] = x;
        point[1] = y;
    }
}

void iccp_mean_value_move(const iccp_mean_value *at, size_t n, double *points)
{
    for (size_t k = 0; k < n; ++k)
        move(at, points + 2 * k);
}

/* Orders points by their distance from a point that is far away. */
#include "geometry/away.h"

static const double FARTHEST = 1e60, TINY = 0x1p-200;

void iccp_away_reach(size_t dim, const double *p, double *reachable)
{
    double largest = 0;
    for (size_t k = 0; k < dim; ++k)
        largest = isfinite(p[k]) && fabs(p[k]) > largest ? fabs(p[k]) : largest;
    const double scale = largest > FARTHEST ? FARTHEST / largest : 1;
    for (size_t k = 0; k < dim; ++k) {
        const double x = isfinite(p[k]) ? p[k] * scale : isinf(p[k]) ? copysign(FARTHEST, p[k]) : 0;
        reachable[k] = fabs(x) >= TINY ? x : 0;
    }
}

iccp_away iccp_away_from(size_t dim, const double *p)
{
    iccp_away away = {.p = p};
    double length2 = 0;
    for (size_t k = 0; k < dim; ++k)
        length2 += p[k] * p[k];
    away.bend = 0.5 / sqrt(length2);
    for (size_t k = 0; k < dim; ++k)
        away.direction[k] = p[k] / sqrt(length2);
    return away;
}

double iccp_away_value(const iccp_away *away, size_t dim, const double *q)
{
    double sum = 0;
    for (size_t k = 0; k < dim; ++k)
        sum += q[k] * (away->bend * q[k] - away->direction[k]);
    return sum;
}

double iccp_away_bound(const iccp_away *away, size_t dim, const double *lower, const double *upper)
{
    double nearest[ICC_MAX_DIM];
    for (size_t k = 0; k < dim; ++k) {
        const double x = away->p[k];
        nearest[k] = x < lower[k] ? lower[k] : x > upper[k] ? upper[k] : x;
    }
    return iccp_away_value(away, dim, nearest);
}

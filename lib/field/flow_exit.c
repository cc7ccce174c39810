/* The piece's end is the first root of one of the barycentric coordinates, which are power series:
 * Newton's method on each, kept within an interval that holds the root. */
#include "field/flow_exit.h"

#include "base/minmax.h"

#include <math.h>

enum { MOST = 60 };

/* Of the barycentric coordinate of corner i, in terms of walk->scale; returns how many terms. One
 * that starts at 0, or less by rounding, starts at SLACK. */
static int32_t coordinate_series(const iccp_flow_walk *w, int32_t i, double *series)
{
    const int32_t dim = w->flow->grid->dim;
    const int8_t *axis = w->place.simplex.axis;
    const double *at = w->place.at;
    series[0] = (i > 0 ? at[axis[i - 1]] : 1) - (i < dim ? at[axis[i]] : 0);
    series[0] = iccp_max(series[0], ICCP_FLOW_SLACK);
    for (int32_t j = 0; j < w->n_terms; ++j) {
        const double *term = w->term[j];
        series[j + 1] =
            w->scale / (j + 1) * ((i > 0 ? term[axis[i - 1]] : 0) - (i < dim ? term[axis[i]] : 0));
    }
    return w->n_terms + 1;
}

static double value_of(const double *series, int32_t n, double s, double *slope)
{
    double value = 0;
    *slope = 0;
    for (int32_t j = n; j-- > 0;) {
        *slope = *slope * s + value;
        value = value * s + series[j];
    }
    return value;
}

/* A root between 0, where the series is positive, and `high`, where it need not be negative.
 * HUGE_VAL when there is none. */
static double root_of(const double *series, int32_t n, double high, double guess)
{
    static const double CLOSE = 1e-8;
    double low = 0, s = guess, slope;
    bool is_beyond = false; /* whether `high` is known to lie beyond the root */
    for (int k = 0; k < MOST; ++k) {
        const double value = value_of(series, n, s, &slope);
        double next = s - value / slope;
        /* The step after that would be about its square. */
        if (fabs(next - s) <= CLOSE * s)
            return next;
        if (value > 0) {
            low = s;
        } else {
            high = s;
            is_beyond = true;
        }
        if (!(next > low && next < high)) {
            if (!is_beyond && !(value_of(series, n, high, &slope) <= 0))
                return HUGE_VAL;
            is_beyond = true;
            next = 0.5 * (low + high);
        }
        s = next;
    }
    return s;
}

/* Whether a coordinate that is positive at both ends falls below 0 between them; if so its first
 * root. */
static bool dips(const double *series, int32_t n, double end, double *root)
{
    double low = 0, high = end, slope;
    if (!(series[1] < 0) || series[0] + series[1] * end > 0)
        return false;
    (void)value_of(series, n, end, &slope);
    if (!(slope > 0))
        return false;
    for (int k = 0; k < MOST; ++k) {
        const double middle = 0.5 * (low + high);
        (void)value_of(series, n, middle, &slope);
        if (slope < 0)
            low = middle;
        else
            high = middle;
    }
    if (value_of(series, n, low, &slope) >= 0)
        return false;
    *root = root_of(series, n, low, 0.5 * low);
    return true;
}

/* The earliest root of all coordinates: each root that is found shortens the piece, and the
 * others are looked at again up to there. */
void iccp_flow_find_exit(iccp_flow_walk *walk)
{
    double end = 1;
    walk->exit = ICCP_FLOW_WITHIN;
    for (bool found = true; found;) {
        found = false;
        for (int32_t i = 0; i <= walk->flow->grid->dim; ++i) {
            double series[ICCP_FLOW_TERMS + 1], root = HUGE_VAL, slope;
            if (i == walk->exit)
                continue;
            const int32_t n = coordinate_series(walk, i, series);
            if (value_of(series, n, end, &slope) < 0)
                root = root_of(series, n, end, 0.5 * end);
            else if (!dips(series, n, end, &root))
                continue;
            if (root < end) {
                end = root;
                walk->exit = i;
                found = true;
            }
        }
    }
    walk->end = end * walk->scale;
}

/* Finds the end of a piece: the first root of a barycentric coordinate. The coordinates are power
 * series. Newton's method runs on each, within an interval that holds the root. Source:
 * docs/theory/charts-space.md, "fields on grids", step 3. */
#include "field/flow_exit.h"

#include "base/compiler.h"
#include "base/minmax.h"

#include <math.h>

enum { MOST = 60 };

/* The barycentric coordinates as power series in s / walk->scale. */
typedef struct coordinates {
    int32_t n; /* number of terms of each */
    double term[ICC_MAX_DIM + 1][ICCP_FLOW_TERMS + 1];
} coordinates;

/* Expands the coordinates. A coordinate that starts at 0, or below it by rounding, starts at
 * SLACK. */
static ICCP_INLINE void expand_coordinates(const iccp_flow_walk *w, int32_t dim, coordinates *c)
{
    const int8_t *axis = w->place.simplex.axis;
    const double *at = w->place.at;
    c->n = w->n_terms + 1;
    for (int32_t i = 0; i <= dim; ++i) {
        const double start = (i > 0 ? at[axis[i - 1]] : 1) - (i < dim ? at[axis[i]] : 0);
        c->term[i][0] = iccp_max(start, ICCP_FLOW_SLACK);
    }
    for (int32_t j = 0; j < w->n_terms; ++j) {
        const double *term = w->term[j], factor = w->scale / (j + 1);
        for (int32_t i = 0; i <= dim; ++i)
            c->term[i][j + 1] =
                factor * ((i > 0 ? term[axis[i - 1]] : 0) - (i < dim ? term[axis[i]] : 0));
    }
}

static ICCP_INLINE void values_at(const coordinates *c, int32_t dim, double s, double *value)
{
    for (int32_t i = 0; i <= dim; ++i)
        value[i] = 0;
    for (int32_t j = c->n; j-- > 0;)
        for (int32_t i = 0; i <= dim; ++i)
            value[i] = value[i] * s + c->term[i][j];
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

/* Finds a root between 0, where the series is positive, and `high`, where it need not be
 * negative. HUGE_VAL if there is none. */
static double root_of(const double *series, int32_t n, double high, double guess)
{
    static const double CLOSE = 1e-8;
    double low = 0, s = guess, slope;
    bool is_beyond = false; /* true if `high` is known to lie beyond the root */
    for (int k = 0; k < MOST; ++k) {
        const double value = value_of(series, n, s, &slope);
        double next = s - value / slope;
        /* Newton's method converges quadratically, so the next step would be about the square of
         * this one. */
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

/* Bounds the second derivative up to `end`. `*size` is a bound on the sum of the terms' sizes. */
static double bend_of(const double *series, int32_t n, double end, double *size)
{
    double bend = 0;
    *size = 0;
    for (int32_t j = n; j-- > 0;) {
        *size = *size * end + fabs(series[j]);
        if (j >= 2)
            bend = bend * end + j * (j - 1) * fabs(series[j]);
    }
    return bend;
}

/* Returns true if a coordinate that is positive at both ends falls below 0 between them, and
 * writes its first root. The least value lies where the slope changes its sign. For most
 * coordinates the bounds soon show that they stay positive. */
static bool dips(const double *series, int32_t n, double end, double *root)
{
    static const double ROUNDING = 1e-12; /* relative to the size of the terms; their rounding
                                             errors are about n times 1e-16 */
    double low = 0, high = end, slope, size;
    if (!(series[1] < 0) || series[0] + series[1] * end > 0)
        return false;
    (void)value_of(series, n, end, &slope);
    if (!(slope > 0))
        return false;
    const double bend = bend_of(series, n, end, &size);
    for (int k = 0; k < MOST; ++k) {
        const double middle = 0.5 * (low + high), reach = 0.5 * (high - low);
        const double value = value_of(series, n, middle, &slope);
        if (value - reach * (fabs(slope) + 0.5 * reach * bend) > ROUNDING * size)
            return false;
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

/* Finds the earliest root of all coordinates. Each root shortens the piece, and the other
 * coordinates are then examined again up to it. */
static ICCP_INLINE void find_exit(iccp_flow_walk *walk, int32_t dim)
{
    coordinates c;
    double end = 1, value[ICC_MAX_DIM + 1];
    walk->exit = ICCP_FLOW_WITHIN;
    expand_coordinates(walk, dim, &c);
    values_at(&c, dim, end, value);
    for (bool found = true; found;) {
        found = false;
        for (int32_t i = 0; i <= dim; ++i) {
            double root = HUGE_VAL;
            if (i == walk->exit)
                continue;
            if (value[i] < 0)
                root = root_of(c.term[i], c.n, end, 0.5 * end);
            else if (!dips(c.term[i], c.n, end, &root))
                continue;
            if (root < end) {
                end = root;
                walk->exit = i;
                found = true;
                values_at(&c, dim, end, value);
            }
        }
    }
    walk->end = end * walk->scale;
}

/* Most calls are in space, so the loops are unrolled for dimension 3. */
void iccp_flow_find_exit(iccp_flow_walk *walk)
{
    if (walk->flow->grid->dim == 3)
        find_exit(walk, 3);
    else
        find_exit(walk, walk->flow->grid->dim);
}

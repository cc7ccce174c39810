/* Computes the pieces of one curve. flow_step.h explains the method, and flow_exit.c handles
 * unusual pieces. */
#include "field/flow_piece.h"

#include "base/minmax.h"
#include "field/flow_exit.h"
#include "math/elementary.h"

#include <float.h>

#define LANES 1
#define TARGET
#include "field/flow_step.h"

/* ---- within a piece ---- */

static ICCP_INLINE void load_series(const iccp_flow_walk *w, int32_t dim, series *x)
{
    x->n = w->n_terms;
    x->scale = w->scale;
    for (int32_t j = 0; j < x->n; ++j)
        for (int32_t k = 0; k < dim; ++k)
            x->term[j][k] = w->term[j][k];
}

static ICCP_INLINE void place_in(const iccp_flow_walk *walk, int32_t dim, double s, double *at)
{
    const double share = s / walk->scale;
    double sum[ICC_MAX_DIM] = {0};
    for (int32_t j = walk->n_terms; j-- > 0;)
        for (int32_t k = 0; k < dim; ++k)
            sum[k] = sum[k] * share + walk->term[j][k] * INVERSE[j + 1];
    for (int32_t k = 0; k < dim; ++k)
        at[k] = walk->place.at[k] + s * sum[k];
}

/* Most calls are in space, so loops over dimensions are unrolled here and below. */
void iccp_flow_at(const iccp_flow_walk *walk, double s, double *at)
{
    if (walk->flow->grid->dim == 3)
        place_in(walk, 3, s, at);
    else
        place_in(walk, walk->flow->grid->dim, s, at);
}

/* Like vector_at(), for a walk that has its series. */
static ICCP_INLINE void velocity_in(const iccp_flow_walk *walk, int32_t dim, double s,
                                    double *vector)
{
    const double share = s / walk->scale;
    double sum[ICC_MAX_DIM] = {0};
    for (int32_t j = walk->n_terms; j-- > 0;)
        for (int32_t k = 0; k < dim; ++k)
            sum[k] = sum[k] * share + walk->term[j][k];
    for (int32_t k = 0; k < dim; ++k)
        vector[k] = sum[k];
}

void iccp_flow_velocity(const iccp_flow_walk *walk, double s, double *vector)
{
    if (walk->flow->grid->dim == 3)
        velocity_in(walk, 3, s, vector);
    else
        velocity_in(walk, walk->flow->grid->dim, s, vector);
}

static ICCP_INLINE void motion_at(const iccp_flow_walk *w, int32_t dim, const series *x,
                                  double share, motion *m)
{
    vector_at(x, dim, &share, m->vector);
    for (int32_t k = 0; k < dim; ++k) {
        m->change[k] = 0;
        for (int32_t i = 0; i < dim; ++i)
            m->change[k] += m->vector[i] * w->column[i][k] * w->scale;
    }
}

/* What all lengths within a piece share. */
typedef struct ruler {
    series series;
    motion first;
    double change;
} ruler;

static ICCP_INLINE void lay_ruler(const iccp_flow_walk *walk, int32_t dim, ruler *r)
{
    r->first = (motion){{0}, {0}};
    load_series(walk, dim, &r->series);
    find_change(&r->series, dim, &r->first, &r->change);
}

/* Computes a length by integrate(). The piece is divided into equal parts, so that the vector's
 * change in each part is within the limit of the last rule. */
static ICCP_INLINE double length_in(const iccp_flow_walk *walk, int32_t dim, const ruler *r,
                                    double s)
{
    enum { MOST_PARTS = 16 };
    const double most = RULES[N_RULES - 1].most * RULES[N_RULES - 1].most;
    const double to = s / walk->scale;
    motion first = r->first, last;
    double change = r->change * (to * to), length = 0;
    int parts = 1;
    for (; parts < MOST_PARTS && change > most; parts *= 2)
        change *= 0.25;
    const double share = to / parts;
    for (int p = 0; p < parts; ++p) {
        const double from = to * p / parts;
        double part;
        motion_at(walk, dim, &r->series, to * (p + 1) / parts, &last);
        integrate(&r->series, dim, &change, &from, &share, &first, &last, &part);
        length += part;
        first = last;
    }
    return length;
}

static ICCP_INLINE double length_to(const iccp_flow_walk *walk, int32_t dim, double s)
{
    ruler r;
    lay_ruler(walk, dim, &r);
    return length_in(walk, dim, &r, s);
}

double iccp_flow_length(const iccp_flow_walk *walk, double s)
{
    const int32_t dim = walk->flow->grid->dim;
    if (walk->radial)
        return walk->end_length * (s / walk->end);
    return dim == 3 ? length_to(walk, 3, s) : length_to(walk, dim, s);
}

/* Liouville's formula: the volume grows at the rate of the trace. Straight curves to a point
 * spread in all directions but their own. */
double iccp_flow_growth(const iccp_flow_walk *walk, double s)
{
    const int32_t dim = walk->flow->grid->dim;
    double trace = 0;
    if (walk->radial)
        return (dim - 1) * iccp_ln1p(-walk->sign * s);
    for (int32_t k = 0; k < dim; ++k)
        trace += walk->column[k][k];
    return s * trace;
}

/* Newton's method for a given length, within an interval that holds the answer. */
static ICCP_INLINE double at_length_in(const iccp_flow_walk *walk, int32_t dim, double s,
                                       double length)
{
    enum { MOST = 50 };
    double low = 0, high = walk->end;
    ruler r;
    lay_ruler(walk, dim, &r);
    for (int k = 0; k < MOST; ++k) {
        double vector[ICC_MAX_DIM], speed2;
        const double miss = length_in(walk, dim, &r, s) - length;
        if (miss < 0)
            low = s;
        else
            high = s;
        velocity_in(walk, dim, s, vector);
        product(dim, vector, vector, &speed2);
        double next = s - miss / sqrt(speed2);
        if (!(next >= low && next <= high))
            next = 0.5 * (low + high);
        if (fabs(next - s) <= 2 * DBL_EPSILON * walk->end)
            return next;
        s = next;
    }
    return s;
}

double iccp_flow_at_length(const iccp_flow_walk *walk, double length)
{
    const int32_t dim = walk->flow->grid->dim;
    const double s = walk->end_length > 0 ? walk->end * iccp_min(length / walk->end_length, 1) : 0;
    if (walk->radial)
        return s;
    return dim == 3 ? at_length_in(walk, 3, s, length) : at_length_in(walk, dim, s, length);
}

/* ---- pieces ---- */

/* Computes a piece with all safeguards. The series reaches somewhat beyond the last guess. */
static ICCP_INLINE icc_status piece_slowly(iccp_flow_walk *walk, int32_t dim, double end)
{
    static const double BEYOND = 1e-6; /* added to a tenth: a curve may start on the facet */
    piece_step a;
    double first[3][ICC_MAX_DIM], size = 0;
    load_start(&a, dim, 0, walk);
    first_terms(&a, dim, first);
    add_size(dim, first[0], &size);
    const double reach = iccp_min(end > 0 ? 1.1 * end + BEYOND : HUGE_VAL, FARTHEST / a.norm);
    if (!(size > 0 && reach < HUGE_VAL))
        return ICC_ERR_TRACE;
    expand(&a, dim, first, &reach);
    store_series(&a, dim, 0, walk);
    iccp_flow_find_exit(walk);
    iccp_flow_at(walk, walk->end, walk->finish);
    walk->end_length = iccp_flow_length(walk, walk->end);
    walk->end_growth = iccp_flow_growth(walk, walk->end);
    return ICC_OK;
}

icc_status iccp_flow_find_piece_slowly(iccp_flow_walk *walk, double end)
{
    const int32_t dim = walk->flow->grid->dim;
    return dim == 3 ? piece_slowly(walk, 3, end) : piece_slowly(walk, dim, end);
}

/* The fast way, which suits nearly all pieces. If MOST_ATTEMPTS tries do not finish the piece,
 * the slow way does. */
static ICCP_INLINE icc_status curved_piece(iccp_flow_walk *w, int32_t dim)
{
    piece_step a;
    load_start(&a, dim, 0, w);
    try_exit(&a, dim);
    for (int n = 1; n < MOST_TRIES && prepare_retry(&a, 0); ++n)
        try_exit(&a, dim);
    if (ICCP_UNLIKELY(a.outcome > FOUND))
        return iccp_flow_find_piece_slowly(w, a.end);
    store_end(&a, dim, 0, w);
    store_series(&a, dim, 0, w);
    return ICC_OK;
}

/* Next to the root the vectors point straight at it. On the way up the place is p(s) = p + s
 * (root - p). On the way down it moves the opposite way, until the corner's weight falls to 0. */
icc_status iccp_flow_find_radial(iccp_flow_walk *w, int32_t corner)
{
    const int32_t dim = w->flow->grid->dim;
    const int8_t *axis = w->place.simplex.axis;
    const double *at = w->place.at;
    double size2;
    const double weight =
        (corner > 0 ? at[axis[corner - 1]] : 1) - (corner < dim ? at[axis[corner]] : 0);
    w->radial = true;
    w->ends = w->sign > 0;
    w->exit = w->ends ? ICCP_FLOW_WITHIN : corner;
    w->end = w->scale = w->ends ? 1 : weight / (1 - weight);
    w->n_terms = 1;
    for (int32_t i = 0; i < dim; ++i)
        w->term[0][axis[i]] = w->sign * ((i < corner ? 1.0 : 0.0) - at[axis[i]]);
    product(dim, w->term[0], w->term[0], &size2);
    w->end_length = w->end * sqrt(size2);
    w->end_growth = w->ends ? 0 : iccp_flow_growth(w, w->end);
    for (int32_t k = 0; k < dim; ++k)
        w->finish[k] = at[k] + w->end * w->term[0][k];
    return weight < 1 || w->ends ? ICC_OK : ICC_ERR_TRACE;
}

icc_status iccp_flow_find_piece(iccp_flow_walk *walk)
{
    const int32_t dim = walk->flow->grid->dim;
    const int32_t corner = iccp_flow_root_corner(walk->flow, &walk->place, dim);
    if (ICCP_UNLIKELY(corner != ICCP_FLOW_WITHIN))
        return iccp_flow_find_radial(walk, corner);
    switch (dim) {
    case 2:
        return curved_piece(walk, 2);
    case 3:
        return curved_piece(walk, 3);
    default:
        return curved_piece(walk, dim > 4 ? dim : 4);
    }
}

/* In a simplex the field is linear in position, so its curves are solutions of x' = A x + b, power series that
 * converge everywhere: the terms of x' are A^j x'(0) s^j / j!. The column of A for an axis is the difference of
 * the vectors at the two corners that the axis joins.
 *
 * The barycentric coordinates' first terms say nearly when the first of them is 0. The series is added up there,
 * once; the rest of the way is so short that the derivatives there, of which A gives as many as one
 * likes, carry on to the end exactly. What is unusual is left to flow_exit.c. */
#include "trace/flow_piece.h"

#include "trace/flow_exit.h"

#include <float.h>
#include <math.h>

/* Lattice units: what a series leaves out. */
static const double NEGLIGIBLE = 1e-16;

/* In terms of 1 / |A|: further than this a piece is cut, so that ICCP_FLOW_TERMS terms suffice. */
static const double FARTHEST = 1.5;

static const double INVERSE[ICCP_FLOW_TERMS + 2] = {
    0,        1.,       1. / 2,  1. / 3,  1. / 4,  1. / 5,  1. / 6,  1. / 7,  1. / 8,
    1. / 9,   1. / 10,  1. / 11, 1. / 12, 1. / 13, 1. / 14, 1. / 15, 1. / 16, 1. / 17,
    1. / 18,  1. / 19,  1. / 20, 1. / 21, 1. / 22, 1. / 23, 1. / 24, 1. / 25};

/* ---- the equation ---- */

/* Returns the sum of the sizes. */
static ICCP_INLINE double set_matrix(iccp_flow_walk *w, int32_t dim)
{
    const int8_t *axis = w->place.simplex.axis;
    double norm = 0;
    for (int32_t i = 0; i < dim; ++i)
        for (int32_t k = 0; k < dim; ++k) {
            const double difference = w->corner[i + 1][k] - w->corner[i][k];
            w->column[axis[i]][k] = difference;
            norm += fabs(difference);
        }
    return norm;
}

static ICCP_INLINE void apply(const iccp_flow_walk *w, int32_t dim, const double *x, double *y)
{
    for (int32_t k = 0; k < dim; ++k) {
        double sum = x[0] * w->column[0][k];
        for (int32_t i = 1; i < dim; ++i)
            sum += x[i] * w->column[i][k];
        y[k] = sum;
    }
}

static ICCP_INLINE double size_of(int32_t dim, const double *x)
{
    double sum = 0;
    for (int32_t k = 0; k < dim; ++k)
        sum += fabs(x[k]);
    return sum;
}

static ICCP_INLINE double product(int32_t dim, const double *a, const double *b)
{
    double sum = 0;
    for (int32_t k = 0; k < dim; ++k)
        sum += a[k] * b[k];
    return sum;
}

/* Terms to parameter s, the first three given as A^j x'(0). */
static ICCP_INLINE void expand(iccp_flow_walk *w, int32_t dim, double first[3][ICC_MAX_DIM],
                               double norm, double s)
{
    const double fading = s * s * norm;
    double power[ICC_MAX_DIM], factor = 1;
    for (int32_t j = 0; j < 3; ++j) {
        for (int32_t k = 0; k < dim; ++k)
            w->term[j][k] = first[j][k] * factor;
        factor *= s * INVERSE[j + 1];
    }
    for (int32_t k = 0; k < dim; ++k)
        power[k] = first[2][k];
    int32_t j = 3;
    for (;; ++j) {
        double next[ICC_MAX_DIM];
        apply(w, dim, power, next);
        for (int32_t k = 0; k < dim; ++k) {
            power[k] = next[k];
            w->term[j][k] = next[k] * factor;
        }
        factor *= s * INVERSE[j + 1];
        if (size_of(dim, w->term[j]) * fading <= NEGLIGIBLE * ((j + 1) * (j + 2)) ||
            j + 1 == ICCP_FLOW_TERMS)
            break;
    }
    w->n_terms = j + 1;
    w->scale = s;
}

static ICCP_INLINE void place_at(const iccp_flow_walk *w, int32_t dim, double at, double *place)
{
    double sum[ICC_MAX_DIM] = {0};
    for (int32_t j = w->n_terms; j-- > 0;)
        for (int32_t k = 0; k < dim; ++k)
            sum[k] = sum[k] * at + w->term[j][k] * INVERSE[j + 1];
    for (int32_t k = 0; k < dim; ++k)
        place[k] = w->place.at[k] + at * w->scale * sum[k];
}

static ICCP_INLINE void vector_at(const iccp_flow_walk *w, int32_t dim, double at, double *vector)
{
    double sum[ICC_MAX_DIM] = {0};
    for (int32_t j = w->n_terms; j-- > 0;)
        for (int32_t k = 0; k < dim; ++k)
            sum[k] = sum[k] * at + w->term[j][k];
    for (int32_t k = 0; k < dim; ++k)
        vector[k] = sum[k];
}

/* ---- length ---- */

/* Rules that use the speed and its derivative at both ends, and the speed at n places between, which are the zeros of
 * the orthogonal polynomials for the weight x^2 (1 - x)^2: exact for polynomials of degree 2 n + 3. */
typedef struct rule {
    double most; /* largest share by which the vector may change along the piece */
    double end, slope;
    int n;
    double node[5], weight[5];
} rule;

static const rule RULES[] = {
    {0.012, 7. / 30, 1. / 60, 1, {0.5}, {8. / 15}},
    {0.05,
     37. / 270,
     1. / 180,
     2,
     {0.311017763495386386393, 0.688982236504613613607},
     {49. / 135, 49. / 135}},
    {0.12,
     19. / 210,
     1. / 420,
     3,
     {0.211324865405187117745, 0.5, 0.788675134594812882255},
     {9. / 35, 32. / 105, 9. / 35}},
    {0.3,
     0.048059964726631393298,
     1. / 1512,
     5,
     {0.115272337834106336489, 0.289542597488094277635, 0.5, 0.710457402511905722365,
      0.884727662165893663511},
     {0.145532595303625143969, 0.198047651609955102945, 0.216719576719576719577,
      0.198047651609955102945, 0.145532595303625143969}},
};

enum { N_RULES = 4, MOST_PARTS = 16 };

/* A vector and how it changes, per walk->scale. */
typedef struct motion {
    double vector[ICC_MAX_DIM], change[ICC_MAX_DIM];
} motion;

static ICCP_INLINE void motion_at(const iccp_flow_walk *w, int32_t dim, double at, motion *m)
{
    vector_at(w, dim, at, m->vector);
    apply(w, dim, m->vector, m->change);
    for (int32_t k = 0; k < dim; ++k)
        m->change[k] *= w->scale;
}

/* From share `from` to `to` of walk->scale. */
static ICCP_INLINE double integrate_part(const iccp_flow_walk *w, int32_t dim, const rule *r,
                                         double from, double to, const motion *first,
                                         const motion *last)
{
    const double first_speed = sqrt(product(dim, first->vector, first->vector));
    const double last_speed = sqrt(product(dim, last->vector, last->vector));
    const double first_slope = product(dim, first->vector, first->change) / first_speed;
    const double last_slope = product(dim, last->vector, last->change) / last_speed;
    double sum = r->end * (first_speed + last_speed) +
                 r->slope * (to - from) * (first_slope - last_slope);
    for (int i = 0; i < r->n; ++i) {
        double vector[ICC_MAX_DIM];
        vector_at(w, dim, from + (to - from) * r->node[i], vector);
        sum += r->weight[i] * sqrt(product(dim, vector, vector));
    }
    return (to - from) * w->scale * sum;
}

/* The motion there given. */
static ICCP_INLINE double integrate(const iccp_flow_walk *w, int32_t dim, double to,
                                    const motion *last)
{
    motion first;
    for (int32_t k = 0; k < dim; ++k) {
        first.vector[k] = w->term[0][k];
        first.change[k] = w->term[1][k];
    }
    const double size2 = product(dim, first.vector, first.vector);
    const double change2 = to * to * product(dim, first.change, first.change);
    int r = 0, parts = 1;
    while (r + 1 < N_RULES && change2 > RULES[r].most * RULES[r].most * size2)
        ++r;
    if (ICCP_LIKELY(change2 <= RULES[r].most * RULES[r].most * size2))
        return integrate_part(w, dim, RULES + r, 0, to, &first, last);
    while (parts < MOST_PARTS && change2 > RULES[r].most * RULES[r].most * size2 * parts * parts)
        parts *= 2;
    double sum = 0;
    for (int p = 1; p <= parts; ++p) {
        motion next = *last;
        if (p < parts)
            motion_at(w, dim, to * p / parts, &next);
        sum += integrate_part(w, dim, RULES + r, to * (p - 1) / parts, to * p / parts, &first, &next);
        first = next;
    }
    return sum;
}

/* ---- the exit ---- */

/* The barycentric coordinates at the start. One that is 0, or less by rounding, starts at SLACK, so that it has not
 * been crossed before it is less than that by SLACK. */
typedef struct start {
    double value[ICC_MAX_DIM + 1], beyond[ICC_MAX_DIM + 1];
    double time[ICC_MAX_DIM + 1];        /* when it would be 0 at its first rate */
    double order[4][ICC_MAX_DIM + 2]; /* the place and A^j x'(0), in the order of the axes */
} start;

/* Barycentric coordinates are the differences of neighbours. */
static ICCP_INLINE void put_in_order(const iccp_flow_walk *w, int32_t dim, double above,
                                     const double *x, double *order)
{
    order[0] = above;
    for (int32_t i = 0; i < dim; ++i)
        order[i + 1] = x[w->place.simplex.axis[i]];
    order[dim + 1] = 0;
}

static ICCP_INLINE double coordinate(const double *order, int32_t i)
{
    return order[i] - order[i + 1];
}

/* Returns which is the first to be 0 when all go on as they start. */
static ICCP_INLINE int32_t look_ahead(const iccp_flow_walk *w, int32_t dim,
                                      double first[3][ICC_MAX_DIM], start *a)
{
    double best = HUGE_VAL;
    int32_t exit = ICCP_FLOW_WITHIN;
    put_in_order(w, dim, 1, w->place.at, a->order[0]);
    for (int32_t j = 0; j < 3; ++j)
        put_in_order(w, dim, 0, first[j], a->order[j + 1]);
    for (int32_t i = 0; i <= dim; ++i) {
        const double value = coordinate(a->order[0], i), rate = coordinate(a->order[1], i);
        const double slack = value > ICCP_FLOW_SLACK ? value : ICCP_FLOW_SLACK;
        const double time = rate < 0 ? slack / -rate : HUGE_VAL;
        a->value[i] = slack;
        a->beyond[i] = value - slack;
        a->time[i] = time;
        exit = time < best ? i : exit;
        best = time < best ? time : best;
    }
    return exit;
}

/* When a coordinate is 0, by a quadratic equation and the cubic term as a correction. Not positive, or NaN, when
 * that says nothing. */
static ICCP_INLINE double guess_time(const start *a, int32_t i)
{
    const double value = a->value[i], rate = coordinate(a->order[1], i);
    const double second = coordinate(a->order[2], i), third = coordinate(a->order[3], i);
    const double root = sqrt(rate * rate - 2 * value * second);
    const double s = rate < 0 ? 2 * value / (root - rate) : -(root + rate) / second;
    return s + third * s * s * s / (6 * root);
}

/* Most of the time is spent waiting for the vector of the next corner: ask for it as soon as it is known. */
static ICCP_INLINE void expect_corner(const iccp_flow_walk *w, int32_t dim, int32_t exit)
{
    const iccp_kuhn_simplex *simplex = &w->place.simplex;
    const size_t *stride = w->flow->grid->stride;
    size_t corner;
    if (exit == 0)
        corner = simplex->corner[dim] + stride[simplex->axis[0]];
    else if (exit == dim)
        corner = simplex->corner[0] - stride[simplex->axis[dim - 1]];
    else
        corner = simplex->corner[exit - 1] + stride[simplex->axis[exit]];
    ICCP_PREFETCH(w->flow->cones->vector + (size_t)dim * corner);
}

/* The end of the series: the place, the vector and its derivative. */
static ICCP_INLINE void add_up(const iccp_flow_walk *w, int32_t dim, double *place, motion *m)
{
    double sum[ICC_MAX_DIM] = {0};
    for (int32_t j = w->n_terms; j-- > 0;)
        for (int32_t k = 0; k < dim; ++k)
            sum[k] += w->term[j][k] * INVERSE[j + 1];
    for (int32_t k = 0; k < dim; ++k)
        sum[k] *= w->scale;
    apply(w, dim, sum, m->vector);
    for (int32_t k = 0; k < dim; ++k) {
        place[k] = w->place.at[k] + sum[k];
        m->vector[k] += w->term[0][k];
    }
    apply(w, dim, m->vector, m->change);
}

/* From the end of the series to the facet. False when that is too far for it, and walk->end is a better
 * guess. */
static ICCP_INLINE bool reach_facet(iccp_flow_walk *w, int32_t dim, const start *a, double norm,
                                    int32_t exit)
{
    double order[3][ICC_MAX_DIM + 2], place[ICC_MAX_DIM];
    motion m;
    add_up(w, dim, place, &m);
    put_in_order(w, dim, 1, place, order[0]);
    put_in_order(w, dim, 0, m.vector, order[1]);
    put_in_order(w, dim, 0, m.change, order[2]);
    const double inverse = 1 / coordinate(order[1], exit);
    const double step = -(coordinate(order[0], exit) - a->beyond[exit]) * inverse;
    const double rest = step - 0.5 * coordinate(order[2], exit) * inverse * step * step;
    const double share = norm * rest;
    w->end = w->scale + rest;
    if (!(fabs(rest) * share * share <= NEGLIGIBLE))
        return false;
    for (int32_t k = 0; k < dim; ++k)
        w->finish[k] = place[k] + rest * (m.vector[k] + 0.5 * rest * m.change[k]);
    const double speed = sqrt(product(dim, m.vector, m.vector));
    const double slope = product(dim, m.vector, m.change) / speed;
    for (int32_t k = 0; k < dim; ++k)
        m.change[k] *= w->scale;
    w->end_length = integrate(w, dim, 1, &m) + rest * (speed + 0.5 * rest * slope);
    return true;
}

/* A coordinate that is negative at the end, or ICCP_FLOW_WITHIN; *dips: whether one may be so before although it
 * is not there. */
static ICCP_INLINE int32_t find_negative(const iccp_flow_walk *w, int32_t dim, const start *a,
                                         int32_t exit, bool *dips)
{
    double order[ICC_MAX_DIM + 2];
    int32_t negative = ICCP_FLOW_WITHIN;
    put_in_order(w, dim, 1, w->finish, order);
    *dips = false;
    for (int32_t i = 0; i <= dim; ++i) {
        if (i != exit && coordinate(order, i) < a->beyond[i])
            negative = i;
        *dips |= i != exit && a->time[i] < w->end;
    }
    return negative;
}

/* ---- pieces ---- */

/* Tries the facets, first the one that is most likely, until no other is crossed before. */
static ICCP_INLINE bool find_end(iccp_flow_walk *w, int32_t dim,
                                 double first[3][ICC_MAX_DIM], double norm)
{
    enum { MOST = 3 };
    start a;
    w->end = 0;
    int32_t exit = look_ahead(w, dim, first, &a);
    for (int tries = 0; tries < MOST && exit != ICCP_FLOW_WITHIN; ++tries) {
        bool there = false, dips;
        expect_corner(w, dim, exit);
        w->end = guess_time(&a, exit);
        for (int k = 0; k < MOST && !there; ++k) {
            if (!(w->end > 0 && w->end * norm <= FARTHEST))
                return false;
            expand(w, dim, first, norm, w->end);
            there = reach_facet(w, dim, &a, norm, exit);
        }
        if (!there || !(w->end > 0))
            return false;
        w->exit = exit;
        exit = find_negative(w, dim, &a, exit, &dips);
        if (exit == ICCP_FLOW_WITHIN)
            return !dips;
    }
    return false;
}

/* With all safeguards, as far as somewhat beyond the last guess. */
static icc_status find_end_slowly(iccp_flow_walk *w, double first[3][ICC_MAX_DIM], double norm)
{
    static const double BEYOND = 1e-6; /* besides a tenth: a curve may start on the facet */
    const int32_t dim = w->flow->grid->dim;
    const double guess = w->end > 0 ? 1.1 * w->end + BEYOND : HUGE_VAL;
    const double reach = fmin(guess, FARTHEST / norm);
    if (!(reach < HUGE_VAL))
        return ICC_ERR_TRACE;
    expand(w, dim, first, norm, reach);
    iccp_flow_find_exit(w);
    place_at(w, dim, w->end / w->scale, w->finish);
    w->end_length = iccp_flow_length(w, w->end);
    return ICC_OK;
}

static ICCP_INLINE icc_status curved_piece(iccp_flow_walk *w, int32_t dim)
{
    double first[3][ICC_MAX_DIM];
    const double norm = set_matrix(w, dim);
    w->radial = false;
    apply(w, dim, w->place.at, first[0]);
    for (int32_t k = 0; k < dim; ++k)
        first[0][k] += w->corner[0][k];
    if (!(size_of(dim, first[0]) > 0))
        return ICC_ERR_TRACE;
    apply(w, dim, first[0], first[1]);
    apply(w, dim, first[1], first[2]);
    return ICCP_LIKELY(find_end(w, dim, first, norm)) ? ICC_OK : find_end_slowly(w, first, norm);
}

/* The corner that is the root, or ICCP_FLOW_WITHIN. */
static ICCP_INLINE int32_t root_corner(const iccp_flow_walk *w, int32_t dim)
{
    int32_t corner = ICCP_FLOW_WITHIN;
    for (int32_t i = 0; i <= dim; ++i)
        corner = w->place.simplex.corner[i] == w->flow->root ? i : corner;
    return corner;
}

/* Straight to the root, or away from it to the facet opposite. */
static icc_status radial_piece(iccp_flow_walk *w, int32_t corner)
{
    const int32_t dim = w->flow->grid->dim;
    const int8_t *axis = w->place.simplex.axis;
    const double *at = w->place.at;
    const double weight =
        (corner > 0 ? at[axis[corner - 1]] : 1) - (corner < dim ? at[axis[corner]] : 0);
    w->radial = true;
    w->ends = w->sign > 0;
    w->exit = w->ends ? ICCP_FLOW_WITHIN : corner;
    w->end = w->scale = w->ends ? 1 : weight / (1 - weight);
    w->n_terms = 1;
    for (int32_t i = 0; i < dim; ++i)
        w->term[0][axis[i]] = w->sign * ((i < corner ? 1.0 : 0.0) - at[axis[i]]);
    w->end_length = w->end * sqrt(product(dim, w->term[0], w->term[0]));
    for (int32_t k = 0; k < dim; ++k)
        w->finish[k] = at[k] + w->end * w->term[0][k];
    return weight < 1 || w->ends ? ICC_OK : ICC_ERR_TRACE;
}

icc_status iccp_flow_find_piece(iccp_flow_walk *walk)
{
    const int32_t dim = walk->flow->grid->dim;
    const int32_t corner = root_corner(walk, dim);
    if (ICCP_UNLIKELY(corner != ICCP_FLOW_WITHIN))
        return radial_piece(walk, corner);
    switch (dim) {
    case 2:
        return curved_piece(walk, 2);
    case 3:
        return curved_piece(walk, 3);
    default:
        return curved_piece(walk, dim);
    }
}

/* ---- within a piece ---- */

void iccp_flow_at(const iccp_flow_walk *walk, double s, double *at)
{
    place_at(walk, walk->flow->grid->dim, s / walk->scale, at);
}

void iccp_flow_velocity(const iccp_flow_walk *walk, double s, double *vector)
{
    vector_at(walk, walk->flow->grid->dim, s / walk->scale, vector);
}

double iccp_flow_length(const iccp_flow_walk *walk, double s)
{
    const int32_t dim = walk->flow->grid->dim;
    if (walk->radial)
        return walk->end_length * (s / walk->end);
    motion m;
    motion_at(walk, dim, s / walk->scale, &m);
    return integrate(walk, dim, s / walk->scale, &m);
}

double iccp_flow_at_length(const iccp_flow_walk *walk, double length)
{
    enum { MOST = 50 };
    const int32_t dim = walk->flow->grid->dim;
    double low = 0, high = walk->end;
    double s = walk->end_length > 0 ? walk->end * fmin(length / walk->end_length, 1) : 0;
    for (int k = 0; k < MOST && !walk->radial; ++k) {
        double vector[ICC_MAX_DIM];
        const double miss = iccp_flow_length(walk, s) - length;
        if (miss < 0)
            low = s;
        else
            high = s;
        iccp_flow_velocity(walk, s, vector);
        double next = s - miss / sqrt(product(dim, vector, vector));
        if (!(next >= low && next <= high))
            next = 0.5 * (low + high);
        if (fabs(next - s) <= 2 * DBL_EPSILON * walk->end)
            return next;
        s = next;
    }
    return s;
}

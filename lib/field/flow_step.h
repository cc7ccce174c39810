/* A step: one try to find the end of a piece, on LANES curves side by side. The file that includes
 * this one defines LANES and TARGET, the processor. Nothing here branches on a single lane, and
 * each lane gets the bits that it would get alone.
 *
 * Source: docs/theory/charts-space.md, "fields on grids", step 3. In a simplex the field is linear
 * in position. So its curves solve x' = A x + b, and their power series converge everywhere. The
 * terms of x' are A^j x'(0) s^j / j!. The column of A for an axis is the difference of the vectors
 * at the two corners that the axis joins.
 *
 * The first terms of the barycentric coordinates tell nearly where the first coordinate vanishes.
 * The series is added up there, once. The rest of the way is so short that a few derivatives at
 * that point reach the end exactly. A gives as many derivatives as needed.
 *
 * All arrays follow the order of the simplex's axes. Barycentric coordinates are then
 * differences of neighbours. */
#ifndef ICCP_FLOW_STEP_H
#define ICCP_FLOW_STEP_H

#include "field/flow.h"

#include <math.h>

#if LANES > 1
#include <immintrin.h>
#endif

/* ---- lanes ---- */

/* Vectors are passed by pointer, because the convention for passing them by value depends on the
 * processor. */
#if LANES > 1
typedef double lanes __attribute__((vector_size(8 * LANES)));
typedef int64_t mask __attribute__((vector_size(8 * LANES)));
#define SELECT(condition, a, b) ((lanes)((mask)(b) ^ (((mask)(a) ^ (mask)(b)) & (condition))))
#define MAGNITUDE(x) ((lanes)((mask)(x)&INT64_MAX))
#define ALL(x) ((double)(x) + (lanes){0})
#else
typedef double lanes;
typedef bool mask;
#define SELECT(condition, a, b) ((condition) ? (a) : (b))
#define MAGNITUDE(x) fabs(x)
#define ALL(x) ((double)(x))
#endif

#define LANE(x, l) (((double *)&(x))[l])

TARGET static ICCP_INLINE bool any(const mask *m)
{
#if LANES == 4
    return _mm256_movemask_pd((__m256d)*m) != 0;
#elif LANES == 2
    return _mm_movemask_pd((__m128d)*m) != 0;
#else
    return *m;
#endif
}

TARGET static ICCP_INLINE void square_root(const lanes *x, lanes *y)
{
#if LANES == 4
    *y = _mm256_sqrt_pd(*x);
#elif LANES == 2
    *y = _mm_sqrt_pd(*x);
#else
    *y = sqrt(*x);
#endif
}

/* ---- constants and state ---- */

/* Lattice units: the largest error that a truncated series may have. */
static const double NEGLIGIBLE = 1e-16;

/* In units of 1 / |A|: longer pieces are cut, so that ICCP_FLOW_TERMS terms suffice. */
static const double FARTHEST = 2.4;

static const double INVERSE[ICCP_FLOW_TERMS + 2] = {
    0,       1.,      1. / 2,  1. / 3,  1. / 4,  1. / 5,  1. / 6,  1. / 7,  1. / 8,
    1. / 9,  1. / 10, 1. / 11, 1. / 12, 1. / 13, 1. / 14, 1. / 15, 1. / 16, 1. / 17,
    1. / 18, 1. / 19, 1. / 20, 1. / 21, 1. / 22, 1. / 23, 1. / 24, 1. / 25, 1. / 26};

/* Terms of x' up to parameter `scale`. */
typedef struct series {
    int32_t n;
    lanes scale, term[ICCP_FLOW_TERMS][ICC_MAX_DIM];
} series;

/* How a step ended. */
enum {
    FOUND,
    NEARER, /* try again: `end` is a better guess */
    OTHER,  /* try again: the facet `exit` is crossed earlier */
    FAILED  /* give up; `end` is the last guess if positive */
};

typedef struct piece_step {
    lanes at[ICC_MAX_DIM], corner[ICC_MAX_DIM + 1][ICC_MAX_DIM];
    lanes exit; /* the facet to try; ICCP_FLOW_WITHIN: choose the one that seems to come first */
    lanes end;  /* with a given facet: the approximate parameter there, or 0 if unknown */
    lanes outcome;
    lanes norm, column[ICC_MAX_DIM][ICC_MAX_DIM];
    series series;
    lanes finish[ICC_MAX_DIM], length;
} piece_step;

/* ---- the equation ---- */

/* Sets the columns of A and the sum of the sizes of its entries, which bounds its norm. */
TARGET static ICCP_INLINE void set_matrix(piece_step *a, int32_t dim)
{
    lanes norm = {0};
    for (int32_t i = 0; i < dim; ++i)
        for (int32_t k = 0; k < dim; ++k) {
            const lanes difference = a->corner[i + 1][k] - a->corner[i][k];
            a->column[i][k] = difference;
            norm += MAGNITUDE(difference);
        }
    a->norm = norm;
}

TARGET static ICCP_INLINE void apply(const piece_step *a, int32_t dim, const lanes *x, lanes *y)
{
    for (int32_t k = 0; k < dim; ++k) {
        lanes sum = x[0] * a->column[0][k];
        for (int32_t i = 1; i < dim; ++i)
            sum += x[i] * a->column[i][k];
        y[k] = sum;
    }
}

/* The first terms A^j x'(0). */
TARGET static ICCP_INLINE void first_terms(piece_step *a, int32_t dim, lanes first[3][ICC_MAX_DIM])
{
    set_matrix(a, dim);
    apply(a, dim, a->at, first[0]);
    for (int32_t k = 0; k < dim; ++k)
        first[0][k] += a->corner[0][k];
    apply(a, dim, first[0], first[1]);
    apply(a, dim, first[1], first[2]);
}

TARGET static ICCP_INLINE void add_size(int32_t dim, const lanes *x, lanes *sum)
{
    for (int32_t k = 0; k < dim; ++k)
        *sum += MAGNITUDE(x[k]);
}

TARGET static ICCP_INLINE void product(int32_t dim, const lanes *a, const lanes *b, lanes *sum)
{
    *sum = a[0] * b[0];
    for (int32_t k = 1; k < dim; ++k)
        *sum += a[k] * b[k];
}

/* Expands x' up to parameter s, two terms at a time. A lane that has enough terms gets zeros. */
TARGET static ICCP_INLINE void expand(piece_step *a, int32_t dim, lanes first[3][ICC_MAX_DIM],
                                      const lanes *s)
{
    series *out = &a->series;
    const lanes fading = *s * *s * a->norm;
    lanes power[ICC_MAX_DIM], factor = ALL(1);
    for (int32_t j = 0; j < 3; ++j) {
        for (int32_t k = 0; k < dim; ++k)
            out->term[j][k] = first[j][k] * factor;
        factor *= *s * INVERSE[j + 1];
    }
    for (int32_t k = 0; k < dim; ++k)
        power[k] = first[2][k];
    int32_t j = 3;
    for (mask open = *s > 0; any(&open) && j < ICCP_FLOW_TERMS;) {
        lanes next[ICC_MAX_DIM], size = {0};
        for (const int32_t end = j + 2; j < end; ++j) {
            apply(a, dim, power, next);
            for (int32_t k = 0; k < dim; ++k) {
                power[k] = next[k];
                out->term[j][k] = SELECT(open, next[k] * factor, ALL(0));
            }
            factor *= *s * INVERSE[j + 1];
        }
        add_size(dim, out->term[j - 1], &size);
        open &= size * fading > NEGLIGIBLE * (j * (j + 1));
    }
    out->n = j;
    out->scale = *s;
}

/* The vector at the share `at` of the series' scale. */
TARGET static ICCP_INLINE void vector_at(const series *x, int32_t dim, const lanes *at,
                                         lanes *vector)
{
    lanes sum[ICC_MAX_DIM] = {0};
    for (int32_t j = x->n; j-- > 0;)
        for (int32_t k = 0; k < dim; ++k)
            sum[k] = sum[k] * *at + x->term[j][k];
    for (int32_t k = 0; k < dim; ++k)
        vector[k] = sum[k];
}

/* ---- length ---- */

/* Quadrature rules with the speed and its derivative at both ends, and the speed at n places
 * between. These places are the zeros of the orthogonal polynomials for the weight x^2 (1 -
 * x)^2. A rule is exact for polynomials of degree 2 n + 3. */
enum { N_RULES = 4, MOST_NODES = 5 };

static const struct rule {
    double most; /* the largest relative change of the vector that the rule allows */
    double end, slope;
    int n;
    double node[MOST_NODES], weight[MOST_NODES];
} RULES[N_RULES] = {
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

/* A vector and its change per scale of the series. */
typedef struct motion {
    lanes vector[ICC_MAX_DIM], change[ICC_MAX_DIM];
} motion;

TARGET static ICCP_INLINE void speed_of(int32_t dim, const motion *m, lanes *speed, lanes *slope)
{
    lanes size2, along;
    product(dim, m->vector, m->vector, &size2);
    product(dim, m->vector, m->change, &along);
    square_root(&size2, speed);
    *slope = along / *speed;
}

/* Integrates the speed over a part of the scale that starts at share `from` and has size
 * `share`. The result is in units of that part. `change` is the square of the largest relative
 * change of the vector, and at most that of the last rule. */
TARGET static ICCP_INLINE void integrate(const series *x, int32_t dim, const lanes *change,
                                         const lanes *from, const lanes *share, const motion *first,
                                         const motion *last, lanes *length)
{
    lanes speed[2], slope[2], end = ALL(RULES[0].end), bend = ALL(RULES[0].slope);
    mask beyond[N_RULES];
    int n_rules = 1;
    speed_of(dim, first, &speed[0], &slope[0]);
    speed_of(dim, last, &speed[1], &slope[1]);
    for (int r = 1; r < N_RULES; ++r) {
        beyond[r] = *change > RULES[r - 1].most * RULES[r - 1].most;
        if (!any(&beyond[r]))
            break;
        end = SELECT(beyond[r], ALL(RULES[r].end), end);
        bend = SELECT(beyond[r], ALL(RULES[r].slope), bend);
        n_rules = r + 1;
    }
    lanes sum = end * (speed[0] + speed[1]) + bend * *share * (slope[0] - slope[1]);
    for (int i = 0; i < RULES[n_rules - 1].n; ++i) {
        lanes node = ALL(RULES[0].node[i]), weight = ALL(RULES[0].weight[i]);
        lanes vector[ICC_MAX_DIM], size2, size;
        for (int r = 1; r < n_rules; ++r) {
            node = SELECT(beyond[r], ALL(RULES[r].node[i]), node);
            weight = SELECT(beyond[r], ALL(RULES[r].weight[i]), weight);
        }
        node = *from + *share * node;
        vector_at(x, dim, &node, vector);
        product(dim, vector, vector, &size2);
        square_root(&size2, &size);
        sum += weight * size;
    }
    *length = *share * x->scale * sum;
}

/* Bounds the vector's change over the whole scale of the series; see integrate(). */
TARGET static ICCP_INLINE void find_change(const series *x, int32_t dim, motion *first,
                                           lanes *change)
{
    lanes size2, change2;
    for (int32_t k = 0; k < dim; ++k) {
        first->vector[k] = x->term[0][k];
        first->change[k] = x->term[1][k];
    }
    product(dim, first->vector, first->vector, &size2);
    product(dim, first->change, first->change, &change2);
    *change = change2 / size2;
}

/* ---- the exit ---- */

/* Barycentric coordinates of x if `above` is 1, or their rates of change if it is 0. */
TARGET static ICCP_INLINE void coordinates(int32_t dim, double above, const lanes *x, lanes *out)
{
    out[0] = above - x[0];
    for (int32_t i = 1; i < dim; ++i)
        out[i] = x[i - 1] - x[i];
    out[dim] = x[dim - 1];
}

/* The barycentric coordinates at the start. A coordinate that is 0, or below it by rounding,
 * starts at SLACK. It counts as crossed only when it falls below its true start by SLACK. */
typedef struct beginning {
    lanes value[ICC_MAX_DIM + 1], beyond[ICC_MAX_DIM + 1];
    lanes rate[3][ICC_MAX_DIM + 1]; /* derivatives */
} beginning;

TARGET static ICCP_INLINE void look_around(const piece_step *a, int32_t dim,
                                           lanes first[3][ICC_MAX_DIM], beginning *b)
{
    lanes value[ICC_MAX_DIM + 1];
    coordinates(dim, 1, a->at, value);
    for (int32_t j = 0; j < 3; ++j)
        coordinates(dim, 0, first[j], b->rate[j]);
    for (int32_t i = 0; i <= dim; ++i) {
        b->value[i] = SELECT(value[i] > ICCP_FLOW_SLACK, value[i], ALL(ICCP_FLOW_SLACK));
        b->beyond[i] = value[i] - b->value[i];
    }
}

/* Chooses the exit unless the facet is given: the coordinate that would reach 0 first if all
 * kept their present rate. */
TARGET static ICCP_INLINE void choose_exit(piece_step *a, int32_t dim, const beginning *b)
{
    const lanes given = a->exit;
    lanes value = ALL(1), rate = ALL(0), exit = ALL(ICCP_FLOW_WITHIN);
    for (int32_t i = 0; i <= dim; ++i) {
        const mask sooner = b->value[i] * rate > value * b->rate[0][i];
        exit = SELECT(sooner, ALL(i), exit);
        value = SELECT(sooner, b->value[i], value);
        rate = SELECT(sooner, b->rate[0][i], rate);
    }
    a->exit = SELECT(given < 0, exit, given);
}

/* Picks the value at the corner opposite to the exit. */
TARGET static ICCP_INLINE void pick(int32_t dim, const lanes *exit, const lanes *values,
                                    lanes *value)
{
    *value = values[0];
    for (int32_t i = 1; i <= dim; ++i)
        *value = SELECT(*exit == (double)i, values[i], *value);
}

/* Guesses when the exit's coordinate is 0: by a quadratic equation, with the cubic term as a
 * correction. The guess is useless if it is NaN or not positive. */
TARGET static ICCP_INLINE void guess_time(int32_t dim, const beginning *b, const lanes *exit,
                                          lanes *s)
{
    lanes value, rate[3], root;
    pick(dim, exit, b->value, &value);
    for (int32_t j = 0; j < 3; ++j)
        pick(dim, exit, b->rate[j], &rate[j]);
    root = rate[0] * rate[0] - 2 * value * rate[1];
    square_root(&root, &root);
    const mask falls = rate[0] < 0;
    const lanes quadratic =
        SELECT(falls, 2 * value, -(root + rate[0])) / SELECT(falls, root - rate[0], rate[1]);
    *s = quadratic + rate[2] * quadratic * quadratic * quadratic / (6 * root);
}

/* Adds up the series to its end: the place, the vector and its derivative. */
TARGET static ICCP_INLINE void add_up(const piece_step *a, int32_t dim, lanes *place, motion *m)
{
    const series *x = &a->series;
    lanes sum[ICC_MAX_DIM] = {0};
    for (int32_t j = x->n; j-- > 0;)
        for (int32_t k = 0; k < dim; ++k)
            sum[k] += x->term[j][k] * INVERSE[j + 1];
    for (int32_t k = 0; k < dim; ++k)
        sum[k] *= x->scale;
    apply(a, dim, sum, m->vector);
    for (int32_t k = 0; k < dim; ++k) {
        place[k] = a->at[k] + sum[k];
        m->vector[k] += x->term[0][k];
    }
    apply(a, dim, m->vector, m->change);
}

/* Parameter from the end of the series to the facet, from three derivatives of the exit's
 * coordinate. */
TARGET static ICCP_INLINE void find_rest(const piece_step *a, int32_t dim, const beginning *b,
                                         const lanes *place, const motion *last, const lanes *bend,
                                         lanes *rest)
{
    lanes all[ICC_MAX_DIM + 1], value, beyond, rate, second, third;
    coordinates(dim, 1, place, all);
    pick(dim, &a->exit, all, &value);
    pick(dim, &a->exit, b->beyond, &beyond);
    coordinates(dim, 0, last->vector, all);
    pick(dim, &a->exit, all, &rate);
    coordinates(dim, 0, last->change, all);
    pick(dim, &a->exit, all, &second);
    coordinates(dim, 0, bend, all);
    pick(dim, &a->exit, all, &third);
    const lanes inverse = 1 / rate, step = (beyond - value) * inverse;
    const lanes half = 0.5 * second * inverse, sixth = third * inverse * (1. / 6);
    *rest = step - step * step * (half - step * (2 * half * half - sixth));
}

/* The length of the curve over that rest. */
TARGET static ICCP_INLINE void measure_rest(int32_t dim, const motion *m, const lanes *bend,
                                            const lanes *rest, lanes *length)
{
    lanes size2, along, change2, across, speed;
    product(dim, m->vector, m->vector, &size2);
    product(dim, m->vector, m->change, &along);
    product(dim, m->change, m->change, &change2);
    product(dim, m->vector, bend, &across);
    square_root(&size2, &speed);
    const lanes inverse = 1 / speed, slope = along * inverse;
    const lanes second = (change2 + across - slope * slope) * inverse;
    *length = *rest * (speed + *rest * (0.5 * slope + *rest * second * (1. / 6)));
}

/* Goes from the end of the series to the facet. `near` tells in which lanes the rest was short
 * enough. */
TARGET static ICCP_INLINE void reach_facet(piece_step *a, int32_t dim, const beginning *b,
                                           mask *near)
{
    lanes place[ICC_MAX_DIM], bend[ICC_MAX_DIM], rest, change, more;
    motion first, last;
    add_up(a, dim, place, &last);
    apply(a, dim, last.change, bend);
    find_rest(a, dim, b, place, &last, bend, &rest);
    const lanes share = a->norm * rest, left = rest * share * share * share;
    *near = MAGNITUDE(left) <= 24 * NEGLIGIBLE;
    a->end = a->series.scale + rest;
    for (int32_t k = 0; k < dim; ++k)
        a->finish[k] =
            place[k] +
            rest * (last.vector[k] + rest * (0.5 * last.change[k] + rest * bend[k] * (1. / 6)));
    measure_rest(dim, &last, bend, &rest, &more);
    for (int32_t k = 0; k < dim; ++k)
        last.change[k] *= a->series.scale;
    find_change(&a->series, dim, &first, &change);
    const lanes from = ALL(0), whole = ALL(1);
    integrate(&a->series, dim, &change, &from, &whole, &first, &last, &a->length);
    a->length += more;
    a->outcome = SELECT(change <= RULES[N_RULES - 1].most * RULES[N_RULES - 1].most, ALL(FOUND),
                        ALL(FAILED));
}

/* Examines the other coordinates. `negative` is one that is negative at the end, or
 * ICCP_FLOW_WITHIN. `dips` tells whether one may have been negative earlier. */
TARGET static ICCP_INLINE void find_negative(const piece_step *a, int32_t dim, const beginning *b,
                                             lanes *negative, mask *dips)
{
    lanes all[ICC_MAX_DIM + 1];
    coordinates(dim, 1, a->finish, all);
    *negative = ALL(ICCP_FLOW_WITHIN);
    *dips = (mask){0};
    for (int32_t i = 0; i <= dim; ++i) {
        const mask others = a->exit != (double)i;
        *negative = SELECT(others & (all[i] < b->beyond[i]), ALL(i), *negative);
        *dips |= others & (b->value[i] + b->rate[0][i] * a->end < 0);
    }
}

/* One try: guesses the exit and its parameter, adds up the series there, and goes the rest of
 * the way. The try succeeds if the rest was short and no other coordinate is, or may have been,
 * negative. Otherwise the outcome tells what to try next. */
TARGET static ICCP_INLINE void try_exit(piece_step *a, int32_t dim)
{
    lanes first[3][ICC_MAX_DIM], s, negative;
    beginning b;
    mask near, dips;
    first_terms(a, dim, first);
    look_around(a, dim, first, &b);
    choose_exit(a, dim, &b);
    guess_time(dim, &b, &a->exit, &s);
    s = SELECT(a->end > 0, a->end, s);
    const mask fits = (s > 0) & (s * a->norm <= FARTHEST) & (a->exit >= 0);
    const lanes reach = SELECT(fits, s, ALL(0));
    expand(a, dim, first, &reach);
    reach_facet(a, dim, &b, &near);
    find_negative(a, dim, &b, &negative, &dips);
    a->outcome = SELECT(dips, ALL(FAILED), a->outcome);
    const mask other = negative >= 0;
    a->outcome = SELECT(other, ALL(OTHER), a->outcome);
    a->exit = SELECT(other & near, negative, a->exit);
    a->outcome = SELECT(near, a->outcome, ALL(NEARER));
    a->outcome = SELECT(fits & (a->end > 0), a->outcome, ALL(FAILED));
    a->end = SELECT(fits, a->end, s);
}

/* The most tries before a piece goes to the slow way. */
enum { MOST_TRIES = 6 };

/* Prepares the next try of a lane. Returns false if there is nothing else to try. */
TARGET static ICCP_INLINE bool prepare_retry(piece_step *a, int l)
{
    const int outcome = (int)LANE(a->outcome, l);
    if (outcome == OTHER)
        LANE(a->end, l) = 0;
    return outcome == OTHER || outcome == NEARER;
}

/* ---- walks ---- */

/* Loads the start of a walk's piece into lane l of the step. */
TARGET static ICCP_INLINE void load_start(piece_step *a, int32_t dim, int l,
                                          const iccp_flow_walk *w)
{
    const iccp_vectors *vectors = w->flow->vectors;
    const iccp_kuhn_simplex *simplex = &w->place.simplex;
    for (int32_t i = 0; i <= dim; ++i) {
        const float *x = vectors->vector + (size_t)dim * simplex->corner[i];
        if (ICCP_UNLIKELY(x[0] >= ICCP_SEVERAL))
            x = iccp_vectors_at(vectors, simplex->corner[i], iccp_order_rank(dim, simplex->axis),
                                i);
        for (int32_t k = 0; k < dim; ++k)
            LANE(a->corner[i][k], l) = w->sign * (double)x[simplex->axis[k]];
    }
    for (int32_t k = 0; k < dim; ++k)
        LANE(a->at[k], l) = w->place.at[simplex->axis[k]];
    LANE(a->exit, l) = ICCP_FLOW_WITHIN;
    LANE(a->end, l) = 0;
}

/* Stores the end of the piece that lane l has found. */
TARGET static ICCP_INLINE void store_end(const piece_step *a, int32_t dim, int l, iccp_flow_walk *w)
{
    for (int32_t k = 0; k < dim; ++k)
        w->finish[w->place.simplex.axis[k]] = LANE(a->finish[k], l);
    double trace = 0;
    for (int32_t k = 0; k < dim; ++k)
        trace += LANE(a->column[k][k], l);
    w->exit = (int32_t)LANE(a->exit, l);
    w->end = LANE(a->end, l);
    w->end_length = LANE(a->length, l);
    w->end_growth = w->end * trace;
}

/* Stores the series, so that the walk can go anywhere within its piece. */
TARGET static ICCP_INLINE void store_series(const piece_step *a, int32_t dim, int l,
                                            iccp_flow_walk *w)
{
    const int8_t *axis = w->place.simplex.axis;
    w->radial = false;
    w->n_terms = a->series.n;
    w->scale = LANE(a->series.scale, l);
    for (int32_t j = 0; j < a->series.n; ++j)
        for (int32_t k = 0; k < dim; ++k)
            w->term[j][axis[k]] = LANE(a->series.term[j][k], l);
    for (int32_t i = 0; i < dim; ++i)
        for (int32_t k = 0; k < dim; ++k)
            w->column[axis[i]][axis[k]] = LANE(a->column[i][k], l);
}

#endif

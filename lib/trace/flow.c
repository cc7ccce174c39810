/* In a simplex the field is linear in position, so its curves are solutions of x' = A x + b: power series
 * that converge everywhere. The column of A for an axis is the difference of the vectors at the two
 * corners that the axis joins. Terms are added until they no longer count at the piece's end, which
 * is the first root of one of the barycentric coordinates, themselves power series. */
#include "trace/flow.h"

#include "domain/simplex.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Lattice units. What a series leaves out, and how far beyond a facet that it starts on a curve may be
 * without having crossed it: curves that run along a facet do so for reasons of symmetry, up to
 * rounding. */
static const double NEGLIGIBLE = 1e-16, SLACK = 1e-15;

/* How much further than guessed a series is made to hold, besides a tenth: so that the facet is surely passed
 * there even when the curve starts on it. */
static const double BEYOND = 1e-6;

/* In terms of 1 / |A|: further than this a piece is cut, so that ICCP_FLOW_TERMS terms suffice. */
static const double FARTHEST = 1.5;

/* ---- places ---- */

bool iccp_flow_find(const iccp_flow *flow, const double *x, const double *ahead,
                    iccp_flow_place *place)
{
    static const double NUDGE = 1e-12; /* lattice units: beyond the rounding of x */
    const icc_grid *grid = flow->grid;
    const int32_t dim = grid->dim;
    double nudged[ICC_MAX_DIM] = {0}, lambda[ICC_MAX_DIM + 1];
    for (int32_t k = 0; k < dim; ++k)
        nudged[k] = x[k] + (ahead != NULL ? NUDGE * ahead[k] : 0);
    if (!iccp_kuhn_simplex_at(&place->simplex, grid, nudged, lambda))
        return false;
    place->entry = ICCP_FLOW_WITHIN;
    double above = 1;
    for (int32_t k = 0; k < dim; ++k) {
        const int8_t axis = place->simplex.axis[k];
        const double at = x[axis] - iccp_grid_coordinate(grid, place->simplex.corner[0], axis);
        place->at[axis] = fmin(fmax(at, 0), above);
        above = place->at[axis];
    }
    return true;
}

void iccp_flow_position(const iccp_flow *flow, const iccp_flow_place *place, const double *at,
                        double *x)
{
    for (int32_t k = 0; k < flow->grid->dim; ++k)
        x[k] = iccp_grid_coordinate(flow->grid, place->simplex.corner[0], k) + at[k];
}

void iccp_flow_vector(const iccp_flow *flow, const iccp_flow_place *place, double *vector)
{
    const int32_t dim = flow->grid->dim;
    const int32_t r = iccp_order_rank(dim, place->simplex.axis);
    double above = 1;
    memset(vector, 0, (size_t)dim * sizeof *vector);
    for (int32_t i = 0; i <= dim; ++i) {
        const double below = i < dim ? place->at[place->simplex.axis[i]] : 0;
        const float *x = iccp_cones_vector(flow->cones, place->simplex.corner[i], r, i);
        for (int32_t k = 0; k < dim; ++k)
            vector[k] += (above - below) * (double)x[k];
        above = below;
    }
}

bool iccp_flow_near_boundary(const iccp_flow *flow, const iccp_flow_place *place)
{
    const uint32_t lowest = place->simplex.corner[0];
    return flow->cover->bits[lowest] != 0 &&
           iccp_cover_has(flow->cover, lowest,
                          iccp_order_rank(flow->grid->dim, place->simplex.axis));
}

/* ---- power series ---- */

/* Of the barycentric coordinate of corner i: its terms from the first on. */
static ICCP_INLINE void coordinate_series(const iccp_flow_walk *w, int32_t dim, int32_t i,
                                          double *series)
{
    const int8_t *axis = w->place.simplex.axis;
    for (int32_t j = 0; j < w->n_terms; ++j)
        series[j] = (i > 0 ? w->term[j][axis[i - 1]] : 0) - (i < dim ? w->term[j][axis[i]] : 0);
    if (i == 0)
        series[0] += 1;
}

static inline double value_of(const double *series, int32_t n, double s)
{
    double sum = 0;
    for (int32_t j = n; j-- > 0;)
        sum = sum * s + series[j];
    return sum;
}

static inline double slope_of(const double *series, int32_t n, double s)
{
    double sum = 0;
    for (int32_t j = n; j-- > 1;)
        sum = sum * s + j * series[j];
    return sum;
}

/* A root of a series between 0, where it is positive, and `high`, where it need not be negative: Newton's
 * method, kept between the two. HUGE_VAL when there is none. */
static double root_of(const double *series, int32_t n, double high, double guess)
{
    enum { MOST = 60, FIRST = 5 };
    static const double CLOSE = 1e-8;
    double low = 0, s = guess;
    bool is_beyond = false; /* whether `high` is known to lie beyond the root */
    /* The first terms do for the first step. */
    int32_t used = n > FIRST ? FIRST : n;
    for (int k = 0; k < MOST; ++k) {
        double value = series[used - 1], slope = 0;
        for (int32_t j = used - 1; j-- > 0;) {
            slope = slope * s + value;
            value = value * s + series[j];
        }
        double next = s - value / slope;
        if (used < n) {
            used = n;
            s = next > 0 && next < high ? next : s;
            continue;
        }
        /* The next step would be about the square of this one. */
        if (fabs(next - s) <= CLOSE * s)
            return next;
        if (value > 0) {
            low = s;
        } else {
            high = s;
            is_beyond = true;
        }
        if (!(next > low && next < high)) {
            if (!is_beyond && !(value_of(series, n, high) <= 0))
                return HUGE_VAL;
            is_beyond = true;
            next = 0.5 * (low + high);
        }
        s = next;
    }
    return s;
}

/* ---- one piece ---- */

static ICCP_INLINE void load_corner(iccp_flow_walk *w, int32_t dim, int32_t i)
{
    const uint32_t v = w->place.simplex.corner[i];
    const float *x = w->flow->cones->vector + (size_t)dim * v;
    if (ICCP_UNLIKELY(x[0] >= ICCP_SEVERAL))
        x = iccp_cones_vector(w->flow->cones, v, iccp_order_rank(dim, w->place.simplex.axis), i);
    for (int32_t k = 0; k < dim; ++k)
        w->corner[i][k] = w->sign * (double)x[k];
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

/* Which facet a straight curve would reach first, and when a quadratic one would reach that. */
static ICCP_INLINE double guess_exit(const iccp_flow_walk *w, int32_t dim, int32_t *exit)
{
    const int8_t *axis = w->place.simplex.axis;
    double best = HUGE_VAL, a = 1, b = 0, a_best = 0, b_best = 0;
    int32_t first = ICCP_FLOW_WITHIN;
    for (int32_t i = 0; i <= dim; ++i) {
        const double a_next = i < dim ? w->term[0][axis[i]] : 0;
        const double b_next = i < dim ? w->term[1][axis[i]] : 0;
        const double slope = b - b_next, time = (a - a_next) / -slope;
        const bool sooner = slope < 0 && time < best;
        best = sooner ? time : best;
        first = sooner ? i : first;
        a = a_next;
        b = b_next;
    }
    *exit = first;
    if (first == ICCP_FLOW_WITHIN)
        return HUGE_VAL;
    a_best = (first > 0 ? w->term[0][axis[first - 1]] : 1) - (first < dim ? w->term[0][axis[first]] : 0);
    b_best = (first > 0 ? w->term[1][axis[first - 1]] : 0) - (first < dim ? w->term[1][axis[first]] : 0);
    const double c = (first > 0 ? w->term[2][axis[first - 1]] : 0) - (first < dim ? w->term[2][axis[first]] : 0);
    const double d = b_best * b_best - 4 * a_best * c;
    return d >= 0 ? 2 * a_best / (sqrt(d) - b_best) : -b_best / (2 * c);
}

static const double INVERSE[ICCP_FLOW_TERMS + 2] = {
    0,        1.,       1. / 2,  1. / 3,  1. / 4,  1. / 5,  1. / 6,  1. / 7,  1. / 8,
    1. / 9,   1. / 10,  1. / 11, 1. / 12, 1. / 13, 1. / 14, 1. / 15, 1. / 16, 1. / 17,
    1. / 18,  1. / 19,  1. / 20, 1. / 21, 1. / 22, 1. / 23, 1. / 24, 1. / 25};

/* The series as far as it counts, and a guess where it ends. Returns how far it may be used. */
static ICCP_INLINE double expand(iccp_flow_walk *w, int32_t dim, int32_t *exit, double *guess)
{
    const int8_t *axis = w->place.simplex.axis;
    double a[ICC_MAX_DIM][ICC_MAX_DIM], norm = 0;
    for (int32_t i = 0; i < dim; ++i)
        for (int32_t k = 0; k < dim; ++k) {
            a[axis[i]][k] = w->corner[i + 1][k] - w->corner[i][k];
            norm += fabs(a[axis[i]][k]);
        }
    for (int32_t k = 0; k < dim; ++k) {
        w->term[0][k] = w->place.at[k];
        w->speed[0][k] = w->corner[0][k];
    }
    for (int32_t i = 0; i < dim; ++i)
        for (int32_t k = 0; k < dim; ++k)
            w->speed[0][k] += w->place.at[i] * a[i][k];
    double reach = HUGE_VAL, power = 0;
    int32_t j = 0;
    *exit = ICCP_FLOW_WITHIN;
    *guess = 0;
    for (;; ++j) {
        double size = 0;
        for (int32_t k = 0; k < dim; ++k) {
            w->term[j + 1][k] = w->speed[j][k] * INVERSE[j + 1];
            size += fabs(w->term[j + 1][k]);
        }
        if (j == 1) {
            *guess = guess_exit(w, dim, exit);
            if (*exit != ICCP_FLOW_WITHIN)
                expect_corner(w, dim, *exit);
            reach = 1.1 * *guess + BEYOND;
            reach = reach * norm > FARTHEST ? FARTHEST / norm : reach;
            power = reach * reach * norm;
        }
        power *= reach;
        if (j >= 1 && (size * power * INVERSE[j + 2] <= NEGLIGIBLE || j + 2 > ICCP_FLOW_TERMS))
            break;
        for (int32_t k = 0; k < dim; ++k) {
            double sum = 0;
            for (int32_t i = 0; i < dim; ++i)
                sum += w->term[j + 1][i] * a[i][k];
            w->speed[j + 1][k] = sum;
        }
    }
    w->n_terms = j + 2;
    return reach;
}

/* Whether a coordinate that is positive at both ends falls below 0 between them; if so its first root. */
static bool dips(const double *series, int32_t n, double end, double *root)
{
    if (!(series[1] < 0) || series[0] + series[1] * end > 0 || !(slope_of(series, n, end) > 0))
        return false;
    double low = 0, high = end;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        if (slope_of(series, n, middle) < 0)
            low = middle;
        else
            high = middle;
    }
    if (value_of(series, n, low) >= 0)
        return false;
    *root = root_of(series, n, low, 0.5 * low);
    return true;
}

/* Given the end by one facet, an earlier one by another. */
static ICCP_INLINE bool find_earlier(iccp_flow_walk *w, int32_t dim)
{
    double series[ICCP_FLOW_TERMS + 1];
    bool found = false;
    for (int32_t i = 0; i <= dim; ++i) {
        if (i == w->exit)
            continue;
        coordinate_series(w, dim, i, series);
        if (series[0] <= SLACK)
            series[0] = SLACK;
        double root = HUGE_VAL;
        if (value_of(series, w->n_terms, w->end) < 0)
            root = root_of(series, w->n_terms, w->end, 0.5 * w->end);
        else if (!dips(series, w->n_terms, w->end, &root))
            continue;
        if (root < w->end) {
            w->end = root;
            w->exit = i;
            found = true;
        }
    }
    return found;
}

static ICCP_INLINE void place_at(const iccp_flow_walk *w, int32_t dim, double s, double *at)
{
    double x[ICC_MAX_DIM];
    for (int32_t k = 0; k < dim; ++k)
        x[k] = w->term[w->n_terms - 1][k];
    for (int32_t j = w->n_terms - 1; j-- > 0;)
        for (int32_t k = 0; k < dim; ++k)
            x[k] = x[k] * s + w->term[j][k];
    for (int32_t k = 0; k < dim; ++k)
        at[k] = x[k];
}

/* Whether no other facet can be crossed before: every coordinate is positive at the end, and does not fall so
 * fast at the start that it could have been negative between. */
static ICCP_INLINE bool is_first(const iccp_flow_walk *w, int32_t dim)
{
    const int8_t *axis = w->place.simplex.axis;
    double above = 1, above_start = 1, above_speed = 0;
    for (int32_t i = 0; i <= dim; ++i) {
        const double below = i < dim ? w->finish[axis[i]] : 0;
        const double below_start = i < dim ? w->term[0][axis[i]] : 0;
        const double below_speed = i < dim ? w->term[1][axis[i]] : 0;
        const double straight = above_start - below_start + (above_speed - below_speed) * w->end;
        if (i != w->exit && (above - below < 0 || straight < 0))
            return false;
        above = below;
        above_start = below_start;
        above_speed = below_speed;
    }
    return true;
}

static ICCP_INLINE void find_end(iccp_flow_walk *w, int32_t dim, double reach, int32_t exit,
                                 double guess)
{
    double series[ICCP_FLOW_TERMS + 1];
    w->end = reach;
    w->exit = ICCP_FLOW_WITHIN;
    if (exit != ICCP_FLOW_WITHIN) {
        coordinate_series(w, dim, exit, series);
        if (series[0] <= SLACK)
            series[0] = SLACK;
        const double root =
            root_of(series, w->n_terms, reach, guess < reach ? guess : 0.999 * reach);
        if (root < reach) {
            w->end = root;
            w->exit = exit;
        }
    }
    place_at(w, dim, w->end, w->finish);
    if (is_first(w, dim))
        return;
    while (find_earlier(w, dim))
        continue;
    place_at(w, dim, w->end, w->finish);
}

/* The corner that is the root, or ICCP_FLOW_WITHIN. */
static ICCP_INLINE int32_t root_corner(const iccp_flow_walk *w, int32_t dim)
{
    for (int32_t i = 0; i <= dim; ++i)
        if (w->place.simplex.corner[i] == w->flow->root)
            return i;
    return ICCP_FLOW_WITHIN;
}

/* Straight to the root, or away from it to the facet opposite. */
static icc_status radial_piece(iccp_flow_walk *w, int32_t dim, int32_t corner)
{
    const int8_t *axis = w->place.simplex.axis;
    const double above = corner > 0 ? w->place.at[axis[corner - 1]] : 1;
    const double weight = above - (corner < dim ? w->place.at[axis[corner]] : 0);
    for (int32_t i = 0; i < dim; ++i) {
        w->term[0][axis[i]] = w->place.at[axis[i]];
        w->term[1][axis[i]] = w->sign * ((i < corner ? 1.0 : 0.0) - w->place.at[axis[i]]);
        w->speed[0][axis[i]] = w->term[1][axis[i]];
    }
    w->n_terms = 2;
    w->ends = w->sign > 0;
    w->end = w->ends ? 1 : weight / (1 - weight);
    for (int32_t k = 0; k < dim; ++k)
        w->finish[k] = w->term[0][k] + w->end * w->term[1][k];
    w->exit = w->ends ? ICCP_FLOW_WITHIN : corner;
    return weight < 1 || w->ends ? ICC_OK : ICC_ERR_TRACE;
}

/* ---- length ---- */

typedef struct rule {
    double most; /* largest share by which the speed may change along the piece */
    int n;
    double node[4], weight[4]; /* of the upper half; twice as many by symmetry, 0 counts once */
} rule;

/* Gauss and Legendre. The error is about (4 / change)^(-2 n): below 1e-15. */
static const rule RULES[] = {
    {0.012, 3, {0, 0.774596669241483377036}, {0.888888888888888888889, 0.555555555555555555556}},
    {0.1,
     5,
     {0, 0.538469310105683091036, 0.906179845938663992798},
     {0.568888888888888888889, 0.478628670499366468041, 0.236926885056189087514}},
    {0.3,
     7,
     {0, 0.405845151377397166907, 0.741531185599394439864, 0.949107912342758524526},
     {0.417959183673469387755, 0.381830050505118944950, 0.279705391489276667901,
      0.129484966168869693271}}};

enum { N_RULES = 3, MOST_PARTS = 16 };

static ICCP_INLINE double speed_at(const iccp_flow_walk *w, int32_t dim, double s)
{
    double sum = 0, v[ICC_MAX_DIM];
    for (int32_t k = 0; k < dim; ++k)
        v[k] = w->speed[w->n_terms - 2][k];
    for (int32_t j = w->n_terms - 2; j-- > 0;)
        for (int32_t k = 0; k < dim; ++k)
            v[k] = v[k] * s + w->speed[j][k];
    for (int32_t k = 0; k < dim; ++k)
        sum += v[k] * v[k];
    return sqrt(sum);
}

static ICCP_INLINE double integrate(const iccp_flow_walk *w, int32_t dim, double s)
{
    double first = 0, second = 0;
    for (int32_t k = 0; k < dim; ++k) {
        first += w->speed[0][k] * w->speed[0][k];
        second += w->n_terms > 2 ? w->speed[1][k] * w->speed[1][k] : 0;
    }
    if (w->n_terms == 2)
        return s * sqrt(first);
    const double change2 = s * s * second;
    int r = 0, parts = 1;
    while (r + 1 < N_RULES && change2 > RULES[r].most * RULES[r].most * first)
        ++r;
    while (parts < MOST_PARTS && change2 > RULES[r].most * RULES[r].most * first * parts * parts)
        parts *= 2;
    double sum = 0;
    for (int p = 0; p < parts; ++p) {
        const double half = 0.5 * s / parts, middle = (2 * p + 1) * half;
        double part = RULES[r].weight[0] * speed_at(w, dim, middle);
        for (int i = 1; i <= RULES[r].n / 2; ++i) {
            const double away = half * RULES[r].node[i];
            part += RULES[r].weight[i] *
                    (speed_at(w, dim, middle - away) + speed_at(w, dim, middle + away));
        }
        sum += half * part;
    }
    return sum;
}

/* ---- walking ---- */

static ICCP_INLINE icc_status find_piece(iccp_flow_walk *w, int32_t dim)
{
    const int32_t corner = root_corner(w, dim);
    if (corner != ICCP_FLOW_WITHIN) {
        const icc_status status = radial_piece(w, dim, corner);
        w->end_length = status == ICC_OK ? integrate(w, dim, w->end) : 0;
        return status;
    }
    int32_t exit;
    double guess, any = 0;
    const double reach = expand(w, dim, &exit, &guess);
    for (int32_t k = 0; k < dim; ++k)
        any += fabs(w->speed[0][k]);
    if (!(any > 0) || !(reach < HUGE_VAL))
        return ICC_ERR_TRACE;
    find_end(w, dim, reach, exit, guess);
    w->end_length = integrate(w, dim, w->end);
    return ICC_OK;
}

/* Onto the facet, exactly, and no corner's weight negative; then across. */
static ICCP_INLINE icc_status cross(iccp_flow_walk *w, int32_t dim)
{
    iccp_flow_place *p = &w->place;
    const int32_t i = w->exit;
    const int8_t *axis = p->simplex.axis;
    double above = 1, *at = w->finish;
    if (i > 0 && i < dim)
        at[axis[i - 1]] = at[axis[i]] = 0.5 * (at[axis[i - 1]] + at[axis[i]]);
    for (int32_t k = 0; k < dim; ++k) {
        double x = at[axis[k]];
        x = x > above ? above : x;
        x = x < 0 ? 0 : x;
        p->at[axis[k]] = above = x;
    }
    p->entry = ICCP_FLOW_WITHIN;
    if (i == ICCP_FLOW_WITHIN)
        return ICC_OK;
    if (i == 0)
        p->at[axis[0]] = 0;
    if (i == dim)
        p->at[axis[dim - 1]] = 1;
    if (!iccp_kuhn_simplex_cross(&p->simplex, w->flow->grid, i, &p->entry))
        return ICC_ERR_TRACE;
    for (int32_t c = 0; i == 0 && c < dim; ++c)
        for (int32_t k = 0; k < dim; ++k)
            w->corner[c][k] = w->corner[c + 1][k];
    for (int32_t c = dim; i == dim && c > 0; --c)
        for (int32_t k = 0; k < dim; ++k)
            w->corner[c][k] = w->corner[c - 1][k];
    load_corner(w, dim, p->entry);
    return ICC_OK;
}

static ICCP_INLINE icc_status start(iccp_flow_walk *w, int32_t dim)
{
    for (int32_t i = 0; i <= dim; ++i)
        load_corner(w, dim, i);
    return find_piece(w, dim);
}

icc_status iccp_flow_start(iccp_flow_walk *walk, const iccp_flow *flow, int32_t sign,
                           const iccp_flow_place *place)
{
    walk->flow = flow;
    walk->sign = sign;
    walk->place = *place;
    walk->length = 0;
    walk->n_steps = 0;
    walk->ends = false;
    return flow->grid->dim == 3 ? start(walk, 3) : start(walk, flow->grid->dim);
}

static ICCP_INLINE icc_status go_on(iccp_flow_walk *w, int32_t dim)
{
    w->length += w->end_length;
    if (++w->n_steps > w->flow->most_steps)
        return ICC_ERR_TRACE;
    const icc_status status = cross(w, dim);
    return status == ICC_OK ? find_piece(w, dim) : status;
}

icc_status iccp_flow_next(iccp_flow_walk *walk)
{
    return walk->flow->grid->dim == 3 ? go_on(walk, 3) : go_on(walk, walk->flow->grid->dim);
}

icc_status iccp_flow_note(const iccp_flow_walk *walk, iccp_path *path)
{
    if (path->n_marks == path->mark_capacity) {
        const size_t capacity = path->mark_capacity > 0 ? 2 * path->mark_capacity : 256;
        iccp_flow_mark *marks =
            iccp_grow(path->memory, path->marks, path->n_marks, capacity, sizeof *marks);
        if (marks == NULL)
            return ICC_ERR_MEMORY;
        path->marks = marks;
        path->mark_capacity = capacity;
    }
    path->marks[path->n_marks++] = (iccp_flow_mark){walk->place, walk->length};
    return ICC_OK;
}

icc_status iccp_flow_rewind(iccp_flow_walk *walk, const iccp_path *path, double length)
{
    size_t low = 0, high = path->n_marks;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (path->marks[middle].length <= length)
            low = middle;
        else
            high = middle;
    }
    const icc_status status =
        iccp_flow_start(walk, walk->flow, walk->sign, &path->marks[low].place);
    walk->length = path->marks[low].length;
    return status;
}

void iccp_flow_at(const iccp_flow_walk *walk, double s, double *at)
{
    place_at(walk, walk->flow->grid->dim, s, at);
}

double iccp_flow_length(const iccp_flow_walk *walk, double s)
{
    return integrate(walk, walk->flow->grid->dim, s);
}

double iccp_flow_at_length(const iccp_flow_walk *walk, double length)
{
    enum { MOST = 50 };
    const int32_t dim = walk->flow->grid->dim;
    double low = 0, high = walk->end;
    double s = walk->end_length > 0 ? walk->end * fmin(length / walk->end_length, 1) : 0;
    for (int k = 0; k < MOST && walk->n_terms > 2; ++k) {
        const double miss = integrate(walk, dim, s) - length;
        if (miss < 0)
            low = s;
        else
            high = s;
        double next = s - miss / speed_at(walk, dim, s);
        if (!(next >= low && next <= high))
            next = 0.5 * (low + high);
        if (fabs(next - s) <= 2 * DBL_EPSILON * walk->end)
            return next;
        s = next;
    }
    return s;
}

/* ---- the boundary ---- */

/* The local coordinates of a place in the cell. */
static void local_of(const iccp_flow_walk *w, const double *at, double *local)
{
    const icc_grid *grid = w->flow->grid;
    iccp_flow_position(w->flow, &w->place, at, local);
    for (int32_t k = 0; k < grid->dim; ++k)
        local[k] = grid->origin[k] + grid->spacing * local[k];
}

/* Where the piece meets the plane of a facet near `guess`; the squared distance from the facet there. */
static double meet_plane(const iccp_flow_walk *w, uint32_t facet, double guess, double *s, double *bary)
{
    const icc_domain *domain = w->flow->domain;
    const icc_grid *grid = w->flow->grid;
    const int32_t dim = grid->dim;
    const double *normal = w->flow->cover->normal + (size_t)dim * facet;
    const double *corner[ICC_MAX_DIM];
    double series[ICCP_FLOW_TERMS + 1], zero[ICC_MAX_DIM] = {0}, local[ICC_MAX_DIM], at[ICC_MAX_DIM];
    iccp_facet_corners(&domain->tree, facet, corner);
    local_of(w, zero, local);
    for (int32_t j = 0; j < w->n_terms; ++j) {
        series[j] = 0;
        for (int32_t k = 0; k < dim; ++k)
            series[j] += normal[k] * w->term[j][k];
    }
    for (int32_t k = 0; k < dim; ++k)
        series[0] += normal[k] * ((local[k] - corner[0][k]) / grid->spacing);
    *s = guess;
    for (int k = 0; k < 8; ++k) {
        const double step = value_of(series, w->n_terms, *s) / slope_of(series, w->n_terms, *s);
        if (!(fabs(step) <= w->end))
            break;
        *s = fmin(fmax(*s - step, 0), w->end);
    }
    iccp_flow_at(w, *s, at);
    local_of(w, at, local);
    return iccp_simplex_nearest((size_t)dim, (size_t)dim, corner, local, bary);
}

bool iccp_flow_leaves(const iccp_flow_walk *walk, double *s, uint32_t *facet, double *bary)
{
    static const double SAME = 1e-11; /* lattice units: the curve meets the facet itself */
    static const double FURTHER = 1e-9; /* of the piece: it may end on the boundary, up to rounding */
    const icc_domain *domain = walk->flow->domain;
    const icc_grid *grid = walk->flow->grid;
    double from[ICC_MAX_DIM], to[ICC_MAX_DIM], share;
    if (!iccp_flow_near_boundary(walk->flow, &walk->place))
        return false;
    local_of(walk, walk->term[0], from);
    local_of(walk, walk->finish, to);
    for (int32_t k = 0; k < grid->dim; ++k)
        to[k] += FURTHER * (to[k] - from[k]);
    if (!iccp_domain_cross(domain, from, to, &share, facet, bary))
        return false;
    const double same2 = SAME * grid->spacing * SAME * grid->spacing;
    const double guess = share * walk->end;
    if (meet_plane(walk, *facet, guess, s, bary) <= same2)
        return true;
    /* The curve bulges beside the chord: another facet close by. */
    iccp_facet_query query;
    double box[2 * ICC_MAX_DIM], best = HUGE_VAL;
    const int32_t dim = grid->dim;
    for (int32_t k = 0; k < dim; ++k) {
        const double reach = 0.1 * grid->spacing;
        box[k] = fmin(from[k], to[k]) - reach;
        box[dim + k] = fmax(from[k], to[k]) + reach;
    }
    uint32_t other;
    iccp_facet_query_start(&query, &domain->tree, box);
    while (iccp_facet_query_next(&query, &other)) {
        double other_s, other_bary[ICC_MAX_DIM];
        const double distance2 = meet_plane(walk, other, guess, &other_s, other_bary);
        if (distance2 <= same2 && fabs(other_s - guess) < best) {
            best = fabs(other_s - guess);
            *s = other_s;
            *facet = other;
            memcpy(bary, other_bary, (size_t)dim * sizeof *bary);
        }
    }
    if (best < HUGE_VAL)
        return true;
    (void)meet_plane(walk, *facet, guess, s, bary);
    return true;
}

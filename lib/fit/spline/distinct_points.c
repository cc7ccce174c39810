/* Merges control points that coincide, and fits an affine map to them. */
#include "fit/spline/distinct_points.h"

#include "base/error.h"
#include "base/sort.h"
#include "math/vec.h"

#include <string.h>

/* Points count as on one line if they are that much less wide than long. */
static const double LINE = 1e-6;

/* An affine map counts as singular below this share of its determinant if it were a similarity. */
static const double FLAT = 1e-9;

/* A similarity fits about as well as an affine map if its residual is less than so many times as
 * large. */
static const double MUCH_WORSE = 2;

/* Rounds of a least squares fit: each repeats it for what is left, so rounding errors of the first
 * hardly matter. */
enum { ROUNDS = 3 };

/* ---- merging ---- */

static bool is_before(const void *context, uint32_t a, uint32_t b)
{
    const double *p = (const double *)context + 2 * (size_t)a;
    const double *q = (const double *)context + 2 * (size_t)b;
    return p[0] < q[0] || (p[0] <= q[0] && p[1] < q[1]);
}

static bool are_equal(const double *points, uint32_t a, uint32_t b)
{
    return !is_before(points, a, b) && !is_before(points, b, a);
}

/* Writes, for each point, the first point at the same place. `order` sorts the points. */
static void find_first(const double *points, size_t n, const uint32_t *order, uint32_t *first)
{
    for (size_t k = 0; k < n; ++k)
        first[order[k]] =
            k > 0 && are_equal(points, order[k - 1], order[k]) ? first[order[k - 1]] : order[k];
}

/* Numbers the different points in the order given. */
static void number_points(iccp_distinct_points *c, size_t n, const double *points,
                          const uint32_t *first)
{
    for (uint32_t i = 0; i < n; ++i) {
        if (first[i] == i) {
            memcpy(c->points + 2 * c->n, points + 2 * (size_t)i, 2 * sizeof *points);
            c->number[i] = (uint32_t)c->n++;
        } else {
            c->number[i] = c->number[first[i]];
        }
    }
}

/* Sorts `points` into `order`. `work` has room for n. */
static void sort_points(uint32_t *order, uint32_t *work, size_t n, const double *points)
{
    for (uint32_t i = 0; i < n; ++i)
        order[i] = i;
    iccp_sort_indices(order, work, n, points, is_before);
}

static icc_status allocate(iccp_distinct_points *c, size_t n)
{
    c->number = iccp_alloc(&c->memory, n, sizeof *c->number);
    c->points = iccp_alloc(&c->memory, n, 2 * sizeof *c->points);
    c->targets = iccp_alloc(&c->memory, n, 2 * sizeof *c->targets);
    c->tolerances = iccp_alloc(&c->memory, n, sizeof *c->tolerances);
    return c->number != NULL && c->points != NULL && c->targets != NULL && c->tolerances != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

/* Returns the first of the given points with a number. */
static size_t first_given(const iccp_distinct_points *c, uint32_t number)
{
    size_t i = 0;
    while (c->number[i] != number)
        ++i;
    return i;
}

/* Merges another target, with its tolerance, into that of a point. The more accurate of the two
 * weighs more. */
static bool merge(iccp_distinct_points *c, uint32_t k, const double *target, double tolerance)
{
    double *own = c->targets + 2 * (size_t)k, *other = &c->tolerances[k];
    const bool is_same = !(iccp_vec_distance2(2, own, target) > 0);
    if (*other > 0 && tolerance > 0) {
        const double a = 1 / (*other * *other), b = 1 / (tolerance * tolerance);
        for (int d = 0; d < 2; ++d)
            own[d] = is_same ? own[d] : (a * own[d] + b * target[d]) / (a + b);
        *other = 1 / sqrt(a + b);
        return true;
    }
    *other = 0;
    return is_same;
}

/* Fails if two exact points have the same target. */
static icc_status check_targets(const iccp_distinct_points *c, const iccp_env *env, icc_error *err)
{
    uint32_t *order = iccp_alloc(&env->memory, c->n, 2 * sizeof *order);
    icc_status status = order != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        sort_points(order, order + c->n, c->n, c->targets);
    for (size_t k = 1; status == ICC_OK && k < c->n; ++k) {
        const uint32_t a = order[k - 1], b = order[k];
        if (are_equal(c->targets, a, b) && !(c->tolerances[a] > 0) && !(c->tolerances[b] > 0))
            status = iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)first_given(c, b),
                                  "points %zu and %zu differ and have the same target",
                                  first_given(c, a), first_given(c, b));
    }
    iccp_free(&env->memory, order);
    return status;
}

/* Merges the targets of points that coincide. */
static icc_status merge_targets(iccp_distinct_points *c, size_t n, const double *targets,
                                const double *tolerances, const iccp_env *env, icc_error *err)
{
    uint32_t next = 0;
    for (size_t i = 0; i < n; ++i) {
        const uint32_t k = c->number[i];
        const double tolerance = tolerances != NULL ? tolerances[i] : 0;
        if (k == next) {
            memcpy(c->targets + 2 * (size_t)k, targets + 2 * i, 2 * sizeof *targets);
            c->tolerances[k] = tolerance;
            ++next;
        } else if (!merge(c, k, targets + 2 * i, tolerance)) {
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                                "points %zu and %zu coincide and have different targets",
                                first_given(c, k), i);
        }
    }
    return check_targets(c, env, err);
}

icc_status iccp_distinct_points_create(iccp_distinct_points *control, size_t n,
                                       const double *points, const double *targets,
                                       const double *tolerances, const iccp_env *env,
                                       icc_error *err)
{
    *control = (iccp_distinct_points){.memory = env->memory};
    uint32_t *order = iccp_alloc(&env->memory, n, 2 * sizeof *order);
    icc_status status = allocate(control, n);
    if (order == NULL)
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        sort_points(order, order + n, n, points);
        find_first(points, n, order, order + n);
        number_points(control, n, points, order + n);
        status = merge_targets(control, n, targets, tolerances, env, err);
    }
    iccp_free(&env->memory, order);
    if (status != ICC_OK)
        iccp_distinct_points_free(control);
    return status;
}

void iccp_distinct_points_free(iccp_distinct_points *control)
{
    iccp_free(&control->memory, control->number);
    iccp_free(&control->memory, control->points);
    iccp_free(&control->memory, control->targets);
    iccp_free(&control->memory, control->tolerances);
    *control = (iccp_distinct_points){.memory = control->memory};
}

/* ---- the affine map ---- */

void iccp_trend_apply(const iccp_trend *trend, const double p[2], double image[2])
{
    const double x = p[0] - trend->from[0], y = p[1] - trend->from[1];
    image[0] = trend->to[0] + (trend->matrix[0] * x + trend->matrix[1] * y);
    image[1] = trend->to[1] + (trend->matrix[2] * x + trend->matrix[3] * y);
}

static void find_mean(size_t n, const double *points, double mean[2])
{
    mean[0] = mean[1] = 0;
    for (size_t i = 0; i < n; ++i)
        for (int k = 0; k < 2; ++k)
            mean[k] += points[2 * i + (size_t)k] / (double)n;
}

/* Sums of products of coordinates: of points (xx, xy, yy), and of points with what the map leaves
 * of the targets (as in its matrix). */
typedef struct sums {
    double own[3], mixed[4], rest[2];
} sums;

static sums add_up(const iccp_trend *t, size_t n, const double *points, const double *targets)
{
    sums s = {{0}, {0}, {0}};
    for (size_t i = 0; i < n; ++i) {
        const double *p = points + 2 * i;
        const double x = p[0] - t->from[0], y = p[1] - t->from[1];
        double image[2];
        iccp_trend_apply(t, p, image);
        s.own[0] += x * x;
        s.own[1] += x * y;
        s.own[2] += y * y;
        for (size_t k = 0; k < 2; ++k) {
            const double rest = targets[2 * i + k] - image[k];
            s.mixed[2 * k] += rest * x;
            s.mixed[2 * k + 1] += rest * y;
            s.rest[k] += rest / (double)n;
        }
    }
    return s;
}

/* Adds the affine map that fits the rest best. */
static void improve_affine(iccp_trend *t, const sums *s)
{
    const double det = s->own[0] * s->own[2] - s->own[1] * s->own[1];
    for (int k = 0; k < 2; ++k) {
        const double *m = s->mixed + 2 * (size_t)k;
        t->matrix[2 * k] += (m[0] * s->own[2] - m[1] * s->own[1]) / det;
        t->matrix[2 * k + 1] += (m[1] * s->own[0] - m[0] * s->own[1]) / det;
        t->to[k] += s->rest[k];
    }
}

/* Adds the similarity that fits the rest best. */
static void improve_similarity(iccp_trend *t, const sums *s)
{
    const double all = s->own[0] + s->own[2];
    const double a = (s->mixed[0] + s->mixed[3]) / all, b = (s->mixed[2] - s->mixed[1]) / all;
    t->matrix[0] += a;
    t->matrix[1] -= b;
    t->matrix[2] += b;
    t->matrix[3] += a;
    for (int k = 0; k < 2; ++k)
        t->to[k] += s->rest[k];
}

/* Compares the two principal variances of the points. */
static bool is_line(size_t n, const sums *s)
{
    const double trace = s->own[0] + s->own[2];
    const double det = s->own[0] * s->own[2] - s->own[1] * s->own[1];
    return n < 3 || !(det > LINE * LINE * trace * trace);
}

/* The determinant, relative to that of a similarity of the same size. */
static double relative_det(const iccp_trend *t)
{
    const double *m = t->matrix;
    return (m[0] * m[3] - m[1] * m[2]) / (0.5 * iccp_vec_dot(4, m, m));
}

static icc_status check(const iccp_trend *t, icc_error *err)
{
    const double det = relative_det(t);
    if (det < -FLAT)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "the targets mirror the points: change the sign of one coordinate");
    if (!(det > FLAT))
        return iccp_fail(err, ICC_ERR_ARGUMENT, "the targets lie on a line, or in one place");
    return ICC_OK;
}

static double find_residual(const iccp_trend *t, size_t n, const double *points,
                            const double *targets)
{
    double sum = 0;
    for (size_t i = 0; i < n; ++i) {
        double image[2];
        iccp_trend_apply(t, points + 2 * i, image);
        sum += iccp_vec_distance2(2, image, targets + 2 * i);
    }
    return sqrt(sum / (double)n);
}

/* Fits an affine map, or a similarity. */
static iccp_trend fit(size_t n, const double *points, const double *targets, bool is_similarity)
{
    iccp_trend t = {.matrix = {0}, .is_line = is_similarity};
    find_mean(n, points, t.from);
    find_mean(n, targets, t.to);
    if (n == 1)
        t.matrix[0] = t.matrix[3] = 1;
    for (int round = 0; n > 1 && round < ROUNDS; ++round) {
        const sums s = add_up(&t, n, points, targets);
        t.is_line = is_similarity || is_line(n, &s);
        if (t.is_line)
            improve_similarity(&t, &s);
        else
            improve_affine(&t, &s);
    }
    t.is_line |= n == 1;
    t.residual = find_residual(&t, n, points, targets);
    return t;
}

/* The points of a narrow strip hardly tell the affine map across it, so even its sign may be
 * wrong. Then a similarity fits about as well. */
icc_status iccp_trend_fit(iccp_trend *trend, size_t n, const double *points, const double *targets,
                          icc_error *err)
{
    *trend = fit(n, points, targets, false);
    if (!(relative_det(trend) > FLAT) && !trend->is_line) {
        iccp_trend similarity = fit(n, points, targets, true);
        similarity.is_line = false;
        if (similarity.residual < MUCH_WORSE * trend->residual)
            *trend = similarity;
    }
    return check(trend, err);
}

/* What charts lose at single points: the flags of icc_chart_encode_flags() and
 * icc_chart_decode_flags(). The way back decides what is lost, and the stages' curves why. */
#include "../domains.h"
#include "../random.h"
#include "../shape_domains.h"
#include "../share.h"
#include "../suite.h"

#include <icc/stages.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 4, N_POINTS = 600, N_FUNCTIONS = 6 };

/* What counts as coming back, relative to the longest side. */
static const double AWAY = 1e-6;

/* ---- shapes ---- */

static icc_domain *domain_of_mask(int32_t dim, const size_t *extent, const uint8_t *cells)
{
    icc_domain *domain = NULL;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_domain_create_mask(&domain, dim, extent, cells, NULL, &err) == ICC_OK, "%s",
                  err.message);
    return domain;
}

/* Two slabs of a box at right angles, and a rod. */
static icc_domain *slabs(void)
{
    static const size_t SHAPE[3] = {4, 3, 3};
    uint8_t cells[36] = {0};
    for (size_t i = 0; i < 36; ++i)
        cells[i] = i % 4 == 0 || i / 12 == 0 || (i % 4 == 3 && i / 4 % 3 == 1 && i / 12 < 2);
    return domain_of_mask(3, SHAPE, cells);
}

/* The same in four dimensions, without a rod. */
static icc_domain *slabs4(void)
{
    static const size_t SHAPE[4] = {2, 2, 2, 3};
    uint8_t cells[24] = {0};
    for (size_t i = 0; i < 24; ++i)
        cells[i] = i / 8 == 0 || i % 4 == 0;
    return domain_of_mask(4, SHAPE, cells);
}

/* Teeth that are thinner than the cells, with gaps that are even thinner. */
static icc_domain *comb(void)
{
    double xy[2 * 44] = {0, 0, 10, 0, 10, 4};
    size_t n = 3;
    for (int k = 9; k >= 1; --k) {
        const double tooth[8] = {k + 0.55, 4, k + 0.53, 0.8, k + 0.45, 0.8, k + 0.4, 4};
        memcpy(xy + 2 * n, tooth, sizeof tooth);
        n += 4;
    }
    xy[2 * n] = 0.3;
    xy[2 * n + 1] = 4;
    return domain_of_polygon(n + 1, xy);
}

static icc_domain *tetrahedron(void)
{
    static const double CORNERS[12] = {0, 0, 0, 1, 0.2, 0, 0.1, 1, 0.1, 0, 0.3, 1};
    static const uint32_t FACES[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
    icc_domain *domain;
    ck_assert_int_eq(icc_domain_create(&domain, 3, 4, CORNERS, 4, FACES, NULL, NULL), ICC_OK);
    return domain;
}

enum { L_SHAPE = 0, COMB = 3, TETRAHEDRON = 4, N_DOMAINS = 7 };

static icc_domain *domain_number(int k)
{
    const shape star = shape_star(5, 0.5, 0.3), l = shape_l(), e = shape_e();
    return k == L_SHAPE       ? domain_of_shape(&l)
           : k == 1           ? domain_of_shape(&e)
           : k == 2           ? domain_of_shape(&star)
           : k == COMB        ? comb()
           : k == TETRAHEDRON ? tetrahedron()
           : k == 5           ? slabs()
                              : slabs4();
}

/* ---- charts and points ---- */

typedef struct subject {
    icc_domain *domain;
    icc_chart *chart;
    icc_domain_info shape;
    size_t dim, n;
    double side;
    double *points, *bary, *t, *back;
    uint32_t *facet;
    icc_status *status;
    int32_t *flags;
} subject;

static void *room(size_t n, size_t size)
{
    void *p = calloc(n, size);
    ck_assert_ptr_nonnull(p);
    return p;
}

static void subject_init(subject *s, icc_domain *domain, const icc_chart_options *options, size_t n)
{
    icc_error err = {.size = sizeof err};
    *s = (subject){.domain = domain, .n = n, .shape = info_of_domain(domain)};
    ck_assert_msg(icc_chart_create(&s->chart, domain, options, NULL, &err) == ICC_OK, "%s",
                  err.message);
    s->dim = (size_t)s->shape.dim;
    for (size_t k = 0; k < s->dim; ++k)
        s->side = fmax(s->side, s->shape.upper[k] - s->shape.lower[k]);
    s->points = room(n * s->dim, sizeof *s->points);
    s->bary = room(n * s->dim, sizeof *s->bary);
    s->back = room(n * s->dim, sizeof *s->back);
    s->t = room(n, sizeof *s->t);
    s->facet = room(n, sizeof *s->facet);
    s->status = room(n, sizeof *s->status);
    s->flags = room(n, sizeof *s->flags);
}

static void subject_clear(subject *s)
{
    icc_chart_free(s->chart);
    icc_domain_free(s->domain);
    free(s->points);
    free(s->bary);
    free(s->back);
    free(s->t);
    free(s->facet);
    free(s->status);
    free(s->flags);
}

/* 24 cells for the tetrahedron, because clamped functions take long in space. */
static icc_chart_options gradient(int number, int32_t function)
{
    return (icc_chart_options){.size = sizeof(icc_chart_options),
                               .method = ICC_METHOD_GRADIENT,
                               .function = function,
                               .cells = number == TETRAHEDRON ? 24 : 0};
}

static void pick_points(subject *s, random_source *r)
{
    for (size_t i = 0; i < s->n; ++i)
        domain_random_point(r, s->domain, s->points + s->dim * i);
}

static void pick_coordinates(subject *s, random_source *r)
{
    for (size_t i = 0; i < s->n; ++i) {
        double sum = 0, *b = s->bary + s->dim * i;
        s->facet[i] = (uint32_t)random_between(r, 0, (double)s->shape.n_facets);
        s->t[i] = random_between(r, 0, 1);
        for (size_t k = 0; k < s->dim; ++k)
            sum += b[k] = random_between(r, 0.01, 1);
        for (size_t k = 0; k < s->dim; ++k)
            b[k] /= sum;
    }
}

/* The largest difference of coordinates; that from NaN is infinite. */
static double distance(const subject *s, const double *a, const double *b)
{
    double most = 0;
    for (size_t k = 0; k < s->dim; ++k)
        most = isnan(b[k]) ? HUGE_VAL : fmax(most, fabs(a[k] - b[k]));
    return most;
}

/* The share of the points where a count is. */
static double share(const subject *s, size_t count)
{
    return (double)count / (double)s->n;
}

static void check_share(const subject *s, const char *what, int number, int32_t function,
                        size_t count, double most)
{
    if (share(s, count) > most)
        ck_abort_msg("shape %d, function %d: %s at %.2f %% of the points", number, function, what,
                     100 * share(s, count));
}

/* How the curves of the points run, by the stages. */
typedef struct ends {
    double *length, *alone;
} ends;

static ends trace(const subject *s, const double *points, int32_t way)
{
    icc_curves *curves;
    const ends e = {room(s->n, sizeof(double)), room(s->n, sizeof(double))};
    ck_assert_int_eq(
        icc_curves_create(&curves, icc_chart_function(s->chart), s->n, points, way, NULL, NULL),
        ICC_OK);
    ck_assert_int_eq(icc_curves_get_ends(curves, NULL, e.length, e.alone, NULL, NULL), ICC_OK);
    icc_curves_free(curves);
    return e;
}

static void ends_free(ends *e)
{
    free(e->length);
    free(e->alone);
}

/* ---- points ---- */

/* Encodes with flags, which must not change anything else, and decodes. */
static void encode(subject *s)
{
    uint32_t *facet = room(s->n, sizeof *facet);
    double *t = room(s->n, sizeof *t);
    size_t n_failed[2];
    ck_assert_int_eq(
        icc_chart_encode(s->chart, s->n, s->points, facet, s->bary, t, NULL, &n_failed[0], NULL),
        ICC_OK);
    ck_assert_int_eq(icc_chart_encode_flags(s->chart, s->n, s->points, s->facet, s->bary, s->t,
                                            s->status, s->flags, &n_failed[1], NULL),
                     ICC_OK);
    ck_assert_mem_eq(facet, s->facet, s->n * sizeof *facet);
    ck_assert_mem_eq(t, s->t, s->n * sizeof *t);
    ck_assert_uint_eq(n_failed[0], n_failed[1]);
    for (size_t i = 0; i < s->n; ++i)
        if (s->status[i] != ICC_OK)
            ck_assert_int_eq(s->flags[i], 0);
    ck_assert_int_eq(
        icc_chart_decode(s->chart, s->n, s->facet, s->bary, s->t, s->back, NULL, NULL, NULL),
        ICC_OK);
    free(facet);
    free(t);
}

static void check_points(int number, int32_t function, random_source *r)
{
    const icc_chart_options options = gradient(number, function);
    subject s;
    subject_init(&s, domain_number(number), &options, (size_t)share_of(N_POINTS * 4));
    pick_points(&s, r);
    encode(&s);
    ends down = trace(&s, s.points, ICC_WAY_DOWN);
    size_t n_vain = 0, n_close = 0;
    for (size_t i = 0; i < s.n; ++i) {
        if (s.status[i] != ICC_OK)
            continue;
        const double off = distance(&s, s.points + s.dim * i, s.back + s.dim * i);
        const int merges = down.alone[i] < down.length[i];
        if (!(off <= AWAY * s.side) && s.flags[i] == 0)
            ck_abort_msg("shape %d, function %d: a point comes back %g away, without a flag",
                         number, function, off);
        if (s.flags[i] != 0)
            ck_assert_int_eq(s.flags[i], ICC_LOSS_AWAY | (merges ? ICC_LOSS_UNCOVERED : 0));
        n_vain += (s.flags[i] != 0 && off <= AWAY * s.side) || (s.flags[i] == 0 && merges);
        n_close += s.flags[i] == ICC_LOSS_AWAY;
    }
    check_share(&s, "flags in vain", number, function, n_vain, 0.01);
    /* Clamped functions fall by many orders of magnitude, and their curves come very close. */
    check_share(&s, "a loss by rounding", number, function, n_close,
                function == ICC_FUNCTION_CLAMPED ? 0.1 : 0.01);
    ends_free(&down);
    subject_clear(&s);
}

START_TEST(a_point_that_does_not_come_back_is_flagged)
{
    random_source r = {1};
    for (int number = 0; number < N_DOMAINS; ++number)
        for (int32_t function = 1; function <= N_FUNCTIONS; ++function)
            check_points(number, function, &r);
}
END_TEST

START_TEST(the_report_estimates_the_flagged_share)
{
    random_source r = {2};
    for (int number = 0; number < N_DOMAINS; ++number) {
        const icc_chart_options options = gradient(number, ICC_FUNCTION_LAPLACE);
        icc_chart_report report = {.size = sizeof report};
        subject s;
        subject_init(&s, domain_number(number), &options, N_POINTS);
        pick_points(&s, &r);
        encode(&s);
        size_t n = 0;
        for (size_t i = 0; i < s.n; ++i)
            n += (s.flags[i] & ICC_LOSS_UNCOVERED) != 0;
        ck_assert_int_eq(icc_chart_get_report(s.chart, 0, &report, NULL, NULL), ICC_OK);
        const double deviation = sqrt(report.uncovered * (1 - report.uncovered) / (double)s.n);
        if (fabs(share(&s, n) - report.uncovered) > 4 * deviation)
            ck_abort_msg("shape %d: %.2f %% uncovered, and %.2f %% by the report", number,
                         100 * share(&s, n), 100 * report.uncovered);
        ck_assert(report.uncovered > 0);
        subject_clear(&s);
    }
}
END_TEST

/* ---- coordinates ---- */

/* Returns true if the curve from a boundary point passes another one. */
static int passes(const subject *s, const double *from, const double *place)
{
    size_t n = 0;
    ck_assert_int_eq(icc_chart_trace(s->chart, from, 0, NULL, &n, NULL, NULL), ICC_OK);
    double *curve = room(n * s->dim, sizeof *curve), nearest = HUGE_VAL;
    ck_assert_int_eq(icc_chart_trace(s->chart, from, n, curve, &n, NULL, NULL), ICC_OK);
    for (size_t i = 0; i + 1 < n; ++i) {
        const double *a = curve + s->dim * i, *b = a + s->dim;
        double along = 0, square = 0, on[MOST];
        for (size_t k = 0; k < s->dim; ++k) {
            along += (b[k] - a[k]) * (place[k] - a[k]);
            square += (b[k] - a[k]) * (b[k] - a[k]);
        }
        const double share = square > 0 ? fmin(1, fmax(0, along / square)) : 0;
        for (size_t k = 0; k < s->dim; ++k)
            on[k] = a[k] + share * (b[k] - a[k]);
        nearest = fmin(nearest, distance(s, on, place));
    }
    free(curve);
    return nearest <= AWAY * s->side;
}

/* The boundary points of coordinates. */
static double *feet(const subject *s, const uint32_t *facet, const double *bary)
{
    double *points = room(s->n * s->dim, sizeof *points), *zero = room(s->n, sizeof *zero);
    ck_assert_int_eq(icc_chart_decode(s->chart, s->n, facet, bary, zero, points, NULL, NULL, NULL),
                     ICC_OK);
    free(zero);
    return points;
}

static void check_coordinates(int number, int32_t function, random_source *r, size_t count[4])
{
    const icc_chart_options options = gradient(number, function);
    subject s;
    subject_init(&s, domain_number(number), &options, (size_t)share_of(N_POINTS));
    pick_coordinates(&s, r);
    ck_assert_int_eq(icc_chart_decode_flags(s.chart, s.n, s.facet, s.bary, s.t, s.points, s.status,
                                            s.flags, NULL, NULL),
                     ICC_OK);
    double *again = room(s.n * s.dim, sizeof *again), *t = room(s.n, sizeof *t);
    uint32_t *facet = room(s.n, sizeof *facet);
    icc_status *status = room(s.n, sizeof *status);
    ck_assert_int_eq(icc_chart_encode(s.chart, s.n, s.points, facet, again, t, status, NULL, NULL),
                     ICC_OK);
    for (size_t i = 0; i < s.n; ++i)
        if (status[i] != ICC_OK) {
            facet[i] = s.facet[i];
            memcpy(again + s.dim * i, s.bary + s.dim * i, s.dim * sizeof *again);
        }
    double *from = feet(&s, s.facet, s.bary), *to = feet(&s, facet, again);
    ends up = trace(&s, from, ICC_WAY_UP);
    for (size_t i = 0; i < s.n; ++i) {
        const double *a = from + s.dim * i, *b = to + s.dim * i;
        const double off = distance(&s, a, b);
        if (s.status[i] != ICC_OK) {
            ck_assert_int_eq(s.flags[i], 0);
            continue;
        }
        if ((status[i] != ICC_OK || off > AWAY * s.side || fabs(t[i] - s.t[i]) > AWAY) &&
            s.flags[i] == 0)
            ck_abort_msg("shape %d, function %d: coordinates do not come back, without a flag",
                         number, function);
        ++count[0];
        if (s.flags[i] == 0)
            continue;
        ck_assert(s.flags[i] & ICC_LOSS_AWAY);
        ck_assert_int_eq(s.flags[i] & ICC_LOSS_UNCOVERED, 0);
        /* Close to where the curves merge, rounding decides. */
        const double part = s.t[i] * up.length[i] - up.alone[i];
        if (fabs(part) > 1e-9 * s.side)
            ck_assert_int_eq((s.flags[i] & ICC_LOSS_COLLAPSED) != 0, part > 0);
        if (s.flags[i] & ICC_LOSS_GAP)
            ck_assert(off > 0.5 * AWAY * s.side && passes(&s, a, b));
        count[1] += (s.flags[i] & ICC_LOSS_COLLAPSED) != 0;
        count[2] += (s.flags[i] & ICC_LOSS_GAP) != 0;
        count[3] += s.flags[i] == ICC_LOSS_AWAY;
    }
    ends_free(&up);
    free(again);
    free(t);
    free(facet);
    free(status);
    free(from);
    free(to);
    subject_clear(&s);
}

START_TEST(coordinates_that_do_not_come_back_are_flagged)
{
    random_source r = {3};
    for (int number = 0; number < N_DOMAINS; ++number) {
        size_t count[4] = {0};
        for (int32_t function = 1; function <= N_FUNCTIONS; ++function)
            check_coordinates(number, function, &r, count);
        ck_assert(count[1] > 0); /* curves always merge */
        ck_assert(number != COMB || count[2] > 0);
        if (count[3] > count[0] / 50)
            ck_abort_msg("shape %d: %zu of %zu losses without a reason", number, count[3],
                         count[0]);
    }
}
END_TEST

/* ---- other charts and points ---- */

START_TEST(certified_charts_lose_no_point)
{
    static const int32_t METHODS[] = {ICC_METHOD_FOLIATION, ICC_METHOD_FIELD, ICC_METHOD_DISC};
    random_source r = {4};
    for (int m = 0; m < 3; ++m) {
        const icc_chart_options options = {.size = sizeof options, .method = METHODS[m]};
        icc_chart_info info = {.size = sizeof info};
        subject s;
        subject_init(&s, domain_number(L_SHAPE), &options, N_POINTS);
        ck_assert_int_eq(icc_chart_get_info(s.chart, &info), ICC_OK);
        ck_assert_int_eq(info.certified, 1);
        pick_points(&s, &r);
        encode(&s);
        for (size_t i = 0; i < s.n; ++i)
            ck_assert(s.status[i] == ICC_OK && s.flags[i] == 0);
        subject_clear(&s);
    }
}
END_TEST

/* Nine cells are too few for the comb, so curves leave it and enter it again. */
START_TEST(a_field_without_a_certificate_tells_what_it_loses)
{
    const icc_chart_options options = {
        .size = sizeof options, .method = ICC_METHOD_FIELD, .cells = 9};
    icc_chart_info info = {.size = sizeof info};
    random_source r = {5};
    subject s;
    subject_init(&s, domain_number(COMB), &options, N_POINTS);
    ck_assert_int_eq(icc_chart_get_info(s.chart, &info), ICC_OK);
    ck_assert_int_eq(info.certified, 0);
    pick_coordinates(&s, &r);
    ck_assert_int_eq(icc_chart_decode_flags(s.chart, s.n, s.facet, s.bary, s.t, s.points, s.status,
                                            s.flags, NULL, NULL),
                     ICC_OK);
    size_t n = 0;
    for (size_t i = 0; i < s.n; ++i) {
        ck_assert(s.flags[i] == 0 || s.flags[i] == ICC_LOSS_AWAY);
        n += s.flags[i] != 0;
    }
    ck_assert(share(&s, n) > 0.2);
    pick_points(&s, &r);
    encode(&s);
    for (size_t i = 0; i < s.n; ++i)
        if (s.status[i] == ICC_OK &&
            !(distance(&s, s.points + s.dim * i, s.back + s.dim * i) <= AWAY * s.side))
            ck_assert_int_eq(s.flags[i], ICC_LOSS_AWAY);
    subject_clear(&s);
}
END_TEST

/* All boundary points lead to the maximum, and a vertex is on two facets. Both come back. */
START_TEST(ends_of_curves_and_failed_points_have_no_flags)
{
    const icc_chart_options options = gradient(L_SHAPE, ICC_FUNCTION_LAPLACE);
    const shape l = shape_l();
    icc_chart_info info = {.size = sizeof info};
    subject s;
    subject_init(&s, domain_number(L_SHAPE), &options, 4);
    ck_assert_int_eq(icc_chart_get_info(s.chart, &info), ICC_OK);
    memcpy(s.points, info.maximum, 2 * sizeof *s.points);
    memcpy(s.points + 2, l.xy, 2 * sizeof *s.points);
    s.points[4] = s.shape.upper[0] + 1;
    s.points[6] = NAN;
    memset(s.flags, -1, 4 * sizeof *s.flags);
    encode(&s);
    ck_assert_int_eq(s.status[2], ICC_ERR_OUTSIDE);
    ck_assert_int_eq(s.status[3], ICC_ERR_ARGUMENT);
    for (int i = 0; i < 4; ++i)
        ck_assert_int_eq(s.flags[i], 0);
    /* Coordinates of the maximum, of a vertex on both facets, and none. */
    for (int i = 0; i < 4; ++i) {
        s.facet[i] = i == 2 ? (uint32_t)s.shape.n_facets - 1 : 0;
        s.bary[2 * i] = i == 1 ? 1 : i == 2 ? 0 : 0.3;
        s.bary[2 * i + 1] = 1 - s.bary[2 * i];
        s.t[i] = i == 0 ? 1 : i == 3 ? 2 : 0;
    }
    memset(s.flags, -1, 4 * sizeof *s.flags);
    ck_assert_int_eq(icc_chart_decode_flags(s.chart, 4, s.facet, s.bary, s.t, s.back, s.status,
                                            s.flags, NULL, NULL),
                     ICC_OK);
    ck_assert_int_eq(s.status[3], ICC_ERR_ARGUMENT);
    ck_assert_mem_eq(s.back + 2, s.back + 4, 2 * sizeof *s.back);
    for (int i = 0; i < 4; ++i)
        ck_assert_int_eq(s.flags[i], 0);
    subject_clear(&s);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("losses");
    TCase *tests = tcase_create("losses");
    tcase_set_timeout(tests, 0);
    tcase_add_test(tests, a_point_that_does_not_come_back_is_flagged);
    tcase_add_test(tests, the_report_estimates_the_flagged_share);
    tcase_add_test(tests, coordinates_that_do_not_come_back_are_flagged);
    tcase_add_test(tests, certified_charts_lose_no_point);
    tcase_add_test(tests, a_field_without_a_certificate_tells_what_it_loses);
    tcase_add_test(tests, ends_of_curves_and_failed_points_have_no_flags);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

/* What holds for the map of gradient curves between every two shapes. */
#include "gradient/coordinates/gradient_state.h"
#include "map/map.h"

#include "../random.h"
#include "../reports.h"
#include "../shape_domains.h"
#include "../shapes.h"
#include "../share.h"
#include "../suite.h"

#include <check.h>
#include <stdlib.h>

/* A map whose domains are kept alive by the charts alone. */
static icc_map *map_of(const shape *source, const shape *target, int32_t cells, int32_t function)
{
    const icc_chart_options chart = {
        .size = sizeof chart, .method = ICC_METHOD_GRADIENT, .cells = cells, .function = function};
    const icc_map_options options = {.size = sizeof options, .chart = &chart};
    icc_domain *a = domain_of_shape(source), *b = domain_of_shape(target);
    icc_map *map;
    ck_assert_int_eq(icc_map_create(&map, a, b, &options, NULL, NULL), ICC_OK);
    icc_domain_free(a);
    icc_domain_free(b);
    return map;
}

enum { N_PAIRS = N_SHAPE_PAIRS + 3 };

/* Pairs with the same number of vertices. */
static void pair_number(int k, shape *source, shape *target)
{
    random_source r = {50 + (uint64_t)k};
    switch (k) {
    case 5:
        *source = shape_dart();
        *target = shape_of(4, (double[]){1e9, 3, 1e9 + 40, 3, 1e9 + 40, 35, 1e9 + 8, 43});
        break;
    case 6:
        *source = shape_star(4, 0.8, 0.1);
        *target = shape_moved(source, 0x1p-900, 0, 0);
        target->xy[0] *= 1.1;
        break;
    case 7:
        *source = shape_star(6, 0.5, 0.4);
        *target = shape_star(6, 0.3, 0.4);
        for (size_t i = 0; i < 2 * target->n; ++i)
            target->xy[i] += 0.05 * random_unit(&r);
        break;
    default:
        shape_pair(k, source, target);
    }
}

static double width(const icc_chart *chart)
{
    icc_domain_info d = {.size = sizeof d};
    ck_assert_int_eq(icc_domain_get_info(icc_chart_domain(chart), &d), ICC_OK);
    return fmax(d.upper[0] - d.lower[0], d.upper[1] - d.lower[1]);
}

static double distance(const double a[2], const double b[2])
{
    return hypot(a[0] - b[0], a[1] - b[1]);
}

static void pick_inside(const icc_chart *chart, random_source *r, double p[2])
{
    icc_domain_info d = {.size = sizeof d};
    (void)icc_domain_get_info(icc_chart_domain(chart), &d);
    int32_t where = ICC_OUTSIDE;
    while (where != ICC_INSIDE) {
        for (int k = 0; k < 2; ++k)
            p[k] = random_between(r, d.lower[k], d.upper[k]);
        ck_assert_int_eq(icc_domain_locate(icc_chart_domain(chart), 1, p, &where, NULL, NULL, NULL),
                         ICC_OK);
    }
}

/* Whether the line from a point down to the boundary meets no other, and is there at all. */
static bool alone_below(const icc_chart *chart, const double p[2])
{
    const iccp_gradient_state *state = chart->state;
    double local[2], q[2];
    iccp_frame_in(&chart->domain->frame, 2, p, local);
    iccp_gradient_to_lattice(state, local, q);
    iccp_walk2 walk;
    iccp_boundary_hit2 hit;
    return iccp_walk2_start(&walk, state->field, ICCP_DOWNHILL, q[0], q[1], NULL) == ICC_OK &&
           iccp_trace_downhill(&walk, &state->cells2, NULL, &hit) == ICC_OK && !walk.merged;
}

START_TEST(a_shape_maps_to_itself)
{
    random_source r = {1};
    for (int k = 0; k < 2 * N_SHAPES; ++k) {
        const shape s = shape_number(k / 2);
        icc_map *map = map_of(&s, &s, k % 2 ? 50 : 21, k % 2 ? ICC_FUNCTION_DISTANCE : 0);
        const icc_chart *chart = icc_map_source_chart(map);
        int n_alone = 0;
        for (int i = 0; i < 200; ++i) {
            double p[2], q[2];
            icc_status status;
            pick_inside(chart, &r, p);
            ck_assert_int_eq(icc_map_apply(map, 1, p, q, &status, NULL, NULL), ICC_OK);
            if (status != ICC_OK || !alone_below(chart, p))
                continue;
            ++n_alone;
            if (distance(p, q) > 1e-12 * width(chart))
                ck_abort_msg("moved by %g", distance(p, q));
        }
        ck_assert_int_gt(n_alone, 150);
        icc_map_free(map);
    }
}
END_TEST

/* Facet k of the source goes to facet k of the target, at the same shares; both ways. */
static void check_boundary(const icc_map *map, const shape *source, const shape *target,
                           random_source *r)
{
    const double w[2] = {width(icc_map_source_chart(map)), width(icc_map_target_chart(map))};
    for (size_t f = 0; f < source->n; ++f)
        for (int i = 0; i < 5; ++i) {
            const double along = i == 0 ? 0 : random_unit(r);
            double p[2][2], q[2];
            for (int k = 0; k < 2; ++k) {
                const size_t a = 2 * f, b = 2 * ((f + 1) % source->n);
                p[0][k] =
                    source->xy[a + (size_t)k] * (1 - along) + source->xy[b + (size_t)k] * along;
                p[1][k] =
                    target->xy[a + (size_t)k] * (1 - along) + target->xy[b + (size_t)k] * along;
            }
            size_t n_failed[2];
            ck_assert_int_eq(icc_map_apply(map, 1, p[0], q, NULL, &n_failed[0], NULL), ICC_OK);
            ck_assert_double_le(distance(q, p[1]),
                                i == 0 ? 0 : 1e-12 * w[1] + 0x1p-52 * fabs(q[0]));
            ck_assert_int_eq(icc_map_apply_inverse(map, 1, p[1], q, NULL, &n_failed[1], NULL),
                             ICC_OK);
            /* Far from zero the point is rounded off the boundary. */
            if (i > 0 && fabs(p[1][0]) > 1e8 * w[1] / 40)
                n_failed[1] = 0;
            else
                ck_assert_double_le(distance(q, p[0]), i == 0 ? 0 : 1e-12 * w[0]);
            ck_assert_uint_eq(n_failed[0] + n_failed[1], 0);
        }
}

START_TEST(boundaries_correspond)
{
    random_source r = {2};
    for (int k = 0; k < 2 * N_PAIRS; ++k) {
        shape source, target;
        pair_number(k / 2, &source, &target);
        if (k % 2) {
            source = shape_reversed(&source);
            target = shape_reversed(&target);
        }
        icc_map *map = map_of(&source, &target, 25, 0);
        check_boundary(map, &source, &target, &r);
        icc_map_free(map);
    }
}
END_TEST

START_TEST(maxima_correspond)
{
    for (int k = 0; k < N_PAIRS; ++k) {
        shape source, target;
        pair_number(k, &source, &target);
        icc_map *map = map_of(&source, &target, 25, 0);
        icc_chart_info a = {.size = sizeof a}, b = {.size = sizeof b};
        (void)icc_chart_get_info(icc_map_source_chart(map), &a);
        (void)icc_chart_get_info(icc_map_target_chart(map), &b);
        double q[2];
        ck_assert_int_eq(icc_map_apply(map, 1, a.maximum, q, NULL, NULL, NULL), ICC_OK);
        ck_assert_mem_eq(q, b.maximum, sizeof q);
        icc_map_free(map);
    }
}
END_TEST

START_TEST(the_inverse_undoes_the_map)
{
    random_source r = {3};
    int n_alone = 0, n_all = 0;
    for (int k = 0; k < 2 * N_PAIRS; ++k) {
        shape source, target;
        pair_number(k / 2, &source, &target);
        if (k / 2 == 5) /* images far away are rounded */
            target = shape_moved(&target, 1, -1e9, 0);
        if (k % 2) {
            source = shape_reversed(&source);
            target = shape_reversed(&target);
        }
        icc_map *map = map_of(&source, &target, 30, k % 2 ? ICC_FUNCTION_DISTANCE : 0);
        for (int i = 0; i < share_of(300); ++i) {
            double p[2], q[2], back[2];
            icc_status status;
            pick_inside(icc_map_source_chart(map), &r, p);
            memcpy(q, p, sizeof q);
            ck_assert_int_eq(icc_map_apply(map, 1, q, q, &status, NULL, NULL), ICC_OK);
            ++n_all;
            if (status != ICC_OK) {
                if (!isnan(q[0]) || !isnan(q[1]) || status != ICC_ERR_TRACE)
                    ck_abort_msg("a point without image has one");
                continue;
            }
            if (!alone_below(icc_map_source_chart(map), p) ||
                !alone_below(icc_map_target_chart(map), q))
                continue;
            /* Where lines have merged in the target, another one leads back. */
            ck_assert_int_eq(icc_map_apply_inverse(map, 1, q, back, &status, NULL, NULL), ICC_OK);
            uint32_t facet[2];
            double bary[2][2], t[2];
            (void)icc_chart_encode(icc_map_source_chart(map), 1, p, &facet[0], bary[0], &t[0], NULL,
                                   NULL, NULL);
            (void)icc_chart_encode(icc_map_target_chart(map), 1, q, &facet[1], bary[1], &t[1], NULL,
                                   NULL, NULL);
            if (facet[0] != facet[1] || fabs(bary[0][0] - bary[1][0]) > 1e-6)
                continue;
            ++n_alone;
            if (distance(p, back) > 1e-8 * width(icc_map_source_chart(map)))
                ck_abort_msg("comes back %g away", distance(p, back));
        }
        icc_map_free(map);
    }
    /* Elsewhere the method collapses. */
    ck_assert_int_gt(n_alone, n_all / 8);
}
END_TEST

/* Facets in any order, but the same in both. */
START_TEST(facets_may_come_in_any_order)
{
    random_source r = {4};
    for (int k = 0; k < N_PAIRS; ++k) {
        shape s[2];
        pair_number(k, &s[0], &s[1]);
        const size_t n = s[0].n;
        uint32_t facets[2 * SHAPE_MAX];
        for (size_t f = 0; f < n; ++f) {
            facets[2 * f] = (uint32_t)f;
            facets[2 * f + 1] = (uint32_t)((f + 1) % n);
        }
        for (size_t f = n; f-- > 1;) {
            const size_t other = (size_t)random_below(&r, (int)f + 1);
            uint32_t swap[2];
            memcpy(swap, facets + 2 * f, sizeof swap);
            memmove(facets + 2 * f, facets + 2 * other, sizeof swap);
            memcpy(facets + 2 * other, swap, sizeof swap);
        }
        icc_domain *domain[2];
        for (int side = 0; side < 2; ++side)
            ck_assert_int_eq(
                icc_domain_create(&domain[side], 2, n, s[side].xy, n, facets, NULL, NULL), ICC_OK);
        const icc_chart_options chart = {
            .size = sizeof chart, .method = ICC_METHOD_GRADIENT, .cells = 25};
        const icc_map_options options = {.size = sizeof options, .chart = &chart};
        icc_map *map, *plain = map_of(&s[0], &s[1], 25, 0);
        ck_assert_int_eq(icc_map_create(&map, domain[0], domain[1], &options, NULL, NULL), ICC_OK);
        check_boundary(map, &s[0], &s[1], &r);
        for (int i = 0; i < share_of(100); ++i) {
            double p[2], q[2][2];
            uint32_t facet[2];
            double bary[2][2], t[2];
            pick_inside(icc_map_source_chart(map), &r, p);
            ck_assert_int_eq(icc_map_apply(map, 1, p, q[0], NULL, NULL, NULL), ICC_OK);
            ck_assert_int_eq(icc_map_apply(plain, 1, p, q[1], NULL, NULL, NULL), ICC_OK);
            ck_assert_mem_eq(q[0], q[1], sizeof q[0]);
            (void)icc_chart_encode(icc_map_source_chart(map), 1, p, &facet[0], bary[0], &t[0], NULL,
                                   NULL, NULL);
            (void)icc_chart_encode(icc_map_source_chart(plain), 1, p, &facet[1], bary[1], &t[1],
                                   NULL, NULL, NULL);
            if (facet[0] != UINT32_MAX)
                ck_assert_uint_eq(facets[2 * facet[0]], facet[1]);
        }
        icc_map_free(map);
        icc_map_free(plain);
        /* Another order in the target does not correspond. */
        icc_error err = {.size = sizeof err};
        icc_domain *other = domain_of_shape(&s[1]);
        ck_assert_int_eq(icc_map_create(&map, domain[0], other, &options, NULL, &err),
                         ICC_ERR_BOUNDARY);
        ck_assert(map == NULL && err.side == 2 && err.status == ICC_ERR_BOUNDARY && err.index >= 0);
        icc_domain_free(domain[0]);
        icc_domain_free(domain[1]);
        icc_domain_free(other);
    }
}
END_TEST

START_TEST(boundaries_that_do_not_correspond_are_refused)
{
    const shape square = shape_square(), l = shape_l(), clockwise = shape_reversed(&square);
    icc_domain *a = domain_of_shape(&square), *b = domain_of_shape(&l),
               *c = domain_of_shape(&clockwise);
    icc_domain *bad[2] = {b, c};
    for (int k = 0; k < 2; ++k) {
        icc_map *map = (icc_map *)&map;
        icc_error err = {.size = sizeof err};
        ck_assert_int_eq(icc_map_create(&map, a, bad[k], NULL, NULL, &err), ICC_ERR_BOUNDARY);
        ck_assert(map == NULL && err.side == 2 && err.message[0] != '\0');
        icc_chart *charts[2];
        ck_assert_int_eq(icc_chart_create(&charts[0], a, NULL, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_chart_create(&charts[1], bad[k], NULL, NULL, NULL), ICC_OK);
        err.side = 0;
        ck_assert_int_eq(icc_map_create_from_charts(&map, charts[0], charts[1], NULL, NULL, &err),
                         ICC_ERR_BOUNDARY);
        ck_assert(map == NULL && err.side == 2);
        icc_chart_free(charts[0]);
        icc_chart_free(charts[1]);
    }
    icc_domain_free(a);
    icc_domain_free(b);
    icc_domain_free(c);
}
END_TEST

/* The side that cannot have a chart is named. */
START_TEST(errors_name_the_side)
{
    const shape needle = shape_of(3, (double[]){0, 0, 1, 1e-9, 0, 1e-3});
    const shape triangle = shape_of(3, (double[]){0, 0, 1, 0, 0, 1});
    icc_domain *good = domain_of_shape(&triangle), *bad = domain_of_shape(&needle);
    const double outside[2] = {5, 5}, inside[2] = {0.25, 0.25};
    const icc_chart_options chart = {
        .size = sizeof chart, .method = ICC_METHOD_GRADIENT, .cells = 10, .maximum = outside};
    icc_map_options options = {.size = sizeof options, .chart = &chart};
    icc_map *map;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_map_create(&map, good, good, &options, NULL, &err), ICC_ERR_OUTSIDE);
    ck_assert_int_eq(err.side, 1);
    options.chart = NULL;
    options.target_maximum = outside;
    ck_assert_int_eq(icc_map_create(&map, good, good, &options, NULL, &err), ICC_ERR_OUTSIDE);
    ck_assert_int_eq(err.side, 2);
    options.target_maximum = inside;
    ck_assert_int_eq(icc_map_create(&map, good, good, &options, NULL, &err), ICC_OK);
    icc_chart_info info = {.size = sizeof info};
    (void)icc_chart_get_info(icc_map_target_chart(map), &info);
    ck_assert_double_le(distance(info.maximum, inside), info.spacing);
    icc_map_free(map);
    const icc_chart_options coarse = {
        .size = sizeof coarse, .method = ICC_METHOD_GRADIENT, .cells = 2};
    options = (icc_map_options){.size = sizeof options, .chart = &coarse};
    const icc_status status = icc_map_create(&map, good, bad, &options, NULL, &err);
    if (status != ICC_OK)
        ck_assert(status == ICC_ERR_RESOLUTION && err.side == 2);
    icc_map_free(map);
    icc_domain_free(good);
    icc_domain_free(bad);
}
END_TEST

START_TEST(charts_make_the_same_map)
{
    shape source, target;
    pair_number(2, &source, &target);
    icc_map *map = map_of(&source, &target, 40, 0), *again;
    ck_assert_int_eq(icc_map_create_from_charts(&again, icc_map_source_chart(map),
                                                icc_map_target_chart(map), NULL, NULL, NULL),
                     ICC_OK);
    icc_map_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_map_get_info(map, &info), ICC_OK);
    ck_assert(info.dim == 2 && info.kind == ICC_MAP_CURVES && report_of(map).seconds > 0);
    random_source r = {5};
    double p[100][2], q[2][100][2];
    for (int i = 0; i < 100; ++i)
        pick_inside(icc_map_source_chart(map), &r, p[i]);
    ck_assert_int_eq(icc_map_apply(map, 100, p[0], q[0][0], NULL, NULL, NULL), ICC_OK);
    icc_map_free(map);
    ck_assert_int_eq(icc_map_apply(again, 100, p[0], q[1][0], NULL, NULL, NULL), ICC_OK);
    ck_assert_mem_eq(q[0], q[1], sizeof q[0]);
    icc_map_free(again);
}
END_TEST

/* Both one-sided differences, column `axis` of the jacobian, agree: then the map is smooth here. */
static bool difference(const icc_map *map, const double p[2], int axis, double column[2])
{
    const double h = 1e-6 * width(icc_map_source_chart(map));
    const double w = width(icc_map_target_chart(map));
    double points[3][2], images[3][2];
    size_t n_failed;
    for (int k = 0; k < 3; ++k) {
        memcpy(points[k], p, sizeof points[k]);
        points[k][axis] += (k - 1) * h;
    }
    ck_assert_int_eq(icc_map_apply(map, 3, points[0], images[0], NULL, &n_failed, NULL), ICC_OK);
    if (n_failed > 0)
        return false;
    for (int i = 0; i < 2; ++i) {
        const double left = (images[1][i] - images[0][i]) / (points[1][axis] - points[0][axis]);
        const double right = (images[2][i] - images[1][i]) / (points[2][axis] - points[1][axis]);
        if (fabs(left - right) > 1e-4 * w + 1e-4 * fabs(left))
            return false;
        column[i] = (left + right) / 2;
    }
    return true;
}

/* Whether every curve of a chart starts into the domain. */
static bool transversal(const icc_chart *chart)
{
    icc_chart_report m = {.size = sizeof m};
    ck_assert_int_eq(icc_chart_get_report(chart, 1000, &m, NULL, NULL), ICC_OK);
    return m.not_inward <= 0;
}

START_TEST(jacobians_are_derivatives)
{
    random_source r = {6};
    int n_smooth = 0, n_all = 0, n_zero = 0, n_transversal = 0;
    for (int k = 0; k < 2 * N_PAIRS; ++k) {
        shape source, target;
        pair_number(k / 2, &source, &target);
        if (k / 2 == 5)
            target = shape_moved(&target, 1, -1e9, 0);
        icc_map *map = map_of(&source, &target, 20, k % 2 ? ICC_FUNCTION_DISTANCE : 0);
        const double w = width(icc_map_target_chart(map));
        const bool positive =
            transversal(icc_map_source_chart(map)) && transversal(icc_map_target_chart(map));
        n_transversal += positive;
        for (int i = 0; i < share_of(400); ++i) {
            double p[2], j[4], column[2];
            icc_status status, mapped;
            pick_inside(icc_map_source_chart(map), &r, p);
            ck_assert_int_eq(icc_map_jacobian(map, 1, p, j, &status, NULL, NULL), ICC_OK);
            double q[2];
            ck_assert_int_eq(icc_map_apply(map, 1, p, q, &mapped, NULL, NULL), ICC_OK);
            ck_assert_int_eq(status, mapped);
            ck_assert(isnan(j[0]) == (status != ICC_OK));
            if (status != ICC_OK)
                continue;
            ++n_all;
            const double a = j[0] / w, b = j[1] / w, c = j[2] / w, d = j[3] / w;
            const double det = a * d - b * c, size = a * a + b * b + c * c + d * d;
            if (fabs(det) <= 1e-9 * (1 + size))
                ++n_zero;
            else
                ck_assert(det > 0 || !positive);
            for (int axis = 0; axis < 2; ++axis) {
                if (!difference(map, p, axis, column))
                    continue;
                ++n_smooth;
                for (int m = 0; m < 2; ++m)
                    if (fabs(column[m] - j[2 * m + axis]) > 1e-3 * (w + fabs(column[m])))
                        ck_abort_msg("pair %d: %g instead of %g at (%.17g, %.17g)", k,
                                     j[2 * m + axis] / w, column[m] / w, p[0], p[1]);
            }
        }
        icc_map_free(map);
    }
    ck_assert_int_gt(n_smooth, n_all);
    ck_assert_int_lt(n_zero, n_all / 2);
    ck_assert_int_gt(n_transversal, 0);
}
END_TEST

START_TEST(boundary_and_maximum_have_no_derivative)
{
    const shape square = shape_square();
    icc_map *map = map_of(&square, &square, 10, 0);
    icc_chart_info info = {.size = sizeof info};
    (void)icc_chart_get_info(icc_map_source_chart(map), &info);
    const double points[5][2] = {
        {0.5, 0}, {0, 0}, {info.maximum[0], info.maximum[1]}, {2, 2}, {NAN, 0}};
    double j[5][4];
    icc_status status[5];
    size_t n_failed;
    ck_assert_int_eq(icc_map_jacobian(map, 5, points[0], j[0], status, &n_failed, NULL), ICC_OK);
    ck_assert_uint_eq(n_failed, 5);
    for (int k = 0; k < 5; ++k) {
        ck_assert_int_eq(status[k], k < 3    ? ICC_ERR_TRACE
                                    : k == 3 ? ICC_ERR_OUTSIDE
                                             : ICC_ERR_ARGUMENT);
        for (int m = 0; m < 4; ++m)
            ck_assert(isnan(j[k][m]));
    }
    icc_map_free(map);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("maps");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, a_shape_maps_to_itself);
    tcase_add_test(tests, boundaries_correspond);
    tcase_add_test(tests, maxima_correspond);
    tcase_add_test(tests, the_inverse_undoes_the_map);
    tcase_add_test(tests, facets_may_come_in_any_order);
    tcase_add_test(tests, boundaries_that_do_not_correspond_are_refused);
    tcase_add_test(tests, errors_name_the_side);
    tcase_add_test(tests, charts_make_the_same_map);
    tcase_add_test(tests, jacobians_are_derivatives);
    tcase_add_test(tests, boundary_and_maximum_have_no_derivative);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

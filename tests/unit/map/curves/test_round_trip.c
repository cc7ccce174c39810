/* What a map between two charts of method field has left of a point's digits. */
#include <check.h>
#include <icc/icc.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "map/curves/curves.h"
#include "map/curves/round_trip.h"

#include "../../../determinant.h"
#include "../../../infos.h"
#include "../../../random.h"
#include "../../../reports.h"
#include "../../../suite.h"

enum { N_VERTICES = 120, N_POINTS = 120 };

/* A disc of radius 1, or an ellipse, or what is bent. */
static void outline(double (*xy)[2], double height, double bend)
{
    for (int i = 0; i < N_VERTICES; ++i) {
        const double angle = 8 * atan(1) * i / N_VERTICES;
        xy[i][0] = cos(angle);
        xy[i][1] = height * sin(angle) + bend * cos(angle) * cos(angle);
    }
}

static icc_map *map_onto(double height, double bend)
{
    double from[N_VERTICES][2], to[N_VERTICES][2];
    icc_domain *source, *target;
    icc_map *map;
    const icc_chart_options chart = {.size = sizeof chart, .method = ICC_METHOD_FIELD};
    const icc_map_options options = {
        .size = sizeof options, .kind = ICC_MAP_CURVES, .chart = &chart};
    outline(from, 1, 0);
    outline(to, height, bend);
    ck_assert_int_eq(icc_domain_create(&source, 2, N_VERTICES, &from[0][0], 0, NULL, NULL, NULL),
                     ICC_OK);
    ck_assert_int_eq(icc_domain_create(&target, 2, N_VERTICES, &to[0][0], 0, NULL, NULL, NULL),
                     ICC_OK);
    ck_assert_int_eq(icc_map_create(&map, source, target, &options, NULL, NULL), ICC_OK);
    icc_domain_free(source);
    icc_domain_free(target);
    return map;
}

static void spread_points(double *points)
{
    random_source r = {3};
    for (size_t i = 0; i < N_POINTS; ++i) {
        const double angle = random_between(&r, 0, 8 * atan(1)), radius = sqrt(random_unit(&r));
        points[2 * i] = 0.99 * radius * cos(angle);
        points[2 * i + 1] = 0.99 * radius * sin(angle);
    }
}

static double measure_of(const icc_chart *chart)
{
    icc_domain_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_get_info(icc_chart_domain(chart), &info), ICC_OK);
    return info.measure;
}

/* The shares say what the derivative does, also where it shrinks area by many orders of
 * magnitude. */
START_TEST(shares_are_determinants)
{
    static const double HEIGHTS[] = {1, 0.3, 0.1};
    double points[2 * N_POINTS], images[2 * N_POINTS];
    iccp_shares shares[N_POINTS];
    icc_status status[N_POINTS];
    iccp_env env;
    iccp_path path;
    spread_points(points);
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    for (int h = 0; h < 3; ++h) {
        icc_map *map = map_onto(HEIGHTS[h], 0.2);
        const icc_chart *from = icc_map_source_chart(map), *to = icc_map_target_chart(map);
        const double ratio = measure_of(to) / measure_of(from);
        int n_close = 0;
        double least = 1;
        iccp_path_init(&path, &env.memory);
        ck_assert_int_eq(
            iccp_curves_points(from, to, N_POINTS, points, images, shares, status, &path), ICC_OK);
        for (int i = 0; i < N_POINTS; ++i) {
            double image[2], jacobian[4];
            ck_assert_int_eq(status[i], ICC_OK);
            ck_assert_int_eq(iccp_curves_point(from, to, points + 2 * i, image, jacobian, &path),
                             ICC_OK);
            ck_assert_mem_eq(image, images + 2 * i, sizeof image);
            const double shrinks = determinant(2, jacobian) / ratio;
            n_close += fabs(exp(shares[i].to - shares[i].from) / shrinks - 1) < 1e-6;
            least = fmin(least, shrinks);
        }
        /* Not where vectors jump, next to the boundary, or a curve starts within the cells around a
         * root. */
        ck_assert_int_ge(n_close, N_POINTS * 95 / 100);
        ck_assert(h < 2 || least < 1e-5);
        iccp_path_clear(&path);
        icc_map_free(map);
    }
}
END_TEST

/* Points that do not come back have no image, the others the image that they would have without. */
START_TEST(what_does_not_come_back_has_no_image)
{
    double points[2 * N_POINTS], plain[2 * N_POINTS], images[2 * N_POINTS], back[2 * N_POINTS];
    icc_status status[N_POINTS], arrived[N_POINTS];
    iccp_env env;
    iccp_path path;
    size_t n_lost = 0, n_kept = 0, n_no_derivative = 0;
    icc_map *map = map_onto(0.02, 0);
    const icc_chart *from = icc_map_source_chart(map), *to = icc_map_target_chart(map);
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    iccp_path_init(&path, &env.memory);
    spread_points(points);
    ck_assert_int_eq(iccp_curves_points(from, to, N_POINTS, points, plain, NULL, status, &path),
                     ICC_OK);
    /* In place, too. */
    memcpy(images, points, sizeof images);
    ck_assert_int_eq(iccp_checked_points(from, to, N_POINTS, images, images, status, &path),
                     ICC_OK);
    ck_assert_int_eq(iccp_curves_points(to, from, N_POINTS, plain, back, NULL, arrived, &path),
                     ICC_OK);
    for (size_t i = 0; i < N_POINTS; ++i) {
        const double away = hypot(back[2 * i] - points[2 * i], back[2 * i + 1] - points[2 * i + 1]);
        double image[2], jacobian[4];
        n_lost += status[i] == ICC_ERR_TRACE;
        n_kept += status[i] == ICC_OK;
        if (status[i] == ICC_OK) {
            ck_assert_mem_eq(images + 2 * i, plain + 2 * i, 2 * sizeof *images);
            ck_assert(away <= 1e-6 * sqrt(8));
        } else {
            ck_assert(isnan(images[2 * i]) && !(away <= 0.9e-6 * sqrt(8)));
        }
        const icc_status one = iccp_checked_point(from, to, points + 2 * i, image, jacobian, &path);
        ck_assert(one == ICC_OK || one == ICC_ERR_TRACE);
        ck_assert(one == ICC_ERR_TRACE || (status[i] == ICC_OK && determinant(2, jacobian) > 0));
        n_no_derivative += one == ICC_ERR_TRACE;
    }
    ck_assert(n_lost > 10 && n_kept > 10 && n_no_derivative >= n_lost);
    iccp_path_clear(&path);
    icc_map_free(map);
}
END_TEST

/* What the certificate says, and why; the same after loading, and the other way round. */
START_TEST(reasons)
{
    static const struct {
        double height;
        int32_t reason;
    } CASES[] = {{0.5, ICC_REASON_NONE}, {0.1, ICC_REASON_FLAT}, {0.05, ICC_REASON_LOST}};
    for (int k = 0; k < 3; ++k) {
        icc_map *map = map_onto(CASES[k].height, 0), *again, *inverse;
        const icc_map_info info = info_of_map(map);
        size_t n_bytes;
        ck_assert_int_eq(info.reason, CASES[k].reason);
        ck_assert_int_eq(info.certified, info.reason == ICC_REASON_NONE);
        ck_assert(info.reason_side == 0 && report_of(map).n_samples > 1800 &&
                  report_of(map).seconds_certify > 0);
        ck_assert((report_of(map).n_lost > 0) == (info.reason == ICC_REASON_LOST));
        ck_assert((report_of(map).n_flat > 0) == (info.reason != ICC_REASON_NONE));
        ck_assert_int_eq(icc_map_save(map, 0, NULL, &n_bytes), ICC_OK);
        void *data = malloc(n_bytes);
        ck_assert_int_eq(icc_map_save(map, n_bytes, data, &n_bytes), ICC_OK);
        ck_assert_int_eq(icc_map_load(&again, n_bytes, data, NULL, NULL), ICC_OK);
        const icc_map_info loaded = info_of_map(again);
        ck_assert(loaded.certified == info.certified && loaded.reason == info.reason &&
                  report_of(again).n_lost == report_of(map).n_lost &&
                  report_of(again).n_flat == report_of(map).n_flat &&
                  report_of(again).n_samples == report_of(map).n_samples);
        ck_assert_int_eq(icc_map_create_from_charts(&inverse, icc_map_target_chart(map),
                                                    icc_map_source_chart(map), NULL, NULL, NULL),
                         ICC_OK);
        ck_assert_uint_eq(report_of(inverse).n_lost, report_of(map).n_lost);
        ck_assert_uint_eq(report_of(inverse).n_flat, report_of(map).n_flat);
        ck_assert_int_eq(info_of_map(inverse).reason, info.reason);
        free(data);
        icc_map_free(inverse);
        icc_map_free(again);
        icc_map_free(map);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("round trip");
    TCase *tests = tcase_create("round trip");
    tcase_add_test(tests, shares_are_determinants);
    tcase_add_test(tests, what_does_not_come_back_has_no_image);
    tcase_add_test(tests, reasons);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

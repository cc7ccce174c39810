/* What holds for disc coordinates of every shape. */
#define METHOD ICC_METHOD_DISC
#include "../suite.h"
#include "certified.h"

/* Vertices of the mesh need not be looked for. */
START_TEST(vertices_have_the_coordinates_of_their_points)
{
    const shape s = shape_number(_i);
    const icc_chart_options options = {
        .size = sizeof options, .method = ICC_METHOD_DISC, .cells = 15};
    icc_domain *domain;
    icc_chart *chart;
    ck_assert_int_eq(icc_domain_create(&domain, 2, s.n, s.xy, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_chart_create(&chart, domain, &options, NULL, NULL), ICC_OK);
    const iccp_planar *mesh = chart->mesh;
    ck_assert_uint_gt(mesh->n_vertices, mesh->n_boundary);
    for (size_t v = mesh->n_boundary; v < mesh->n_vertices; ++v) {
        iccp_coords own, found;
        double back[2][2];
        ck_assert_int_eq(iccp_chart_encode_vertex(chart, v, &own), ICC_OK);
        ck_assert_int_eq(iccp_chart_encode(chart, mesh->points + 2 * v, &found, NULL), ICC_OK);
        ck_assert_double_eq_tol(own.t, found.t, 1e-14);
        ck_assert_int_eq(iccp_chart_decode(chart, &own, back[0], NULL, NULL), ICC_OK);
        ck_assert_int_eq(iccp_chart_decode(chart, &found, back[1], NULL, NULL), ICC_OK);
        for (size_t d = 0; d < 2; ++d) {
            ck_assert_double_eq_tol(back[0][d], mesh->points[2 * v + d], 1e-10);
            ck_assert_double_eq_tol(back[0][d], back[1][d], 1e-10);
        }
    }
    icc_chart_free(chart);
    icc_domain_free(domain);
}
END_TEST

START_TEST(hard_shapes_have_coordinates)
{
    const shape s = shape_hard(_i), reversed = shape_reversed(&s);
    /* The map shrinks the neighbourhood of a very short edge, and rounding in the disc is magnified
     * on the way back: at a slit of 1e-9 seven digits are lost, at one of 1e-14 all but two. */
    static const double TOLERANCE[N_HARD_SHAPES] = {
        [2] = 1e-7, [3] = 1e-2, [5] = 1e-7, [6] = 1e-2, [13] = 1e-8, [14] = 1e-7, [15] = 1e-4};
    const double tolerance = fmax(TOLERANCE[_i], 1e-10);
    check_chart(&s, 50, 100, tolerance, shape_hard_slack(_i));
    check_chart(&reversed, 12, 100, tolerance, shape_hard_slack(_i));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("disc");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    add_certified_tests(tests);
    tcase_add_loop_test(tests, vertices_have_the_coordinates_of_their_points, 0, N_SHAPES);
    tcase_add_loop_test(tests, hard_shapes_have_coordinates, 0, N_HARD_SHAPES);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

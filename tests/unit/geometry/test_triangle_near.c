/* Searches among triangles in space find what a look at every triangle finds. */
#include "geometry/simplex.h"
#include "geometry/triangle_near.h"

#include "../../random.h"
#include "../../suite.h"

#include <check.h>
#include <math.h>

enum { N = 60, QUERIES = 400 };

static random_source source = {3};

static double vertices[3 * N];
static uint32_t triangles[3 * N];

/* A third of the triangles are thin, and some points lie on corners. */
static void draw_triangles(void)
{
    for (size_t k = 0; k < sizeof vertices / sizeof *vertices; ++k)
        vertices[k] = random_unit(&source);
    for (size_t k = 0; k < sizeof triangles / sizeof *triangles; ++k)
        triangles[k] = (uint32_t)(random_bits(&source) % N);
    for (size_t f = 0; f < N; ++f) {
        uint32_t *const t = triangles + 3 * f;
        t[1] = t[1] == t[0] ? (t[0] + 1) % N : t[1];
        while (t[2] == t[0] || t[2] == t[1])
            t[2] = (t[2] + 1) % N;
    }
    for (size_t f = 0; f < N; f += 3)
        for (size_t k = 0; k < 3; ++k)
            vertices[3 * triangles[3 * f] + k] = 0.5 * (vertices[3 * triangles[3 * f + 1] + k] +
                                                        vertices[3 * triangles[3 * f + 2] + k]) +
                                                 1e-7 * random_unit(&source);
}

START_TEST(the_distance_is_that_of_the_nearest_point)
{
    for (int trial = 0; trial < 20; ++trial) {
        draw_triangles();
        for (size_t f = 0; f < N; ++f) {
            const double *corner[3];
            double bary[3], p[3];
            for (size_t i = 0; i < 3; ++i) {
                corner[i] = vertices + 3 * (size_t)triangles[3 * f + i];
                p[i] = 3 * random_unit(&source) - 1;
            }
            const double right = iccp_simplex_nearest(3, 3, corner, p, bary);
            ck_assert_double_eq_tol(
                sqrt(iccp_triangle_distance2(corner[0], corner[1], corner[2], p)), sqrt(right),
                1e-6);
            ck_assert_double_eq(iccp_triangle_distance2(corner[0], corner[1], corner[2], corner[1]),
                                0);
        }
    }
}
END_TEST

START_TEST(searches_find_the_nearest_or_one_that_is_near_enough)
{
    const iccp_memory memory = iccp_memory_default;
    iccp_facet_tree tree;
    size_t n_near = 0, n_other = 0, n_none = 0;
    draw_triangles();
    iccp_facet_tree_create(&tree, 3, vertices, N, triangles, &memory);
    ck_assert_ptr_nonnull(tree.boxes);
    for (size_t k = 0; k < QUERIES; ++k) {
        double p[3], least = HUGE_VAL, distance2;
        const double far2 = 0.1 * random_unit(&source);
        uint32_t best = UINT32_MAX;
        for (size_t i = 0; i < 3; ++i)
            p[i] = 2 * random_unit(&source) - 0.5;
        for (uint32_t f = 0; f < N; ++f) {
            const double *corner[3];
            iccp_facet_corners(&tree, f, corner);
            const double now = iccp_triangle_distance2(corner[0], corner[1], corner[2], p);
            if (now < least) {
                least = now;
                best = f;
            }
        }
        ck_assert_uint_eq(iccp_triangle_near(&tree, p, -1, HUGE_VAL, &distance2), best);
        ck_assert_double_eq(distance2, least);
        const uint32_t any = iccp_triangle_near(&tree, p, far2, far2, &distance2);
        ck_assert_int_eq(any == UINT32_MAX, !(least <= far2));
        if (any == UINT32_MAX) {
            ++n_none;
            continue;
        }
        const double *corner[3];
        iccp_facet_corners(&tree, any, corner);
        ck_assert_double_eq(iccp_triangle_distance2(corner[0], corner[1], corner[2], p), distance2);
        ck_assert_double_le(distance2, far2);
        ++*(any == best ? &n_near : &n_other);
    }
    ck_assert_uint_gt(n_near, QUERIES / 40);
    ck_assert_uint_gt(n_other, QUERIES / 40);
    ck_assert_uint_gt(n_none, QUERIES / 40);
    iccp_facet_tree_free(&tree, &memory);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("triangle_near");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, the_distance_is_that_of_the_nearest_point);
    tcase_add_test(tests, searches_find_the_nearest_or_one_that_is_near_enough);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

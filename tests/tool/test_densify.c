/* Vertices that are put into lines: where they come from. */
#include "geo/densify.h"

#include "../suite.h"

#include <check.h>
#include <stdlib.h>

/* A vertex that is as good as at the next position still comes from the one before, which is the last
 * one but one of a line. */
START_TEST(test_origin)
{
    double ends[] = {0.5, -1, 0.5, 1}, images[] = {1.5, -1, 1.5, 1};
    map_edges edges = {.n = 1, .ends = ends, .images = images};
    polyline line = {0};
    vertex v = {.image = {1, 0}, .from = 5, .along = 1 - 0x1p-50, .open = true};
    polyline_add(&line, &v);
    v = (vertex){.point = {1, 0}, .image = {2, 0}, .position = true, .from = 6};
    polyline_add(&line, &v);
    segment_tree_make(&edges.tree, 1, ends, 0);
    polyline_cut(&line, &edges, 0);
    ck_assert_uint_eq(line.n, 3);
    ck_assert_uint_eq(line.vertices[1].from, 5);
    ck_assert_double_eq(line.vertices[1].along, 1);
    ck_assert_double_eq(line.vertices[1].image[0], 1.5);
    segment_tree_free(&edges.tree);
    free(edges.cuts);
    polyline_free(&line);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("densify");
    TCase *tests = tcase_create("densify");
    tcase_add_test(tests, test_origin);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

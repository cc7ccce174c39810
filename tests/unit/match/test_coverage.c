#include <icc/icc.h>

#include "../../faulty.h"
#include "../../suite.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A layer of N x N cells. Cell borders are drawn with `cuts` further vertices on each edge, bent and
 * moved, each cell by itself with noise. */
enum { N = 5, MOST = N * N * 64 };

typedef struct grid {
    size_t first[N * N + 1];
    double vertices[2 * MOST];
    int64_t ids[N * N];
    icc_layer layer;
} grid;

/* A small number for each place and cell, always the same. */
static double noise_at(size_t k)
{
    return (double)((k * 2654435761u) % 1000) / 500 - 1;
}

static void bend(double x, double y, double amount, double *out)
{
    out[0] = x + amount * sin(1.3 * y) + 10 * amount;
    out[1] = y + amount * cos(0.9 * x + 1);
}

static void make_grid(grid *g, size_t cuts, double amount, double noise)
{
    static const int corner[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    size_t n = 0;
    for (size_t c = 0; c < N * N; ++c) {
        g->first[c] = n;
        g->ids[c] = 100 + (int64_t)c;
        for (size_t e = 0; e < 4; ++e)
            for (size_t k = 0; k <= cuts; ++k) {
                /* Neighbours cut their edge at the same places: from the lower end on. */
                const double t = (double)k / (double)(cuts + 1);
                const double x = (double)(c % N) + corner[e][0] * (1 - t) + corner[e + 1][0] * t;
                const double y = (double)(c / N) + corner[e][1] * (1 - t) + corner[e + 1][1] * t;
                bend(x, y, amount, g->vertices + 2 * n);
                g->vertices[2 * n] += noise * noise_at(2 * n + c);
                g->vertices[2 * n + 1] += noise * noise_at(2 * n + 1 + c);
                ++n;
            }
    }
    g->first[N * N] = n;
    g->layer = (icc_layer){.size = sizeof g->layer,
                           .n_rings = N * N,
                           .first = g->first,
                           .vertices = g->vertices,
                           .ids = g->ids};
}

static grid source, target;

static icc_coverage_info info_of(const icc_coverage *coverage)
{
    icc_coverage_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_coverage_get_info(coverage, &info), ICC_OK);
    return info;
}

/* Other vertices, and noise of each cell: nodes and borders are those of the grid. */
START_TEST(cells_with_other_vertices_are_one_map)
{
    make_grid(&source, 2, 0.1, 1e-4);
    make_grid(&target, 3, 0.2, 1e-4);
    icc_coverage *coverage;
    icc_error err = {.size = sizeof err};
    const icc_coverage_options options = {.size = sizeof options, .weld = {4e-4, 4e-4}};
    ck_assert_msg(icc_coverage_create(&coverage, &source.layer, &target.layer, &options, NULL,
                                      &err) == ICC_OK,
                  "%s", err.message);
    const icc_coverage_info info = info_of(coverage);
    ck_assert_uint_eq(info.n_regions, N * N);
    ck_assert_uint_eq(info.n_features, N * N);
    ck_assert_uint_eq(info.n_nodes, (N + 1) * (N + 1) - 4);
    ck_assert_uint_eq(info.n_sides, 2 * N * (N + 1) - 4);
    ck_assert_uint_eq(info.n_differences, 0);
    for (int e = 0; e < 2; ++e) {
        ck_assert_uint_eq(info.n_chains[e], 0);
        ck_assert_double_le(info.most_moved[e], 4e-4);
        ck_assert_double_gt(info.least_apart[e], 0.1);
    }
    icc_map *map;
    ck_assert_msg(icc_map_create(&map, icc_coverage_source(coverage), icc_coverage_target(coverage),
                                 NULL, NULL, &err) == ICC_OK,
                  "%s", err.message);
    icc_map_info made = {.size = sizeof made};
    icc_map_get_info(map, &made);
    ck_assert_int_eq(made.certified, 1);
    icc_map_free(map);
    icc_coverage_free(coverage);
}
END_TEST

/* Each vertex of a ring that moved nowhere is a common vertex, and lies where it was given. */
START_TEST(given_vertices_are_common_vertices)
{
    make_grid(&source, 1, 0.1, 0);
    make_grid(&target, 2, 0.2, 0);
    icc_coverage *coverage;
    const icc_coverage_options options = {.size = sizeof options, .weld = {1e-9, 1e-9}};
    ck_assert_int_eq(
        icc_coverage_create(&coverage, &source.layer, &target.layer, &options, NULL, NULL), ICC_OK);
    const icc_feature *features[2];
    int64_t ids[N * N];
    ck_assert_int_eq(icc_coverage_get_features(coverage, &features[0], &features[1]), ICC_OK);
    ck_assert_int_eq(icc_coverage_get_ids(coverage, ids), ICC_OK);
    for (size_t c = 0; c < N * N; ++c) {
        ck_assert_int_eq(ids[c], 100 + (int64_t)c);
        ck_assert_uint_eq(features[0][c].n_vertices, features[1][c].n_vertices);
        for (int e = 0; e < 2; ++e) {
            const grid *const g = e == 0 ? &source : &target;
            for (size_t v = g->first[c]; v < g->first[c + 1]; ++v) {
                double least = HUGE_VAL;
                for (size_t k = 0; k < features[e][c].n_vertices; ++k)
                    least = fmin(
                        least, hypot(features[e][c].vertices[2 * k] - g->vertices[2 * v],
                                     features[e][c].vertices[2 * k + 1] - g->vertices[2 * v + 1]));
                ck_assert_double_le(least, 1e-9);
            }
        }
    }
    icc_coverage_free(coverage);
}
END_TEST

static const double squares[] = {0, 0, 1, 0, 1, 1, 0, 1, 1, 0, 2, 0, 2, 1, 1, 1};
static const size_t of_squares[] = {0, 4, 8};
static const int64_t seven_eight[] = {7, 8}, seven_nine[] = {7, 9};

START_TEST(differences_are_named_or_left_out)
{
    /* In the target the squares are apart, so their border is missing there. */
    double moved[16];
    memcpy(moved, squares, sizeof moved);
    for (size_t k = 8; k < 16; k += 2)
        moved[k] += 0.5;
    icc_layer a = {.size = sizeof a,
                   .n_rings = 2,
                   .first = of_squares,
                   .vertices = squares,
                   .ids = seven_eight};
    icc_layer b = a;
    b.vertices = moved;
    icc_coverage *coverage;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_coverage_create(&coverage, &a, &b, NULL, NULL, &err), ICC_ERR_TOPOLOGY);
    ck_assert_ptr_null(coverage);
    ck_assert_ptr_nonnull(strstr(err.message, "region"));
    b = a;
    b.ids = seven_nine;
    ck_assert_int_eq(icc_coverage_create(&coverage, &a, &b, NULL, NULL, &err), ICC_ERR_TOPOLOGY);
    ck_assert_str_eq(
        err.message,
        "region 8, near (1, 0), is in the source only (and 1 more difference): leave it out");
    const icc_coverage_options options = {.size = sizeof options,
                                          .unmatched = ICC_UNMATCHED_LEAVE_OUT};
    ck_assert_int_eq(icc_coverage_create(&coverage, &a, &b, &options, NULL, &err), ICC_OK);
    const icc_coverage_info info = info_of(coverage);
    ck_assert_uint_eq(info.n_regions, 1);
    ck_assert_uint_eq(info.n_differences, 2);
    ck_assert_uint_eq(info.n_left_out, 2);
    icc_coverage_difference d = {.size = sizeof d};
    ck_assert_int_eq(icc_coverage_get_difference(coverage, 1, &d), ICC_OK);
    ck_assert_int_eq(d.kind, ICC_DIFFERENCE_REGION);
    ck_assert_int_eq(d.side, 2);
    ck_assert_int_eq(d.ids[0], 9);
    ck_assert_int_eq(icc_coverage_get_difference(coverage, 2, &d), ICC_ERR_ARGUMENT);
    icc_coverage_free(coverage);
}
END_TEST

START_TEST(regions_that_overlap_are_named)
{
    double over[16];
    memcpy(over, squares, sizeof over);
    over[8] = over[14] = 0.5;
    icc_layer a = {
        .size = sizeof a, .n_rings = 2, .first = of_squares, .vertices = over, .ids = seven_eight};
    icc_coverage *coverage;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_coverage_create(&coverage, &a, &a, NULL, NULL, &err), ICC_ERR_BOUNDARY);
    ck_assert_int_eq(err.side, 1);
    ck_assert_ptr_nonnull(strstr(err.message, "regions 7 and 8 overlap"));
}
END_TEST

/* Regions may overlap without sides that cross. */
START_TEST(regions_inside_others_are_named)
{
    static const double nested[] = {0, 0, 9, 0, 9, 9, 0, 9, 3, 3, 6, 3, 6, 6, 3, 6};
    static const double apart[] = {0, 0, 9, 0, 9, 9, 0, 9, 13, 3, 16, 3, 16, 6, 13, 6};
    static const double bow[] = {0, 0, 2, 2, 2, 0, 0, 2};
    static const int64_t twice[] = {7, 7};
    static const uint8_t second[] = {0, 1};
    static const struct {
        const double *vertices;
        const int64_t *ids;
        const uint8_t *holes;
        size_t n_rings;
        const char *message;
    } cases[] = {{nested, seven_eight, NULL, 2,
                  "source: regions 7 and 8 overlap at (3, 3): weld if they should only meet"},
                 {nested, twice, NULL, 2, "source: region 7 overlaps itself at (3, 3)"},
                 {nested, twice, second, 2, NULL},
                 {apart, twice, NULL, 2, NULL},
                 {apart, twice, second, 2, "source: a hole of region 7 lies outside it at (13, 3)"},
                 {bow, twice, NULL, 1, "source: region 7 overlaps itself at (1, 1)"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        const icc_layer layer = {.size = sizeof layer,
                                 .n_rings = cases[k].n_rings,
                                 .first = of_squares,
                                 .vertices = cases[k].vertices,
                                 .ids = cases[k].ids,
                                 .holes = cases[k].holes};
        icc_coverage *coverage = NULL;
        icc_error err = {.size = sizeof err};
        const icc_status status = icc_coverage_create(&coverage, &layer, &layer, NULL, NULL, &err);
        ck_assert_int_eq(status, cases[k].message == NULL ? ICC_OK : ICC_ERR_BOUNDARY);
        if (cases[k].message != NULL)
            ck_assert_str_eq(err.message, cases[k].message);
        icc_coverage_free(coverage);
    }
}
END_TEST

/* A hole whose centre is that of its region: the two centres tell no direction and no scale. */
START_TEST(rings_with_one_centre_are_paired)
{
    static const double rings[] = {0, 0, 9, 0, 9, 9, 0, 9, 3, 3, 6, 3, 6, 6, 3, 6};
    static const int64_t twice[] = {7, 7};
    static const uint8_t second[] = {0, 1};
    const icc_layer layer = {.size = sizeof layer,
                             .n_rings = 2,
                             .first = of_squares,
                             .vertices = rings,
                             .ids = twice,
                             .holes = second};
    icc_coverage *coverage;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_coverage_create(&coverage, &layer, &layer, NULL, NULL, &err) == ICC_OK, "%s",
                  err.message);
    ck_assert_uint_eq(info_of(coverage).n_vertices, 8);
    icc_coverage_free(coverage);
}
END_TEST

/* A chain of vertices, each within the weld length of the next, is not drawn together. */
START_TEST(welding_makes_no_chains)
{
    const double ring[] = {0, 0, 1, 0, 1.08, 0.01, 1.16, 0, 2, 0, 2, 1, 0, 1};
    const size_t first[] = {0, 7};
    const int64_t id = -3;
    const icc_layer a = {
        .size = sizeof a, .n_rings = 1, .first = first, .vertices = ring, .ids = &id};
    const icc_coverage_options options = {.size = sizeof options, .weld = {0.1, 0.1}};
    icc_coverage *coverage;
    ck_assert_int_eq(icc_coverage_create(&coverage, &a, &a, &options, NULL, NULL), ICC_OK);
    const icc_coverage_info info = info_of(coverage);
    ck_assert_uint_eq(info.n_welded[0], 1);
    ck_assert_uint_gt(info.n_chains[0], 0);
    ck_assert_double_le(info.most_moved[0], 0.1);
    icc_coverage_free(coverage);
}
END_TEST

START_TEST(wrong_arguments_are_refused)
{
    make_grid(&source, 1, 0.1, 0);
    icc_coverage *coverage;
    icc_coverage_options options = {.size = sizeof options, .weld = {-1, 0}};
    ck_assert_int_eq(
        icc_coverage_create(&coverage, &source.layer, &source.layer, &options, NULL, NULL),
        ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_coverage_create(NULL, &source.layer, &source.layer, NULL, NULL, NULL),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_coverage_create(&coverage, &source.layer, NULL, NULL, NULL, NULL),
                     ICC_ERR_ARGUMENT);
    icc_layer wrong = source.layer;
    wrong.ids = NULL;
    ck_assert_int_eq(icc_coverage_create(&coverage, &source.layer, &wrong, NULL, NULL, NULL),
                     ICC_ERR_ARGUMENT);
    ck_assert_ptr_null(coverage);
    ck_assert_ptr_null(icc_coverage_source(NULL));
    icc_coverage_free(NULL);
}
END_TEST

static icc_status make_both(const icc_env *env, icc_error *err, void *argument)
{
    icc_coverage *coverage;
    const icc_layer layer = {.size = sizeof layer,
                             .n_rings = 2,
                             .first = of_squares,
                             .vertices = squares,
                             .ids = seven_eight};
    const icc_status status = icc_coverage_create(&coverage, &layer, &layer, NULL, env, err);
    (void)argument;
    icc_coverage_free(coverage);
    return status;
}

START_TEST(failures_leave_nothing_behind)
{
    faulty_sweep(make_both, NULL);
}
END_TEST

/* A square with two islands and a lake each; the target lacks an island and has another lake. */
START_TEST(islands_are_paired_by_place)
{
    static const double at[][3] = {{0, 0, 4}, {6, 0, 1}, {6, 3, 1}, {1, 1, 1}, {2.5, 2.5, 0.5}};
    static const size_t used[2][5] = {{0, 1, 2, 3, 3}, {0, 2, 3, 4, 4}};
    double vertices[2][8 * 5];
    size_t first[5] = {0, 4, 8, 12, 16};
    const int64_t ids[5] = {1, 1, 1, 1, 1};
    const uint8_t holes[2][5] = {{0, 0, 0, 1, 1}, {0, 0, 1, 1, 1}};
    icc_layer layer[2];
    for (int e = 0; e < 2; ++e) {
        for (size_t r = 0; r < 4; ++r)
            for (size_t k = 0; k < 4; ++k) {
                const double *const s = at[used[e][r]];
                vertices[e][8 * r + 2 * k] = s[0] + (k == 1 || k == 2 ? s[2] : 0) + 0.01 * e;
                vertices[e][8 * r + 2 * k + 1] = s[1] + (k >= 2 ? s[2] : 0);
            }
        layer[e] = (icc_layer){.size = sizeof layer[e],
                               .n_rings = 4,
                               .first = first,
                               .vertices = vertices[e],
                               .ids = ids,
                               .holes = holes[e]};
    }
    const icc_coverage_options options = {.size = sizeof options,
                                          .unmatched = ICC_UNMATCHED_LEAVE_OUT};
    icc_coverage *coverage;
    ck_assert_int_eq(icc_coverage_create(&coverage, &layer[0], &layer[1], &options, NULL, NULL),
                     ICC_OK);
    const icc_coverage_info info = info_of(coverage);
    ck_assert_uint_eq(info.n_features, 3);
    ck_assert_uint_eq(info.n_islands, 3);
    ck_assert_uint_eq(info.n_differences, 2);
    const icc_feature *from, *to;
    icc_coverage_get_features(coverage, &from, &to);
    for (size_t f = 0; f < 3; ++f)
        for (size_t k = 0; k < 8; ++k)
            ck_assert_double_eq_tol(to[f].vertices[k], from[f].vertices[k], 0.011);
    icc_coverage_free(coverage);
}
END_TEST

/* The places of the regions tell nothing here: those of the target are mirrored. */
START_TEST(islands_at_mirrored_places_are_paired_by_number)
{
    double vertices[2][8 * 4];
    size_t first[5] = {0, 4, 8, 12, 16};
    const int64_t ids[4] = {1, 2, 3, 4};
    icc_layer layer[2];
    for (int e = 0; e < 2; ++e) {
        for (size_t r = 0; r < 4; ++r)
            for (size_t k = 0; k < 4; ++k) {
                const double y = r >= 2 ? 10 : 0;
                vertices[e][8 * r + 2 * k] = (r % 2 == 0 ? 0 : 10) + (k == 1 || k == 2 ? 3 : 0);
                vertices[e][8 * r + 2 * k + 1] = (e == 0 ? y : 10 - y) + (k >= 2 ? 3 : 0);
            }
        layer[e] = (icc_layer){.size = sizeof layer[e],
                               .n_rings = 4,
                               .first = first,
                               .vertices = vertices[e],
                               .ids = ids};
    }
    icc_coverage *coverage;
    ck_assert_int_eq(icc_coverage_create(&coverage, &layer[0], &layer[1], NULL, NULL, NULL),
                     ICC_OK);
    const icc_coverage_info info = info_of(coverage);
    ck_assert_uint_eq(info.n_islands, 4);
    ck_assert_uint_eq(info.n_settled, 0);
    icc_coverage_free(coverage);
}
END_TEST

/* Vertices opposite to where a pairing begins are common ones, too. */
START_TEST(equal_rings_are_paired_vertex_by_vertex)
{
    enum { RINGS = 5, EACH = 6, OUTER = 8, ALL = OUTER + (RINGS - 1) * EACH };
    double vertices[2 * ALL];
    size_t first[RINGS + 1] = {0};
    const int64_t ids[RINGS] = {1, 1, 1, 1, 1};
    const uint8_t holes[RINGS] = {0, 1, 1, 1, 1};
    for (size_t r = 0; r < RINGS; ++r) {
        const size_t n = r == 0 ? OUTER : EACH;
        const double x = r == 0 ? 4.5 : 3 * (double)((r - 1) / 2);
        const double y = r == 0 ? 4.5 : 3 * (double)((r - 1) % 2), radius = r == 0 ? 10.8 : 1;
        first[r + 1] = first[r] + n;
        for (size_t k = 0; k < n; ++k) {
            const double turn = (double)k * 2 * 3.141592653589793 / (double)n;
            vertices[2 * (first[r] + k)] = x + radius * cos(turn);
            vertices[2 * (first[r] + k) + 1] = y + radius * sin(turn);
        }
    }
    const icc_layer layer = {.size = sizeof layer,
                             .n_rings = RINGS,
                             .first = first,
                             .vertices = vertices,
                             .ids = ids,
                             .holes = holes};
    const icc_coverage_options options = {.size = sizeof options, .between = ICC_BETWEEN_ARC};
    icc_coverage *coverage;
    ck_assert_int_eq(icc_coverage_create(&coverage, &layer, &layer, &options, NULL, NULL), ICC_OK);
    const icc_coverage_info info = info_of(coverage);
    ck_assert_uint_eq(info.n_vertices, ALL);
    ck_assert_uint_eq(info.n_joined, ALL);
    icc_coverage_free(coverage);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("coverage");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, cells_with_other_vertices_are_one_map);
    tcase_add_test(tests, given_vertices_are_common_vertices);
    tcase_add_test(tests, differences_are_named_or_left_out);
    tcase_add_test(tests, regions_that_overlap_are_named);
    tcase_add_test(tests, regions_inside_others_are_named);
    tcase_add_test(tests, rings_with_one_centre_are_paired);
    tcase_add_test(tests, welding_makes_no_chains);
    tcase_add_test(tests, wrong_arguments_are_refused);
    tcase_add_test(tests, islands_are_paired_by_place);
    tcase_add_test(tests, equal_rings_are_paired_vertex_by_vertex);
    tcase_add_test(tests, islands_at_mirrored_places_are_paired_by_number);
    tcase_add_test(tests, failures_leave_nothing_behind);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

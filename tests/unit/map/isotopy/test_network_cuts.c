/* Networks are cut open to one polygon for each face, and ties stay in one face. */
#include "map/isotopy/cut_polygon.h"
#include "mesh/vertex_fans.h"

#include "../../../default_env.h"
#include "../../../faulty.h"
#include "../../../suite.h"

#include <check.h>
#include <string.h>

static const double SQUARE[8] = {0, 0, 12, 0, 12, 12, 0, 12};

static icc_feature feature_of(int32_t kind, size_t n, const double *vertices)
{
    return (icc_feature){
        .size = sizeof(icc_feature), .kind = kind, .n_vertices = n, .vertices = vertices};
}

static icc_domain *domain_of(size_t n_outer, size_t n, const icc_feature *features)
{
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    if (icc_domain_create_features(&domain, n_outer, n_outer > 0 ? SQUARE : NULL, n, features, NULL,
                                   &err) != ICC_OK)
        ck_abort_msg("%s", err.message);
    return domain;
}

/* Two triangles as holes. They touch each other at (6, 6), and the outline at (0, 0) and (12, 12).
 * A point lies on either side of them. */
static icc_domain *chain_of_holes(double x, double y)
{
    const double holes[2][6] = {{0, 0, 6, 6, 2, 4}, {6, 6, 12, 12, 8, 10}};
    const double points[2][2] = {{x, y}, {3, 10}};
    const icc_feature features[4] = {
        feature_of(ICC_FEATURE_HOLE, 3, holes[0]), feature_of(ICC_FEATURE_HOLE, 3, holes[1]),
        feature_of(ICC_FEATURE_POINT, 1, points[0]), feature_of(ICC_FEATURE_POINT, 1, points[1])};
    return domain_of(4, 4, features);
}

/* Two squares that are regions, the first with a point and a line inside. */
static icc_domain *two_parts(double x)
{
    const double regions[2][8] = {{0, 0, 4, 0, 4, 4, 0, 4}, {6, 0, 10, 0, 10, 4, 6, 4}};
    const double point[2] = {x, 1}, line[4] = {1, 3, 3, 3};
    const icc_feature features[4] = {feature_of(ICC_FEATURE_REGION, 4, regions[0]),
                                     feature_of(ICC_FEATURE_REGION, 4, regions[1]),
                                     feature_of(ICC_FEATURE_POINT, 1, point),
                                     feature_of(ICC_FEATURE_LINE, 2, line)};
    return domain_of(0, 4, features);
}

/* A square with its diagonals, which meet at a place, and a point in the lowest face. */
static icc_domain *crossed(double x, double y)
{
    const double lines[4][4] = {{0, 0, x, y}, {x, y, 12, 0}, {12, 12, x, y}, {x, y, 0, 12}};
    const double point[2] = {6, 1};
    icc_feature features[5];
    for (size_t k = 0; k < 4; ++k)
        features[k] = feature_of(ICC_FEATURE_LINE, 2, lines[k]);
    features[4] = feature_of(ICC_FEATURE_POINT, 1, point);
    return domain_of(4, 5, features);
}

static void check_cuts(icc_domain *source, icc_domain *target, size_t n_parts, size_t n_cuts,
                       size_t n_polygons)
{
    const iccp_env env = default_env();
    iccp_domain_pair pair;
    iccp_cutter cutter;
    ck_assert_int_eq(iccp_domain_pair_create(&pair, source, target, &env), ICC_OK);
    ck_assert_uint_eq(pair.n_cuts, n_cuts);
    size_t n = 0;
    for (uint32_t c = 0; c < pair.n_components; ++c)
        n += pair.part[c] == c;
    ck_assert_uint_eq(n, n_parts);
    ck_assert_int_eq(iccp_cutter_create(&cutter, &pair, &env), ICC_OK);
    for (uint64_t tree = 0; tree < 6; ++tree) {
        iccp_cuts cuts;
        iccp_cut_polygons polygons[2];
        ck_assert_int_eq(iccp_cuts_create(&cuts, &cutter, tree, &env), ICC_OK);
        ck_assert_uint_eq(cuts.n, n_cuts);
        for (int side = 0; side < 2; ++side) {
            ck_assert_int_eq(iccp_cut_polygons_create(&polygons[side], &pair, side, &cuts, &env),
                             ICC_OK);
            ck_assert_uint_eq(polygons[side].n_polygons, n_polygons);
        }
        ck_assert(iccp_cut_polygons_same(&polygons[0], &polygons[1]));
        for (int side = 0; side < 2; ++side)
            iccp_cut_polygons_free(&polygons[side]);
        iccp_cuts_free(&cuts);
    }
    iccp_cutter_free(&cutter);
    iccp_domain_pair_free(&pair);
}

static void check_map(const icc_domain *source, const icc_domain *target, size_t n_ties,
                      const icc_tie *ties, const char *text)
{
    const icc_map_options options = {.size = sizeof options, .n_ties = n_ties, .ties = ties};
    icc_error err = {.size = sizeof err};
    icc_map *map;
    const icc_status status = icc_map_create(&map, source, target, &options, NULL, &err);
    if (text == NULL) {
        icc_map_info info = {.size = sizeof info};
        ck_assert_msg(status == ICC_OK, "%s", err.message);
        (void)icc_map_get_info(map, &info);
        ck_assert(info.certified == 1 && info.class_kept == 1);
    } else {
        ck_assert_int_eq(status, ICC_ERR_TOPOLOGY);
        ck_assert_msg(strstr(err.message, text) != NULL, "'%s' is not in '%s'", text, err.message);
    }
    icc_map_free(map);
}

static icc_tie tie_of(uint32_t a, uint32_t b)
{
    return (icc_tie){.size = sizeof(icc_tie), .vertex = {a, b}};
}

static void release(icc_domain *source, icc_domain *target)
{
    icc_domain_free(source);
    icc_domain_free(target);
}

START_TEST(holes_that_touch)
{
    icc_domain *source = chain_of_holes(8, 2), *target = chain_of_holes(11, 9);
    check_cuts(source, target, 1, 2, 2);
    check_map(source, target, 0, NULL, NULL);
    /* The chain of holes is one component with the outline: a point lies on either side of it. */
    const icc_tie ties[2] = {tie_of(1, 10), tie_of(3, 11)},
                  other[2] = {tie_of(5, 10), tie_of(6, 11)};
    check_map(source, target, 2, ties, NULL);
    check_map(source, target, 2, other, NULL);
    release(source, target);
}
END_TEST

START_TEST(parts)
{
    icc_domain *source = two_parts(1), *target = two_parts(3);
    check_cuts(source, target, 2, 2, 2);
    check_map(source, target, 0, NULL, NULL);
    const icc_tie ties[2] = {tie_of(0, 8), tie_of(3, 9)}, far[2] = {tie_of(0, 8), tie_of(5, 10)};
    check_map(source, target, 2, ties, NULL);
    check_map(source, target, 1, ties, "1 ties: there must be 2");
    check_map(source, target, 2, far, "tie 1 joins two parts of the domain");
    release(source, target);
}
END_TEST

START_TEST(faces)
{
    icc_domain *source = crossed(6, 6), *target = crossed(4, 9);
    check_cuts(source, target, 1, 1, 4);
    check_map(source, target, 0, NULL, NULL);
    const icc_tie good = tie_of(5, 12), ring = tie_of(5, 0), across = tie_of(2, 12);
    check_map(source, target, 1, &good, NULL);
    check_map(source, target, 1, &ring, "tie 0 joins what the ties before it join already");
    check_map(source, target, 1, &across, "tie 0 meets itself");
    release(source, target);
}
END_TEST

/* At the place where the holes touch there are two fans, and a turn visits both. */
START_TEST(fans_at_vertices)
{
    const iccp_env env = default_env();
    icc_domain *domain = chain_of_holes(8, 2);
    iccp_domain_pair pair;
    iccp_fans fans;
    ck_assert_int_eq(iccp_domain_pair_create(&pair, domain, domain, &env), ICC_OK);
    const iccp_corners *mesh = &pair.mesh[0];
    ck_assert_int_eq(iccp_fans_create(&fans, mesh, pair.n, &env.memory), ICC_OK);
    for (uint32_t v = 0; v < pair.n; ++v) {
        size_t n = 0, n_there = 0;
        for (size_t c = 0; c < 3 * mesh->n_triangles; ++c)
            n += mesh->vertex[c] == v;
        iccp_turn turn = iccp_turn_begin(&fans, mesh, v);
        for (; turn.corner != ICCP_NO_NEIGHBOUR; iccp_turn_next(&turn, &fans, mesh)) {
            ck_assert_uint_eq(mesh->vertex[turn.corner], v);
            ++n_there;
        }
        ck_assert_uint_eq(n_there, n);
        ck_assert_uint_eq(n > 0, pair.node[v] == v);
    }
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c) {
        const uint32_t a = mesh->vertex[iccp_after(c)], b = mesh->vertex[iccp_before(c)];
        const uint32_t least = mesh->twin[c] < c ? mesh->twin[c] : c;
        ck_assert_uint_eq(iccp_fans_edge(&fans, mesh, a, b), least);
        ck_assert_uint_eq(iccp_fans_edge(&fans, mesh, b, a), least);
    }
    ck_assert_uint_eq(fans.first[pair.n], 6);
    iccp_fans_free(&fans, &env.memory);
    iccp_domain_pair_free(&pair);
    icc_domain_free(domain);
}
END_TEST

static icc_status create(const icc_env *env, icc_error *err, void *argument)
{
    icc_domain *const *domain = argument;
    icc_map *map;
    const icc_status status = icc_map_create(&map, domain[0], domain[1], NULL, env, err);
    ck_assert((map != NULL) == (status == ICC_OK));
    icc_map_free(map);
    return status;
}

START_TEST(failures)
{
    icc_domain *pairs[3][2] = {{chain_of_holes(8, 2), chain_of_holes(11, 9)},
                               {two_parts(1), two_parts(3)},
                               {crossed(6, 6), crossed(4, 9)}};
    for (size_t k = 0; k < 3; ++k) {
        faulty_sweep(create, pairs[k]);
        release(pairs[k][0], pairs[k][1]);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("cuts of networks");
    TCase *tests = tcase_create("networks");
    tcase_add_test(tests, holes_that_touch);
    tcase_add_test(tests, parts);
    tcase_add_test(tests, faces);
    tcase_add_test(tests, fans_at_vertices);
    tcase_add_test(tests, failures);
    tcase_set_timeout(tests, 60);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

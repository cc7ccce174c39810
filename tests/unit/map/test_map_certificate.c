/* Certificates of maps: each kind computes its own from what the map is, and sees what is wrong. */
#include "../../default_env.h"
#include "../../infos.h"
#include "../../mesh_domains.h"
#include "../../meshes.h"
#include "../../shape_domains.h"
#include "../../suite.h"
#include "map/map.h"
#include "map/plane/plane_kind.h"
#include "map/solid/solid_map.h"

/* What the kind of a map says of it. */
static icc_status judge(icc_map *map)
{
    const iccp_env env = default_env();
    icc_error err = {.size = sizeof err};
    map->info.certified = -1;
    const icc_status status = map->kind->certify(map, &env, &err);
    ck_assert_int_eq(map->info.certified, status == ICC_OK && map->info.reason == 0);
    ck_assert((err.message[0] != 0) == (status != ICC_OK));
    return status;
}

/* Puts a coordinate elsewhere, judges, and puts it back. */
static icc_status judge_with(icc_map *map, double *coordinate, double value)
{
    const double before = *coordinate;
    *coordinate = value;
    const icc_status status = judge(map);
    *coordinate = before;
    ck_assert_int_eq(judge(map), ICC_OK);
    return status;
}

static icc_domain *l_shape(double far)
{
    shape s = shape_l();
    s.xy[4] += far;
    return domain_of_shape(&s);
}

START_TEST(in_the_plane)
{
    icc_domain *source = l_shape(0), *target = l_shape(0.4);
    icc_map *map;
    ck_assert_int_eq(icc_map_create(&map, source, target, NULL, NULL, NULL), ICC_OK);
    const iccp_plmap *pl = &iccp_plane_of(map)->pl;
    size_t inner = 0, outer = 0;
    while (pl->fixed[inner] != ICCP_FREE)
        ++inner;
    while (pl->fixed[outer] == ICCP_FREE)
        ++outer;
    ck_assert_int_eq(judge(map), ICC_OK);
    ck_assert_int_eq(judge_with(map, &pl->images[2 * inner], 10), ICC_ERR_CERTIFICATE);
    ck_assert_int_eq(judge_with(map, &pl->points[2 * inner], 10), ICC_ERR_CERTIFICATE);
    ck_assert_int_eq(judge_with(map, &pl->images[2 * outer], 10), ICC_ERR_CERTIFICATE);
    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
}
END_TEST

START_TEST(in_space)
{
    random_source r = {1};
    icc_domain *cube;
    icc_map *map;
    test_mesh m = mesh_cube(3, 3, 0.1, &r);
    ck_assert_int_eq(mesh_domain(&cube, &m, NULL, NULL), ICC_OK);
    mesh_free(&m);
    ck_assert_int_eq(icc_map_create(&map, cube, cube, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(info_of_map(map).kind, ICC_MAP_MESH);
    const iccp_solid_map *solid = map->state;
    const size_t inner = 3 * solid->mesh->n_boundary;
    ck_assert_uint_lt(solid->mesh->n_boundary, solid->mesh->n_points);
    ck_assert_int_eq(judge(map), ICC_OK);
    ck_assert_int_eq(judge_with(map, &solid->images[inner], 10), ICC_ERR_CERTIFICATE);
    /* A vertex of the boundary that inverts nothing, but is not where the target has it. */
    ck_assert_int_eq(judge_with(map, &solid->images[0], solid->images[0] + 1e-9),
                     ICC_ERR_CERTIFICATE);
    icc_map_free(map);
    icc_domain_free(cube);
}
END_TEST

/* By charts that are certified, and by others. */
START_TEST(along_curves)
{
    const int32_t methods[] = {ICC_METHOD_FOLIATION, ICC_METHOD_GRADIENT};
    for (int k = 0; k < 2; ++k) {
        const icc_chart_options chart = {.size = sizeof chart, .method = methods[k], .cells = 20};
        const icc_map_options options = {
            .size = sizeof options, .kind = ICC_MAP_CURVES, .chart = &chart};
        icc_domain *source = l_shape(0), *target = l_shape(0.4);
        icc_map *map;
        ck_assert_int_eq(icc_map_create(&map, source, target, &options, NULL, NULL), ICC_OK);
        ck_assert_int_eq(info_of_map(map).certified, methods[k] == ICC_METHOD_FOLIATION);
        ck_assert_int_eq(judge(map), ICC_OK);
        ck_assert_int_eq(map->info.certified, methods[k] == ICC_METHOD_FOLIATION);
        icc_map_free(map);
        icc_domain_free(source);
        icc_domain_free(target);
    }
}
END_TEST

/* Maps without charts, and those that came of other maps, have certificates of their own. */
START_TEST(of_what_comes_of_a_map)
{
    icc_domain *source = l_shape(0), *target = l_shape(0.4), *next = l_shape(0.5);
    icc_map *map, *moved, *better;
    ck_assert_int_eq(icc_map_create(&map, source, target, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_retarget(&moved, map, next, 0, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_improve(&better, moved, NULL, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(info_of_map(moved).certified, 1);
    ck_assert_int_eq(info_of_map(better).certified, 1);
    ck_assert_int_eq(judge(moved), ICC_OK);
    ck_assert_int_eq(judge(better), ICC_OK);
    icc_map_free(map);
    icc_map_free(moved);
    icc_map_free(better);
    icc_domain_free(source);
    icc_domain_free(target);
    icc_domain_free(next);
}
END_TEST

int main(void)
{
    Suite *s = suite_create("certificates of maps");
    TCase *c = tcase_create("all");
    tcase_add_test(c, in_the_plane);
    tcase_add_test(c, in_space);
    tcase_add_test(c, along_curves);
    tcase_add_test(c, of_what_comes_of_a_map);
    suite_add_tcase(s, c);
    return suite_run(s);
}

/* The region of each simplex of a map's mesh: in the plane against the rings themselves, in space
 * against volumes, and 0 where there are no regions. */
#include "../../domains.h"
#include "../../faulty.h"
#include "../../feature_pairs.h"
#include "../../flat_mesh.h"
#include "../../infos.h"
#include "../../saved.h"
#include "../../suite.h"
#include "../../surfaces.h"

/* ---------------------------------------------------------------- plane */

/* The inner ring comes first, and runs clockwise. */
static void nested(plan *p)
{
    *p = plan_square(8);
    plan_feature(p, ICC_FEATURE_REGION, 4, (const double[]){3, 3, 3, 5, 5, 5, 5, 3});
    plan_feature(p, ICC_FEATURE_REGION, 4, (const double[]){1, 1, 7, 1, 7, 7, 1, 7});
    plan_feature(p, ICC_FEATURE_HOLE, 3, (const double[]){2, 2, 2.5, 2, 2, 2.5});
    plan_feature(p, ICC_FEATURE_LINE, 2, (const double[]){1, 7, 3, 5});
    plan_point(p, 0.5, 4);
}

/* A region with a hole, which an island fills in part, and a neighbour with a common border. */
static void island(plan *p)
{
    *p = (plan){.n_outer = 0};
    plan_feature(p, ICC_FEATURE_REGION, 4, (const double[]){0, 0, 4, 0, 4, 4, 0, 4});
    plan_feature(p, ICC_FEATURE_HOLE, 4, (const double[]){1, 1, 1, 3, 3, 3, 3, 1});
    plan_feature(p, ICC_FEATURE_REGION, 3, (const double[]){1.5, 1.5, 2.5, 1.5, 2, 2.5});
    plan_feature(p, ICC_FEATURE_REGION, 4, (const double[]){4, 0, 7, 0, 7, 4, 4, 4});
    plan_feature(p, ICC_FEATURE_LINE, 3, (const double[]){4, 0, 5, 2, 7, 4});
}

/* Regions that fill all, and one that repeats another. */
static void halves(plan *p)
{
    *p = plan_square(4);
    plan_feature(p, ICC_FEATURE_REGION, 3, (const double[]){0, 0, 4, 0, 4, 4});
    plan_feature(p, ICC_FEATURE_REGION, 3, (const double[]){0, 0, 4, 4, 0, 4});
    plan_feature(p, ICC_FEATURE_REGION, 3, (const double[]){4, 4, 0, 4, 0, 0});
}

static void no_regions(plan *p)
{
    *p = plan_square(4);
    plan_feature(p, ICC_FEATURE_LINE, 2, (const double[]){0, 0, 4, 4});
}

static void (*const MAKE[])(plan *) = {nested, island, halves, no_regions};
enum { N_SHAPES = sizeof MAKE / sizeof *MAKE };

static double area_of(size_t n, const double *xy)
{
    double twice = 0;
    for (size_t k = 0; k < n; ++k) {
        const double *a = xy + 2 * k, *b = xy + 2 * ((k + 1) % n);
        twice += a[0] * b[1] - b[0] * a[1];
    }
    return fabs(twice) / 2;
}

static bool is_within(size_t n, const double *xy, const double *x)
{
    bool odd = false;
    for (size_t k = 0; k < n; ++k) {
        const double *a = xy + 2 * k, *b = xy + 2 * ((k + 1) % n);
        if ((a[1] > x[1]) != (b[1] > x[1]))
            odd ^= x[0] < a[0] + (b[0] - a[0]) * (x[1] - a[1]) / (b[1] - a[1]);
    }
    return odd;
}

/* The smallest ring around a place; of equal ones, the first. */
static uint32_t region_at(const plan *p, const double *x)
{
    uint32_t found = 0, number = 0;
    double least = HUGE_VAL;
    size_t first = p->n_outer;
    for (size_t f = 0; f < p->n_features; first += p->feature[f++].n) {
        const double *xy = p->xy + 2 * first;
        if (p->feature[f].kind != ICC_FEATURE_REGION)
            continue;
        ++number;
        if (is_within(p->feature[f].n, xy, x) && area_of(p->feature[f].n, xy) < least) {
            least = area_of(p->feature[f].n, xy);
            found = number;
        }
    }
    return found;
}

static void check_plane(const icc_map *map, const plan *p)
{
    const icc_map_info info = info_of_map(map);
    double *points = malloc(2 * info.n_vertices * sizeof *points);
    uint32_t *corners = malloc(3 * info.n_simplices * sizeof *corners);
    uint32_t *regions = malloc(info.n_simplices * sizeof *regions);
    icc_error err = {.size = sizeof err};
    ck_assert(points != NULL && corners != NULL && regions != NULL);
    ck_assert_int_eq(flat_get_mesh(map, points, NULL, corners), ICC_OK);
    ck_assert_int_eq(icc_map_get_regions(map, regions, &err), ICC_OK);
    for (size_t t = 0; t < info.n_simplices; ++t) {
        double x[2] = {0, 0};
        for (size_t k = 0; k < 6; ++k)
            x[k % 2] += points[2 * corners[3 * t + k / 2] + k % 2] / 3;
        ck_assert_uint_eq(regions[t], region_at(p, x));
    }
    free(points);
    free(corners);
    free(regions);
}

START_TEST(regions_of_the_plane)
{
    plan p, moved;
    MAKE[_i](&p);
    moved = plan_moved(&p, 1.5, 0.25, -2);
    for (size_t v = 0; v < moved.n_vertices; ++v)
        moved.xy[2 * v] += 0.3 * sin(moved.xy[2 * v + 1]);
    icc_domain *source = plan_domain(&p), *target = plan_domain(&moved);
    const icc_improve_options options = {.size = sizeof options, .levels = 1};
    icc_map *map, *better, *loaded;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_map_create(&map, source, target, NULL, NULL, &err) == ICC_OK, "%s",
                  err.message);
    check_plane(map, &p);
    ck_assert_int_eq(icc_map_improve(&better, map, &options, NULL, NULL, NULL), ICC_OK);
    check_plane(better, &p);
    bytes saved = map_bytes(better);
    ck_assert_int_eq(icc_map_load(&loaded, saved.n, saved.data, NULL, NULL), ICC_OK);
    check_plane(loaded, &p);
    free(saved.data);
    icc_map_free(map);
    icc_map_free(better);
    icc_map_free(loaded);
    icc_domain_free(source);
    icc_domain_free(target);
}
END_TEST

/* Each allocation fails in turn. */
START_TEST(without_memory)
{
    plan p;
    faulty f = {0};
    const icc_env env = faulty_env(&f);
    nested(&p);
    icc_domain *source = plan_domain(&p);
    icc_map *map;
    ck_assert_int_eq(icc_map_create(&map, source, source, NULL, &env, NULL), ICC_OK);
    uint32_t *regions = malloc(info_of_map(map).n_simplices * sizeof *regions);
    const size_t n_live = f.n_live;
    icc_status status = ICC_ERR_MEMORY;
    for (f.fail_at = 1; status != ICC_OK; ++f.fail_at) {
        icc_error err = {.size = sizeof err};
        f.n_allocs = 0;
        status = icc_map_get_regions(map, regions, &err);
        ck_assert(status == ICC_OK || (status == ICC_ERR_MEMORY && err.message[0] != '\0'));
        ck_assert_uint_eq(f.n_live, n_live);
    }
    ck_assert_uint_gt(f.fail_at, 2);
    f.fail_at = 0;
    free(regions);
    icc_map_free(map);
    icc_domain_free(source);
}
END_TEST

/* ---------------------------------------------------------------- space */

enum { N_SURFACES = 3 };

/* An octahedron of radius 1 with two regions, the second one in the first one, and a void. */
static icc_domain *make_solid(double scale)
{
    static const int32_t KINDS[N_SURFACES] = {ICC_FEATURE_REGION, ICC_FEATURE_HOLE,
                                              ICC_FEATURE_REGION};
    static const double PLACES[N_SURFACES][2] = {{-0.25, 0.4}, {0.5, 0.1}, {-0.25, 0.2}};
    static surface outer, own[N_SURFACES];
    icc_feature features[N_SURFACES];
    surface_octahedron(&outer);
    for (size_t i = 0; i < 3 * outer.n_vertices; ++i)
        outer.vertices[i] *= scale;
    for (int f = 0; f < N_SURFACES; ++f) {
        surface_octahedron(&own[f]);
        for (size_t i = 0; i < 3 * own[f].n_vertices; ++i)
            own[f].vertices[i] =
                scale * (PLACES[f][1] * own[f].vertices[i] + (i % 3 == 0 ? PLACES[f][0] : 0));
        features[f] = (icc_feature){.size = sizeof(icc_feature),
                                    .kind = KINDS[f],
                                    .n_vertices = own[f].n_vertices,
                                    .vertices = own[f].vertices,
                                    .n_facets = own[f].n_faces,
                                    .facets = own[f].faces};
    }
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_domain_create_solid(&domain, outer.n_vertices, outer.vertices, outer.n_faces,
                                          outer.faces, N_SURFACES, features, NULL, &err) == ICC_OK,
                  "%s", err.message);
    return domain;
}

static double volume_of(const double *points, const uint32_t *v)
{
    double e[3][3];
    for (size_t k = 0; k < 9; ++k)
        e[k / 3][k % 3] = points[3 * v[1 + k / 3] + k % 3] - points[3 * v[0] + k % 3];
    return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
            e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
            e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
           6;
}

static void check_space(const icc_map *map)
{
    const icc_map_info info = info_of_map(map);
    const double whole = 4.0 / 3,
                 wanted[3] = {whole * (1 - 0.064 - 0.001), whole * (0.064 - 0.008), whole * 0.008};
    double *points = malloc(3 * info.n_vertices * sizeof *points), volume[3] = {0, 0, 0};
    uint32_t *corners = malloc(4 * info.n_simplices * sizeof *corners);
    uint32_t *regions = malloc(info.n_simplices * sizeof *regions);
    ck_assert(points != NULL && corners != NULL && regions != NULL);
    ck_assert_int_eq(flat_get_mesh(map, points, NULL, corners), ICC_OK);
    ck_assert_int_eq(icc_map_get_regions(map, regions, NULL), ICC_OK);
    for (size_t t = 0; t < info.n_simplices; ++t) {
        ck_assert_uint_le(regions[t], 2);
        volume[regions[t]] += volume_of(points, corners + 4 * t);
    }
    for (int k = 0; k < 3; ++k)
        ck_assert_double_eq_tol(volume[k], wanted[k], 1e-12);
    free(points);
    free(corners);
    free(regions);
}

START_TEST(regions_of_space)
{
    icc_domain *source = make_solid(1), *target = make_solid(1.5);
    const icc_improve_options options = {.size = sizeof options, .levels = 1};
    icc_map *map, *better, *loaded;
    ck_assert_int_eq(icc_map_create(&map, source, target, NULL, NULL, NULL), ICC_OK);
    check_space(map);
    ck_assert_int_eq(icc_map_improve(&better, map, &options, NULL, NULL, NULL), ICC_OK);
    check_space(better);
    bytes saved = map_bytes(better);
    ck_assert_int_eq(icc_map_load(&loaded, saved.n, saved.data, NULL, NULL), ICC_OK);
    check_space(loaded);
    free(saved.data);
    icc_map_free(map);
    icc_map_free(better);
    icc_map_free(loaded);
    icc_domain_free(source);
    icc_domain_free(target);
}
END_TEST

/* ---------------------------------------------------------------- others */

START_TEST(curve_maps_have_none)
{
    const double square[8] = {0, 0, 1, 0, 1, 1, 0, 1};
    const icc_map_options options = {.size = sizeof options, .kind = ICC_MAP_CURVES};
    icc_domain *domain;
    icc_map *map;
    uint32_t region;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_domain_create(&domain, 2, 4, square, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_create(&map, domain, domain, &options, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_get_regions(map, &region, &err), ICC_ERR_UNSUPPORTED);
    ck_assert_str_eq(err.message, "a curve map has no mesh, so it has no regions");
    ck_assert_int_eq(icc_map_get_regions(NULL, &region, &err), ICC_ERR_ARGUMENT);
    ck_assert_str_eq(err.message, "map is NULL");
    ck_assert_int_eq(icc_map_get_regions(map, NULL, &err), ICC_ERR_ARGUMENT);
    ck_assert_str_eq(err.message, "regions is NULL");
    icc_map_free(map);
    icc_domain_free(domain);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("map_regions");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 600);
    tcase_add_loop_test(tests, regions_of_the_plane, 0, N_SHAPES);
    tcase_add_test(tests, without_memory);
    tcase_add_test(tests, regions_of_space);
    tcase_add_test(tests, curve_maps_have_none);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

/* Surfaces that have little in common but their triangles: maps in space are of kind mesh, and
 * certified. */
#include "../flat_mesh.h"
#include "../reports.h"
#include <check.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <icc/icc.h>

#include "../determinant.h"
#include "../faulty.h"
#include "../saved.h"
#include "../share.h"
#include "../suite.h"
#include "../surfaces.h"

/* ---- shapes ---- */

typedef enum shape_kind { SPHERE, CUBE, BODY, PLATE } shape_kind;

/* Six limbs of that length along the axes of a ball, twisted by so many radians a unit of z. Or a
 * cube, flattened to that thickness and turned. */
typedef struct test_shape {
    shape_kind kind;
    double length, twist;
} test_shape;

static void place_on_cube(double *x)
{
    const double most = fmax(fabs(x[0]), fmax(fabs(x[1]), fabs(x[2])));
    for (size_t k = 0; k < 3; ++k)
        x[k] /= most;
}

static void place_on_body(double *x, const test_shape *shape)
{
    static const double RIM = 0.5; /* of a limb: an angle on the sphere */
    for (size_t k = 0; k < 3; ++k) {
        const size_t i = (k + 1) % 3, j = (k + 2) % 3;
        const double angle = acos(fmin(fabs(x[k]), 1)), side = hypot(x[i], x[j]);
        if (angle >= RIM)
            continue;
        const double along = 1 - angle / RIM;
        const double share = side > 0 ? sin(RIM) * sqrt(1 - along) / side : 0;
        x[k] = copysign(cos(RIM) + shape->length * along, x[k]);
        x[i] *= share;
        x[j] *= share;
        break;
    }
    const double c = cos(shape->twist * x[2]), s = sin(shape->twist * x[2]), first = x[0];
    x[0] = c * first - s * x[1];
    x[1] = s * first + c * x[1];
}

static void place_on_plate(double *x, double thickness)
{
    const double c = cos(0.7), s = sin(0.7);
    place_on_cube(x);
    x[2] *= thickness;
    for (size_t k = 0; k < 2; ++k) {
        const double first = x[k];
        x[k] = c * first - s * x[k + 1];
        x[k + 1] = s * first + c * x[k + 1];
    }
}

/* An octahedron's faces in 4^splits each, on the unit sphere and then on the shape. */
static icc_domain *domain_of(int splits, const test_shape *shape)
{
    static surface s;
    icc_error err = {.size = sizeof err};
    icc_domain *domain;
    surface_octahedron(&s);
    for (int k = 0; k < splits; ++k)
        surface_split(&s);
    for (size_t v = 0; v < s.n_vertices; ++v) {
        double *x = s.vertices + 3 * v;
        const double length = hypot(x[0], hypot(x[1], x[2]));
        for (size_t k = 0; k < 3; ++k)
            x[k] /= length;
        if (shape->kind == CUBE)
            place_on_cube(x);
        else if (shape->kind == BODY)
            place_on_body(x, shape);
        else if (shape->kind == PLATE)
            place_on_plate(x, shape->length);
    }
    ck_assert_msg(icc_domain_create(&domain, 3, s.n_vertices, s.vertices, s.n_faces, s.faces, NULL,
                                    &err) == ICC_OK,
                  "%s", err.message);
    return domain;
}

/* ---- maps ---- */

/* Six times the volume of a tetrahedron. */
static double volume_of(const double *points, const uint32_t *v)
{
    double edges[9];
    for (size_t i = 0; i < 9; ++i)
        edges[i] = points[3 * v[i / 3 + 1] + i % 3] - points[3 * v[0] + i % 3];
    return determinant(3, edges);
}

/* The mesh that is handed out begins with the vertices of the surface, before and after, and fills
 * both: volumes are positive and sum to those of the surfaces. */
static void check_mesh(const icc_map *map, const icc_map_info *info, const icc_domain *const d[2])
{
    double *x[2];
    uint32_t *corners = calloc(info->n_simplices, 4 * sizeof *corners);
    for (int k = 0; k < 2; ++k)
        x[k] = calloc(info->n_vertices, 3 * sizeof **x);
    ck_assert_int_eq(flat_get_mesh(map, x[0], x[1], corners), ICC_OK);
    for (int k = 0; k < 2; ++k) {
        icc_domain_info domain = {.size = sizeof domain};
        ck_assert_int_eq(icc_domain_get_info(d[k], &domain), ICC_OK);
        double *vertices = calloc(domain.n_vertices, 3 * sizeof *vertices), sum = 0;
        ck_assert_int_eq(icc_domain_get_boundary(d[k], vertices, NULL), ICC_OK);
        for (size_t i = 0; i < 3 * domain.n_vertices; ++i)
            ck_assert_double_eq_tol(vertices[i], x[k][i], 1e-14);
        for (size_t t = 0; t < info->n_simplices; ++t)
            sum += volume_of(x[k], corners + 4 * t) / 6;
        ck_assert_double_eq_tol(sum, domain.measure, 1e-9 * domain.measure);
        free(vertices);
        free(x[k]);
    }
    free(corners);
}

/* Points come back; and a map that was saved and loaded is the same. */
static void check_points(const icc_map *map)
{
    random_source r = {7};
    bytes saved = map_bytes(map);
    icc_map *loaded;
    ck_assert_int_eq(icc_map_load(&loaded, saved.n, saved.data, NULL, NULL), ICC_OK);
    for (int i = 0; i < 200; ++i) {
        double x[3], y[3], z[3], same[3];
        icc_status status;
        for (int k = 0; k < 3; ++k)
            x[k] = 0.8 * (random_unit(&r) - 0.5);
        ck_assert_int_eq(icc_map_apply(map, 1, x, y, &status, NULL, NULL), ICC_OK);
        ck_assert_int_eq(status, ICC_OK);
        ck_assert_int_eq(icc_map_apply(loaded, 1, x, same, &status, NULL, NULL), ICC_OK);
        ck_assert_same(y, same, sizeof y, "loaded map");
        ck_assert_int_eq(icc_map_apply_inverse(map, 1, y, z, &status, NULL, NULL), ICC_OK);
        ck_assert_int_eq(status, ICC_OK);
        for (int k = 0; k < 3; ++k)
            ck_assert_double_eq_tol(x[k], z[k], 1e-9);
    }
    icc_map_free(loaded);
    free(saved.data);
}

static void check_pair(const icc_domain *const d[2], const char *name, const icc_env *env)
{
    icc_error err = {.size = sizeof err};
    icc_map_info info = {.size = sizeof info};
    icc_map *map;
    ck_assert_msg(icc_map_create(&map, d[0], d[1], NULL, env, &err) == ICC_OK, "%s: %s", name,
                  err.message);
    ck_assert_int_eq(icc_map_get_info(map, &info), ICC_OK);
    ck_assert_msg(info.kind == ICC_MAP_MESH && info.certified == 1 &&
                      report_of(map).n_unrepaired == 0,
                  "%s: %zu tetrahedra are left", name, report_of(map).n_unrepaired);
    check_mesh(map, &info, d);
    check_points(map);
    icc_map_free(map);
}

static void check_both_ways(int splits, const test_shape *a, const test_shape *b)
{
    icc_domain *const d[2] = {domain_of(splits, a), domain_of(splits, b)};
    char name[100];
    (void)snprintf(name, sizeof name, "%d splits, shapes %d (%g, %g) and %d (%g, %g)", splits,
                   (int)a->kind, a->length, a->twist, (int)b->kind, b->length, b->twist);
    for (int k = 0; k < 2; ++k)
        check_pair((const icc_domain *const[2]){d[k], d[1 - k]}, name, NULL);
    icc_domain_free(d[0]);
    icc_domain_free(d[1]);
}

/* A ball's mesh has no points where limbs come from, and a cube's faces are flat: the inverse of a map
 * on the other mesh will do. */
START_TEST(bodies_spheres_cubes)
{
    check_both_ways(3, &(test_shape){BODY, 8, 0.6}, &(test_shape){SPHERE, 0, 0});
    check_both_ways(3, &(test_shape){BODY, 12, 0}, &(test_shape){CUBE, 0, 0});
    check_both_ways(3, &(test_shape){BODY, 8, 0.6}, &(test_shape){BODY, 4, -0.6});
}
END_TEST

/* Long limbs, much twisted: neither mesh will do as it is. */
static const test_shape STUCK[][2] = {
    {{BODY, 11.764130455090291, -0.54344699827679688}, {CUBE, 0, 0}},
    {{BODY, 11.798651096662216, -0.5059197956120548}, {SPHERE, 0, 0}},
    {{BODY, 6.7324459905756582, 0.7482038652394909}, {CUBE, 0, 0}},
    {{BODY, 12.642880156128776, 1.0468084025933282}, {CUBE, 0, 0}}};

START_TEST(points_are_added)
{
    for (size_t k = 0; k < sizeof STUCK / sizeof *STUCK; ++k)
        check_both_ways(2, &STUCK[k][0], &STUCK[k][1]);
}
END_TEST

static void note_pockets(void *is_there, const char *message)
{
    *(bool *)is_there |= strstr(message, "a pocket of") != NULL;
}

/* From either side a few tetrahedra are left. */
START_TEST(in_pockets)
{
    icc_domain *const d[2] = {domain_of(2, &STUCK[3][0]), domain_of(2, &STUCK[3][1])};
    for (int k = 0; k < 2; ++k) {
        bool is_there = false;
        const icc_env env = {.size = sizeof env, .log = note_pockets, .user = &is_there};
        check_pair((const icc_domain *const[2]){d[k], d[1 - k]}, "cube", &env);
        ck_assert(is_there);
    }
    icc_domain_free(d[0]);
    icc_domain_free(d[1]);
}
END_TEST

START_TEST(random_pairs)
{
    random_source r = {11};
    for (int k = share_of(40); k > 0; --k) {
        const test_shape body = {BODY, 1 + 7 * random_unit(&r), random_unit(&r) - 0.5};
        const test_shape other = {(shape_kind)(3 * random_unit(&r)), 1 + 4 * random_unit(&r),
                                  random_unit(&r) - 0.5};
        check_both_ways(k % 4 == 0 ? 4 : 3, &body, &other);
    }
}
END_TEST

/* Doubles hardly tell points in a plate from one another, so no map of kind mesh is found. Who asks
 * for that kind is told of kind 0. */
START_TEST(kinds_that_cannot_be_had)
{
    icc_domain *const d[2] = {domain_of(2, &(test_shape){PLATE, 1e-15, 0}),
                              domain_of(2, &(test_shape){BODY, 8, 0.6})};
    const icc_map_options mesh = {.size = sizeof mesh, .kind = ICC_MAP_MESH};
    icc_error err = {.size = sizeof err};
    icc_map_info info = {.size = sizeof info};
    icc_map *map;
    ck_assert_int_eq(icc_map_create(&map, d[0], d[1], NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_get_info(map, &info), ICC_OK);
    ck_assert_int_eq(info.kind, ICC_MAP_CURVES);
    ck_assert_uint_gt(report_of(map).n_unrepaired, 0);
    icc_map_free(map);
    ck_assert_int_eq(icc_map_create(&map, d[0], d[1], &mesh, NULL, &err), ICC_ERR_CERTIFICATE);
    ck_assert_ptr_null(map);
    ck_assert_msg(strstr(err.message, "tetrahedra") && strstr(err.message, "kind 0"), "%s",
                  err.message);
    icc_domain_free(d[0]);
    icc_domain_free(d[1]);
}
END_TEST

/* Inverses and points, on their way back: here and there from the first allocation and report to the
 * last. */
START_TEST(failures)
{
    for (size_t n = 0; n < 4; n += 3) {
        icc_domain *const d[2] = {domain_of(2, &STUCK[n][1]), domain_of(2, &STUCK[n][0])};
        icc_status status = ICC_ERR_MEMORY;
        for (size_t k = 1; status != ICC_OK; k = share_next(k + k / 2)) {
            faulty f = {.fail_at = k};
            const icc_env env = faulty_env(&f);
            icc_map *map;
            status = icc_map_create(&map, d[0], d[1], NULL, &env, NULL);
            ck_assert_int_eq(status, f.n_allocs < k ? ICC_OK : ICC_ERR_MEMORY);
            icc_map_free(map);
            ck_assert_uint_eq(f.n_live, 0);
        }
        status = ICC_ERR_CANCELLED;
        for (size_t k = 1; status != ICC_OK; k = share_next(k + k / 2)) {
            faulty f = {.cancel_at = k};
            const icc_env env = faulty_env(&f);
            icc_map *map;
            status = icc_map_create(&map, d[0], d[1], NULL, &env, NULL);
            ck_assert_int_eq(status, f.n_reports < k ? ICC_OK : ICC_ERR_CANCELLED);
            icc_map_free(map);
            ck_assert_uint_eq(f.n_live, 0);
        }
        icc_domain_free(d[0]);
        icc_domain_free(d[1]);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("surfaces that have little in common");
    TCase *tcase = tcase_create("all");
    tcase_set_timeout(tcase, 3600);
    tcase_add_test(tcase, bodies_spheres_cubes);
    tcase_add_test(tcase, points_are_added);
    tcase_add_test(tcase, in_pockets);
    tcase_add_test(tcase, random_pairs);
    tcase_add_test(tcase, kinds_that_cannot_be_had);
    tcase_add_test(tcase, failures);
    suite_add_tcase(suite, tcase);
    return suite_run(suite);
}

/* Method foliation on conforming meshes of any dimension: what the certificate promises holds in
 * doubles. */
#include <check.h>
#include <icc/stages.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../determinant.h"
#include "../domains.h"
#include "../faulty.h"
#include "../infos.h"
#include "../mesh_domains.h"
#include "../meshes.h"
#include "../random.h"
#include "../share.h"
#include "../suite.h"

enum { N_POINTS = 300, MAX = ICC_MAX_DIM };

/* A mesh before and after. */
typedef struct pair {
    int32_t dim;
    icc_domain *source, *target;
    double diagonal;
} pair;

/* Turns, bends and stretches, by about as much as the size of [0, 3]^dim allows. */
static void deform(int32_t dim, const double *x, double *y)
{
    const double angle = 0.2 * x[dim - 1], c = cos(angle), s = sin(angle);
    memcpy(y, x, (size_t)dim * sizeof *y);
    y[0] = 1.3 * (c * x[0] - s * x[1]);
    y[1] = s * x[0] + c * x[1] + 0.05 * x[0] * x[0];
    for (int32_t k = 2; k < dim; ++k)
        y[k] = x[k] + 0.1 * sin(x[0]);
}

static double diagonal_of(const icc_domain *domain)
{
    icc_domain_info info = {.size = sizeof info};
    double sum = 0;
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    for (int32_t k = 0; k < info.dim; ++k)
        sum += (info.upper[k] - info.lower[k]) * (info.upper[k] - info.lower[k]);
    return sqrt(sum);
}

/* Takes the meshes over. */
static pair pair_of(test_mesh source, test_mesh target)
{
    pair p = {
        .dim = source.dim, .source = domain_of_mesh(&source), .target = domain_of_mesh(&target)};
    p.diagonal = fmax(diagonal_of(p.source), diagonal_of(p.target));
    mesh_free(&source);
    mesh_free(&target);
    return p;
}

/* Two different meshes inside. */
static pair pair_of_cubes(int32_t dim, size_t n, random_source *r)
{
    test_mesh source = mesh_cube(dim, n, 0.1, r), target = mesh_cube(dim, n, 0.1, r);
    test_mesh moved = mesh_moved(&target, deform);
    mesh_free(&target);
    return pair_of(source, moved);
}

static void pair_free(pair *p)
{
    icc_domain_free(p->source);
    icc_domain_free(p->target);
}

/* Through the charts, which are what is tested. */
static const icc_map_options CURVES = {.size = sizeof CURVES, .kind = ICC_MAP_CURVES};

static icc_map *make_map(const pair *p)
{
    icc_error err = {.size = sizeof err};
    icc_map_info info = {.size = sizeof info};
    icc_map *map;
    ck_assert_msg(icc_map_create(&map, p->source, p->target, &CURVES, NULL, &err) == ICC_OK, "%s",
                  err.message);
    ck_assert_int_eq(icc_map_get_info(map, &info), ICC_OK);
    ck_assert(info.certified == 1 && info.kind == ICC_MAP_CURVES);
    for (int k = 0; k < 2; ++k) {
        const icc_chart *chart = k == 0 ? icc_map_source_chart(map) : icc_map_target_chart(map);
        const icc_chart_info common = info_of_chart(chart);
        icc_shelling_info own = {.size = sizeof own};
        ck_assert(common.certified == 1 && common.method == ICC_METHOD_FOLIATION);
        ck_assert_int_eq(icc_chart_get_shelling_info(chart, &own), ICC_OK);
        ck_assert(own.n_mesh_simplices > 0 && own.n_orders > 0);
        ck_assert(own.flux_divergence < 1e-12);
    }
    return map;
}

static double distance(int32_t dim, const double *a, const double *b)
{
    double sum = 0;
    for (int32_t k = 0; k < dim; ++k)
        sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sqrt(sum);
}

/* Every point inside has an image inside, and comes back. */
static void check_round_trip(random_source *r, const pair *p, const icc_map *map)
{
    const size_t dim = (size_t)p->dim;
    double points[N_POINTS * MAX], images[N_POINTS * MAX], back[N_POINTS * MAX];
    int32_t where[N_POINTS];
    size_t n_failed = 1;
    for (size_t i = 0; i < N_POINTS; ++i)
        domain_random_point(r, p->source, points + dim * i);
    ck_assert_int_eq(icc_map_apply(map, N_POINTS, points, images, NULL, &n_failed, NULL), ICC_OK);
    ck_assert_uint_eq(n_failed, 0);
    ck_assert_int_eq(icc_map_apply_inverse(map, N_POINTS, images, back, NULL, &n_failed, NULL),
                     ICC_OK);
    ck_assert_uint_eq(n_failed, 0);
    ck_assert_int_eq(icc_domain_locate(p->target, N_POINTS, images, where, NULL, NULL, NULL),
                     ICC_OK);
    for (size_t i = 0; i < N_POINTS; ++i) {
        ck_assert_int_ne(where[i], ICC_OUTSIDE);
        ck_assert_double_le(distance(p->dim, points + dim * i, back + dim * i),
                            1e-12 * p->diagonal);
    }
}

/* Boundary points keep their facet and barycentric coordinates, whatever face of it they lie on. */
static void check_boundary(random_source *r, const pair *p, const icc_map *map)
{
    const size_t dim = (size_t)p->dim;
    icc_domain_info info = {.size = sizeof info};
    const icc_domain *const domain[2] = {p->source, p->target};
    ck_assert_int_eq(icc_domain_get_info(p->source, &info), ICC_OK);
    uint32_t *facets = mesh_alloc(info.n_facets * dim, sizeof *facets);
    double *vertices[2];
    for (int k = 0; k < 2; ++k) {
        vertices[k] = mesh_alloc(info.n_vertices * dim, sizeof *vertices[k]);
        ck_assert_int_eq(icc_domain_get_boundary(domain[k], vertices[k], facets), ICC_OK);
    }
    for (int i = 0; i < N_POINTS; ++i) {
        const uint32_t *facet = facets + dim * (size_t)random_below(r, (int)info.n_facets);
        double bary[MAX], sum = 0, at[2][MAX] = {{0}}, image[MAX];
        icc_status status;
        while (!(sum > 0)) {
            for (size_t k = 0; k < dim; ++k)
                sum += bary[k] = random_below(r, 3) == 0 ? 0 : random_unit(r);
        }
        for (int side = 0; side < 2; ++side)
            for (size_t k = 0; k < dim; ++k)
                for (size_t c = 0; c < dim; ++c)
                    at[side][c] += bary[k] / sum * vertices[side][dim * facet[k] + c];
        ck_assert_int_eq(icc_map_apply(map, 1, at[0], image, &status, NULL, NULL), ICC_OK);
        ck_assert_int_eq(status, ICC_OK);
        ck_assert_double_le(distance(p->dim, image, at[1]), 1e-12 * p->diagonal);
    }
    free(facets);
    free(vertices[0]);
    free(vertices[1]);
}

/* Positive, and what differences say but where a kink lies between. */
static void check_jacobians(random_source *r, const pair *p, const icc_map *map)
{
    const size_t dim = (size_t)p->dim;
    const double h = 1e-7;
    int n_close = 0;
    for (int i = 0; i < N_POINTS; ++i) {
        double x[MAX], jacobian[MAX * MAX], worst = 0, largest = 0;
        icc_status status;
        domain_random_point(r, p->source, x);
        ck_assert_int_eq(icc_map_jacobian(map, 1, x, jacobian, &status, NULL, NULL), ICC_OK);
        ck_assert_int_eq(status, ICC_OK);
        ck_assert_double_gt(determinant(p->dim, jacobian), 0);
        for (size_t j = 0; j < dim; ++j) {
            double low[MAX], high[MAX], y[MAX], z[MAX];
            memcpy(low, x, sizeof x);
            memcpy(high, x, sizeof x);
            low[j] -= h;
            high[j] += h;
            (void)icc_map_apply(map, 1, low, y, NULL, NULL, NULL);
            (void)icc_map_apply(map, 1, high, z, NULL, NULL, NULL);
            for (size_t k = 0; k < dim; ++k) {
                worst = fmax(worst, fabs((z[k] - y[k]) / (2 * h) - jacobian[dim * k + j]));
                largest = fmax(largest, fabs(jacobian[dim * k + j]));
            }
        }
        n_close += worst < 1e-5 * largest;
    }
    ck_assert_int_ge(n_close, N_POINTS * 95 / 100);
}

/* From the boundary through the point to the maximum; everything on it has the same boundary point,
 * and t rises by arc length. */
static void check_curve(const icc_chart *chart, const double *point, int32_t dim, double diagonal)
{
    enum { ROOM = 4000 };
    static double curve[ROOM * MAX];
    size_t n;
    uint32_t facet;
    double bary[MAX], t, start[MAX], length = 0, so_far = 0, nearest = HUGE_VAL;
    icc_status status;
    ck_assert_int_eq(icc_chart_trace(chart, point, ROOM, curve, &n, NULL, NULL), ICC_OK);
    ck_assert(n >= 2 && n <= ROOM);
    for (size_t i = 1; i < n; ++i)
        length += distance(dim, curve + (size_t)dim * (i - 1), curve + (size_t)dim * i);
    for (size_t i = 0; i < n; ++i) {
        const double *x = curve + (size_t)dim * i;
        so_far += i > 0 ? distance(dim, x - dim, x) : 0;
        nearest = fmin(nearest, distance(dim, x, point));
        ck_assert_int_eq(icc_chart_encode(chart, 1, x, &facet, bary, &t, &status, NULL, NULL),
                         ICC_OK);
        ck_assert_int_eq(status, ICC_OK);
        ck_assert_double_le(fabs(t - so_far / length), 1e-9);
        t = 0;
        ck_assert_int_eq(icc_chart_decode(chart, 1, &facet, bary, &t, start, &status, NULL, NULL),
                         ICC_OK);
        ck_assert(i + 1 == n || so_far > 0.99 * length ||
                  distance(dim, start, curve) < 1e-9 * diagonal);
    }
    ck_assert_double_le(nearest, 1e-13 * diagonal);
    const icc_chart_info info = info_of_chart(chart);
    ck_assert_double_le(distance(dim, info.maximum, curve + (size_t)dim * (n - 1)),
                        1e-14 * diagonal);
}

static void check_pair(random_source *r, pair p)
{
    icc_map *map = make_map(&p);
    check_round_trip(r, &p, map);
    check_boundary(r, &p, map);
    check_jacobians(r, &p, map);
    for (int i = 0; i < 10; ++i) {
        double x[MAX];
        domain_random_point(r, p.source, x);
        check_curve(icc_map_source_chart(map), x, p.dim, p.diagonal);
    }
    icc_map_free(map);
    pair_free(&p);
}

START_TEST(cubes)
{
    random_source r = {1};
    for (int32_t dim = 2; dim <= 4; ++dim)
        for (size_t n = 2; n <= (dim < 4 ? 5 : 3); ++n)
            check_pair(&r, pair_of_cubes(dim, n, &r));
}
END_TEST

START_TEST(balls)
{
    random_source r = {2};
    for (int32_t dim = 2; dim <= 4; ++dim) {
        test_mesh source = mesh_ball(dim, 4 - (size_t)dim / 4, 0.1, &r);
        test_mesh target = mesh_moved(&source, deform);
        check_pair(&r, pair_of(source, target));
    }
}
END_TEST

/* Beyond four dimensions, and without vertices inside: one is put in. */
START_TEST(no_vertex_inside)
{
    random_source r = {3};
    for (int32_t dim = 2; dim <= 5; ++dim)
        check_pair(&r, pair_of_cubes(dim, 1, &r));
    for (int32_t dim = 2; dim <= 6; ++dim) {
        test_mesh one = mesh_of(dim, (size_t)dim + 1, 1);
        for (size_t i = 0; i <= (size_t)dim; ++i) {
            one.simplices[i] = (uint32_t)i;
            for (size_t k = 0; k < (size_t)dim; ++k)
                one.vertices[(size_t)dim * i + k] = i == k + 1;
        }
        test_mesh moved = mesh_moved(&one, deform);
        check_pair(&r, pair_of(one, moved));
    }
}
END_TEST

/* Nothing moves, also when the whole is far away or tiny. */
START_TEST(identity)
{
    random_source r = {4};
    static const double SCALE[] = {1, 1e-9, 1e9}, SHIFT[] = {0, 1e-3, 1e12};
    for (int k = 0; k < 3; ++k) {
        test_mesh m = mesh_cube(3, 4, 0.1, &r);
        for (size_t i = 0; i < 3 * m.n_vertices; ++i)
            m.vertices[i] = SHIFT[k] + SCALE[k] * m.vertices[i];
        pair p = pair_of(m, mesh_copy(&m));
        icc_map *map = make_map(&p);
        for (int i = 0; i < N_POINTS; ++i) {
            double x[3], y[3];
            domain_random_point(&r, p.source, x);
            ck_assert_int_eq(icc_map_apply(map, 1, x, y, NULL, NULL, NULL), ICC_OK);
            ck_assert_double_le(distance(3, x, y), 1e-12 * p.diagonal);
        }
        icc_map_free(map);
        pair_free(&p);
    }
}
END_TEST

/* Vertices, and points on edges and faces, of the mesh are points as others are. */
START_TEST(faces_of_the_mesh)
{
    random_source r = {5};
    for (int32_t dim = 2; dim <= 4; ++dim) {
        const size_t n = (size_t)dim + 1;
        test_mesh source = mesh_cube(dim, 3, 0.1, &r), target = mesh_moved(&source, deform);
        test_mesh kept = mesh_copy(&source);
        pair p = pair_of(source, target);
        icc_map *map = make_map(&p);
        for (int i = 0; i < share_of(3000); ++i) {
            const uint32_t *corner =
                kept.simplices + n * (size_t)random_below(&r, (int)kept.n_simplices);
            double x[MAX] = {0}, y[MAX], z[MAX], sum = 0, bary[MAX + 1];
            icc_status status[2];
            while (!(sum > 0))
                for (size_t k = 0; k < n; ++k)
                    sum += bary[k] = random_below(&r, 2) == 0 ? 0 : 1 + random_below(&r, 3);
            for (size_t k = 0; k < n; ++k)
                for (size_t c = 0; c < (size_t)dim; ++c)
                    x[c] += bary[k] / sum * kept.vertices[(size_t)dim * corner[k] + c];
            ck_assert_int_eq(icc_map_apply(map, 1, x, y, &status[0], NULL, NULL), ICC_OK);
            ck_assert_int_eq(icc_map_apply_inverse(map, 1, y, z, &status[1], NULL, NULL), ICC_OK);
            ck_assert(status[0] == ICC_OK && status[1] == ICC_OK);
            ck_assert_double_le(distance(dim, x, z), 1e-12 * p.diagonal);
        }
        icc_map_free(map);
        pair_free(&p);
        mesh_free(&kept);
    }
}
END_TEST

/* Outside is outside, t = 0 and t = 1 are exact, and a given maximum is the nearest vertex
 * inside. */
START_TEST(ends)
{
    random_source r = {6};
    test_mesh m = mesh_cube(3, 4, 0, &r);
    icc_domain *domain = domain_of_mesh(&m);
    icc_error err = {.size = sizeof err};
    const double wish[3] = {1.1, 2.9, 2.2}, outside[3] = {1, 1, -1e-9}, corner[3] = {4, 4, 4};
    const icc_chart_options options = {.size = sizeof options, .maximum = wish};
    icc_chart *chart;
    uint32_t facet;
    double bary[3], t, x[3];
    icc_status status;
    ck_assert_msg(icc_chart_create(&chart, domain, &options, NULL, &err) == ICC_OK, "%s",
                  err.message);
    const icc_chart_info info = info_of_chart(chart);
    ck_assert(info.maximum[0] == 1 && info.maximum[1] == 3 && info.maximum[2] == 2);
    ck_assert_int_eq(
        icc_chart_encode(chart, 1, info.maximum, &facet, bary, &t, &status, NULL, NULL), ICC_OK);
    ck_assert(status == ICC_OK && t == 1 && facet == 0 && bary[0] == bary[1]);
    ck_assert_int_eq(icc_chart_decode(chart, 1, &facet, bary, &t, x, &status, NULL, NULL), ICC_OK);
    ck_assert(status == ICC_OK && memcmp(x, info.maximum, sizeof x) == 0);
    ck_assert_int_eq(icc_chart_encode(chart, 1, outside, &facet, bary, &t, &status, NULL, NULL),
                     ICC_OK);
    ck_assert_int_eq(status, ICC_ERR_OUTSIDE);
    ck_assert_int_eq(icc_chart_encode(chart, 1, corner, &facet, bary, &t, &status, NULL, NULL),
                     ICC_OK);
    ck_assert(status == ICC_OK && t == 0);
    ck_assert_int_eq(icc_chart_decode(chart, 1, &facet, bary, &t, x, &status, NULL, NULL), ICC_OK);
    ck_assert(status == ICC_OK && memcmp(x, corner, sizeof x) == 0);
    icc_chart_free(chart);
    const icc_chart_options beyond = {.size = sizeof beyond, .maximum = outside};
    ck_assert_int_eq(icc_chart_create(&chart, domain, &beyond, NULL, &err), ICC_ERR_OUTSIDE);
    ck_assert_ptr_null(chart);
    icc_domain_free(domain);
    mesh_free(&m);
}
END_TEST

/* A million times thinner than wide, one way and then the other: an image is rounded to 1e-16 of
 * its domain's size, 1e-10 of its thickness, which the way back makes 1e-10 of the size. */
START_TEST(thin)
{
    random_source r = {10};
    for (int32_t dim = 2; dim <= 3; ++dim) {
        test_mesh source = mesh_cube(dim, 4, 0.1, &r), target = mesh_cube(dim, 4, 0.1, &r);
        for (size_t v = 0; v < source.n_vertices; ++v) {
            source.vertices[(size_t)dim * v] *= 1e-6;
            target.vertices[(size_t)dim * v + 1] *= 1e-6;
        }
        pair p = pair_of(source, target);
        icc_map *map = make_map(&p);
        p.diagonal *= 1e4;
        check_round_trip(&r, &p, map);
        icc_map_free(map);
        pair_free(&p);
    }
}
END_TEST

/* In the plane a chart with a mesh of the caller's and one with the library's go together. */
START_TEST(two_kinds_of_mesh)
{
    random_source r = {11};
    pair p = pair_of_cubes(2, 5, &r);
    icc_domain_info info = {.size = sizeof info};
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_domain_get_info(p.target, &info), ICC_OK);
    double *vertices = mesh_alloc(2 * info.n_vertices, sizeof *vertices);
    uint32_t *facets = mesh_alloc(2 * info.n_facets, sizeof *facets);
    ck_assert_int_eq(icc_domain_get_boundary(p.target, vertices, facets), ICC_OK);
    icc_domain_free(p.target);
    ck_assert_int_eq(icc_domain_create(&p.target, 2, info.n_vertices, vertices, info.n_facets,
                                       facets, NULL, NULL),
                     ICC_OK);
    icc_chart *charts[2];
    ck_assert_int_eq(icc_chart_create(&charts[0], p.source, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_chart_create(&charts[1], p.target, NULL, NULL, NULL), ICC_OK);
    for (int k = 0; k < 2; ++k) {
        icc_map *map;
        ck_assert_msg(
            icc_map_create_from_charts(&map, charts[k], charts[1 - k], NULL, NULL, &err) == ICC_OK,
            "%s", err.message);
        const pair way = {.dim = 2,
                          .source = k == 0 ? p.source : p.target,
                          .target = k == 0 ? p.target : p.source,
                          .diagonal = p.diagonal};
        check_round_trip(&r, &way, map);
        icc_map_free(map);
    }
    icc_map *map;
    ck_assert_msg(icc_map_create(&map, p.source, p.target, &CURVES, NULL, &err) == ICC_OK, "%s",
                  err.message);
    icc_map_free(map);
    icc_chart_free(charts[0]);
    icc_chart_free(charts[1]);
    pair_free(&p);
    free(vertices);
    free(facets);
}
END_TEST

/* Without a mesh there is no foliation in space, and the message says what would help. */
START_TEST(without_a_mesh)
{
    const size_t shape[3] = {1, 1, 1};
    const uint8_t cells[1] = {1};
    icc_domain *domain;
    icc_chart *chart;
    icc_error err = {.size = sizeof err};
    const icc_chart_options options = {.size = sizeof options, .method = ICC_METHOD_FOLIATION};
    ck_assert_int_eq(icc_domain_create_mask(&domain, 3, shape, cells, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_chart_create(&chart, domain, &options, NULL, &err), ICC_ERR_UNSUPPORTED);
    ck_assert_ptr_nonnull(strstr(err.message, "icc_domain_create_mesh"));
    icc_domain_free(domain);
}
END_TEST

static icc_status call_create(const icc_env *env, icc_error *err, void *argument)
{
    const pair *p = argument;
    icc_map *map = NULL;
    const icc_status status = icc_map_create(&map, p->source, p->target, &CURVES, env, err);
    ck_assert((map != NULL) == (status == ICC_OK));
    icc_map_free(map);
    return status;
}

START_TEST(failures)
{
    random_source r = {7};
    for (size_t n = 1; n <= 2; ++n) {
        pair p = pair_of_cubes(2 + (int32_t)n % 2, n, &r);
        faulty_sweep(call_create, &p);
        pair_free(&p);
    }
}
END_TEST

/* The same bits for every number of threads, map and all. */
START_TEST(threads)
{
    random_source r = {8};
    pair p = pair_of_cubes(3, 5, &r);
    enum { N = 2000 };
    static double points[3 * N], images[2][3 * N];
    for (size_t i = 0; i < N; ++i)
        domain_random_point(&r, p.source, points + 3 * i);
    for (int k = 0; k < 2; ++k) {
        const icc_env env = {.size = sizeof env, .threads = k == 0 ? 1 : 4};
        icc_map *map;
        ck_assert_int_eq(icc_map_create(&map, p.source, p.target, &CURVES, &env, NULL), ICC_OK);
        ck_assert_int_eq(icc_map_apply(map, N, points, images[k], NULL, NULL, &env), ICC_OK);
        icc_map_free(map);
    }
    ck_assert(memcmp(images[0], images[1], sizeof images[0]) == 0);
    pair_free(&p);
}
END_TEST

/* Real surfaces, where they and tetgen are. */
START_TEST(surfaces)
{
    random_source r = {9};
    static const char *const NAMES[] = {"t01_cube_bend", "t06_spikes_sphere", "t08_fox"};
    for (int k = 0; k < 3; ++k) {
        test_mesh source, target;
        if (!mesh_of_data(&source, NAMES[k], "src", "shelling_chart"))
            continue;
        if (mesh_of_data(&target, NAMES[k], "tgt", "shelling_chart"))
            check_pair(&r, pair_of(source, target));
        else
            mesh_free(&source);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("shelling chart");
    TCase *tests = tcase_create("shelling chart");
    tcase_add_test(tests, cubes);
    tcase_add_test(tests, balls);
    tcase_add_test(tests, no_vertex_inside);
    tcase_add_test(tests, identity);
    tcase_add_test(tests, faces_of_the_mesh);
    tcase_add_test(tests, ends);
    tcase_add_test(tests, thin);
    tcase_add_test(tests, two_kinds_of_mesh);
    tcase_add_test(tests, without_a_mesh);
    tcase_add_test(tests, failures);
    tcase_add_test(tests, threads);
    tcase_add_test(tests, surfaces);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

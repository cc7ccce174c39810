/* Maps of method field are certified as maps: whatever the target, if there is a certificate, every
 * point has an image, comes back from it, and is turned nowhere. */
#include <check.h>
#include <icc/icc.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../determinant.h"
#include "../random.h"
#include "../suite.h"
#include "../surfaces.h"

enum { N_POINTS = 400, N_DERIVATIVES = 60, N_OUTLINE = 120 };

static icc_map *make_map(int32_t dim, size_t n_vertices, const double *from, const double *to,
                         size_t n_facets, const uint32_t *facets)
{
    icc_domain *source, *target;
    icc_map *map;
    icc_error err = {.size = sizeof err};
    const icc_chart_options chart = {.size = sizeof chart, .method = ICC_METHOD_FIELD};
    const icc_map_options options = {
        .size = sizeof options, .kind = ICC_MAP_CURVES, .chart = &chart};
    ck_assert_msg(icc_domain_create(&source, dim, n_vertices, from, n_facets, facets, NULL, &err) ==
                      ICC_OK,
                  "%s", err.message);
    ck_assert_msg(icc_domain_create(&target, dim, n_vertices, to, n_facets, facets, NULL, &err) ==
                      ICC_OK,
                  "%s", err.message);
    ck_assert_msg(icc_map_create(&map, source, target, &options, NULL, &err) == ICC_OK, "%s",
                  err.message);
    icc_domain_free(source);
    icc_domain_free(target);
    return map;
}

static void fill_inside(random_source *r, const icc_domain *domain, double *points)
{
    icc_domain_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    for (size_t i = 0; i < N_POINTS;) {
        int32_t where;
        double *point = points + (size_t)info.dim * i;
        for (int32_t k = 0; k < info.dim; ++k)
            point[k] = random_between(r, info.lower[k], info.upper[k]);
        ck_assert_int_eq(icc_domain_locate(domain, 1, point, &where, NULL, NULL, NULL), ICC_OK);
        i += where == ICC_INSIDE;
    }
}

static icc_domain_info shape_of(const icc_chart *chart)
{
    icc_domain_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_get_info(icc_chart_domain(chart), &info), ICC_OK);
    return info;
}

/* The largest distance from there and back, of the diagonal; infinite where there is no image. */
static double worst_return(const icc_map *map, const icc_domain_info *shape, const double *points,
                           bool inverse)
{
    static double images[N_POINTS * 3], back[N_POINTS * 3];
    const size_t dim = (size_t)shape->dim;
    double diagonal = 0, worst = 0;
    for (size_t k = 0; k < dim; ++k)
        diagonal = hypot(diagonal, shape->upper[k] - shape->lower[k]);
    icc_status (*there)(const icc_map *, size_t, const double *, double *, icc_status *, size_t *,
                        const icc_env *) = inverse ? icc_map_apply_inverse : icc_map_apply;
    icc_status (*again)(const icc_map *, size_t, const double *, double *, icc_status *, size_t *,
                        const icc_env *) = inverse ? icc_map_apply : icc_map_apply_inverse;
    ck_assert_int_eq(there(map, N_POINTS, points, images, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(again(map, N_POINTS, images, back, NULL, NULL, NULL), ICC_OK);
    for (size_t i = 0; i < N_POINTS; ++i) {
        double away = 0;
        for (size_t k = 0; k < dim; ++k)
            away = hypot(away, back[dim * i + k] - points[dim * i + k]);
        worst = fmax(worst, isfinite(away) ? away / diagonal : HUGE_VAL);
    }
    return worst;
}

/* How many determinants are not positive, and how many next to nothing. */
static void count_turned(const icc_map *map, double ratio, const double *points, size_t *n_turned,
                         size_t *n_flat)
{
    static double jacobians[N_DERIVATIVES * 9];
    icc_map_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_map_get_info(map, &info), ICC_OK);
    ck_assert_int_eq(icc_map_jacobian(map, N_DERIVATIVES, points, jacobians, NULL, NULL, NULL),
                     ICC_OK);
    *n_turned = *n_flat = 0;
    for (size_t i = 0; i < N_DERIVATIVES; ++i) {
        const double d = determinant(info.dim, jacobians + (size_t)(info.dim * info.dim) * i);
        *n_turned += !(d > 0);
        *n_flat += !(d >= 1e-6 * ratio);
    }
}

/* Whether the map is certified; if so it has to hold, and if not there has to be a reason. */
static bool check_promise(const char *name, icc_map *map)
{
    static double points[N_POINTS * 3];
    random_source r = {7};
    icc_map_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_map_get_info(map, &info), ICC_OK);
    ck_assert_msg((info.reason == ICC_REASON_NONE) == (info.certified == 1), "%s: reason %d", name,
                  (int)info.reason);
    const icc_chart *const charts[2] = {icc_map_source_chart(map), icc_map_target_chart(map)};
    const icc_domain_info shapes[2] = {shape_of(charts[0]), shape_of(charts[1])};
    for (int side = 0; side < 2 && info.certified; ++side) {
        fill_inside(&r, icc_chart_domain(charts[side]), points);
        const double away = worst_return(map, &shapes[side], points, side == 1);
        ck_assert_msg(away <= 1e-6, "%s: side %d comes back %g off", name, side, away);
        size_t n_turned, n_flat;
        if (side == 1)
            continue;
        count_turned(map, shapes[1].measure / shapes[0].measure, points, &n_turned, &n_flat);
        ck_assert_msg(n_turned == 0 && n_flat <= 1, "%s: %zu turned, %zu flat", name, n_turned,
                      n_flat);
    }
    icc_map_free(map);
    return info.certified;
}

static surface ball;

/* Scaled along the axes, bent, and then turned by an angle about (1, 1, 1). */
static void place_surface(double *to, const double scale[3], double bend, double angle)
{
    const double c = cos(angle), s = sin(angle) / sqrt(3), d = (1 - cos(angle)) / 3;
    for (size_t v = 0; v < ball.n_vertices; ++v) {
        double x[3];
        for (int k = 0; k < 3; ++k)
            x[k] = scale[k] * ball.vertices[3 * v + (size_t)k];
        x[1] += bend * x[0] * x[0];
        const double sum = x[0] + x[1] + x[2];
        for (size_t k = 0; k < 3; ++k)
            to[3 * v + k] = c * x[k] + d * sum + s * (x[(k + 2) % 3] - x[(k + 1) % 3]);
    }
}

/* Flat, long and turned: those that are mild keep their certificate, the others lose it. */
START_TEST(balls)
{
    static const struct {
        double from[3], to[3], bend, angle;
        int certified; /* 1 or 0; -1: either will do */
    } CASES[] = {
        {{1, 1, 1}, {1, 1.2, 0.8}, 0.3, 0, 1}, {{1, 1, 1}, {1, 1, 0.3}, 0, 0.6, 1},
        {{1, 1, 1}, {3, 1, 1}, 0.1, 1, 1},     {{1, 1, 1}, {1, 1, 0.1}, 0, 0, -1},
        {{1, 1, 1}, {1, 1, 0.02}, 0, 0, 0},    {{1, 1, 1}, {1, 1, 0.03}, 0.1, 0.5, 0},
        {{1, 1, 0.03}, {1, 1, 1}, 0, 0, 0},    {{1, 1, 1}, {20, 1, 1}, 0, 0.4, 0},
        {{1, 1, 1}, {8, 1, 1}, 0.02, 0, -1},   {{1, 1, 0.2}, {1, 1, 0.2}, 0.2, 0.7, 1},
    };
    random_source r = {1};
    surface_star(&ball, 2, 0, &r);
    const size_t n = ball.n_vertices;
    double *from = malloc(3 * n * sizeof *from), *to = malloc(3 * n * sizeof *to);
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; ++k) {
        char name[40];
        (void)snprintf(name, sizeof name, "ball %zu", k);
        place_surface(from, CASES[k].from, 0, 0);
        place_surface(to, CASES[k].to, CASES[k].bend, CASES[k].angle);
        const int certified =
            check_promise(name, make_map(3, n, from, to, ball.n_faces, ball.faces));
        ck_assert_msg(CASES[k].certified < 0 || certified == CASES[k].certified, "%s: certified %d",
                      name, certified);
    }
    free(from);
    free(to);
}
END_TEST

/* In the plane, from discs and from flat ellipses. */
START_TEST(ellipses)
{
    static const double HEIGHTS[] = {0.6, 0.25, 0.15, 0.1, 0.07, 0.04, 0.02};
    double round_one[2 * N_OUTLINE], flat[2 * N_OUTLINE];
    for (int k = 0; k < 7; ++k) {
        char name[40];
        (void)snprintf(name, sizeof name, "ellipse of height %g", HEIGHTS[k]);
        for (int i = 0; i < N_OUTLINE; ++i) {
            const double angle = 8 * atan(1) * i / N_OUTLINE;
            round_one[2 * i] = cos(angle);
            round_one[2 * i + 1] = sin(angle);
            flat[2 * i] = cos(angle) * cos(0.3) - HEIGHTS[k] * sin(angle) * sin(0.3);
            flat[2 * i + 1] = cos(angle) * sin(0.3) + HEIGHTS[k] * sin(angle) * cos(0.3);
        }
        const bool onto = check_promise(name, make_map(2, N_OUTLINE, round_one, flat, 0, NULL));
        const bool from = check_promise(name, make_map(2, N_OUTLINE, flat, round_one, 0, NULL));
        ck_assert(k > 1 || (onto && from));
        ck_assert(k < 4 || !(onto || from));
    }
}
END_TEST

/* A band about a curve: up one side and down the other. */
static void band(double (*xy)[2], bool spiral, double width)
{
    enum { HALF = N_OUTLINE / 2 };
    for (int i = 0; i < HALF; ++i) {
        const double t = (double)i / (HALF - 1), angle = 7 * t, radius = 1 + 0.35 * angle;
        const double x[2] = {spiral ? radius * cos(angle) : 14 * t,
                             spiral ? radius * sin(angle) : 0};
        const double out[2] = {spiral ? cos(angle) : 0, spiral ? sin(angle) : -1};
        for (int k = 0; k < 2; ++k) {
            xy[i][k] = x[k] + width * out[k];
            xy[N_OUTLINE - 1 - i][k] = x[k] - width * out[k];
        }
    }
}

/* A rod rolled up, thick or thin, and flattened to a thinner one. */
START_TEST(rods)
{
    static const double WIDTHS[] = {0.8, 0.4, 0.2};
    for (int k = 0; k < 3; ++k) {
        double rod[N_OUTLINE][2], spiral[N_OUTLINE][2], thin[N_OUTLINE][2];
        band(rod, false, WIDTHS[k]);
        band(spiral, true, WIDTHS[k]);
        band(thin, true, 0.1 * WIDTHS[k]);
        const bool rolled =
            check_promise("spiral", make_map(2, N_OUTLINE, &rod[0][0], &spiral[0][0], 0, NULL));
        ck_assert(k > 0 || rolled);
        (void)check_promise("thin spiral",
                            make_map(2, N_OUTLINE, &rod[0][0], &thin[0][0], 0, NULL));
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("field round trip");
    TCase *tests = tcase_create("field round trip");
    tcase_add_test(tests, balls);
    tcase_add_test(tests, ellipses);
    tcase_add_test(tests, rods);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

#include <icc/icc.h>

#include "../../faulty.h"
#include "../../suite.h"

#include <check.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

/* A bent plate: an outline without symmetry, two holes, two lines, three points of which one has a
 * radius. */
enum { N_OUTER = 40, N_HOLE = 24, N_LINE = 21, N_FEATURES = 7 };

typedef struct plate {
    double outer[2 * 2 * N_OUTER], part[N_FEATURES][2 * 2 * N_HOLE];
    size_t n_outer;
    icc_feature feature[N_FEATURES];
} plate;

static void bend(double *out, double x, double y, double by)
{
    out[0] = x + by * y * y;
    out[1] = y - by * .5 * x * x + .3 * by * x;
}

/* A closed curve round (x, y), from a place on, with `n` vertices, in either sense. */
static void ring(double *xy, size_t n, double x, double y, double size, double from, bool is_back,
                 double by)
{
    for (size_t k = 0; k < n; ++k) {
        const double t = 6.283185307179586 * (from + (double)(is_back ? n - k : k) / (double)n);
        const double r = size * (1 + .25 * cos(t - 1) + .2 * cos(3 * t + .4));
        bend(xy + 2 * k, x + r * cos(t), y + r * sin(t), by);
    }
}

static void line(double *xy, size_t n, const double *ends, bool is_back, double by)
{
    for (size_t k = 0; k < n; ++k) {
        const double f = (double)(is_back ? n - 1 - k : k) / (double)(n - 1);
        bend(xy + 2 * k, ends[0] + f * (ends[2] - ends[0]),
             ends[1] + f * (ends[3] - ends[1]) + .1 * sin(5 * f), by);
    }
}

static const double hole[2][3] = {{-.5, .1, .15}, {.45, .3, .2}};
static const double ends[2][4] = {{-.6, -.4, .1, -.5}, {0, .1, .1, .6}};
static const double point[3][2] = {{.2, -.15}, {.3, -.25}, {-.1, -.2}};

/* Everything in the order of `order`: 0 and 1 holes, 2 and 3 lines, 4 .. 6 points. */
static void make(plate *p, const int *order, size_t more, double from, bool is_back, double by)
{
    p->n_outer = N_OUTER + more;
    ring(p->outer, p->n_outer, 0, 0, 1, from, is_back, by);
    for (size_t k = 0; k < N_FEATURES; ++k) {
        const int which = order[k];
        icc_feature *const f = &p->feature[k];
        *f = (icc_feature){.size = sizeof *f, .vertices = p->part[k]};
        f->kind = which < 2 ? ICC_FEATURE_HOLE : which < 4 ? ICC_FEATURE_LINE : ICC_FEATURE_POINT;
        f->n_vertices = which < 2 ? N_HOLE + more : which < 4 ? N_LINE + more / 2 : 1;
        f->radius = which == 5 ? .03 : 0;
        if (which < 2)
            ring(p->part[k], f->n_vertices, hole[which][0], hole[which][1], hole[which][2],
                 from * which, is_back == (which == 0), by);
        else if (which < 4)
            line(p->part[k], f->n_vertices, ends[which - 2], is_back == (which == 2), by);
        else
            bend(p->part[k], point[which - 4][0], point[which - 4][1], by);
    }
}

static icc_domain *domain_of(const plate *p, size_t n_features)
{
    icc_domain *domain = NULL;
    icc_error err = {.size = sizeof err};
    const icc_status status = icc_domain_create_features(&domain, p->n_outer, p->outer, n_features,
                                                         p->feature, NULL, &err);
    ck_assert_msg(status == ICC_OK, "%s", err.message);
    return domain;
}

static icc_status match_of(icc_match **match, const plate *p, size_t n, const plate *q, size_t m,
                           size_t n_landmarks, const double *landmarks,
                           const icc_match_options *options, icc_error *err)
{
    icc_domain *source = domain_of(p, n), *target = domain_of(q, m);
    *err = (icc_error){.size = sizeof *err, .index = -1};
    const icc_status status =
        icc_match_create(match, source, target, n_landmarks, landmarks, options, NULL, err);
    ck_assert((status == ICC_OK) == (*match != NULL));
    icc_domain_free(source);
    icc_domain_free(target);
    return status;
}

/* How far the target's vertices of a feature are from where the source's, bent, are. */
static double distance(const double *a, const double *b, const icc_feature_info *f, double by)
{
    double most = 0;
    for (size_t k = f->first_vertex; k < f->first_vertex + f->n_vertices; ++k) {
        double p[2];
        bend(p, a[2 * k], a[2 * k + 1], by);
        const double d = hypot(b[2 * k] - p[0], b[2 * k + 1] - p[1]);
        most = d > most ? d : most;
    }
    return most;
}

/* Each vertex once, as it was given, on both sides. */
static void check_vertices(const icc_match *match, const plate *p, const plate *q)
{
    const plate *const plates[2] = {p, q};
    const icc_domain *const domains[2] = {icc_match_source(match), icc_match_target(match)};
    icc_match_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_match_get_info(match, &info), ICC_OK);
    uint32_t *const origin[2] = {calloc(info.n_vertices, sizeof(uint32_t)),
                                 calloc(info.n_vertices, sizeof(uint32_t))};
    ck_assert_int_eq(icc_match_get_origins(match, origin[0], origin[1]), ICC_OK);
    size_t n_joined = 0;
    for (size_t k = 0; k < info.n_vertices; ++k)
        n_joined += origin[0][k] != UINT32_MAX && origin[1][k] != UINT32_MAX;
    ck_assert_uint_eq(n_joined, info.n_joined);
    for (int e = 0; e < 2; ++e) {
        icc_domain *const given = domain_of(plates[e], N_FEATURES);
        icc_domain_info size = {.size = sizeof size}, common = {.size = sizeof common};
        (void)icc_domain_get_info(given, &size);
        (void)icc_domain_get_info(domains[e], &common);
        ck_assert_uint_eq(common.n_vertices, info.n_vertices);
        ck_assert_uint_eq(common.n_features, size.n_features);
        double *const xy = calloc(size.n_vertices, 2 * sizeof(double));
        double *const is = calloc(info.n_vertices, 2 * sizeof(double));
        unsigned char *const n_found = calloc(size.n_vertices, 1);
        (void)icc_domain_get_boundary(given, xy, NULL);
        (void)icc_domain_get_boundary(domains[e], is, NULL);
        for (size_t k = 0; k < info.n_vertices; ++k)
            if (origin[e][k] != UINT32_MAX) {
                ck_assert_uint_lt(origin[e][k], size.n_vertices);
                ++n_found[origin[e][k]];
                ck_assert_int_eq(memcmp(is + 2 * k, xy + 2 * origin[e][k], 2 * sizeof(double)), 0);
            }
        for (size_t k = 0; k < size.n_vertices; ++k)
            ck_assert_uint_eq(n_found[k], 1);
        free(xy);
        free(is);
        free(n_found);
        free(origin[e]);
        icc_domain_free(given);
    }
}

static void check_map(const icc_match *match)
{
    icc_map *map = NULL;
    icc_error err = {.size = sizeof err};
    const icc_status status =
        icc_map_create(&map, icc_match_source(match), icc_match_target(match), NULL, NULL, &err);
    ck_assert_msg(status == ICC_OK, "%s", err.message);
    icc_map_free(map);
}

static const int in_order[N_FEATURES] = {0, 1, 2, 3, 4, 5, 6};

/* Orders, starts and senses make no difference, nor do further vertices: each feature goes to what
 * it was before all was bent, and so does each place on it. */
START_TEST(finds_features)
{
    static const int orders[][N_FEATURES] = {
        {0, 1, 2, 3, 4, 5, 6}, {5, 3, 1, 6, 0, 2, 4}, {1, 0, 3, 2, 6, 5, 4}};
    const double by = .25;
    for (size_t k = 0; k < 6; ++k) {
        plate p, q;
        make(&p, orders[k % 3], k % 2 * 3, 0, k == 3, 0);
        make(&q, orders[k * 2 % 3], 4, .13 * (double)k, k % 2 == 1, by);
        const icc_match_options options = {.size = sizeof options,
                                           .between = k < 4 ? 0 : ICC_BETWEEN_ARC};
        icc_match *match = NULL;
        icc_error err;
        const icc_status status =
            match_of(&match, &p, N_FEATURES, &q, N_FEATURES, 0, NULL, &options, &err);
        ck_assert_msg(status == ICC_OK, "%zu: %s", k, err.message);
        check_vertices(match, &p, &q);
        check_map(match);
        icc_match_info info = {.size = sizeof info};
        (void)icc_match_get_info(match, &info);
        double *const a = calloc(info.n_vertices, 2 * sizeof *a);
        double *const b = calloc(info.n_vertices, 2 * sizeof *b);
        (void)icc_domain_get_boundary(icc_match_source(match), a, NULL);
        (void)icc_domain_get_boundary(icc_match_target(match), b, NULL);
        for (size_t f = 0; f < N_FEATURES; ++f) {
            icc_feature_info feature = {.size = sizeof feature};
            ck_assert_int_eq(icc_domain_get_feature(icc_match_source(match), f, &feature), ICC_OK);
            ck_assert_int_eq(feature.kind, p.feature[f].kind);
            const double most = distance(a, b, &feature, by);
            ck_assert_msg(most < .04, "%zu: feature %zu: %g", k, f, most);
        }
        free(a);
        free(b);
        icc_match_free(match);
    }
}
END_TEST

/* One feature less of some kind is reported with both numbers. */
START_TEST(counts_features)
{
    static const char *const texts[] = {"the source has 2 holes, the target 0",
                                        "the source has 2 lines inside, the target 0",
                                        "the source has 3 points inside, the target 2"};
    static const size_t n[] = {0, 2, 6};
    plate p, q;
    make(&p, in_order, 0, 0, false, 0);
    make(&q, in_order, 4, .2, false, .2);
    for (size_t k = 0; k < 3; ++k) {
        icc_match *match = NULL;
        icc_error err;
        ck_assert_int_eq(match_of(&match, &p, N_FEATURES, &q, n[k], 0, NULL, NULL, &err),
                         ICC_ERR_BOUNDARY);
        ck_assert_str_eq(err.message, texts[k]);
    }
    q.feature[5].radius = 0;
    icc_match *match = NULL;
    icc_error err;
    ck_assert_int_eq(match_of(&match, &p, N_FEATURES, &q, N_FEATURES, 0, NULL, NULL, &err),
                     ICC_ERR_BOUNDARY);
    ck_assert_str_eq(err.message, "the source has 1 points with a radius, the target 0");
}
END_TEST

/* Two points that might as well change places are refused, unless that is welcome, or a landmark
 * says which is which. */
START_TEST(refuses_what_may_change_places)
{
    plate p, q;
    make(&p, in_order, 0, 0, false, 0);
    make(&q, in_order, 4, .2, false, 0);
    double a[2][2] = {{0, -.1}, {.02, -.1}}, b[2][2] = {{.01, -.09}, {.01, -.11}};
    for (int k = 0; k < 2; ++k) {
        p.feature[k] = (icc_feature){
            .size = sizeof p.feature[k], .kind = 3, .n_vertices = 1, .vertices = a[k]};
        q.feature[k] = (icc_feature){
            .size = sizeof q.feature[k], .kind = 3, .n_vertices = 1, .vertices = b[k]};
    }
    icc_match *match = NULL;
    icc_error err;
    ck_assert_int_eq(match_of(&match, &p, 2, &q, 2, 0, NULL, NULL, &err), ICC_ERR_AMBIGUOUS);
    ck_assert_int_eq(err.item, ICC_ITEM_FEATURE);
    ck_assert_int_eq(err.side, 1);
    ck_assert(err.index == 0 || err.index == 1);
    const icc_match_options any = {.size = sizeof any, .least_sure = 1};
    ck_assert_int_eq(match_of(&match, &p, 2, &q, 2, 0, NULL, &any, &err), ICC_OK);
    icc_match_free(match);
    for (int k = 0; k < 2; ++k) {
        const double landmark[] = {a[0][0], a[0][1], b[k][0], b[k][1]};
        ck_assert_int_eq(match_of(&match, &p, 2, &q, 2, 1, landmark, NULL, &err), ICC_OK);
        icc_match_info info = {.size = sizeof info};
        (void)icc_match_get_info(match, &info);
        double *const xy = calloc(info.n_vertices, 2 * sizeof *xy);
        (void)icc_domain_get_boundary(icc_match_target(match), xy, NULL);
        ck_assert_int_eq(memcmp(xy + 2 * info.n_vertices - 4, b[k], sizeof b[k]), 0);
        free(xy);
        icc_match_free(match);
    }
}
END_TEST

/* Landmarks on holes and lines are obeyed, exactly; those that cannot be are named. */
START_TEST(passes_through_landmarks_inside)
{
    plate p, q;
    make(&p, in_order, 0, 0, false, 0);
    make(&q, in_order, 4, .2, true, .1);
    const double *const h = p.part[0], *const g = q.part[0], *const l = p.part[2],
                        *const m = q.part[2];
    const double landmarks[][8] = {
        {h[2], h[3], g[8], g[9], p.part[1][0], p.part[1][1], q.part[1][2], q.part[1][3]},
        {l[4], l[5], m[6], m[7], l[8], l[9], m[4], m[5]},
        {l[4], l[5], m[4], m[5], l[8], l[9], m[6], m[7]},
        {l[0], l[1], m[2 * 22], m[2 * 22 + 1], h[0], h[1], g[0], g[1]}};
    for (size_t k = 0; k < sizeof landmarks / sizeof *landmarks; ++k) {
        icc_match *match = NULL;
        icc_error err;
        const icc_status status =
            match_of(&match, &p, N_FEATURES, &q, N_FEATURES, 2, landmarks[k], NULL, &err);
        ck_assert_msg(status == ICC_OK, "%zu: %s", k, err.message);
        check_vertices(match, &p, &q);
        icc_match_info info = {.size = sizeof info};
        (void)icc_match_get_info(match, &info);
        double *const a = calloc(info.n_vertices, 2 * sizeof *a);
        double *const b = calloc(info.n_vertices, 2 * sizeof *b);
        (void)icc_domain_get_boundary(icc_match_source(match), a, NULL);
        (void)icc_domain_get_boundary(icc_match_target(match), b, NULL);
        size_t n_hit = 0;
        for (size_t v = 0; v < info.n_vertices; ++v)
            for (size_t i = 0; i < 2; ++i)
                n_hit += memcmp(a + 2 * v, landmarks[k] + 4 * i, 2 * sizeof *a) == 0 &&
                         memcmp(b + 2 * v, landmarks[k] + 4 * i + 2, 2 * sizeof *b) == 0;
        ck_assert_uint_eq(n_hit, 2);
        free(a);
        free(b);
        icc_match_free(match);
    }
    const double bad[][8] = {{h[0], h[1], g[0], g[1], p.outer[0], p.outer[1], g[6], g[7]},
                             {h[0], h[1], g[0], g[1], h[4], h[5], q.part[1][0], q.part[1][1]},
                             {h[0], h[1], g[0], g[1], l[0], l[1], m[4], m[5]}};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k) {
        icc_match *match = NULL;
        icc_error err;
        ck_assert_int_eq(match_of(&match, &p, N_FEATURES, &q, N_FEATURES, 2, bad[k], NULL, &err),
                         ICC_ERR_ARGUMENT);
        ck_assert_int_eq(err.item, ICC_ITEM_POINT);
        ck_assert_int_eq(err.index, 1);
    }
}
END_TEST

static icc_status make_one(const icc_env *env, icc_error *err, void *argument)
{
    const plate *const plates = argument;
    icc_domain *source = domain_of(&plates[0], N_FEATURES);
    icc_domain *target = domain_of(&plates[1], N_FEATURES);
    icc_match *match = NULL;
    const double *const h = plates[0].part[0], *const g = plates[1].part[0];
    const double landmark[] = {h[0], h[1], g[4], g[5]};
    const icc_match_options options = {.size = sizeof options, .between = ICC_BETWEEN_ARC};
    const icc_status status =
        icc_match_create(&match, source, target, 1, landmark, &options, env, err);
    ck_assert((status == ICC_OK) == (match != NULL));
    icc_match_free(match);
    icc_domain_free(source);
    icc_domain_free(target);
    return status;
}

START_TEST(fails_cleanly)
{
    plate plates[2];
    make(&plates[0], in_order, 0, 0, false, 0);
    make(&plates[1], in_order, 4, .2, true, .1);
    faulty_sweep(make_one, plates);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("match_features");
    TCase *tests = tcase_create("match_features");
    tcase_add_test(tests, finds_features);
    tcase_add_test(tests, counts_features);
    tcase_add_test(tests, refuses_what_may_change_places);
    tcase_add_test(tests, passes_through_landmarks_inside);
    tcase_add_test(tests, fails_cleanly);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

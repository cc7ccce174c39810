/* Maps whose chains slide: lower energy, chains in order and exactly where they were given. */
#include "../../domains.h"
#include "../../faulty.h"
#include "../../feature_pairs.h"
#include "../../saved.h"
#include "../../suite.h"
#include "map/map.h"
#include "map/slide/added_vertices.h"

/* A chain of the plans: so many vertices from one of them on. Closed chains repeat the first. */
typedef struct row {
    size_t first, n;
} row;

typedef struct pair {
    plan source, target;
    row row; /* the chain that slides */
} pair;

/* A line of n vertices from (0, 2) to (8, 2), whose places grow with a power of their number. */
static void add_interface(plan *p, size_t n, double power, double height)
{
    double xy[2 * PLAN_VERTICES];
    for (size_t k = 0; k < n; ++k) {
        const double share = pow((double)k / (double)(n - 1), power);
        xy[2 * k] = 8 * share;
        xy[2 * k + 1] = k == 0 || k == n - 1 ? 2 : 2 + height * sin(9 * share);
    }
    plan_feature(p, ICC_FEATURE_LINE, n, xy);
}

static plan frame(void)
{
    plan p = {.n_outer = 6};
    plan_vertex(&p, 0, 0);
    plan_vertex(&p, 8, 0);
    plan_vertex(&p, 8, 2);
    plan_vertex(&p, 8, 4);
    plan_vertex(&p, 0, 4);
    plan_vertex(&p, 0, 2);
    return p;
}

static void materials(pair *p, double height)
{
    p->source = p->target = frame();
    p->row = (row){6, 13};
    add_interface(&p->source, 13, 1, height);
    add_interface(&p->target, 13, 1.8, height);
    plan_point(&p->source, 2, 3.3);
    plan_point(&p->target, 2, 3.3);
}

static void straight(pair *p)
{
    materials(p, 0);
}

static void curved(pair *p)
{
    materials(p, 0.6);
}

/* Rows that are shared: the lower material is a region, and the interface a line along it. */
static void shared(pair *p)
{
    plan *const both[2] = {&p->source, &p->target};
    p->row = (row){6, 11};
    for (int k = 0; k < 2; ++k) {
        double xy[2 * PLAN_VERTICES] = {0, 0, 8, 0};
        *both[k] = frame();
        add_interface(both[k], 11, k == 0 ? 1 : 0.6, 0.4);
        for (size_t v = 0; v < 11; ++v)
            memcpy(xy + 4 + 2 * v, both[k]->xy + 2 * (6 + 10 - v), 2 * sizeof *xy);
        plan_feature(both[k], ICC_FEATURE_REGION, 13, xy);
    }
}

/* A closed line whose vertices go round faster in one half. */
static void closed(pair *p)
{
    plan *const both[2] = {&p->source, &p->target};
    p->row = (row){6, 25};
    for (int k = 0; k < 2; ++k) {
        double xy[2 * PLAN_VERTICES];
        for (size_t v = 0; v <= 24; ++v) {
            const double turn = 6.283185307179586 * (double)(v % 24) / 24;
            const double own = turn + (k == 0 ? 0 : 0.6 * (1 - cos(turn)));
            xy[2 * v] = 4 + 1.6 * cos(own);
            xy[2 * v + 1] = 2 + 1.2 * sin(own);
        }
        *both[k] = frame();
        plan_feature(both[k], ICC_FEATURE_LINE, 25, xy);
    }
}

static void (*const MAKE[])(pair *) = {straight, curved, shared, closed};
enum { N_PAIRS = sizeof MAKE / sizeof *MAKE };

static icc_status make_map(icc_map **map, const icc_domain *source, const icc_domain *target,
                           int32_t slide, const icc_env *env, icc_error *err)
{
    const icc_map_options options = {.size = sizeof options, .slide = slide};
    return icc_map_create(map, source, target, &options, env, err);
}

static icc_map *map_of(const icc_domain *source, const icc_domain *target, int32_t slide)
{
    icc_map *map;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(make_map(&map, source, target, slide, NULL, &err) == ICC_OK, "%s", err.message);
    return map;
}

/* Returns where a point lies along a row: the number of its segment plus the share of it. */
static double place_along(const plan *p, row r, const double *point)
{
    double nearest = HUGE_VAL, place = 0;
    for (size_t k = 0; k + 1 < r.n; ++k) {
        const double *a = p->xy + 2 * (r.first + k), *b = a + 2;
        const double d[2] = {b[0] - a[0], b[1] - a[1]};
        double share =
            ((point[0] - a[0]) * d[0] + (point[1] - a[1]) * d[1]) / (d[0] * d[0] + d[1] * d[1]);
        share = fmin(fmax(share, 0), 1);
        const double off = hypot(point[0] - a[0] - share * d[0], point[1] - a[1] - share * d[1]);
        if (off < nearest) {
            nearest = off;
            place = (double)k + share;
        }
    }
    ck_assert_double_le(nearest, 1e-12);
    return place;
}

/* Points along a row go to the other one, in order; its ends go to its ends. */
static void check_row(const icc_map *map, bool inverse, const plan *from, const plan *to, row r)
{
    double last = -1e-9;
    for (size_t i = 0; i <= 8 * (r.n - 1); ++i) {
        const size_t k = i / 8 < r.n - 1 ? i / 8 : r.n - 2;
        const double *a = from->xy + 2 * (r.first + k), share = (double)(i - 8 * k) / 8;
        const double point[2] = {a[0] + share * (a[2] - a[0]), a[1] + share * (a[3] - a[1])};
        double image[2];
        ck_assert_int_eq((inverse ? icc_map_apply_inverse : icc_map_apply)(map, 1, point, image,
                                                                           NULL, NULL, NULL),
                         ICC_OK);
        const bool is_stop = i == 0 || i == 8 * (r.n - 1);
        const double *end = to->xy + 2 * (r.first + (i > 0 ? r.n - 1 : 0));
        const double place = place_along(to, r, image);
        for (int d = 0; d < 2 && is_stop; ++d)
            ck_assert_double_eq_tol(image[d], end[d], 1e-13);
        ck_assert(is_stop || place > last);
        last = is_stop ? last : place;
    }
}

/* Vertices outside the row go to their partners. */
static void check_others(const icc_map *map, const plan *from, const plan *to, row r, size_t n)
{
    for (size_t v = 0; v < n; ++v) {
        double image[2];
        if (v >= r.first && v < r.first + r.n)
            continue;
        ck_assert_int_eq(icc_map_apply(map, 1, from->xy + 2 * v, image, NULL, NULL, NULL), ICC_OK);
        for (size_t d = 0; d < 2; ++d)
            ck_assert_double_eq_tol(image[d], to->xy[2 * v + d], 1e-13);
    }
}

static void check_map(const icc_map *map, const plan *from, const plan *to, row r)
{
    const icc_map_info info = info_of_map(map);
    ck_assert_int_eq(info.certified, 1);
    ck_assert_uint_gt(info.n_slid, 0);
    ck_assert_uint_le(info.n_slid, r.n - 2);
    check_row(map, false, from, to, r);
    check_row(map, true, to, from, r);
    check_others(map, from, to, r, 6);
}

START_TEST(energies_fall)
{
    pair p;
    MAKE[_i](&p);
    icc_domain *d[2] = {plan_domain(&p.source), plan_domain(&p.target)};
    for (int swapped = 0; swapped < 2; ++swapped) {
        const plan *from = swapped ? &p.target : &p.source, *to = swapped ? &p.source : &p.target;
        icc_map *still = map_of(d[swapped], d[!swapped], ICC_SLIDE_NONE);
        icc_map *map = map_of(d[swapped], d[!swapped], ICC_SLIDE_INSIDE);
        const double before = info_of_map(still).energy, after = info_of_map(map).energy;
        ck_assert_uint_eq(info_of_map(still).n_slid, 0);
        ck_assert_double_lt(after - 4, 0.3 * (before - 4));
        check_map(map, from, to, p.row);
        icc_map_free(still);
        icc_map_free(map);
    }
    icc_domain_free(d[0]);
    icc_domain_free(d[1]);
}
END_TEST

START_TEST(maps_that_go_on)
{
    pair p;
    MAKE[_i](&p);
    plan further = p.target;
    for (size_t v = 0; v < further.n_vertices; ++v)
        further.xy[2 * v] += 0.3 * further.xy[2 * v + 1];
    icc_domain *d[3] = {plan_domain(&p.source), plan_domain(&p.target), plan_domain(&further)};
    icc_map *map = map_of(d[0], d[1], ICC_SLIDE_INSIDE), *better, *next, *loaded;
    ck_assert_int_eq(icc_map_improve(&better, map, NULL, NULL, NULL, NULL), ICC_OK);
    ck_assert_double_le(info_of_map(better).energy, info_of_map(map).energy * (1 + 1e-12));
    check_map(better, &p.source, &p.target, p.row);
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_map_retarget(&next, better, d[2], NULL, NULL, &err) == ICC_OK, "%s",
                  err.message);
    check_map(next, &p.source, &further, p.row);
    ck_assert_uint_eq(info_of_map(next).n_slid, info_of_map(map).n_slid);
    ck_assert_int_eq(icc_map_retarget(&loaded, next, d[0], NULL, NULL, NULL), ICC_OK);
    icc_map_free(loaded);
    bytes b = map_bytes(next);
    ck_assert_int_eq(b.data[8], 5);
    ck_assert_int_eq(icc_map_load(&loaded, b.n, b.data, NULL, NULL), ICC_OK);
    same_map(next, loaded, d[0]);
    ck_assert_uint_eq(info_of_map(loaded).n_slid, info_of_map(map).n_slid);
    bytes again = map_bytes(loaded);
    ck_assert_uint_eq(again.n, b.n);
    ck_assert_same(again.data, b.data, b.n, "what is saved again");
    icc_map_free(better);
    ck_assert_int_eq(icc_map_retarget(&better, loaded, d[1], NULL, NULL, NULL), ICC_OK);
    check_map(better, &p.source, &p.target, p.row);
    free(b.data);
    free(again.data);
    icc_map_free(loaded);
    icc_map_free(next);
    icc_map_free(better);
    icc_map_free(map);
    for (int k = 0; k < 3; ++k)
        icc_domain_free(d[k]);
}
END_TEST

/* Where nothing is gained, nothing slides, and the map is the one without sliding. */
START_TEST(maps_that_stay)
{
    pair p;
    MAKE[_i](&p);
    icc_domain *d = plan_domain(&p.source);
    icc_map *still = map_of(d, d, ICC_SLIDE_NONE), *map = map_of(d, d, ICC_SLIDE_ALL);
    bytes a = map_bytes(still), b = map_bytes(map);
    ck_assert_uint_eq(info_of_map(map).n_slid, 0);
    ck_assert_uint_eq(a.n, b.n);
    ck_assert_same(a.data, b.data, a.n, "the map");
    free(a.data);
    free(b.data);
    icc_map_free(still);
    icc_map_free(map);
    icc_domain_free(d);
}
END_TEST

/* The boundary slides if it is asked to, except for the vertices where the interface ends. */
START_TEST(boundaries)
{
    pair p;
    straight(&p);
    p.target.xy[2] = 5;
    p.target.xy[2 * 1 + 1] = 0;
    icc_domain *d[2] = {plan_domain(&p.source), plan_domain(&p.target)};
    icc_map *inside = map_of(d[0], d[1], ICC_SLIDE_INSIDE),
            *all = map_of(d[0], d[1], ICC_SLIDE_ALL);
    check_map(inside, &p.source, &p.target, p.row);
    ck_assert_int_eq(info_of_map(all).certified, 1);
    ck_assert_uint_gt(info_of_map(all).n_slid, info_of_map(inside).n_slid);
    ck_assert_double_lt(info_of_map(all).energy, info_of_map(inside).energy);
    check_row(all, false, &p.source, &p.target, p.row);
    icc_map_free(inside);
    icc_map_free(all);
    icc_domain_free(d[0]);
    icc_domain_free(d[1]);
}
END_TEST

/* The end of a tie is held. */
START_TEST(ties)
{
    pair p;
    straight(&p);
    p.source.n_features = p.target.n_features = 1;
    p.source.n_vertices = p.target.n_vertices = 19;
    plan_point(&p.source, 2, 3.3);
    plan_point(&p.target, 2, 3.3);
    icc_domain *d[2] = {plan_domain(&p.source), plan_domain(&p.target)};
    const icc_tie tie = {.size = sizeof tie, .vertex = {9, 19}};
    const icc_map_options options = {
        .size = sizeof options, .slide = ICC_SLIDE_INSIDE, .n_ties = 1, .ties = &tie};
    icc_map *map;
    double image[2];
    ck_assert_int_eq(icc_map_create(&map, d[0], d[1], &options, NULL, NULL), ICC_OK);
    check_map(map, &p.source, &p.target, p.row);
    ck_assert_int_eq(icc_map_apply(map, 1, p.source.xy + 18, image, NULL, NULL, NULL), ICC_OK);
    for (size_t k = 0; k < 2; ++k)
        ck_assert_double_eq_tol(image[k], p.target.xy[18 + k], 1e-13);
    icc_tie_info info = {.size = sizeof info};
    const icc_status status = icc_map_get_tie(map, 0, &info, NULL, NULL);
    ck_assert(status == ICC_ERR_UNSUPPORTED ||
              (status == ICC_OK && (info.vertex[0] == 19 || info.vertex[1] == 19)));
    icc_map_free(map);
    icc_domain_free(d[0]);
    icc_domain_free(d[1]);
}
END_TEST

static icc_domain *with_circle(const plan *p, double x, double y, double radius)
{
    const double point[2] = {x, y};
    const icc_feature features[2] = {{.size = sizeof *features,
                                      .kind = ICC_FEATURE_LINE,
                                      .n_vertices = p->feature[0].n,
                                      .vertices = p->xy + 2 * p->n_outer},
                                     {.size = sizeof *features,
                                      .kind = ICC_FEATURE_POINT,
                                      .n_vertices = 1,
                                      .vertices = point,
                                      .radius = radius}};
    icc_domain *domain;
    ck_assert_int_eq(
        icc_domain_create_features(&domain, p->n_outer, p->xy, 2, features, NULL, NULL), ICC_OK);
    return domain;
}

/* The circle around a point does not turn, though it would if its vertices could slide. */
START_TEST(circles)
{
    enum { CIRCLE = 6 + 13 + 1, N = CIRCLE + 16 };
    pair p;
    straight(&p);
    const double turn[2] = {0.6, 0.8};
    for (size_t v = 0; v < p.target.n_vertices; ++v) {
        double *xy = p.target.xy + 2 * v, x = xy[0];
        xy[0] = turn[0] * x - turn[1] * xy[1];
        xy[1] = turn[1] * x + turn[0] * xy[1];
    }
    icc_domain *d[2] = {
        with_circle(&p.source, 2, 3, 0.5),
        with_circle(&p.target, 2 * turn[0] - 3 * turn[1], 2 * turn[1] + 3 * turn[0], 0.5)};
    icc_map *map = map_of(d[0], d[1], ICC_SLIDE_ALL);
    double xy[2][2 * N], to[2 * N];
    for (int k = 0; k < 2; ++k)
        ck_assert_int_eq(icc_domain_get_boundary(d[k], xy[k], NULL), ICC_OK);
    ck_assert_uint_gt(info_of_map(map).n_slid, 0);
    ck_assert_uint_le(info_of_map(map).n_slid, p.row.n - 2);
    ck_assert_int_eq(icc_map_apply(map, N, xy[0], to, NULL, NULL, NULL), ICC_OK);
    for (size_t k = 2 * CIRCLE; k < 2 * N; ++k)
        ck_assert_double_eq_tol(to[k], xy[1][k], 1e-13);
    icc_map_free(map);
    icc_domain_free(d[0]);
    icc_domain_free(d[1]);
}
END_TEST

START_TEST(threads)
{
    pair p;
    MAKE[_i](&p);
    icc_domain *d[2] = {plan_domain(&p.source), plan_domain(&p.target)};
    icc_map *one = map_of(d[0], d[1], ICC_SLIDE_ALL), *other;
    const icc_env env = {.size = sizeof env, .threads = 3};
    ck_assert_int_eq(make_map(&other, d[0], d[1], ICC_SLIDE_ALL, &env, NULL), ICC_OK);
    bytes a = map_bytes(one), b = map_bytes(other);
    ck_assert_uint_eq(a.n, b.n);
    ck_assert_same(a.data, b.data, a.n, "the map");
    free(a.data);
    free(b.data);
    icc_map_free(one);
    icc_map_free(other);
    icc_domain_free(d[0]);
    icc_domain_free(d[1]);
}
END_TEST

static icc_status make_and_save(const icc_env *env, icc_error *err, void *argument)
{
    icc_domain *const *d = argument;
    icc_map *map, *loaded = NULL;
    icc_status status = make_map(&map, d[0], d[1], ICC_SLIDE_INSIDE, env, err);
    if (status != ICC_OK)
        return status;
    bytes b = map_bytes(map);
    status = icc_map_load(&loaded, b.n, b.data, env, err);
    free(b.data);
    icc_map_free(loaded);
    icc_map_free(map);
    return status;
}

START_TEST(failures)
{
    pair p;
    p.source = p.target = frame();
    add_interface(&p.source, 4, 1, 0.3);
    add_interface(&p.target, 4, 1.5, 0.3);
    icc_domain *d[2] = {plan_domain(&p.source), plan_domain(&p.target)};
    faulty_sweep(make_and_save, d);
    icc_domain_free(d[0]);
    icc_domain_free(d[1]);
}
END_TEST

/* Bytes that are made up give an error, or a map whose certificate holds. */
START_TEST(bytes_made_up)
{
    pair p;
    curved(&p);
    icc_domain *d[2] = {plan_domain(&p.source), plan_domain(&p.target)};
    icc_map *map = map_of(d[0], d[1], ICC_SLIDE_INSIDE), *loaded;
    bytes b = map_bytes(map), changed = {.n = b.n, .data = saved_alloc(b.n)};
    random_source r = {5};
    for (int k = 0; k < 400; ++k) {
        make_up_content(&changed, &b, "MAP_", &r);
        if (icc_map_load(&loaded, changed.n, changed.data, NULL, NULL) == ICC_OK) {
            ck_assert_int_eq(info_of_map(loaded).certified, 1);
            icc_map_free(loaded);
        }
    }
    free(changed.data);
    free(b.data);
    icc_map_free(map);
    icc_domain_free(d[0]);
    icc_domain_free(d[1]);
}
END_TEST

START_TEST(refusals)
{
    pair p;
    straight(&p);
    icc_domain *d = plan_domain(&p.source), *polygon;
    icc_map *map;
    icc_error err = {.size = sizeof err};
    icc_map_options options = {.size = sizeof options, .slide = 3};
    ck_assert_int_eq(icc_map_create(&map, d, d, &options, NULL, &err), ICC_ERR_ARGUMENT);
    ck_assert_ptr_nonnull(strstr(err.message, "slide"));
    options =
        (icc_map_options){.size = sizeof options, .slide = ICC_SLIDE_INSIDE, .iterations = -1};
    ck_assert_int_eq(icc_map_create(&map, d, d, &options, NULL, &err), ICC_ERR_ARGUMENT);
    options.iterations = 0;
    ck_assert_int_eq(icc_domain_create(&polygon, 2, 6, p.source.xy, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_create(&map, polygon, polygon, &options, NULL, &err),
                     ICC_ERR_UNSUPPORTED);
    ck_assert_ptr_nonnull(strstr(err.message, "slide"));
    icc_domain_free(polygon);
    icc_domain_free(d);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("sliding");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 300);
    tcase_add_loop_test(tests, energies_fall, 0, N_PAIRS);
    tcase_add_loop_test(tests, maps_that_go_on, 0, N_PAIRS);
    tcase_add_loop_test(tests, maps_that_stay, 0, N_PAIRS);
    tcase_add_test(tests, boundaries);
    tcase_add_test(tests, ties);
    tcase_add_test(tests, circles);
    tcase_add_loop_test(tests, threads, 0, N_PAIRS);
    tcase_add_test(tests, failures);
    tcase_add_test(tests, bytes_made_up);
    tcase_add_test(tests, refusals);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

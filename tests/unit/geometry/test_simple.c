/* The quick test of polygons: its answers beside the list of all defects, which polygons it decides,
 * and what it does without
 * memory or when it is cancelled. */
#include "../../default_env.h"
#include "../../faulty.h"
#include "../../random.h"
#include "../../share.h"
#include "../../suite.h"
#include "base/error.h"
#include "geometry/defects.h"
#include "geometry/simple.h"
#include "icc/icc.h"

#include <math.h>

static const double TURN = 6.28318530717958647692;

enum { MOST = 4000 };

typedef struct outline {
    size_t n;
    double points[2 * (MOST + 1)];
} outline;

static void put(outline *o, size_t k, double x, double y)
{
    o->points[2 * k] = x;
    o->points[2 * k + 1] = y;
}

static void close_outline(outline *o, size_t n)
{
    o->n = n;
    put(o, n, o->points[0], o->points[1]);
}

static iccp_simple find(const outline *o)
{
    const iccp_env env = default_env();
    iccp_simple result;
    ck_assert_int_eq(iccp_simple_find(&result, o->points, o->n, &env), ICC_OK);
    return result;
}

/* The first entry of the list of all defects, or kind 0. */
static iccp_defect first_defect(const outline *o)
{
    const iccp_env env = default_env();
    const iccp_polygon polygon = {.n = o->n, .points = o->points};
    int32_t kind = 0;
    uint32_t items[2] = {0, 0};
    iccp_defect_list list = {.capacity = 1, .kinds = &kind, .items = items};
    iccp_boxtree tree;
    iccp_boxtree_create(&tree, o->points, o->n, &env.memory);
    ck_assert_int_eq(iccp_defects_list(&list, &polygon, &tree, &env), ICC_OK);
    iccp_boxtree_free(&tree, &env.memory);
    return (iccp_defect){kind, items[0], items[1]};
}

static bool has_empty_edge(const outline *o)
{
    for (size_t e = 0; e < o->n; ++e)
        if (o->points[2 * e] == o->points[2 * e + 2] &&
            o->points[2 * e + 1] == o->points[2 * e + 3])
            return true;
    return false;
}

/* Returns true if there is an answer. It must be that of the list. */
static bool check(const outline *o)
{
    const iccp_simple quick = find(o);
    const iccp_defect first = first_defect(o);
    if (quick.answer == ICCP_UNDECIDED)
        return false;
    ck_assert_int_eq(quick.answer, first.kind == 0 ? ICCP_SIMPLE : ICCP_NOT_SIMPLE);
    if (first.kind == 0 || has_empty_edge(o)) {
        ck_assert_uint_eq(quick.first, o->n);
    } else if (first.kind != ICC_DEFECT_FLAT) {
        const iccp_polygon polygon = {.n = o->n, .points = o->points};
        const iccp_defect at = iccp_defects_at(&polygon, (uint32_t)quick.first);
        ck_assert_int_eq(at.kind, first.kind);
        ck_assert_uint_eq(at.a, first.a);
        ck_assert_uint_eq(at.b, first.b);
    }
    return true;
}

/* ------------------------------------------------------------------ outlines */

/* A few points of a small lattice: nearly all have several defects of several kinds. */
static void make_lattice(outline *o, random_source *r)
{
    const int side = 2 + random_below(r, 12);
    const size_t n = 3 + (size_t)random_below(r, 30);
    for (size_t k = 0; k < n; ++k)
        put(o, k, random_below(r, side), random_below(r, side));
    close_outline(o, n);
}

/* Rough and smooth stretches by turns. */
static void make_coast(outline *o, random_source *r, size_t n, double rough)
{
    for (size_t k = 0; k < n; ++k) {
        const double angle = TURN * (double)k / (double)n;
        const double radius = 1 + 0.4 * sin(5 * angle) +
                              (k * 9 / n % 3 == 0 ? 0 : rough * random_unit(r) / (double)n);
        put(o, k, radius * cos(angle), radius * sin(angle));
    }
    close_outline(o, n);
}

/* There and back. With few points a turn it is not simple. */
static void make_spiral(outline *o, size_t n, int turns, bool outwards)
{
    const size_t half = n / 2;
    for (size_t k = 0; k < half; ++k) {
        const double share = (double)(outwards ? k : half - 1 - k) / (double)half;
        const double angle = turns * TURN * share;
        put(o, k, (1 + angle) * cos(angle), (1 + angle) * sin(angle));
        put(o, 2 * half - 1 - k, (3 + angle) * cos(angle), (3 + angle) * sin(angle));
    }
    close_outline(o, 2 * half);
}

/* Long thin teeth along a diagonal. */
static void make_comb(outline *o, size_t n)
{
    for (size_t k = 0; k + 2 < n; ++k) {
        const double u = k % 2 == 0 ? 0 : 1, v = (double)k / (double)n;
        put(o, k, u - v, u + v);
    }
    put(o, n - 2, -1.01, 0.99);
    put(o, n - 1, -0.01, -0.01);
    close_outline(o, n);
}

/* Moves a few points onto others, or close to them. */
static void spoil(outline *o, random_source *r)
{
    for (int times = 1 + random_below(r, 3); times > 0; --times) {
        const size_t k = (size_t)random_below(r, (int)o->n), l = (size_t)random_below(r, (int)o->n);
        const double away = random_below(r, 2) == 0 ? 0 : 1e-3 * random_unit(r);
        put(o, k, o->points[2 * l] + away, o->points[2 * l + 1]);
    }
    close_outline(o, o->n);
}

/* ------------------------------------------------------------------ tests */

START_TEST(test_answers)
{
    static outline o;
    random_source r = {1};
    int n_decided = 0, n_simple = 0;
    const int n = share_of(20000);
    for (int round = 0; round < n; ++round) {
        const size_t size = 20 + (size_t)random_below(&r, 300);
        if (round % 4 == 0)
            make_coast(&o, &r, size, 20 * random_unit(&r));
        else if (round % 4 == 1)
            make_spiral(&o, size, 1 + random_below(&r, 20), round % 8 == 1);
        else
            make_lattice(&o, &r);
        if (round % 3 == 1)
            spoil(&o, &r);
        if (round % 5 == 4) /* a thin shape in a far corner */
            for (size_t k = 0; k <= o.n; ++k)
                put(&o, k, 1 + 0x1p-30 * o.points[2 * k], o.points[2 * k + 1]);
        n_decided += check(&o);
        n_simple += find(&o).answer == ICCP_SIMPLE;
    }
    ck_assert_int_gt(n_decided, n * 9 / 10);
    ck_assert_int_gt(n_simple, n / 20);
}
END_TEST

/* Outlines, rough ones too, and polygons of many turns that are not simple have an answer. */
START_TEST(test_decided)
{
    static outline o;
    random_source r = {2};
    for (size_t n = 100; n <= MOST; n *= 2) {
        make_coast(&o, &r, n, 1);
        ck_assert(check(&o));
        make_coast(&o, &r, n, 20);
        ck_assert(check(&o));
    }
    make_spiral(&o, 1000, 60, true);
    ck_assert(check(&o));
    ck_assert_int_eq(find(&o).answer, ICCP_NOT_SIMPLE);
}
END_TEST

/* Where nearly all boxes overlap, the search leaves the answer to the sweep. */
START_TEST(test_undecided)
{
    static outline o;
    make_comb(&o, MOST);
    ck_assert(!check(&o));
}
END_TEST

static icc_status check_rough(const icc_env *env, icc_error *err, void *argument)
{
    const outline *o = argument;
    iccp_env full;
    iccp_simple result;
    ck_assert_int_eq(iccp_env_read(&full, env, NULL), ICC_OK);
    const icc_status status = iccp_simple_find(&result, o->points, o->n, &full);
    return iccp_explain(err, status);
}

START_TEST(test_no_memory)
{
    static outline o;
    random_source r = {3};
    make_coast(&o, &r, 100, 20);
    faulty_sweep(check_rough, &o);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("simple");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, test_answers);
    tcase_add_test(tests, test_decided);
    tcase_add_test(tests, test_undecided);
    tcase_add_test(tests, test_no_memory);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

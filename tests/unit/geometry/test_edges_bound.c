/* Directed edges that are or are not the boundary of a region on their left. */
#include "../../default_env.h"
#include "../../faulty.h"
#include "../../suite.h"
#include "base/error.h"
#include "geometry/edges_bound.h"

enum { MOST = 40 };

/* Rings of points, which may share them. */
typedef struct rings {
    size_t n_points, n;
    double points[2 * MOST];
    uint32_t ends[2 * MOST];
} rings;

static uint32_t add_point(rings *r, double x, double y)
{
    ck_assert_uint_lt(r->n_points, MOST);
    r->points[2 * r->n_points] = x;
    r->points[2 * r->n_points + 1] = y;
    return (uint32_t)r->n_points++;
}

static void add_ring(rings *r, size_t n, const uint32_t *points)
{
    for (size_t k = 0; k < n; ++k, ++r->n) {
        ck_assert_uint_lt(r->n, MOST);
        r->ends[2 * r->n] = points[k];
        r->ends[2 * r->n + 1] = points[(k + 1) % n];
    }
}

static bool bound(const rings *r)
{
    const iccp_env env = default_env();
    const iccp_edges edges = {r->n_points, r->n, r->ends};
    bool is;
    ck_assert_int_eq(iccp_edges_bound(&is, &edges, r->points, &env), ICC_OK);
    return is;
}

/* A square of side 8, counter-clockwise, and a point of no edge. */
static rings square(void)
{
    rings r = {0};
    (void)add_point(&r, 1, 1);
    (void)add_point(&r, 0, 0);
    (void)add_point(&r, 8, 0);
    (void)add_point(&r, 8, 8);
    (void)add_point(&r, 0, 8);
    add_ring(&r, 4, (const uint32_t[]){1, 2, 3, 4});
    return r;
}

static void reverse(rings *r, size_t first, size_t end)
{
    for (size_t e = first; e < end; ++e) {
        const uint32_t a = r->ends[2 * e];
        r->ends[2 * e] = r->ends[2 * e + 1];
        r->ends[2 * e + 1] = a;
    }
}

START_TEST(rings_apart)
{
    rings r = square();
    ck_assert(bound(&r));
    reverse(&r, 0, 4);
    ck_assert(!bound(&r));
    reverse(&r, 0, 4);
    const uint32_t a = add_point(&r, 2, 2), b = add_point(&r, 4, 6), c = add_point(&r, 6, 2);
    add_ring(&r, 3, (const uint32_t[]){a, b, c});
    ck_assert(bound(&r));
    reverse(&r, 4, 7);
    ck_assert(!bound(&r));
    const rings none = {.n_points = 3};
    ck_assert(!bound(&none));
}
END_TEST

/* Two holes touch each other, and one touches the square. */
static rings touching_holes(void)
{
    rings r = square();
    const uint32_t a = add_point(&r, 4, 2), b = add_point(&r, 2, 4), c = add_point(&r, 6, 6),
                   d = add_point(&r, 6, 4);
    add_ring(&r, 3, (const uint32_t[]){1, b, a});
    add_ring(&r, 3, (const uint32_t[]){a, c, d});
    return r;
}

START_TEST(rings_that_touch)
{
    rings r = touching_holes();
    ck_assert(bound(&r));
    for (int hole = 0; hole < 2; ++hole) {
        const size_t first = 4 + 3 * (size_t)hole;
        reverse(&r, first, first + 3);
        ck_assert(!bound(&r));
        reverse(&r, first, first + 3);
    }
    /* Another region outside touches a corner. Turned, it would be a hole of nothing. */
    const uint32_t e = add_point(&r, 12, 8), f = add_point(&r, 12, 12);
    add_ring(&r, 3, (const uint32_t[]){3, e, f});
    ck_assert(bound(&r));
    reverse(&r, r.n - 3, r.n);
    ck_assert(!bound(&r));
}
END_TEST

/* In one place there are two points, or two edges cross, overlap or run back. */
START_TEST(defects)
{
    rings r = touching_holes();
    r.points[2 * 6] = 2.5; /* crosses no edge */
    ck_assert(bound(&r));
    r.points[2 * 6 + 1] = -1;
    ck_assert(!bound(&r));
    r = square();
    const uint32_t a = add_point(&r, 0, 0), b = add_point(&r, 2, 4), c = add_point(&r, 4, 2);
    add_ring(&r, 3, (const uint32_t[]){a, b, c});
    ck_assert(!bound(&r));
    r.points[2 * a] = r.points[2 * a + 1] = 1;
    ck_assert(bound(&r));
    r.points[2 * a] = 0; /* on an edge */
    ck_assert(!bound(&r));
    r = square();
    add_ring(&r, 2, (const uint32_t[]){0, 1}); /* a crack */
    ck_assert(!bound(&r));
    r = square();
    add_ring(&r, 4, (const uint32_t[]){1, 2, 3, 4}); /* twice */
    ck_assert(!bound(&r));
}
END_TEST

static icc_status check(const icc_env *env, icc_error *err, void *argument)
{
    const rings *r = argument;
    const iccp_edges edges = {r->n_points, r->n, r->ends};
    iccp_env full;
    bool is;
    ck_assert_int_eq(iccp_env_read(&full, env, NULL), ICC_OK);
    const icc_status status = iccp_edges_bound(&is, &edges, r->points, &full);
    ck_assert_int_eq(is, status == ICC_OK);
    return iccp_explain(err, status);
}

START_TEST(no_memory)
{
    rings r = touching_holes();
    faulty_sweep(check, &r);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("edges_bound");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, rings_apart);
    tcase_add_test(tests, rings_that_touch);
    tcase_add_test(tests, defects);
    tcase_add_test(tests, no_memory);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

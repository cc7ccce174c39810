/* Cutting and turning edges: after any number of changes the two arrays are a mesh of the same
 * disc. */
#include "mesh/corners.h"

#include "../../random.h"
#include "../../suite.h"

#include <check.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_TRIANGLES = 12000 };

static uint32_t vertices[3 * MAX_TRIANGLES], twins[3 * MAX_TRIANGLES];

/* A fan of n triangles round vertex 0, which is on the boundary when the fan is open. */
static iccp_corners fan(uint32_t n, bool closed)
{
    iccp_corners c = {vertices, twins, n};
    for (uint32_t t = 0; t < n; ++t) {
        vertices[3 * t] = 0;
        vertices[3 * t + 1] = 1 + t;
        vertices[3 * t + 2] = closed ? 1 + (t + 1) % n : 2 + t;
        twins[3 * t] = ICCP_NO_NEIGHBOUR;
        twins[3 * t + 1] = closed || t + 1 < n ? 3 * ((t + 1) % n) + 2 : ICCP_NO_NEIGHBOUR;
        twins[3 * t + 2] = closed || t > 0 ? 3 * ((t + n - 1) % n) + 1 : ICCP_NO_NEIGHBOUR;
    }
    return c;
}

/* Twins are mutual and face the same edge from its two sides. */
static bool is_linked(const iccp_corners *c, uint32_t k, uint32_t n_vertices)
{
    const uint32_t twin = c->twin[k];
    if (c->vertex[k] >= n_vertices || c->vertex[k] == c->vertex[iccp_after(k)])
        return false;
    return twin == ICCP_NO_NEIGHBOUR ||
           (twin < 3 * c->n_triangles && twin / 3 != k / 3 && c->twin[twin] == k &&
            c->vertex[iccp_after(twin)] == c->vertex[iccp_before(k)] &&
            c->vertex[iccp_before(twin)] == c->vertex[iccp_after(k)]);
}

/* Returns the edges of the boundary. */
static size_t check_twins(const iccp_corners *c, uint32_t n_vertices)
{
    size_t n_open = 0, n_faults = 0;
    for (uint32_t k = 0; k < 3 * c->n_triangles; ++k) {
        n_open += c->twin[k] == ICCP_NO_NEIGHBOUR;
        n_faults += !is_linked(c, k, n_vertices);
    }
    ck_assert_uint_eq(n_faults, 0);
    return n_open;
}

/* Corners at one vertex are one fan: all are met by going round from any of them. */
static void check_fans(const iccp_corners *c, uint32_t n_vertices)
{
    uint32_t *degree = calloc(n_vertices, sizeof *degree), *seen = calloc(n_vertices, sizeof *seen);
    ck_assert(degree != NULL && seen != NULL);
    for (uint32_t k = 0; k < 3 * c->n_triangles; ++k)
        ++degree[c->vertex[k]];
    for (uint32_t start = 0; start < 3 * c->n_triangles; ++start) {
        const uint32_t v = c->vertex[start];
        if (seen[v] > 0)
            continue;
        uint32_t k = start;
        do {
            ++seen[v];
            const uint32_t twin = c->twin[iccp_after(k)];
            k = twin == ICCP_NO_NEIGHBOUR ? twin : iccp_after(twin);
        } while (k != start && k != ICCP_NO_NEIGHBOUR);
        k = k == start ? ICCP_NO_NEIGHBOUR : c->twin[iccp_before(start)];
        while (k != ICCP_NO_NEIGHBOUR) {
            k = iccp_before(k);
            ++seen[v];
            k = c->twin[iccp_before(k)];
        }
    }
    size_t n_faults = 0;
    for (uint32_t v = 0; v < n_vertices; ++v)
        n_faults += degree[v] == 0 || seen[v] != degree[v];
    ck_assert_uint_eq(n_faults, 0);
    free(degree);
    free(seen);
}

static void check_disc(const iccp_corners *c, uint32_t n_vertices)
{
    const size_t n_open = check_twins(c, n_vertices);
    check_fans(c, n_vertices);
    ck_assert_uint_eq(2 * (size_t)n_vertices, c->n_triangles + n_open + 2);
}

static bool is_joined(const iccp_corners *c, uint32_t a, uint32_t b)
{
    for (uint32_t k = 0; k < 3 * c->n_triangles; ++k)
        if ((c->vertex[k] == a && c->vertex[iccp_after(k)] == b) ||
            (c->vertex[k] == b && c->vertex[iccp_after(k)] == a))
            return true;
    return false;
}

/* Other triangles than the two beside the edge keep their vertices. */
static void check_rest(const iccp_corners *c, const uint32_t *before, size_t n, uint32_t t,
                       uint32_t u)
{
    size_t n_changed = 0;
    for (size_t k = 0; k < 3 * n; ++k)
        n_changed += k / 3 != t && k / 3 != u && c->vertex[k] != before[k];
    ck_assert_uint_eq(n_changed, 0);
}

START_TEST(random_changes_keep_every_invariant)
{
    static uint32_t before[3 * MAX_TRIANGLES];
    for (int run = 0; run < 40; ++run) {
        random_source r = {(uint64_t)run};
        const uint32_t n = 3 + (uint32_t)random_below(&r, 9);
        const bool closed = run % 2 == 0;
        iccp_corners c = fan(n, closed);
        uint32_t n_vertices = closed ? n + 1 : n + 2;
        size_t n_turns = 0;
        check_disc(&c, n_vertices);
        for (int step = 0; step < 300; ++step) {
            const uint32_t k = (uint32_t)random_below(&r, 3 * (int)c.n_triangles);
            const uint32_t twin = c.twin[k], x = c.vertex[k];
            const uint32_t y = twin == ICCP_NO_NEIGHBOUR ? x : c.vertex[twin];
            const uint32_t a = c.vertex[iccp_after(k)], b = c.vertex[iccp_before(k)];
            const size_t n_before = c.n_triangles;
            memcpy(before, c.vertex, 3 * n_before * sizeof *before);
            if (random_below(&r, 2) == 0) {
                iccp_cut_edge(&c, k, n_vertices++);
                ck_assert_uint_eq(c.n_triangles, n_before + (twin == ICCP_NO_NEIGHBOUR ? 1 : 2));
                ck_assert(!is_joined(&c, a, b) && is_joined(&c, x, n_vertices - 1) &&
                          is_joined(&c, y, n_vertices - 1));
            } else if (twin != ICCP_NO_NEIGHBOUR && !is_joined(&c, x, y)) {
                iccp_flip_edge(&c, k);
                ck_assert_uint_eq(c.n_triangles, n_before);
                ck_assert(!is_joined(&c, a, b) && is_joined(&c, x, y));
                ++n_turns;
            }
            check_rest(&c, before, n_before, k / 3, twin == ICCP_NO_NEIGHBOUR ? k / 3 : twin / 3);
            check_disc(&c, n_vertices);
        }
        ck_assert_uint_gt(n_turns, 20);
    }
}
END_TEST

static bool is_inner(const iccp_corners *c, uint32_t v)
{
    for (uint32_t k = 0; k < 3 * c->n_triangles; ++k)
        if (c->vertex[k] == v && (c->twin[iccp_after(k)] == ICCP_NO_NEIGHBOUR ||
                                  c->twin[iccp_before(k)] == ICCP_NO_NEIGHBOUR))
            return false;
    return true;
}

static size_t n_joined_to_both(const iccp_corners *c, uint32_t a, uint32_t b, uint32_t n_vertices)
{
    size_t n = 0;
    for (uint32_t v = 0; v < n_vertices; ++v)
        n += is_joined(c, a, v) && is_joined(c, b, v);
    return n;
}

/* The last triangle takes another's place. */
static void drop_triangle(iccp_corners *c, uint32_t t)
{
    const uint32_t last = (uint32_t)--c->n_triangles;
    for (uint32_t k = 0; k < 3 && t != last; ++k) {
        const uint32_t twin = c->twin[3 * last + k];
        c->vertex[3 * t + k] = c->vertex[3 * last + k];
        c->twin[3 * t + k] = twin;
        if (twin != ICCP_NO_NEIGHBOUR)
            c->twin[twin] = 3 * t + k;
    }
}

/* Where the ends of an edge have two neighbours in common, they can be one vertex. */
START_TEST(collapsed_edges_leave_a_disc)
{
    size_t n_collapsed = 0;
    for (int run = 0; run < 60; ++run) {
        random_source r = {(uint64_t)run};
        iccp_corners c = fan(5, run % 2 == 0);
        uint32_t n_vertices = run % 2 == 0 ? 6 : 7;
        while (n_vertices < 30)
            iccp_cut_edge(&c, (uint32_t)random_below(&r, 3 * (int)c.n_triangles), n_vertices++);
        for (int step = 0; step < 100; ++step) {
            const uint32_t k = (uint32_t)random_below(&r, 3 * (int)c.n_triangles);
            const uint32_t v = c.vertex[k], to = c.vertex[iccp_after(k)];
            if (!is_inner(&c, v) || n_joined_to_both(&c, v, to, n_vertices) != 2)
                continue;
            const uint32_t other = c.twin[iccp_before(k)] / 3, last = n_vertices - 1;
            iccp_collapse_edge(&c, k);
            drop_triangle(&c, k / 3 > other ? k / 3 : other);
            drop_triangle(&c, k / 3 > other ? other : k / 3);
            for (uint32_t x = 0; x < 3 * c.n_triangles; ++x) {
                ck_assert_uint_ne(c.vertex[x], v);
                if (c.vertex[x] == last)
                    c.vertex[x] = v;
            }
            check_disc(&c, --n_vertices);
            ++n_collapsed;
        }
    }
    ck_assert_uint_gt(n_collapsed, 300);
}
END_TEST

/* Twins follow from the vertices alone. */
START_TEST(twins_are_found)
{
    static uint32_t own[3 * MAX_TRIANGLES];
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    for (int run = 0; run < 20; ++run) {
        random_source r = {(uint64_t)run};
        iccp_corners c = fan(5, run % 2 == 0);
        bool is_manifold = false;
        for (uint32_t v = 7; v < 500; ++v)
            iccp_cut_edge(&c, (uint32_t)random_below(&r, 3 * (int)c.n_triangles), v);
        memcpy(own, c.twin, 3 * c.n_triangles * sizeof *own);
        memset(c.twin, 0, 3 * c.n_triangles * sizeof *own);
        ck_assert_int_eq(iccp_find_twins(&c, 500, &is_manifold, &env), ICC_OK);
        ck_assert(is_manifold);
        ck_assert_mem_eq(own, c.twin, 3 * c.n_triangles * sizeof *own);
        /* One triangle the other way round, twice the same, or with an edge of no length. */
        const uint32_t first = c.vertex[0];
        c.vertex[0] = c.vertex[1];
        c.vertex[1] = first;
        ck_assert_int_eq(iccp_find_twins(&c, 500, &is_manifold, &env), ICC_OK);
        ck_assert(!is_manifold);
        memcpy(c.vertex, c.vertex + 3, 3 * sizeof *c.vertex);
        ck_assert_int_eq(iccp_find_twins(&c, 500, &is_manifold, &env), ICC_OK);
        ck_assert(!is_manifold);
        c.vertex[0] = c.vertex[1];
        ck_assert_int_eq(iccp_find_twins(&c, 500, &is_manifold, &env), ICC_OK);
        ck_assert(!is_manifold);
    }
}
END_TEST

/* Turning takes the pair a quarter round: four times is nothing, as a set of triangles. */
START_TEST(four_turns_change_nothing)
{
    iccp_corners c = fan(2, false);
    ck_assert(is_joined(&c, 0, 2) && !is_joined(&c, 1, 3));
    for (int k = 1; k <= 4; ++k) {
        const uint32_t inner = c.twin[0] != ICCP_NO_NEIGHBOUR   ? 0
                               : c.twin[1] != ICCP_NO_NEIGHBOUR ? 1
                                                                : 2;
        iccp_flip_edge(&c, inner);
        check_disc(&c, 4);
        ck_assert(is_joined(&c, 0, 2) == (k % 2 == 0) && is_joined(&c, 1, 3) == (k % 2 == 1));
    }
}
END_TEST

/* Thousands of cuts along the boundary only. */
START_TEST(a_boundary_may_be_cut_again_and_again)
{
    iccp_corners c = fan(1, false);
    random_source r = {7};
    uint32_t n_vertices = 3;
    while (c.n_triangles < MAX_TRIANGLES) {
        uint32_t k = (uint32_t)random_below(&r, 3 * (int)c.n_triangles);
        while (c.twin[k] != ICCP_NO_NEIGHBOUR)
            k = (k + 1) % (3 * (uint32_t)c.n_triangles);
        iccp_cut_edge(&c, k, n_vertices++);
        if (n_vertices % 1000 == 0)
            check_disc(&c, n_vertices);
    }
    check_disc(&c, n_vertices);
    ck_assert_uint_eq(check_twins(&c, n_vertices), n_vertices);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("corners");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, random_changes_keep_every_invariant);
    tcase_add_test(tests, collapsed_edges_leave_a_disc);
    tcase_add_test(tests, twins_are_found);
    tcase_add_test(tests, four_turns_change_nothing);
    tcase_add_test(tests, a_boundary_may_be_cut_again_and_again);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

/* Orders of elimination: every one lists each row once, and what they fill is compared with what is
 * known of trees, cycles and grids, and with nested dissection. */
#include "base/error.h"
#include "math/ldlt.h"
#include "math/ordering.h"

#include "../../default_env.h"
#include "../../faulty.h"
#include "../../random.h"
#include "../../suite.h"

#include <check.h>
#include <stdbool.h>
#include <string.h>

typedef struct graph {
    size_t n, n_edges, room;
    uint32_t (*edge)[2];
    size_t *first;
    uint32_t *column;
    iccp_symmetric m; /* borrows the two arrays above */
} graph;

static void join(graph *g, size_t a, size_t b)
{
    if (g->n_edges == g->room) {
        g->room = 2 * g->room + 64;
        g->edge = realloc(g->edge, g->room * sizeof *g->edge);
    }
    g->edge[g->n_edges][0] = (uint32_t)a;
    g->edge[g->n_edges++][1] = (uint32_t)b;
}

/* To be called after the last edge. */
static void finish(graph *g)
{
    g->first = calloc(g->n + 2, sizeof *g->first);
    g->column = malloc((2 * g->n_edges + 1) * sizeof *g->column);
    for (size_t e = 0; e < g->n_edges; ++e)
        for (int k = 0; k < 2; ++k)
            ++g->first[g->edge[e][k] + 2];
    for (size_t i = 0; i <= g->n; ++i)
        g->first[i + 1] += g->first[i];
    for (size_t e = 0; e < g->n_edges; ++e)
        for (int k = 0; k < 2; ++k)
            g->column[g->first[g->edge[e][k] + 1]++] = g->edge[e][!k];
    g->m = (iccp_symmetric){g->n, g->first, g->column, NULL, NULL};
}

static void clear(graph *g)
{
    free(g->edge);
    free(g->first);
    free(g->column);
}

static uint32_t *order_of(const graph *g)
{
    const iccp_env env = default_env();
    uint32_t *order = malloc((g->n + 1) * sizeof *order);
    bool *seen = calloc(g->n + 1, sizeof *seen);
    ck_assert_int_eq(iccp_ordering(&g->m, order, &env), ICC_OK);
    for (size_t k = 0; k < g->n; ++k) {
        ck_assert(order[k] < g->n && !seen[order[k]]);
        seen[order[k]] = true;
    }
    free(seen);
    return order;
}

/* Entries of the factor below the diagonal. */
static size_t entries_by(const graph *g, const uint32_t *order)
{
    const iccp_env env = default_env();
    iccp_ldlt factor;
    ck_assert_int_eq(iccp_ldlt_analyse_ordered(&factor, &g->m, order, &env), ICC_OK);
    const size_t n_entries = factor.n_entries;
    iccp_ldlt_free(&factor);
    return n_entries;
}

static size_t entries(const graph *g)
{
    uint32_t *order = order_of(g);
    const size_t n_entries = entries_by(g, order);
    free(order);
    return n_entries;
}

static graph path(size_t n, bool is_closed)
{
    graph g = {.n = n};
    for (size_t i = 1; i < n; ++i)
        join(&g, i - 1, i);
    if (is_closed)
        join(&g, n - 1, 0);
    finish(&g);
    return g;
}

static graph complete(size_t n, size_t n_pieces)
{
    graph g = {.n = n * n_pieces};
    for (size_t p = 0; p < n_pieces; ++p)
        for (size_t i = 0; i < n; ++i)
            for (size_t j = 0; j < i; ++j)
                join(&g, p + n_pieces * i, p + n_pieces * j);
    finish(&g);
    return g;
}

/* Hubs that are neighbours of everything but of each other. */
static graph hubs(size_t n_hubs, size_t n)
{
    graph g = {.n = n_hubs + n};
    for (size_t i = 0; i < n; ++i)
        for (size_t h = 0; h < n_hubs; ++h)
            join(&g, h, n_hubs + i);
    finish(&g);
    return g;
}

static graph random_tree(size_t n, size_t reach, random_source *r)
{
    graph g = {.n = n};
    for (size_t i = 1; i < n; ++i)
        join(&g, i, i - 1 - (size_t)random_below(r, (int)(i < reach ? i : reach)));
    finish(&g);
    return g;
}

/* Each vertex has about `degree` neighbours; some are more popular. */
static graph random_graph(size_t n, size_t degree, bool is_skewed, random_source *r)
{
    graph g = {.n = n};
    for (size_t i = 1; i < n; ++i) {
        bool *seen = calloc(n, sizeof *seen);
        for (size_t k = 0; k < (degree + 1) / 2; ++k) {
            const size_t most = is_skewed ? 1 + (size_t)random_below(r, (int)i) : i;
            const size_t j = (size_t)random_below(r, (int)most);
            if (!seen[j])
                join(&g, i, j);
            seen[j] = true;
        }
        free(seen);
    }
    finish(&g);
    return g;
}

/* A grid of size^dim vertices with neighbours along the axes; `hub`: one more vertex, next to
 * all. */
static graph grid(size_t size, size_t dim, bool hub)
{
    graph g = {.n = 1};
    for (size_t axis = 0; axis < dim; ++axis)
        g.n *= size;
    for (size_t i = 0; i < g.n; ++i)
        for (size_t axis = 0, step = 1; axis < dim; ++axis, step *= size)
            if (i / step % size + 1 < size)
                join(&g, i, i + step);
    for (size_t i = 0; hub && i < g.n; ++i)
        join(&g, g.n, i);
    g.n += hub;
    finish(&g);
    return g;
}

START_TEST(all_sorts_of_graphs_are_ordered)
{
    random_source r = {1};
    for (int k = 0; k < 24; ++k) {
        graph g;
        switch (k) {
        case 0:
            g = path(0, false);
            break;
        case 1:
            g = path(1, false);
            break;
        case 2: /* nothing but single vertices */
            g = (graph){.n = 1000};
            finish(&g);
            break;
        case 3:
            g = path(1000000, false);
            break;
        case 4:
            g = complete(400, 1);
            break;
        case 5:
            g = complete(12, 500);
            break;
        case 6:
            g = hubs(1, 100000);
            break;
        case 7:
            g = hubs(20, 20000);
            break;
        case 8:
            g = hubs(300, 300);
            break;
        case 9:
            g = grid(300, 2, true);
            break;
        case 10:
            g = grid(20, 3, false);
            break;
        case 11:
            g = random_tree(200000, 1, &r);
            break;
        default:
            g = random_graph(2 + (size_t)random_below(&r, 2000), 1 + (size_t)k % 9, k % 2, &r);
        }
        free(order_of(&g));
        clear(&g);
    }
}
END_TEST

/* Leaves first: nothing is filled. */
START_TEST(trees_do_not_fill)
{
    static const size_t REACH[] = {1, 3, 30, 100000};
    random_source r = {2};
    for (int k = 0; k < 4; ++k) {
        graph g = random_tree(30000, REACH[k], &r);
        ck_assert_uint_eq(entries(&g), g.n - 1);
        clear(&g);
    }
    graph star = hubs(1, 50000);
    ck_assert_uint_eq(entries(&star), 50000);
    clear(&star);
}
END_TEST

START_TEST(fill_is_least_where_that_is_known)
{
    graph cycle = path(1000, true), cliques = complete(30, 40), pair = hubs(2, 5000);
    ck_assert_uint_eq(entries(&cycle), 2 * 1000 - 3);
    ck_assert_uint_eq(entries(&cliques), 40 * (30 * 29 / 2));
    ck_assert_uint_eq(entries(&pair), 2 * 5000 + 1);
    clear(&cycle);
    clear(&cliques);
    clear(&pair);
}
END_TEST

/* Puts a box of a grid into order[..end), the middle plane across its longest axis last. Returns
 * where it begins. */
static size_t dissect(size_t size, size_t dim, const size_t *low, const size_t *high,
                      uint32_t *order, size_t end)
{
    size_t axis = 0, half[2][3], place = 0;
    for (size_t a = 0; a < dim; ++a) {
        if (high[a] <= low[a])
            return end;
        axis = high[a] - low[a] > high[axis] - low[axis] ? a : axis;
    }
    const size_t middle = (low[axis] + high[axis]) / 2;
    if (high[axis] - low[axis] == 1) {
        for (size_t a = dim; a-- > 0;)
            place = place * size + low[a];
        order[--end] = (uint32_t)place;
        return end;
    }
    for (int k = 0; k < 3; ++k) { /* the plane, then below it, then above it */
        memcpy(half[0], low, sizeof half[0]);
        memcpy(half[1], high, sizeof half[1]);
        half[0][axis] = k == 1 ? low[axis] : k == 0 ? middle : middle + 1;
        half[1][axis] = k == 1 ? middle : k == 0 ? middle + 1 : high[axis];
        end = dissect(size, dim, half[0], half[1], order, end);
    }
    return end;
}

static void check_grid(size_t size, size_t dim, double most)
{
    const size_t low[3] = {0}, high[3] = {size, size, size};
    graph g = grid(size, dim, false);
    uint32_t *order = malloc(g.n * sizeof *order);
    ck_assert_uint_eq(dissect(size, dim, low, high, order, g.n), 0);
    const double dissected = (double)entries_by(&g, order), ours = (double)entries(&g);
    if (!(ours <= most * dissected))
        ck_abort_msg("%zu^%zu: %.0f entries, %.3f of dissection's", size, dim, ours,
                     ours / dissected);
    free(order);
    clear(&g);
}

/* Dissection wins with larger grids; leaves are better eliminated by degree. */
START_TEST(grids_fill_less_than_by_dissection)
{
    check_grid(31, 2, 0.75);
    check_grid(100, 2, 0.85);
    check_grid(250, 2, 0.9);
    check_grid(12, 3, 0.7);
    check_grid(25, 3, 0.8);
}
END_TEST

/* The hub comes last, and all that it adds to the factor is its row. */
START_TEST(a_full_row_comes_last)
{
    graph without = grid(60, 2, false), with = grid(60, 2, true);
    uint32_t *order = order_of(&with);
    ck_assert_uint_eq(order[with.n - 1], with.n - 1);
    ck_assert_uint_eq(entries_by(&with, order), entries(&without) + without.n);
    free(order);
    clear(&without);
    clear(&with);
}
END_TEST

/* Memory that is full of the same byte. */
static void *stale_alloc(void *user, size_t size)
{
    void *memory = malloc(size);
    if (memory != NULL)
        memset(memory, *(const int *)user, size);
    return memory;
}

static void stale_dealloc(void *user, void *memory)
{
    (void)user;
    free(memory);
}

START_TEST(orders_are_always_the_same)
{
    random_source r = {3};
    for (int k = 0; k < 20; ++k) {
        graph g = random_graph(500, (size_t)k, k % 2, &r);
        uint32_t *order[2];
        for (int b = 0; b < 2; ++b) {
            int byte = b * 0x7f;
            const icc_env given = {.size = sizeof given,
                                   .user = &byte,
                                   .alloc = stale_alloc,
                                   .dealloc = stale_dealloc};
            iccp_env env;
            ck_assert_int_eq(iccp_env_read(&env, &given, NULL), ICC_OK);
            order[b] = malloc(g.n * sizeof **order);
            ck_assert_int_eq(iccp_ordering(&g.m, order[b], &env), ICC_OK);
        }
        ck_assert_mem_eq(order[0], order[1], g.n * sizeof **order);
        free(order[0]);
        free(order[1]);
        clear(&g);
    }
}
END_TEST

static icc_status order_with(const icc_env *outer, icc_error *err, void *argument)
{
    const graph *g = argument;
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, outer, NULL), ICC_OK);
    uint32_t *order = malloc(g->n * sizeof *order);
    const icc_status status = iccp_ordering(&g->m, order, &env);
    free(order);
    return status == ICC_OK ? ICC_OK : iccp_fail(err, status, "not ordered");
}

START_TEST(failures_leave_nothing_behind)
{
    graph g = path(200000, false);
    faulty_sweep(order_with, &g);
    clear(&g);
}
END_TEST

START_TEST(too_many_entries_are_refused)
{
    const size_t first[2] = {0, (size_t)1 << 31};
    const iccp_symmetric m = {1, first, NULL, NULL, NULL};
    const iccp_env env = default_env();
    uint32_t order[1];
    ck_assert_int_eq(iccp_ordering(&m, order, &env), ICC_ERR_RESOLUTION);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("orders of elimination");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, all_sorts_of_graphs_are_ordered);
    tcase_add_test(tests, trees_do_not_fill);
    tcase_add_test(tests, fill_is_least_where_that_is_known);
    tcase_add_test(tests, grids_fill_less_than_by_dissection);
    tcase_add_test(tests, a_full_row_comes_last);
    tcase_add_test(tests, orders_are_always_the_same);
    tcase_add_test(tests, failures_leave_nothing_behind);
    tcase_add_test(tests, too_many_entries_are_refused);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

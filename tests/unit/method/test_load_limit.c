/* What loading may cost: memory is limited by the bytes and icc_env::load_limit, whatever somebody
 * has made up with a checksum that is right, and time with it. */
#include "../../meshes.h"
#include "../../saved.h"
#include "../../suite.h"

#include "base/budget.h"

#include <stdbool.h>
#include <stddef.h>
#include <time.h>

/* Of what is stated in icc/base.h. */
static const double BYTES_PER_BYTE = 64;

typedef struct meter {
    size_t live, peak;
} meter;

/* Each block begins with its size. */
typedef union block {
    size_t size;
    max_align_t align;
} block;

static void *take(void *user, size_t size)
{
    meter *m = user;
    block *b = malloc(sizeof *b + size);
    if (b == NULL)
        return NULL;
    b->size = size;
    m->live += size;
    m->peak = m->live > m->peak ? m->live : m->peak;
    return b + 1;
}

static void give(void *user, void *memory)
{
    meter *m = user;
    block *b = (block *)memory - 1;
    m->live -= b->size;
    free(b);
}

typedef struct cost {
    icc_status status;
    double peak, seconds;
    char message[240];
} cost;

static cost load_cost(const bytes *b, bool is_map, uint64_t limit)
{
    meter m = {0};
    icc_error err = {.size = sizeof err};
    const icc_env env = {
        .size = sizeof env, .user = &m, .alloc = take, .dealloc = give, .load_limit = limit};
    cost c = {0};
    const clock_t start = clock();
    icc_chart *chart = NULL;
    icc_map *map = NULL;
    c.status = is_map ? icc_map_load(&map, b->n, b->data, &env, &err)
                      : icc_chart_load(&chart, b->n, b->data, &env, &err);
    c.seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    c.peak = (double)m.peak;
    memcpy(c.message, err.message, sizeof c.message);
    icc_chart_free(chart);
    icc_map_free(map);
    ck_assert_uint_eq(m.live, 0);
    return c;
}

static void put_u32(unsigned char *at, uint32_t value)
{
    for (int i = 0; i < 4; ++i)
        at[i] = (unsigned char)(value >> 8 * i);
}

/* What a chart on a grid is rebuilt from; the last in its bytes. */
typedef struct choice {
    uint32_t function, tree, cells, constraints, solver;
} choice;

static void forge(bytes *b, int32_t dim, const choice *c)
{
    const uint32_t values[5] = {c->function, c->tree, c->cells, c->constraints, c->solver};
    unsigned char *at = b->data + b->n - (8 + 8 * (size_t)dim + 16 + 24);
    for (int i = 0; i < 5; ++i)
        put_u32(at + 4 * i, values[i]);
    repair_bytes(b, "CHRT");
}

static icc_domain *box(int32_t dim)
{
    static const double L[12] = {0, 0, 3, 0, 3, 1, 1, 1, 1, 3, 0, 3};
    const size_t shape[ICC_MAX_DIM] = {2, 2, 2, 2, 2, 2};
    uint8_t cells[64];
    icc_domain *domain;
    memset(cells, 1, sizeof cells);
    cells[3] = 0;
    const icc_status status = dim == 2
                                  ? icc_domain_create(&domain, 2, 6, L, 0, NULL, NULL, NULL)
                                  : icc_domain_create_mask(&domain, dim, shape, cells, NULL, NULL);
    ck_assert_int_eq(status, ICC_OK);
    return domain;
}

static bytes small_chart(int32_t dim, int32_t method)
{
    icc_domain *domain = box(dim);
    const icc_chart_options options = {.size = sizeof options, .method = method, .cells = 4};
    icc_chart *chart;
    ck_assert_int_eq(icc_chart_create(&chart, domain, &options, NULL, NULL), ICC_OK);
    const bytes b = chart_bytes(chart);
    icc_chart_free(chart);
    icc_domain_free(domain);
    return b;
}

/* Another digest is a later complaint: then the chart has been rebuilt. */
static void check_cost(const bytes *b, const choice *c, double limit)
{
    const cost got = load_cost(b, false, (uint64_t)limit);
    const bool refused = strstr(got.message, "load_limit") != NULL;
    if (!(got.peak <= limit + BYTES_PER_BYTE * (double)b->n) || got.seconds > 4 ||
        (got.status == ICC_ERR_FORMAT) != refused || got.status == ICC_ERR_CANCELLED)
        ck_abort_msg(
            "function %u, %u cells, constraints %u, solver %u, limit %g: status %d (%s), peak "
            "%g, %g s",
            (unsigned)c->function, (unsigned)c->cells, (unsigned)c->constraints,
            (unsigned)c->solver, limit, (int)got.status, got.message, got.peak, got.seconds);
}

/* Gradient in dimensions 2 to 4, field in these: every function, solver and size. */
START_TEST(made_up_charts_stay_within_the_limit)
{
    static const uint32_t CELLS[] = {20, 60, 150, 16384};
    const int32_t dim = 2 + _i / 2, method = _i % 2 == 0 ? ICC_METHOD_GRADIENT : ICC_METHOD_FIELD;
    bytes b = small_chart(dim, method);
    for (uint32_t f = 1; f <= (method == ICC_METHOD_FIELD ? 1u : 5u); ++f)
        for (uint32_t constraints = 0; constraints <= (f > 2 ? 3u : 0u); constraints += 3)
            for (uint32_t solver = 0; solver <= 2; ++solver)
                for (size_t k = 0; k < sizeof CELLS / sizeof *CELLS; ++k) {
                    const choice c = {f, 1, CELLS[k], constraints, solver};
                    forge(&b, dim, &c);
                    check_cost(&b, &c, 1e6);
                    check_cost(&b, &c, 1e7);
                }
    free(b.data);
}
END_TEST

/* Of what cannot be afforded nothing is begun. */
START_TEST(large_grids_are_refused_at_once)
{
    bytes b = small_chart(2, ICC_METHOD_GRADIENT);
    const choice c = {ICC_FUNCTION_DECAY, 1, 4096, 0, 0};
    forge(&b, 2, &c);
    const cost refused = load_cost(&b, false, 0);
    ck_assert_int_eq(refused.status, ICC_ERR_FORMAT);
    ck_assert_ptr_nonnull(strstr(refused.message, "icc_env.load_limit"));
    ck_assert_double_lt(refused.peak, 1e5);
    ck_assert_double_lt(refused.seconds, 0.5);
    free(b.data);
}
END_TEST

/* Whoever raises the limit gets what was saved. */
START_TEST(a_higher_limit_loads_it)
{
    icc_domain *domain = box(2);
    const icc_chart_options options = {
        .size = sizeof options, .method = ICC_METHOD_GRADIENT, .cells = 300};
    icc_chart *chart, *loaded;
    ck_assert_int_eq(icc_chart_create(&chart, domain, &options, NULL, NULL), ICC_OK);
    bytes b = chart_bytes(chart);
    ck_assert_int_eq(load_cost(&b, false, 1000000).status, ICC_ERR_FORMAT);
    ck_assert_int_eq(load_cost(&b, false, 0).status, ICC_OK);
    ck_assert_int_eq(load_cost(&b, false, UINT64_MAX).status, ICC_OK);
    const icc_env env = {.size = sizeof env, .load_limit = 100000000};
    ck_assert_int_eq(icc_chart_load(&loaded, b.n, b.data, &env, NULL), ICC_OK);
    icc_chart_free(loaded);
    icc_chart_free(chart);
    icc_domain_free(domain);
    free(b.data);
}
END_TEST

/* 6-D masks have a facet for every 4 bits or so, thousands of bytes each. */
START_TEST(masks_stay_within_the_limit)
{
    for (int32_t dim = 2; dim <= ICC_MAX_DIM; ++dim) {
        size_t shape[ICC_MAX_DIM] = {dim > 4 ? 2 : 40, 2, 2, 2, 2, 2}, n = 1;
        for (int32_t k = 0; k < dim; ++k)
            n *= shape[k];
        uint8_t *cells = calloc(n, 1);
        icc_domain *domain;
        icc_chart *chart;
        memset(cells, 1, n);
        ck_assert_int_eq(icc_domain_create_mask(&domain, dim, shape, cells, NULL, NULL), ICC_OK);
        const icc_chart_options options = {.size = sizeof options, .method = ICC_METHOD_GRADIENT};
        ck_assert_int_eq(icc_chart_create(&chart, domain, &options, NULL, NULL), ICC_OK);
        bytes b = chart_bytes(chart);
        for (double limit = 1e3; limit < 1e9; limit *= 10) {
            const cost c = load_cost(&b, false, (uint64_t)limit);
            ck_assert_double_le(c.peak, limit + BYTES_PER_BYTE * (double)b.n);
            ck_assert(c.status == ICC_OK || strstr(c.message, "load_limit") != NULL);
            ck_assert(dim > 4 || limit < 1e8 || c.status == ICC_OK);
        }
        ck_assert_int_eq(load_cost(&b, false, UINT64_MAX).status, ICC_OK);
        free(b.data);
        free(cells);
        icc_chart_free(chart);
        icc_domain_free(domain);
    }
}
END_TEST

/* Meshes are read as they are: the bytes alone limit what they take. */
START_TEST(maps_take_a_multiple_of_their_bytes)
{
    static const double A[12] = {0, 0, 3, 0, 3, 1, 1, 1, 1, 3, 0, 3};
    static const double B[12] = {0, 0, 3, 0, 3, 1.2, 1, 1, 1, 3.3, 0, 3};
    icc_domain *source, *target;
    ck_assert_int_eq(icc_domain_create(&source, 2, 6, A, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_domain_create(&target, 2, 6, B, 0, NULL, NULL, NULL), ICC_OK);
    for (int32_t cells = 3; cells <= 100; cells *= 5)
        for (int32_t method = ICC_METHOD_FOLIATION; method <= ICC_METHOD_DISC; method += 2) {
            const icc_chart_options chart = {
                .size = sizeof chart, .method = method, .cells = cells};
            const icc_map_options options = {.size = sizeof options, .chart = &chart};
            icc_map *map;
            ck_assert_int_eq(icc_map_create(&map, source, target, &options, NULL, NULL), ICC_OK);
            bytes b = map_bytes(map);
            const cost c = load_cost(&b, true, 1);
            ck_assert_msg(c.status == ICC_OK, "%s", c.message);
            ck_assert_double_le(c.peak, BYTES_PER_BYTE * (double)b.n);
            free(b.data);
            icc_map_free(map);
        }
    icc_domain_free(source);
    icc_domain_free(target);
}
END_TEST

/* Charts and maps on meshes in two to five dimensions. */
START_TEST(meshes_take_a_multiple_of_their_bytes)
{
    random_source r = {3};
    for (int32_t dim = 2; dim <= 5; ++dim)
        for (size_t n = 1; n <= (dim < 4 ? 8u : 2u); n *= 2) {
            test_mesh m = mesh_cube(dim, n, 0.1, &r);
            const icc_chart_options options = {.size = sizeof options,
                                               .method = ICC_METHOD_FOLIATION};
            icc_domain *domain;
            icc_chart *chart;
            ck_assert_int_eq(mesh_domain(&domain, &m, NULL, NULL), ICC_OK);
            ck_assert_int_eq(icc_chart_create(&chart, domain, &options, NULL, NULL), ICC_OK);
            bytes b = chart_bytes(chart);
            const cost c = load_cost(&b, false, 1);
            ck_assert_msg(c.status == ICC_OK, "%s", c.message);
            ck_assert_double_le(c.peak, BYTES_PER_BYTE * (double)b.n);
            free(b.data);
            icc_chart_free(chart);
            icc_domain_free(domain);
            mesh_free(&m);
        }
}
END_TEST

START_TEST(budgets_are_kept)
{
    iccp_env env;
    iccp_budget budget;
    const icc_env given = {.size = sizeof given, .load_limit = 1000};
    ck_assert_int_eq(iccp_env_read(&env, &given, NULL), ICC_OK);
    ck_assert_int_eq(iccp_budget_keep(&env, 1e30), ICC_OK); /* none so far */
    const iccp_env limited = iccp_budget_begin(&budget, &env);
    ck_assert_int_eq(iccp_budget_keep(&limited, 600), ICC_OK);
    ck_assert_int_eq(iccp_budget_borrow(&limited, 400), ICC_OK);
    ck_assert_int_eq(iccp_budget_borrow(&limited, 400), ICC_OK);
    ck_assert_int_eq(iccp_budget_end(&budget, ICC_ERR_TRACE, NULL), ICC_ERR_TRACE);
    ck_assert_int_eq(iccp_budget_borrow(&limited, 401), ICC_ERR_CANCELLED);
    ck_assert_int_eq(iccp_budget_end(&budget, ICC_ERR_CANCELLED, NULL), ICC_ERR_FORMAT);
    const iccp_env again = iccp_budget_begin(&budget, &env);
    ck_assert_int_eq(iccp_budget_work(&again, 1e3), ICC_OK);
    ck_assert_int_eq(iccp_budget_work(&again, 1e30), ICC_ERR_CANCELLED);
    ck_assert_int_eq(iccp_budget_end(&budget, ICC_ERR_CANCELLED, NULL), ICC_ERR_FORMAT);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("load limit");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 240);
    tcase_add_loop_test(tests, made_up_charts_stay_within_the_limit, 0, 6);
    tcase_add_test(tests, large_grids_are_refused_at_once);
    tcase_add_test(tests, a_higher_limit_loads_it);
    tcase_add_test(tests, masks_stay_within_the_limit);
    tcase_add_test(tests, maps_take_a_multiple_of_their_bytes);
    tcase_add_test(tests, meshes_take_a_multiple_of_their_bytes);
    tcase_add_test(tests, budgets_are_kept);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

/* Every function that allocates, with every one of its allocations failing once. */
#include "../share.h"
#include "../suite.h"
#include "objects.h"

typedef struct counter {
    size_t n_calls, n_live, fail_at;
} counter;

static void *count_alloc(void *user, size_t size)
{
    counter *c = user;
    if (c->n_calls++ == c->fail_at)
        return NULL;
    void *memory = malloc(size);
    c->n_live += memory != NULL;
    return memory;
}

static void count_dealloc(void *user, void *memory)
{
    counter *c = user;
    ck_assert_ptr_nonnull(memory);
    --c->n_live;
    free(memory);
}

/* Returns how many allocations the call makes. */
static size_t fail_each(const objects *o, const call *c)
{
    static outcome plain, out;
    memset(&plain, 0, sizeof plain);
    ck_assert_int_eq(c->run(o, &plain, NULL, NULL), ICC_OK);
    for (size_t k = 0;; k = share_next(k)) {
        counter count = {.fail_at = k};
        const icc_env env = {
            .size = sizeof env, .user = &count, .alloc = count_alloc, .dealloc = count_dealloc};
        icc_error err = {.size = sizeof err};
        memset(&out, 0, sizeof out);
        const icc_status status = c->run(o, &out, &env, &err);
        if (count.n_live != 0)
            ck_abort_msg("%s leaks %zu when allocation %zu fails", c->name, count.n_live, k);
        /* Points are located without the cells that there is no memory for. */
        if (status == ICC_OK) {
            if (memcmp(&plain, &out, sizeof out) != 0)
                ck_abort_msg("%s gives something else when allocation %zu fails", c->name, k);
            if (count.n_calls <= k)
                return k;
            continue;
        }
        if (status != ICC_ERR_MEMORY ||
            (has_error(c) && (err.status != status || err.message[0] == '\0')))
            ck_abort_msg("%s: status %d, error %d (%s) when allocation %zu fails", c->name,
                         (int)status, (int)err.status, err.message, k);
        ck_assert_uint_lt(k, 10000);
    }
}

START_TEST(failed_allocations_are_reported)
{
    for (int m = 0; m < N_METHODS; ++m) {
        objects o;
        objects_init(&o, METHODS[m]);
        for (int i = 0; i < N_CALLS; ++i) {
            if (m > 0 && is_once(&CALLS[i]))
                continue;
            const size_t n = fail_each(&o, &CALLS[i]);
            /* The calls that only read need none, nor do measures that are 0 without looking. */
            if (strcmp(CALLS[i].name, "icc_domain_locate") != 0 &&
                strcmp(CALLS[i].name, "icc_chart_encode") != 0 &&
                strcmp(CALLS[i].name, "icc_tree_get_report") != 0 &&
                strcmp(CALLS[i].name, "icc_function_get_report") != 0 &&
                strcmp(CALLS[i].name, "icc_weights_evaluate") != 0 &&
                strcmp(CALLS[i].name, "icc_binding_pose") != 0 && n == 0 &&
                METHODS[m] == ICC_METHOD_GRADIENT)
                ck_abort_msg("%s: the allocator was not used", CALLS[i].name);
        }
        objects_clear(&o);
    }
}
END_TEST

/* Objects keep each other alive and go back to their allocator with the last. */
START_TEST(objects_are_freed_in_any_order)
{
    counter count = {.fail_at = SIZE_MAX};
    const icc_env env = {
        .size = sizeof env, .user = &count, .alloc = count_alloc, .dealloc = count_dealloc};
    icc_domain *domain;
    icc_chart *chart;
    icc_map *map;
    icc_grid *grid;
    icc_tree *tree;
    icc_function *field;
    icc_shape *shape;
    icc_sampling *sampling;
    icc_weights *kernel, *painted;
    icc_binding *binding;
    uint32_t root;
    const icc_sampling_options coarse = {.size = sizeof coarse, .spacing = 0.5, .steps = -1};
    ck_assert_int_eq(icc_domain_create(&domain, 2, N_CORNERS, SOURCE, 0, NULL, &env, NULL), ICC_OK);
    const icc_domain *regions[1] = {domain};
    ck_assert_int_eq(icc_shape_create(&shape, 2, 1, regions, 0, NULL, 0, NULL, &env, NULL), ICC_OK);
    ck_assert_int_eq(icc_sampling_create(&sampling, shape, &coarse, &env, NULL), ICC_OK);
    ck_assert_int_eq(icc_weights_create(&kernel, sampling, N_HANDLES, HANDLES, NULL, &env, NULL),
                     ICC_OK);
    icc_shape_free(shape);
    icc_sampling_free(sampling);
    ck_assert_int_eq(icc_weights_with_method(&painted, kernel, ICC_WEIGHTS_EQUALITY, &env, NULL),
                     ICC_OK);
    icc_weights_free(kernel);
    ck_assert_int_eq(icc_binding_create(&binding, painted, 1, SOURCE, 1, &env, NULL), ICC_OK);
    icc_weights_free(painted);
    icc_binding_free(binding);
    ck_assert_int_eq(icc_chart_create(&chart, domain, NULL, &env, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_create_from_charts(&map, chart, chart, NULL, &env, NULL), ICC_OK);
    ck_assert_int_eq(icc_grid_create(&grid, domain, 10, &env, NULL), ICC_OK);
    ck_assert_int_eq(icc_grid_find_maximum(grid, &root, NULL, &env, NULL), ICC_OK);
    ck_assert_int_eq(icc_tree_create(&tree, grid, root, NULL, &env, NULL), ICC_OK);
    ck_assert_int_eq(icc_function_create(&field, tree, NULL, &env, NULL), ICC_OK);
    icc_domain_free(domain);
    icc_chart_free(chart);
    icc_grid_free(grid);
    icc_tree_free(tree);
    ck_assert_uint_gt(count.n_live, 0);
    const double p[2] = {0.5, 0.25};
    double q[2];
    icc_status status;
    ck_assert_int_eq(icc_map_apply(map, 1, p, q, &status, NULL, NULL), ICC_OK);
    ck_assert_int_eq(status, ICC_OK);
    ck_assert_double_eq(icc_function_values(field)[root], 10);
    icc_function_report report = {.size = sizeof report};
    ck_assert_int_eq(icc_function_get_report(field, &report, NULL, NULL), ICC_OK);
    ck_assert_uint_eq(report.n_maxima, 1);
    icc_map_free(map);
    icc_function_free(field);
    ck_assert_uint_eq(count.n_live, 0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("allocations");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 300);
    tcase_add_test(tests, failed_allocations_are_reported);
    tcase_add_test(tests, objects_are_freed_in_any_order);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

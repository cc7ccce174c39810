/* Results do not depend on threads, objects may be shared, progress stays on its thread and
 * cancels. */
#include "../reports.h"
#include "../share.h"
#include "../suite.h"
#include "objects.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>

static void check_equal(const call *c, const outcome *a, const outcome *b)
{
    if (memcmp(a, b, sizeof *a) != 0)
        ck_abort_msg("%s: another result", c->name);
}

static void serial(const objects *o, const call *c, outcome *out)
{
    memset(out, 0, sizeof *out);
    ck_assert_int_eq(c->run(o, out, NULL, NULL), ICC_OK);
}

START_TEST(results_do_not_depend_on_the_number_of_threads)
{
    static outcome plain, out;
    objects o;
    objects_init(&o, METHODS[_i]);
    for (int i = 0; i < N_CALLS; ++i) {
        serial(&o, &CALLS[i], &plain);
        for (int32_t n = test_share() < 100 ? 8 : 1; n <= 8; ++n) {
            const icc_env env = {.size = sizeof env, .threads = n};
            memset(&out, 0, sizeof out);
            ck_assert_int_eq(CALLS[i].run(&o, &out, &env, NULL), ICC_OK);
            check_equal(&CALLS[i], &plain, &out);
        }
    }
    objects_clear(&o);
}
END_TEST

typedef struct crew {
    icc_task task;
    void *argument;
    size_t n_tasks;
    atomic_size_t next, n_rounds;
} crew;

static void *crew_work(void *argument)
{
    crew *c = argument;
    for (size_t i; (i = atomic_fetch_add(&c->next, 1)) < c->n_tasks;)
        c->task(c->argument, c->n_tasks - 1 - i);
    return NULL;
}

/* Four threads, the last task first. */
static void crew_run(void *user, size_t n_tasks, icc_task task, void *argument)
{
    crew *c = user;
    pthread_t threads[4];
    c->task = task;
    c->argument = argument;
    c->n_tasks = n_tasks;
    atomic_store(&c->next, 0);
    atomic_fetch_add(&c->n_rounds, 1);
    for (int k = 0; k < 4; ++k)
        ck_assert_int_eq(pthread_create(&threads[k], NULL, crew_work, c), 0);
    for (int k = 0; k < 4; ++k)
        ck_assert_int_eq(pthread_join(threads[k], NULL), 0);
}

START_TEST(the_caller_may_run_the_tasks)
{
    static outcome plain, out;
    objects o;
    objects_init(&o, METHODS[_i]);
    crew c = {.n_tasks = 0};
    for (int i = 0; i < N_CALLS; ++i) {
        serial(&o, &CALLS[i], &plain);
        const icc_env env = {
            .size = sizeof env, .user = &c, .parallel_for = crew_run, .threads = 8};
        memset(&out, 0, sizeof out);
        ck_assert_int_eq(CALLS[i].run(&o, &out, &env, NULL), ICC_OK);
        check_equal(&CALLS[i], &plain, &out);
    }
    ck_assert_uint_ge(atomic_load(&c.n_rounds), METHODS[_i] == ICC_METHOD_GRADIENT ? 7 : 5);
    objects_clear(&o);
}
END_TEST

/* More tasks than the library hands over at once; every one of them must run, and only once. */
START_TEST(long_loops_run_every_task_once)
{
    enum { N = 40000 };
    objects o;
    objects_init(&o, METHODS[_i]);
    double *points = malloc(2 * N * sizeof *points), *images = malloc(4 * N * sizeof *images);
    ck_assert(points != NULL && images != NULL);
    for (size_t i = 0; i < 2 * N; ++i)
        points[i] = o.points[i % (2 * N_POINTS)] + (i % 7 == 0 ? 3 : 0);
    crew c = {.n_tasks = 0};
    const icc_env env = {.size = sizeof env, .user = &c, .parallel_for = crew_run};
    size_t n_failed[2];
    ck_assert_int_eq(icc_map_apply(o.map, N, points, images, NULL, &n_failed[0], NULL), ICC_OK);
    ck_assert_int_eq(icc_map_apply(o.map, N, points, images + 2 * N, NULL, &n_failed[1], &env),
                     ICC_OK);
    ck_assert_uint_eq(n_failed[0], n_failed[1]);
    ck_assert(n_failed[0] > N / 100 && n_failed[0] < N);
    ck_assert_mem_eq(images, images + 2 * N, 2 * N * sizeof *images);
    ck_assert_uint_gt(atomic_load(&c.n_rounds), 1);
    free(points);
    free(images);
    objects_clear(&o);
}
END_TEST

/* A ball and a C, large enough that loops are shared out. */
static icc_tree *large_tree(bool ball)
{
    enum { BALL = 40, C = 180 };
    const size_t side = ball ? BALL : C, n = ball ? side * side * side : side * side;
    const double middle = 0.5 * (double)(side - 1), size = middle - 2;
    uint8_t *inside = malloc(n);
    icc_grid *grid;
    icc_tree *tree;
    uint32_t root;
    ck_assert_ptr_nonnull(inside);
    for (size_t v = 0; v < n; ++v) {
        const double x = (double)(v % side) - middle, y = (double)(v / side % side) - middle;
        const double z = ball ? (double)(v / side / side) - middle : 0,
                     r = sqrt(x * x + y * y + z * z);
        inside[v] = r < size && (ball || (r > 0.5 * size && (x < 0 || fabs(y) > 0.3 * size)));
    }
    ck_assert_int_eq(
        icc_grid_create_mask(&grid, ball ? 3 : 2, (size_t[]){side, side, side}, inside, NULL, NULL),
        ICC_OK);
    ck_assert_int_eq(icc_grid_find_maximum(grid, &root, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_tree_create(&tree, grid, root, NULL, NULL, NULL), ICC_OK);
    icc_grid_free(grid);
    free(inside);
    return tree;
}

static icc_function *large_field(const icc_tree *tree, int32_t function, int32_t solver,
                                 const icc_env *env)
{
    const icc_function_options options = {.size = sizeof options,
                                          .function = function,
                                          .constraints = ICC_CONSTRAINTS_ALL,
                                          .solver = solver};
    icc_function *field;
    ck_assert_int_eq(icc_function_create(&field, tree, &options, env, NULL), ICC_OK);
    return field;
}

static void check_same(const icc_function *a, const icc_function *b, size_t n)
{
    icc_function_info of_a = {.size = sizeof of_a}, of_b = {.size = sizeof of_b};
    ck_assert_int_eq(icc_function_get_info(a, &of_a), ICC_OK);
    ck_assert_int_eq(icc_function_get_info(b, &of_b), ICC_OK);
    ck_assert_mem_eq(&of_a, &of_b, sizeof of_a);
    const icc_solver_report by_a = solver_report_of(a), by_b = solver_report_of(b);
    ck_assert_mem_eq(&by_a, &by_b, offsetof(icc_solver_report, seconds_setup));
    ck_assert_mem_eq(icc_function_values(a), icc_function_values(b), n * sizeof(double));
    ck_assert_mem_eq(icc_function_logs(a), icc_function_logs(b), n * sizeof(double));
}

static const struct {
    bool ball;
    int32_t function, solver;
} LARGE[] = {{true, ICC_FUNCTION_LAPLACE, ICC_SOLVER_ITERATIVE},
             {false, ICC_FUNCTION_LAPLACE, ICC_SOLVER_ITERATIVE},
             {false, ICC_FUNCTION_LAPLACE, ICC_SOLVER_DIRECT},
             {false, ICC_FUNCTION_BILAPLACE, ICC_SOLVER_DIRECT}};
enum { N_LARGE = sizeof LARGE / sizeof *LARGE };

START_TEST(functions_do_not_depend_on_the_number_of_threads)
{
    icc_tree *tree = large_tree(LARGE[_i].ball);
    icc_grid_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_grid_get_info(icc_tree_grid(tree), &info), ICC_OK);
    const int32_t function = LARGE[_i].function, solver = LARGE[_i].solver;
    icc_function *plain = large_field(tree, function, solver, NULL);
    for (int32_t n = 2; n <= 4; n += test_share() < 100 ? 2 : 1) {
        crew c = {.n_tasks = 0};
        const icc_env env = {
            .size = sizeof env, .user = &c, .parallel_for = n == 4 ? crew_run : NULL, .threads = n};
        icc_function *field = large_field(tree, function, solver, &env);
        check_same(plain, field, info.n_vertices);
        icc_function_free(field);
    }
    icc_function_free(plain);
    icc_tree_free(tree);
}
END_TEST

typedef struct user {
    const objects *o;
    const outcome *expected;
    bool same;
} user;

static void *use_objects(void *argument)
{
    user *u = argument;
    outcome *out = malloc(sizeof *out);
    const icc_env env = {.size = sizeof env, .threads = 2};
    u->same = out != NULL;
    for (int round = 0; u->same && round < share_of(2); ++round)
        for (int i = 0; i < N_CALLS; ++i) {
            memset(out, 0, sizeof *out);
            u->same = u->same && CALLS[i].run(u->o, out, &env, NULL) == ICC_OK &&
                      memcmp(out, &u->expected[i], sizeof *out) == 0;
        }
    free(out);
    return NULL;
}

START_TEST(objects_may_be_shared)
{
    static outcome expected[N_CALLS];
    objects o;
    objects_init(&o, METHODS[_i]);
    for (int i = 0; i < N_CALLS; ++i)
        serial(&o, &CALLS[i], &expected[i]);
    enum { N_USERS = 4 };
    pthread_t threads[N_USERS];
    user users[N_USERS];
    for (int k = 0; k < N_USERS; ++k) {
        users[k] = (user){&o, expected, false};
        ck_assert_int_eq(pthread_create(&threads[k], NULL, use_objects, &users[k]), 0);
    }
    for (int k = 0; k < N_USERS; ++k) {
        ck_assert_int_eq(pthread_join(threads[k], NULL), 0);
        ck_assert(users[k].same);
    }
    objects_clear(&o);
}
END_TEST

/* ---- progress ---- */

typedef struct watcher {
    pthread_t caller;
    size_t n_calls, cancel_at;
    atomic_long n_live;
    double last;
    char stage[64];
    crew crew;
} watcher;

static int32_t watch(void *user_pointer, const char *stage, double share)
{
    watcher *w = user_pointer;
    ck_assert(pthread_equal(pthread_self(), w->caller));
    ck_assert(stage != NULL && stage[0] != '\0' && strlen(stage) < sizeof w->stage);
    ck_assert(share >= 0 && share <= 1);
    if (strcmp(stage, w->stage) == 0)
        ck_assert_double_ge(share, w->last);
    strcpy(w->stage, stage);
    w->last = share;
    return w->n_calls++ == w->cancel_at;
}

static void *watch_alloc(void *user_pointer, size_t size)
{
    watcher *w = user_pointer;
    atomic_fetch_add(&w->n_live, 1);
    return malloc(size);
}

static void watch_dealloc(void *user_pointer, void *memory)
{
    watcher *w = user_pointer;
    atomic_fetch_sub(&w->n_live, 1);
    free(memory);
}

static void watch_tasks(void *user_pointer, size_t n_tasks, icc_task task, void *argument)
{
    watcher *w = user_pointer;
    crew_run(&w->crew, n_tasks, task, argument);
}

/* Cancels a call at every chance that it gives, or a share of them, and returns how many there
 * are. */
static size_t cancel_everywhere(const objects *o, const call *c, int32_t threads, bool own_tasks)
{
    static outcome out;
    for (size_t k = 0;; k = share_next(k)) {
        watcher w = {.caller = pthread_self(), .cancel_at = k};
        icc_env env = {.size = sizeof env,
                       .user = &w,
                       .alloc = watch_alloc,
                       .dealloc = watch_dealloc,
                       .progress = watch,
                       .threads = threads};
        if (own_tasks)
            env.parallel_for = watch_tasks;
        icc_error err = {.size = sizeof err};
        const icc_status status = c->run(o, &out, &env, &err);
        if (atomic_load(&w.n_live) != 0)
            ck_abort_msg("%s leaks when it is cancelled", c->name);
        if (status == ICC_OK) {
            ck_assert_uint_le(w.n_calls, k);
            return w.n_calls;
        }
        if (status != ICC_ERR_CANCELLED || w.n_calls != k + 1 ||
            (has_error(c) && (err.status != status || err.message[0] == '\0')))
            ck_abort_msg("%s: status %d, error %d after %zu calls", c->name, (int)status,
                         (int)err.status, w.n_calls);
    }
}

START_TEST(every_long_call_can_be_cancelled)
{
    objects o;
    objects_init(&o, METHODS[_i]);
    for (int i = 0; i < N_CALLS; ++i) {
        if (_i > 0 && is_once(&CALLS[i]))
            continue;
        const size_t n = cancel_everywhere(&o, &CALLS[i], 1, false);
        const char *name = CALLS[i].name;
        /* These take no time, or one report per 65536 vertices is enough. */
        if (n == 0 && METHODS[_i] == ICC_METHOD_GRADIENT && strcmp(name, "icc_chart_trace") != 0 &&
            strcmp(name, "icc_shape_create") != 0 &&
            strcmp(name, "icc_map_create_from_charts") != 0 &&
            strcmp(name, "icc_grid_create_mask") != 0)
            ck_abort_msg("%s reports no progress", name);
    }
    objects_clear(&o);
}
END_TEST

START_TEST(progress_stays_on_the_calling_thread)
{
    objects o;
    objects_init(&o, METHODS[_i]);
    for (int i = 0; i < N_CALLS; ++i) {
        static outcome out;
        if (_i > 0 && is_once(&CALLS[i]))
            continue;
        for (int own = 0; own < 2; ++own) {
            watcher w = {.caller = pthread_self(), .cancel_at = SIZE_MAX};
            const icc_env env = {.size = sizeof env,
                                 .user = &w,
                                 .progress = watch,
                                 .threads = 4,
                                 .parallel_for = own ? watch_tasks : NULL};
            ck_assert_int_eq(CALLS[i].run(&o, &out, &env, NULL), ICC_OK);
        }
        (void)cancel_everywhere(&o, &CALLS[i], 1, true);
    }
    objects_clear(&o);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("threads");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 240);
    tcase_add_loop_test(tests, results_do_not_depend_on_the_number_of_threads, 0, N_METHODS);
    tcase_add_loop_test(tests, the_caller_may_run_the_tasks, 0, N_METHODS);
    tcase_add_loop_test(tests, long_loops_run_every_task_once, 0, N_METHODS);
    tcase_add_loop_test(tests, functions_do_not_depend_on_the_number_of_threads, 0, N_LARGE);
    tcase_add_loop_test(tests, objects_may_be_shared, 0, N_METHODS);
    suite_add_tcase(suite, tests);
    TCase *progress = tcase_create("progress");
    tcase_set_timeout(progress, 240);
    tcase_set_tags(progress, "progress");
    tcase_add_loop_test(progress, every_long_call_can_be_cancelled, 0, N_METHODS);
    tcase_add_loop_test(progress, progress_stays_on_the_calling_thread, 0, N_METHODS);
    suite_add_tcase(suite, progress);
    return suite_run(suite);
}

/* Maps that are made on several threads: the bits of one thread, and no harm when memory or
 * patience end in the middle. */
#include <icc/icc.h>

#include "../../faulty.h"
#include "../../suite.h"

#include <check.h>
#include <math.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 3000 };

typedef struct domains {
    icc_domain *source, *target;
} domains;

/* A round outline with waves, before and after. */
static domains make_domains(size_t n)
{
    static double xy[2][2 * MOST];
    domains d;
    for (size_t i = 0; i < n; ++i) {
        const double angle = 6.28318530717958647692 * (double)i / (double)n;
        const double radius[2] = {1 + 0.12 * cos(6 * angle), 1 + 0.16 * cos(5 * angle + 1)};
        for (int k = 0; k < 2; ++k) {
            xy[k][2 * i] = radius[k] * cos(angle + 0.3 * k);
            xy[k][2 * i + 1] = radius[k] * sin(angle + 0.3 * k);
        }
    }
    ck_assert_int_eq(icc_domain_create(&d.source, 2, n, xy[0], 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_domain_create(&d.target, 2, n, xy[1], 0, NULL, NULL, NULL), ICC_OK);
    return d;
}

static void clear_domains(domains *d)
{
    icc_domain_free(d->source);
    icc_domain_free(d->target);
}

static icc_status make_map(icc_map **map, const domains *d, int32_t method, int32_t kind,
                           const icc_env *env, icc_error *err)
{
    icc_map_options options = {.size = sizeof options, .kind = kind};
    icc_chart_options chart = {.size = sizeof chart, .method = method};
    if (method != 0)
        options.chart = &chart;
    return icc_map_create(map, d->source, d->target, &options, env, err);
}

typedef struct bytes {
    size_t size;
    unsigned char *data;
} bytes;

static bytes saved(const domains *d, int32_t method, int32_t kind, const icc_env *env)
{
    icc_map *map;
    bytes b;
    ck_assert_int_eq(make_map(&map, d, method, kind, env, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_save(map, 0, NULL, &b.size), ICC_OK);
    b.data = malloc(b.size);
    ck_assert_int_eq(icc_map_save(map, b.size, b.data, &b.size), ICC_OK);
    icc_map_free(map);
    return b;
}

/* A caller's loop: backwards, and on two threads; never from inside one of its tasks. */
typedef struct crew {
    icc_task task;
    void *argument;
    size_t begin, end, n_loops;
    bool is_busy;
} crew;

static void *run_part(void *argument)
{
    const crew *c = argument;
    for (size_t i = c->end; i-- > c->begin;)
        c->task(c->argument, i);
    return NULL;
}

static void run_on_two(void *user, size_t n, icc_task task, void *argument)
{
    crew *c = user;
    pthread_t thread;
    crew part[2] = {{.task = task, .argument = argument, .begin = n / 2, .end = n},
                    {.task = task, .argument = argument, .begin = 0, .end = n / 2}};
    ck_assert(!c->is_busy);
    c->is_busy = true;
    ++c->n_loops;
    ck_assert_int_eq(pthread_create(&thread, NULL, run_part, &part[0]), 0);
    (void)run_part(&part[1]);
    ck_assert_int_eq(pthread_join(thread, NULL), 0);
    c->is_busy = false;
}

static const struct {
    size_t n;
    int32_t method, kind;
} CASES[] = {{MOST, 0, ICC_MAP_MESH},
             {300, ICC_METHOD_FOLIATION, ICC_MAP_MESH},
             {300, ICC_METHOD_FOLIATION, ICC_MAP_CURVES},
             {300, ICC_METHOD_DISC, ICC_MAP_CURVES},
             {60, ICC_METHOD_GRADIENT, ICC_MAP_CURVES}};

START_TEST(maps_have_the_same_bits_on_any_threads)
{
    static const int32_t threads[4] = {2, 3, 8, 0};
    domains d = make_domains(CASES[_i].n);
    bytes one = saved(&d, CASES[_i].method, CASES[_i].kind, NULL);
    for (int k = 0; k < 4; ++k) {
        crew c = {.n_loops = 0};
        const icc_env env = {.size = sizeof env,
                             .user = &c,
                             .threads = threads[k],
                             .parallel_for = threads[k] == 0 ? run_on_two : NULL};
        bytes other = saved(&d, CASES[_i].method, CASES[_i].kind, &env);
        ck_assert_uint_eq(one.size, other.size);
        ck_assert(memcmp(one.data, other.data, one.size) == 0);
        ck_assert(threads[k] > 0 || c.n_loops > 0);
        free(other.data);
    }
    free(one.data);
    clear_domains(&d);
}
END_TEST

/* Any allocation may fail on any thread, or the caller may want to stop. What is reported depends
 * on the threads; a share of all is tried. */
START_TEST(failures_on_threads_leave_nothing_behind)
{
    static const size_t sizes[2] = {1500, 100};
    static const int32_t methods[2] = {0, ICC_METHOD_FOLIATION};
    domains d = make_domains(sizes[_i]);
    for (int cancels = 0; cancels < 2; ++cancels) {
        icc_status status = -1;
        for (size_t k = 1; status != ICC_OK; k += 1 + k / 8) {
            faulty f = {.fail_at = cancels ? 0 : k, .cancel_at = cancels ? k : 0};
            icc_error err = {.size = sizeof err};
            icc_env env = faulty_env(&f);
            icc_map *map = NULL;
            env.threads = 2;
            status = make_map(&map, &d, methods[_i], 0, &env, &err);
            icc_map_free(map);
            ck_assert_uint_eq(f.n_live, 0);
            if (status == ICC_OK)
                break;
            ck_assert_int_eq(status, cancels ? ICC_ERR_CANCELLED : ICC_ERR_MEMORY);
            ck_assert_int_eq(err.status, status);
            ck_assert(err.message[0] != '\0');
        }
    }
    clear_domains(&d);
}
END_TEST

/* The side at fault is named whichever thread it is on: a maximum outside. */
START_TEST(the_side_at_fault_is_named)
{
    domains d = make_domains(100);
    for (int32_t side = 1; side <= 2; ++side) {
        const double outside[2] = {5, 5};
        const icc_chart_options chart = {.size = sizeof chart,
                                         .method = ICC_METHOD_GRADIENT,
                                         .maximum = side == 1 ? outside : NULL};
        const icc_map_options options = {.size = sizeof options,
                                         .kind = ICC_MAP_CURVES,
                                         .chart = &chart,
                                         .target_maximum = side == 2 ? outside : NULL};
        for (int32_t threads = 1; threads <= 2; ++threads) {
            const icc_env env = {.size = sizeof env, .threads = threads};
            icc_error err = {.size = sizeof err};
            icc_map *map;
            ck_assert_int_eq(icc_map_create(&map, d.source, d.target, &options, &env, &err),
                             ICC_ERR_OUTSIDE);
            ck_assert_int_eq(err.side, side);
            ck_assert(err.message[0] != '\0');
        }
    }
    clear_domains(&d);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("maps on threads");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 300);
    tcase_add_loop_test(tests, maps_have_the_same_bits_on_any_threads, 0,
                        sizeof CASES / sizeof *CASES);
    tcase_add_loop_test(tests, failures_on_threads_leave_nothing_behind, 0, 2);
    tcase_add_test(tests, the_side_at_fault_is_named);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

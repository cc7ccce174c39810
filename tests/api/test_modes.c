/* Results are the same in every floating-point environment of the caller, which gets it back as it
 * was; and callbacks run in the usual one. */
#include "../share.h"
#include "../suite.h"
#include "objects.h"

#include <fenv.h>
#include <pthread.h>
#include <stdbool.h>

static const char *const MODES[] = {"upward", "downward",
                                    "zero",
#ifdef __SSE2__
                                    "sse",    "ftz",
                                    "traps"
#endif
};
enum { N_MODES = sizeof MODES / sizeof *MODES };

/* ---- callbacks ---- */

static void check_usual(void)
{
    const volatile double third = 1. / 3, small = 0x1p-1060;
    ck_assert_int_eq(fegetround(), FE_TONEAREST);
    ck_assert(third * 3 == 1 && small * 0.5 > 0);
}

static void *get_memory(void *user, size_t size)
{
    (void)user;
    check_usual();
    return malloc(size);
}

static void free_memory(void *user, void *memory)
{
    (void)user;
    check_usual();
    free(memory);
}

static void take_line(void *user, const char *message)
{
    (void)user;
    (void)message;
    check_usual();
}

static int32_t watch(void *user, const char *stage, double share)
{
    (void)user;
    (void)stage;
    (void)share;
    check_usual();
    return 0;
}

typedef struct crew {
    icc_task task;
    void *argument;
    size_t n_tasks;
} crew;

/* The odd tasks, in the mode that is tried; a task leaves it as it was. */
static void *do_odd(void *argument)
{
    const crew *c = argument;
    for (size_t i = 1; i < c->n_tasks; i += 2) {
        mode_begin();
        c->task(c->argument, i);
        (void)mode_end(ICC_OK, "a task");
    }
    return NULL;
}

/* The even ones are done here, the others by another thread. */
static void run_tasks(void *user, size_t n_tasks, icc_task task, void *argument)
{
    (void)user;
    crew c = {.task = task, .argument = argument, .n_tasks = n_tasks};
    pthread_t thread;
    check_usual();
    ck_assert_int_eq(pthread_create(&thread, NULL, do_odd, &c), 0);
    for (size_t i = 0; i < n_tasks; i += 2)
        task(argument, i);
    ck_assert_int_eq(pthread_join(thread, NULL), 0);
}

/* ---- the tests ---- */

static void compare(const objects *o, const call *c, const char *mode, const icc_env *env)
{
    static outcome usual, out;
    memset(&usual, 0, sizeof usual);
    memset(&out, 0, sizeof out);
    mode_choose(NULL);
    ck_assert_int_eq(c->run(o, &usual, NULL, NULL), ICC_OK);
    mode_choose(mode);
    ck_assert_int_eq(c->run(o, &out, env, NULL), ICC_OK);
    mode_choose(NULL);
    if (memcmp(&usual, &out, sizeof out) != 0)
        ck_abort_msg("%s: another result in the mode %s", c->name, mode);
}

/* Every call in each mode, or a share of them: on this thread, with three, and with tasks in that
 * mode. */
START_TEST(results_are_the_same_bits)
{
    const icc_env envs[] = {{.size = sizeof *envs,
                             .alloc = get_memory,
                             .dealloc = free_memory,
                             .log = take_line,
                             .progress = watch},
                            {.size = sizeof *envs, .threads = 3},
                            {.size = sizeof *envs, .parallel_for = run_tasks}};
    objects o;
    objects_init(&o, METHODS[_i]);
    const size_t n_modes = (size_t)share_of(N_MODES);
    for (size_t i = 0; i < N_CALLS; ++i)
        for (size_t m = i; m < i + n_modes && !(_i > 0 && is_once(&CALLS[i])); ++m)
            compare(&o, &CALLS[i], MODES[m % N_MODES], &envs[m % 7 % 3]);
    objects_clear(&o);
}
END_TEST

/* Numbers in messages are rounded as usual. */
START_TEST(messages_are_the_same)
{
    const icc_match_options options = {.size = sizeof options, .drop = 1};
    icc_error err = {.size = sizeof err};
    icc_match *match;
    objects o;
    objects_init(&o, METHODS[0]);
    mode_choose(MODES[_i]);
    const icc_status status =
        icc_match_create(&match, o.source, o.target, 0, NULL, &options, NULL, &err);
    mode_choose(NULL);
    ck_assert_int_eq(status, ICC_ERR_ARGUMENT);
    ck_assert_ptr_nonnull(strstr(err.message, "[0, 0.01]"));
    objects_clear(&o);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("modes");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 300);
    tcase_add_loop_test(tests, results_are_the_same_bits, 0, N_METHODS);
    tcase_add_loop_test(tests, messages_are_the_same, 0, N_MODES);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

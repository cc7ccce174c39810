/* The ground that everything stands on: size-first structs, errors, memory, the environment and
 * parallel loops. */
#include "base/env.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/minmax.h"
#include "base/options.h"
#include "base/sort.h"
#include "base/threads.h"
#include "base/version.h"

#include "../../suite.h"

#include <check.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* ---------------------------------------------------------------- version */

START_TEST(version_is_written_down_once)
{
    char text[32];
    (void)snprintf(text, sizeof text, "%d.%d.%d", ICCP_VERSION_MAJOR, ICCP_VERSION_MINOR,
                   ICCP_VERSION_PATCH);
    ck_assert_str_eq(icc_version(), text);
    ck_assert_int_eq(icc_version_number(),
                     10000 * ICCP_VERSION_MAJOR + 100 * ICCP_VERSION_MINOR + ICCP_VERSION_PATCH);
}
END_TEST

START_TEST(every_status_has_its_name)
{
    ck_assert_str_eq(icc_status_name(ICC_OK), "ICC_OK");
    ck_assert_str_eq(icc_status_name(ICC_ERR_MEMORY), "ICC_ERR_MEMORY");
    ck_assert_str_eq(icc_status_name(ICC_ERR_FORMAT), "ICC_ERR_FORMAT");
    for (icc_status a = ICC_OK; a <= ICC_ERR_FORMAT; ++a) {
        ck_assert(strncmp(icc_status_name(a), "ICC_", 4) == 0);
        for (icc_status b = ICC_OK; b < a; ++b)
            ck_assert_str_ne(icc_status_name(a), icc_status_name(b));
    }
    ck_assert_str_eq(icc_status_name(ICC_ERR_AMBIGUOUS + 1), "unknown status");
    ck_assert_str_eq(icc_status_name(-1), "unknown status");
    ck_assert_str_eq(icc_status_name(INT32_MIN), "unknown status");
}
END_TEST

/* ------------------------------------------------------- size-first structs */

typedef struct old_struct {
    size_t size;
    int32_t a, b;
} old_struct;

typedef struct new_struct {
    size_t size;
    int32_t a, b;
    double c;
} new_struct;

START_TEST(reading_a_struct)
{
    icc_error err = {.size = sizeof err};
    new_struct full;
    memset(&full, 0x55, sizeof full);
    ck_assert_int_eq(iccp_read_struct(&full, sizeof full, NULL, "new_struct", &err), ICC_OK);
    ck_assert(full.a == 0 && full.b == 0 && full.c == 0);

    const old_struct shorter = {sizeof shorter, 1, 2};
    memset(&full, 0x55, sizeof full);
    ck_assert_int_eq(iccp_read_struct(&full, sizeof full, &shorter, "new_struct", &err), ICC_OK);
    ck_assert(full.a == 1 && full.b == 2 && full.c == 0);

    new_struct longer = {.size = sizeof longer, .a = 3, .b = 4};
    old_struct known;
    ck_assert_int_eq(iccp_read_struct(&known, sizeof known, &longer, "old_struct", &err), ICC_OK);
    ck_assert(known.a == 3 && known.b == 4);
    longer.c = 1e-300;
    ck_assert_int_eq(iccp_read_struct(&known, sizeof known, &longer, "old_struct", &err),
                     ICC_ERR_VERSION);
    ck_assert_int_eq(err.status, ICC_ERR_VERSION);
    ck_assert_ptr_nonnull(strstr(err.message, "old_struct"));

    static const size_t sizes[3] = {0, sizeof(size_t) - 1, SIZE_MAX};
    for (int i = 0; i < 3; ++i) {
        longer.size = sizes[i];
        ck_assert_int_eq(iccp_read_struct(&known, sizeof known, &longer, "old_struct", &err),
                         ICC_ERR_ARGUMENT);
    }
}
END_TEST

START_TEST(writing_a_struct)
{
    const new_struct full = {.size = 0, .a = 1, .b = 2, .c = 3};
    struct {
        old_struct given;
        unsigned char beyond[8];
    } room;
    memset(&room, 0x55, sizeof room);
    room.given.size = sizeof room.given;
    ck_assert_int_eq(iccp_write_struct(&room.given, &full, sizeof full, "new_struct", NULL),
                     ICC_OK);
    ck_assert(room.given.size == sizeof room.given && room.given.a == 1 && room.given.b == 2);
    for (size_t i = 0; i < sizeof room.beyond; ++i)
        ck_assert_uint_eq(room.beyond[i], 0x55);

    new_struct longer;
    memset(&longer, 0x55, sizeof longer);
    longer.size = sizeof longer;
    ck_assert_int_eq(iccp_write_struct(&longer, &full, sizeof(old_struct), "old_struct", NULL),
                     ICC_OK);
    ck_assert(longer.a == 1 && longer.b == 2 && longer.c == 0);
    longer.size = 1;
    ck_assert_int_eq(iccp_write_struct(&longer, &full, sizeof full, "new_struct", NULL),
                     ICC_ERR_ARGUMENT);
}
END_TEST

/* ------------------------------------------------------------------ errors */

START_TEST(errors_fill_what_the_caller_has)
{
    ck_assert_int_eq(iccp_fail_at(NULL, ICC_ERR_TRACE, ICC_ITEM_CELL, 5, "x"), ICC_ERR_TRACE);
    size_t n_touched = 0; /* bytes beyond */
    for (size_t size = 0; size <= sizeof(icc_error) + 8; ++size) {
        struct {
            icc_error err;
            unsigned char beyond[8];
        } room;
        unsigned char *bytes = (unsigned char *)&room;
        memset(&room, 0x55, sizeof room);
        room.err.size = size;
        ck_assert_int_eq(iccp_fail_at(&room.err, ICC_ERR_TRACE, ICC_ITEM_VERTEX, 5, "vertex %d", 5),
                         ICC_ERR_TRACE);
        ck_assert_uint_eq(room.err.size, size);
        const size_t known = size == 0 ? sizeof room.err : size; /* 0: the members of version 0.1 */
        for (size_t i = known < sizeof size ? sizeof size : known; i < sizeof room; ++i)
            n_touched += bytes[i] != 0x55;
        if (size == 0 || size >= offsetof(icc_error, message) + 16) {
            ck_assert_str_eq(room.err.message, "vertex 5");
            ck_assert_int_eq(room.err.index, 5);
            ck_assert_int_eq(room.err.item, ICC_ITEM_VERTEX);
            ck_assert_int_eq(room.err.side, 0);
        } else if (size > offsetof(icc_error, message)) {
            ck_assert_ptr_nonnull(memchr(room.err.message, 0, size - offsetof(icc_error, message)));
        }
    }
    ck_assert_uint_eq(n_touched, 0);
}
END_TEST

START_TEST(long_messages_are_cut)
{
    icc_error err = {.size = sizeof err};
    char text[1000];
    memset(text, 'x', sizeof text);
    text[999] = '\0';
    ck_assert_int_eq(iccp_fail(&err, ICC_ERR_FORMAT, "%s", text), ICC_ERR_FORMAT);
    ck_assert_uint_eq(strlen(err.message), sizeof err.message - 1);
    ck_assert_int_eq(iccp_fail_side(&err, ICC_ERR_FORMAT, 2), ICC_ERR_FORMAT);
    ck_assert_int_eq(err.side, 2);
    ck_assert_uint_eq(strlen(err.message), sizeof err.message - 1);
    ck_assert_int_eq(strncmp(err.message, "target: xx", 10), 0);
    icc_error tiny = {.size = offsetof(icc_error, side)};
    ck_assert_int_eq(iccp_fail_side(&tiny, ICC_ERR_FORMAT, 2), ICC_ERR_FORMAT);
    ck_assert_int_eq(tiny.side, 0);
    ck_assert_int_eq(iccp_fail_side(NULL, ICC_ERR_FORMAT, 1), ICC_ERR_FORMAT);
    ck_assert_int_eq(iccp_fail_memory(&err), ICC_ERR_MEMORY);
    ck_assert_int_eq(err.index, -1);
}
END_TEST

/* The first to know says whose fault it is; what comes from deep inside is no side's fault. */
START_TEST(messages_name_the_side)
{
    icc_error err = {0};
    iccp_fail_at(&err, ICC_ERR_BOUNDARY, ICC_ITEM_VERTEX, 3, "vertex %d", 3);
    ck_assert_int_eq(iccp_fail_side(&err, ICC_ERR_BOUNDARY, 0), ICC_ERR_BOUNDARY);
    ck_assert_str_eq(err.message, "vertex 3");
    iccp_fail_side(&err, ICC_ERR_BOUNDARY, 1);
    iccp_fail_side(&err, ICC_ERR_BOUNDARY, 2);
    ck_assert_str_eq(err.message, "source: vertex 3");
    ck_assert(err.side == 1 && err.index == 3 && err.size == 0);
    iccp_fail_side(&err, iccp_fail_memory(&err), 2);
    ck_assert_str_eq(err.message, "out of memory");
    ck_assert_int_eq(err.side, 0);
    for (size_t size = sizeof err.size + 1; size < sizeof err; ++size) {
        icc_error older = {.size = size};
        iccp_fail_side(&older, iccp_fail(&older, ICC_ERR_FORMAT, "x"), 2);
        ck_assert_int_eq(older.message[sizeof older.message - 1], '\0');
    }
}
END_TEST

/* ------------------------------------------------------------------ memory */

typedef struct counter {
    size_t n_allocs, n_frees, last_size;
    bool exhausted;
} counter;

static void *counting_alloc(void *user, size_t size)
{
    counter *c = user;
    c->last_size = size;
    if (c->exhausted)
        return NULL;
    ++c->n_allocs;
    return malloc(size);
}

static void counting_dealloc(void *user, void *memory)
{
    ck_assert_ptr_nonnull(memory);
    ++((counter *)user)->n_frees;
    free(memory);
}

START_TEST(sizes_that_overflow_are_refused)
{
    counter c = {0};
    const iccp_memory memory = {&c, counting_alloc, counting_dealloc};
    static const size_t sizes[4] = {1, 2, 8, SIZE_MAX / 2};
    for (int i = 0; i < 4; ++i) {
        ck_assert_ptr_null(iccp_alloc(&memory, SIZE_MAX / sizes[i], sizes[i]));
        ck_assert_ptr_null(iccp_alloc_zero(&memory, SIZE_MAX / 2 / sizes[i] + 1, sizes[i]));
        ck_assert_ptr_null(iccp_grow(&memory, NULL, 0, SIZE_MAX / sizes[i], sizes[i]));
    }
    ck_assert_uint_eq(c.n_allocs, 0);
}
END_TEST

START_TEST(memory_comes_from_the_caller)
{
    counter c = {0};
    const iccp_memory memory = {&c, counting_alloc, counting_dealloc};
    void *empty = iccp_alloc(&memory, 0, 24);
    ck_assert_ptr_nonnull(empty);
    iccp_free(&memory, empty);
    void *sizeless = iccp_alloc_zero(&memory, 5, 0);
    ck_assert_ptr_nonnull(sizeless);
    iccp_free(&memory, sizeless);
    unsigned char *zeros = iccp_alloc_zero(&memory, 5, 8);
    ck_assert_uint_eq(c.last_size, 40);
    for (int i = 0; i < 40; ++i)
        ck_assert_uint_eq(zeros[i], 0);
    memset(zeros, 7, 40);
    unsigned char *more = iccp_grow(&memory, zeros, 5, 9, 8);
    ck_assert_uint_eq(c.last_size, 72);
    for (int i = 0; i < 40; ++i)
        ck_assert_uint_eq(more[i], 7);
    c.exhausted = true;
    ck_assert_ptr_null(iccp_grow(&memory, more, 9, 10, 8));
    ck_assert_uint_eq(more[0], 7); /* still there */
    ck_assert_ptr_null(iccp_alloc_zero(&memory, 1, 8));
    iccp_free(&memory, more);
    iccp_free(&memory, NULL);
    ck_assert_uint_eq(c.n_allocs, 4);
    ck_assert_uint_eq(c.n_frees, 4);
    void *usual = iccp_alloc(&iccp_memory_default, 3, 3);
    ck_assert_ptr_nonnull(usual);
    iccp_free(&iccp_memory_default, usual);
}
END_TEST

/* ------------------------------------------------------------- environment */

static void keep_line(void *user, const char *message)
{
    (void)snprintf(user, 300, "%s", message);
}

static int32_t stop_at_half(void *user, const char *stage, double share)
{
    ck_assert_str_eq(stage, "stage");
    ++*(int *)user;
    return share >= 0.5;
}

START_TEST(environments_are_completed)
{
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    ck_assert_int_eq(env.threads, 1);
    ck_assert(env.memory.alloc == iccp_memory_default.alloc);
    ck_assert_int_eq(iccp_progress(&env, "stage", 1), ICC_OK);
    iccp_log(&env, "nobody listens");

    int n_reports = 0;
    icc_env given = {.size = sizeof given, .user = &n_reports, .progress = stop_at_half};
    ck_assert_int_eq(iccp_env_read(&env, &given, NULL), ICC_OK);
    ck_assert_int_eq(iccp_progress(&env, "stage", 0.25), ICC_OK);
    ck_assert_int_eq(iccp_progress(&env, "stage", 0.5), ICC_ERR_CANCELLED);
    ck_assert_int_eq(n_reports, 2);

    char line[300] = "";
    given = (icc_env){.size = sizeof given, .user = line, .log = keep_line};
    ck_assert_int_eq(iccp_env_read(&env, &given, NULL), ICC_OK);
    iccp_log(&env, "%d vertices", 12);
    ck_assert_str_eq(line, "12 vertices");
}
END_TEST

static int32_t keep_share(void *user, const char *stage, double share)
{
    iccp_reported *last = user;
    ck_assert_double_ge(share, last->share);
    *last = (iccp_reported){stage, share};
    return 0;
}

START_TEST(parts_report_for_the_whole_call)
{
    iccp_env env, part[3];
    iccp_reported last = {0};
    const icc_env given = {.size = sizeof given, .user = &last, .progress = keep_share};
    ck_assert_int_eq(iccp_env_read(&env, &given, NULL), ICC_OK);
    /* A call that reports nothing ends without a report. */
    ck_assert_int_eq(iccp_finish(&env, ICC_OK), ICC_OK);
    ck_assert_ptr_null(last.stage);

    iccp_split(part, 3, (const double[]){1, 2, 1}, &env);
    ck_assert_int_eq(iccp_progress(&part[0], "mesh", 0.5), ICC_OK);
    ck_assert_double_eq_tol(last.share, 0.125, 1e-15);
    const iccp_env second = iccp_part(&part[1], "improve", 0.5, 1);
    ck_assert_int_eq(iccp_progress(&second, "solve", 0), ICC_OK);
    ck_assert_str_eq(last.stage, "improve");
    ck_assert_double_eq_tol(last.share, 0.5, 1e-15);
    /* A part of a part keeps the outer name, and shares that fall are held back. */
    const iccp_env inner = iccp_part(&second, "repair", 0, 0.1);
    ck_assert_int_eq(iccp_progress(&inner, "solve", 1), ICC_OK);
    ck_assert_str_eq(last.stage, "improve");
    const double before = last.share;
    ck_assert_int_eq(iccp_progress(&part[0], "mesh", 1), ICC_OK);
    ck_assert_str_eq(last.stage, "mesh");
    ck_assert_double_eq(last.share, before);
    /* Rounds without end stay below the end of their part. */
    for (size_t k = 0; k < 1000; ++k) {
        const iccp_env round = iccp_round(&part[2], k, 3);
        ck_assert_int_eq(iccp_progress(&round, "solve", 1), ICC_OK);
        ck_assert_double_lt(last.share, 1);
        ck_assert(k != 2 || fabs(last.share - 0.875) < 1e-15);
    }
    ck_assert_int_eq(iccp_finish(&env, ICC_ERR_SOLVER), ICC_ERR_SOLVER);
    ck_assert_double_lt(last.share, 1);
    ck_assert_int_eq(iccp_finish(&env, ICC_OK), ICC_OK);
    ck_assert_double_eq(last.share, 1);
}
END_TEST

START_TEST(environments_that_make_no_sense)
{
    iccp_env env;
    icc_error err = {.size = sizeof err};
    icc_env given = {.size = sizeof given, .alloc = counting_alloc};
    ck_assert_int_eq(iccp_env_read(&env, &given, &err), ICC_ERR_ARGUMENT);
    given = (icc_env){.size = sizeof given, .dealloc = counting_dealloc};
    ck_assert_int_eq(iccp_env_read(&env, &given, &err), ICC_ERR_ARGUMENT);
    static const int32_t threads[3] = {-1, 1025, INT32_MIN};
    for (int i = 0; i < 3; ++i) {
        given = (icc_env){.size = sizeof given, .threads = threads[i]};
        ck_assert_int_eq(iccp_env_read(&env, &given, &err), ICC_ERR_ARGUMENT);
    }
    given = (icc_env){.size = 0};
    ck_assert_int_eq(iccp_env_read(&env, &given, &err), ICC_ERR_ARGUMENT);
}
END_TEST

/* ----------------------------------------------------------------- threads */

enum { N_ITEMS = 100003, GRAIN = 97 };

typedef struct job {
    unsigned char *done;
    size_t fail_from, fail_again; /* chunks that begin at or after these fail, differently */
    atomic_size_t n_chunks, n_wrong;
} job;

static job new_job(size_t fail_from, size_t fail_again)
{
    job j = {calloc(N_ITEMS, 1), fail_from, fail_again, 0, 0};
    ck_assert_ptr_nonnull(j.done);
    return j;
}

static icc_status work(void *argument, size_t begin, size_t end)
{
    job *j = argument;
    if (begin % GRAIN != 0 || begin >= end || end - begin > GRAIN)
        atomic_fetch_add(&j->n_wrong, 1);
    atomic_fetch_add(&j->n_chunks, 1);
    if (begin >= j->fail_again)
        return ICC_ERR_TRACE;
    if (begin >= j->fail_from)
        return ICC_ERR_SOLVER;
    for (size_t i = begin; i < end; ++i)
        ++j->done[i];
    return ICC_OK;
}

static icc_status run_loop(job *j, size_t n, const icc_env *given)
{
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, given, NULL), ICC_OK);
    const icc_status status = iccp_for_chunks(&env, "loop", n, GRAIN, work, j);
    ck_assert_uint_eq(atomic_load(&j->n_wrong), 0);
    return status;
}

/* An assertion costs a system call: once for all. */
static void check_done_once(const unsigned char *done, size_t n)
{
    size_t n_wrong = 0;
    for (size_t i = 0; i < N_ITEMS; ++i)
        n_wrong += done[i] != (i < n);
    ck_assert_uint_eq(n_wrong, 0);
}

START_TEST(loops_do_everything_once)
{
    static const size_t lengths[6] = {0, 1, GRAIN, GRAIN + 1, 5000, N_ITEMS};
    for (int32_t threads = 0; threads <= 8; ++threads)
        for (int i = 0; i < 6; ++i) {
            job j = new_job(SIZE_MAX, SIZE_MAX);
            const icc_env env = {.size = sizeof env, .threads = threads};
            ck_assert_int_eq(run_loop(&j, lengths[i], &env), ICC_OK);
            check_done_once(j.done, lengths[i]);
            ck_assert_uint_eq(atomic_load(&j.n_chunks), (lengths[i] + GRAIN - 1) / GRAIN);
            free(j.done);
        }
    job j = new_job(SIZE_MAX, SIZE_MAX); /* more than the library will start */
    const icc_env env = {.size = sizeof env, .threads = 1024};
    ck_assert_int_eq(run_loop(&j, N_ITEMS, &env), ICC_OK);
    check_done_once(j.done, N_ITEMS);
    free(j.done);
}
END_TEST

START_TEST(the_first_failure_wins)
{
    for (int32_t threads = 1; threads <= 8; ++threads)
        for (int round = 0; round < 50; ++round) {
            /* Everything after chunk 300 fails; only the first of them in this way. */
            job j = new_job(300 * GRAIN, 301 * GRAIN);
            const icc_env env = {.size = sizeof env, .threads = threads};
            ck_assert_int_eq(run_loop(&j, N_ITEMS, &env), ICC_ERR_SOLVER);
            ck_assert_uint_lt(atomic_load(&j.n_chunks), 301 + 2 * (size_t)threads);
            check_done_once(j.done, 300 * GRAIN);
            free(j.done);
        }
}
END_TEST

/* A caller's parallel_for: backwards, or on two threads of its own. */
typedef struct half {
    icc_task task;
    void *argument;
    size_t begin, end;
} half;

static void *run_half(void *argument)
{
    const half *h = argument;
    for (size_t i = h->end; i-- > h->begin;)
        h->task(h->argument, i);
    return NULL;
}

static void run_backwards(void *user, size_t n, icc_task task, void *argument)
{
    ++*(size_t *)user;
    half all = {task, argument, 0, n};
    (void)run_half(&all);
}

static void run_on_two(void *user, size_t n, icc_task task, void *argument)
{
    ++*(size_t *)user;
    half first = {task, argument, 0, n / 2}, second = {task, argument, n / 2, n};
    pthread_t thread;
    ck_assert_int_eq(pthread_create(&thread, NULL, run_half, &first), 0);
    (void)run_half(&second);
    ck_assert_int_eq(pthread_join(thread, NULL), 0);
}

/* Some twice, some never. */
static void run_badly(void *user, size_t n, icc_task task, void *argument)
{
    ++*(size_t *)user;
    for (size_t i = 0; i < n; i += 3) {
        task(argument, i);
        task(argument, i);
    }
}

static void run_nothing(void *user, size_t n, icc_task task, void *argument)
{
    (void)n, (void)task, (void)argument;
    ++*(size_t *)user;
}

START_TEST(the_callers_threads_are_used)
{
    void (*const run[])(void *, size_t, icc_task, void *) = {run_backwards, run_on_two, run_badly,
                                                             run_nothing};
    for (int i = 0; i < 4; ++i) {
        size_t n_rounds = 0;
        const icc_env env = {.size = sizeof env, .user = &n_rounds, .parallel_for = run[i]};
        job j = new_job(SIZE_MAX, SIZE_MAX);
        ck_assert_int_eq(run_loop(&j, N_ITEMS, &env), ICC_OK);
        check_done_once(j.done, N_ITEMS);
        ck_assert_uint_gt(n_rounds, 1);
        memset(j.done, 0, N_ITEMS);
        j.fail_from = 300 * GRAIN;
        j.fail_again = 301 * GRAIN;
        ck_assert_int_eq(run_loop(&j, N_ITEMS, &env), ICC_ERR_SOLVER);
        free(j.done);
    }
}
END_TEST

typedef struct patience {
    int n_reports, n_wanted;
    pthread_t caller;
} patience;

static int32_t run_out(void *user, const char *stage, double share)
{
    patience *p = user;
    ck_assert_str_eq(stage, "loop");
    ck_assert(share >= 0 && share <= 1);
    ck_assert(pthread_equal(pthread_self(), p->caller));
    return ++p->n_reports == p->n_wanted;
}

static void run_in_order(void *user, size_t n, icc_task task, void *argument)
{
    (void)user;
    for (size_t i = 0; i < n; ++i)
        task(argument, i);
}

/* Loops inside the tasks of a loop. */
typedef struct nest {
    const iccp_env *env;
    job *inner;
} nest;

static icc_status run_inner(void *argument, size_t begin, size_t end)
{
    const nest *t = argument;
    icc_status status = ICC_OK;
    for (size_t k = begin; k < end && status == ICC_OK; ++k)
        status = iccp_for_chunks(t->env, "inner", N_ITEMS / 10, GRAIN, work, &t->inner[k]);
    return status;
}

/* A team passes from loop to loop, after naps too; without threads the callers do it all. */
START_TEST(teams_stay_from_loop_to_loop)
{
    enum { N_INNER = 6 };
    for (int32_t threads = 1; threads <= 8; threads += 1 + threads / 3)
        for (int has_threads = 0; has_threads < 2; ++has_threads) {
            const icc_env given = {.size = sizeof given, .threads = threads};
            iccp_env env, with;
            iccp_team team, idle;
            job inner[N_INNER];
            ck_assert_int_eq(iccp_env_read(&env, &given, NULL), ICC_OK);
            iccp_team_begin(&idle, 0);
            if (has_threads == 0)
                env.team = &idle;
            iccp_with_team(&with, &team, &env);
            ck_assert((with.team == &team) == (threads > 1 && has_threads == 1));
            for (int round = 0; round < 12; ++round) {
                job j = new_job(SIZE_MAX, SIZE_MAX);
                const size_t n = round % 3 == 0 ? N_ITEMS : 3 * GRAIN;
                if (round % 4 == 3)
                    (void)nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
                ck_assert_int_eq(iccp_for_chunks(&with, "loop", n, GRAIN, work, &j), ICC_OK);
                check_done_once(j.done, n);
                free(j.done);
            }
            for (int k = 0; k < N_INNER; ++k)
                inner[k] = new_job(k == 3 ? 300 : SIZE_MAX, SIZE_MAX);
            ck_assert_int_eq(iccp_for_chunks(&with, "loop", 3, 1, run_inner, &(nest){&with, inner}),
                             ICC_OK);
            for (int k = 0; k < 3; ++k)
                check_done_once(inner[k].done, N_ITEMS / 10);
            ck_assert_int_eq(
                iccp_for_chunks(&with, "loop", N_INNER, 1, run_inner, &(nest){&with, inner}),
                ICC_ERR_SOLVER);
            for (int k = 0; k < N_INNER; ++k)
                free(inner[k].done);
            iccp_without_team(&with, &env);
            iccp_team_end(&idle);
        }
}
END_TEST

START_TEST(loops_can_be_cancelled)
{
    for (int32_t threads = 0; threads <= 8; ++threads) /* 0: the caller's */
        for (int n_wanted = 1; n_wanted <= 3; ++n_wanted) {
            patience p = {0, n_wanted, pthread_self()};
            const icc_env env = {.size = sizeof env,
                                 .user = &p,
                                 .progress = run_out,
                                 .threads = threads,
                                 .parallel_for = threads == 0 ? run_in_order : NULL};
            job j = new_job(SIZE_MAX, SIZE_MAX);
            const icc_status status = run_loop(&j, N_ITEMS, &env);
            /* Other threads may have finished before the caller was asked that often. */
            ck_assert(status == ICC_ERR_CANCELLED || (threads > 1 && p.n_reports < n_wanted));
            ck_assert_int_le(p.n_reports, n_wanted);
            free(j.done);
        }
}
END_TEST

/* ----------------------------------------------------------- side by side */

/* What two tasks do and see: a loop each, reports, a line in the log, and an error. */
typedef struct pair {
    const iccp_env *outer;
    unsigned char *done[2];
    int32_t threads[2];
    size_t fails, fails_too; /* task numbers; 2: none */
    atomic_int n_calls_inside;
    int n_reports, cancel_at;
    double share;
    pthread_t caller;
    char lines[64];
    atomic_size_t n_tasks; /* that a caller's parallel_for has run */
    icc_status status;
} pair;

static icc_status fill_side(void *argument, size_t begin, size_t end)
{
    for (size_t i = begin; i < end; ++i)
        ++((unsigned char *)argument)[i];
    return ICC_OK;
}

static icc_status run_task(void *argument, size_t k, const iccp_env *env, icc_error *err)
{
    pair *p = argument;
    p->threads[k] = env->threads;
    iccp_log(env, "task %zu", k);
    const icc_status status = iccp_for_chunks(env, "loop", N_ITEMS, GRAIN, fill_side, p->done[k]);
    if (status != ICC_OK)
        return iccp_explain(err, status);
    for (int i = 0; i < 100; ++i)
        if (iccp_progress(env, "later", i / 99.0) != ICC_OK)
            return iccp_explain(err, ICC_ERR_CANCELLED);
    if (k == p->fails || k == p->fails_too)
        return iccp_fail(err, k == p->fails ? ICC_ERR_SOLVER : ICC_ERR_TRACE, "task %zu fails", k);
    return ICC_OK;
}

static void note_line(void *user, const char *message)
{
    pair *p = user;
    ck_assert(pthread_equal(pthread_self(), p->caller));
    (void)strcat(strcat(p->lines, message), ";");
}

static int32_t note_share(void *user, const char *stage, double share)
{
    pair *p = user;
    (void)stage;
    ck_assert(pthread_equal(pthread_self(), p->caller));
    ck_assert(share >= p->share && share <= 1);
    p->share = share;
    return ++p->n_reports == p->cancel_at;
}

static void run_pair_on_two(void *user, size_t n, icc_task task, void *argument)
{
    pair *p = user;
    size_t n_rounds = 0;
    ck_assert_int_eq(atomic_fetch_add(&p->n_calls_inside, 1), 0); /* never from inside a task */
    atomic_fetch_add(&p->n_tasks, n);
    run_on_two(&n_rounds, n, task, argument);
    atomic_fetch_sub(&p->n_calls_inside, 1);
}

/* `threads` 0: on the caller's. */
static pair run_pair(int32_t threads, size_t fails, size_t fails_too, int cancel_at)
{
    pair p = {.fails = fails, .fails_too = fails_too, .cancel_at = cancel_at};
    const icc_env given = {.size = sizeof given,
                           .user = &p,
                           .log = note_line,
                           .progress = note_share,
                           .threads = threads,
                           .parallel_for = threads == 0 ? run_pair_on_two : NULL};
    iccp_env env;
    icc_error err = {.size = sizeof err};
    p.caller = pthread_self();
    for (int k = 0; k < 2; ++k)
        p.done[k] = calloc(N_ITEMS, 1);
    ck_assert_int_eq(iccp_env_read(&env, &given, NULL), ICC_OK);
    p.status = iccp_side_by_side(&env, 2, run_task, &p, &err);
    if (p.status != ICC_OK) {
        ck_assert_int_eq(err.status, p.status);
        ck_assert(cancel_at > 0 ||
                  strcmp(err.message,
                         fails == 1 && fails_too == 2 ? "task 1 fails" : "task 0 fails") == 0);
    }
    for (int k = 0; k < 2 && p.status == ICC_OK; ++k)
        check_done_once(p.done[k], N_ITEMS);
    free(p.done[0]);
    free(p.done[1]);
    return p;
}

START_TEST(tasks_run_side_by_side)
{
    for (int32_t threads = 0; threads <= 8; ++threads) {
        const pair p = run_pair(threads, 2, 2, 0);
        ck_assert_int_eq(p.status, ICC_OK);
        ck_assert_str_eq(p.lines, "task 0;task 1;");
        if (threads == 0)
            ck_assert_uint_eq(p.n_tasks, 2);
        for (int k = 0; k < 2; ++k)
            ck_assert_int_eq(p.threads[k], threads > 1 ? threads : 1);
    }
}
END_TEST

START_TEST(the_first_task_that_fails_decides)
{
    for (int32_t threads = 0; threads <= 4; ++threads)
        for (int round = 0; round < 5; ++round) {
            ck_assert_int_eq(run_pair(threads, 0, 2, 0).status, ICC_ERR_SOLVER);
            ck_assert_int_eq(run_pair(threads, 1, 2, 0).status, ICC_ERR_SOLVER);
            ck_assert_int_eq(run_pair(threads, 0, 1, 0).status, ICC_ERR_SOLVER);
            ck_assert_int_eq(run_pair(threads, 1, 0, 0).status, ICC_ERR_TRACE);
        }
}
END_TEST

/* A task that another thread runs has no reports to be cancelled by, but ends soon as well. */
START_TEST(tasks_can_be_cancelled)
{
    for (int32_t threads = 1; threads <= 4; ++threads)
        for (int cancel_at = 1; cancel_at <= 40; cancel_at += 13) {
            const pair p = run_pair(threads, 2, 2, cancel_at);
            /* Another thread may have done it all before the caller was asked that often. */
            ck_assert(p.status == ICC_ERR_CANCELLED || (threads > 1 && p.n_reports < cancel_at));
            ck_assert_int_le(p.n_reports, cancel_at);
        }
}
END_TEST

static int by_value(const void *a, const void *b)
{
    const uint32_t *p = a, *q = b;
    return (p[0] > q[0]) - (p[0] < q[0]);
}

/* Pairs of a value and a number: in order, and each still there. */
static bool same_number(double a, double b)
{
    return a >= b && a <= b && !signbit(a) == !signbit(b);
}

START_TEST(the_lesser_and_the_greater_of_two)
{
    ck_assert(same_number(iccp_min(1, 2), 1) && same_number(iccp_min(2, 1), 1));
    ck_assert(same_number(iccp_max(1, 2), 2) && same_number(iccp_max(2, 1), 2));
    ck_assert(same_number(iccp_min(-HUGE_VAL, 1), -HUGE_VAL));
    ck_assert(same_number(iccp_max(1, HUGE_VAL), HUGE_VAL));
    /* A number rather than NaN; of two zeros the second. */
    ck_assert(same_number(iccp_min(NAN, 1), 1) && same_number(iccp_min(1, NAN), 1));
    ck_assert(same_number(iccp_max(NAN, 1), 1) && same_number(iccp_max(1, NAN), 1));
    ck_assert(isnan(iccp_min(NAN, NAN)) && isnan(iccp_max(NAN, NAN)));
    ck_assert(same_number(iccp_min(0.0, -0.0), -0.0) && same_number(iccp_min(-0.0, 0.0), 0.0));
    ck_assert(same_number(iccp_max(0.0, -0.0), -0.0) && same_number(iccp_max(-0.0, 0.0), 0.0));
}
END_TEST

START_TEST(sorting_keeps_everything)
{
    enum { MOST = 300 };
    uint32_t pairs[2 * MOST];
    iccp_sort(NULL, 0, sizeof *pairs, by_value);
    for (size_t n = 0; n < MOST; ++n)
        for (uint32_t values = 1; values < 1000; values *= 30) {
            bool seen[MOST] = {false};
            for (size_t i = 0; i < n; ++i) {
                pairs[2 * i] = (uint32_t)(i * 2654435761u >> 5) % values;
                pairs[2 * i + 1] = (uint32_t)i;
            }
            iccp_sort(pairs, n, 2 * sizeof *pairs, by_value);
            for (size_t i = 0; i < n; ++i) {
                const uint32_t number = pairs[2 * i + 1];
                ck_assert(i == 0 || pairs[2 * i - 2] <= pairs[2 * i]);
                ck_assert(number < n && !seen[number]);
                ck_assert_uint_eq(pairs[2 * i],
                                  (uint32_t)(number * (size_t)2654435761u >> 5) % values);
                seen[number] = true;
            }
        }
}
END_TEST

static bool is_below(const void *context, uint32_t a, uint32_t b)
{
    const uint32_t *values = context;
    return values[a] < values[b];
}

START_TEST(selected_numbers_are_those_of_a_sorted_list)
{
    for (size_t n = 1; n < 40; ++n)
        for (size_t k = 0; k < n; ++k) {
            double x[40];
            for (size_t i = 0; i < n; ++i)
                x[i] = (uint32_t)((i + n) * 2654435761u >> 5) % 10;
            size_t n_below = 0, n_not_above = 0;
            const double least = iccp_select(x, n, k);
            for (size_t i = 0; i < n; ++i) {
                n_below += x[i] < least;
                n_not_above += x[i] <= least;
            }
            ck_assert(n_below <= k && k < n_not_above);
        }
}
END_TEST

START_TEST(sorted_indices_keep_their_order_where_values_are_equal)
{
    enum { MOST = 300 };
    uint32_t values[MOST], order[MOST], work[MOST];
    for (size_t n = 0; n < MOST; ++n)
        for (uint32_t different = 1; different < 1000; different *= 30) {
            bool seen[MOST] = {false};
            for (size_t i = 0; i < n; ++i) {
                values[i] = (uint32_t)(i * 2654435761u >> 5) % different;
                order[i] = (uint32_t)i;
            }
            iccp_sort_indices(order, work, n, values, is_below);
            for (size_t i = 0; i < n; ++i) {
                ck_assert(order[i] < n && !seen[order[i]]);
                seen[order[i]] = true;
                if (i == 0)
                    continue;
                const uint32_t a = order[i - 1], b = order[i];
                ck_assert(values[a] < values[b] || (values[a] == values[b] && a < b));
            }
        }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("base");
    TCase *tests = tcase_create("base");
    tcase_add_test(tests, version_is_written_down_once);
    tcase_add_test(tests, the_lesser_and_the_greater_of_two);
    tcase_add_test(tests, sorting_keeps_everything);
    tcase_add_test(tests, sorted_indices_keep_their_order_where_values_are_equal);
    tcase_add_test(tests, selected_numbers_are_those_of_a_sorted_list);
    tcase_add_test(tests, every_status_has_its_name);
    tcase_add_test(tests, reading_a_struct);
    tcase_add_test(tests, writing_a_struct);
    tcase_add_test(tests, errors_fill_what_the_caller_has);
    tcase_add_test(tests, long_messages_are_cut);
    tcase_add_test(tests, messages_name_the_side);
    tcase_add_test(tests, sizes_that_overflow_are_refused);
    tcase_add_test(tests, memory_comes_from_the_caller);
    tcase_add_test(tests, environments_are_completed);
    tcase_add_test(tests, parts_report_for_the_whole_call);
    tcase_add_test(tests, environments_that_make_no_sense);
    tcase_add_test(tests, loops_do_everything_once);
    tcase_add_test(tests, the_first_failure_wins);
    tcase_add_test(tests, the_callers_threads_are_used);
    tcase_add_test(tests, teams_stay_from_loop_to_loop);
    tcase_add_test(tests, loops_can_be_cancelled);
    tcase_add_test(tests, tasks_run_side_by_side);
    tcase_add_test(tests, the_first_task_that_fails_decides);
    tcase_add_test(tests, tasks_can_be_cancelled);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

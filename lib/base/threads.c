/* Parallel loops over chunks, and tasks side by side. */
#include "base/threads.h"

#include "base/error.h"
#include "base/fpenv.h"

#include <assert.h>
#include <errno.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>

/* ---- teams ---- */

void iccp_with_team(iccp_env *out, iccp_team *team, const iccp_env *env)
{
    *out = *env;
    if (env->team != NULL || env->threads <= 1 || env->parallel_for != NULL)
        return;
    iccp_team_begin(team, (size_t)env->threads - 1);
    out->team = team;
}

void iccp_without_team(const iccp_env *with, const iccp_env *env)
{
    if (with->team != env->team)
        iccp_team_end(with->team);
}

/* ---- loops ---- */

typedef struct loop {
    iccp_chunk chunk;
    void *argument;
    size_t n, grain, n_chunks;
    atomic_size_t next; /* next chunk to give out */
    atomic_bool stop;
    atomic_flag lock; /* guards the two below; taken for a few instructions, after failures only */
    size_t failed_chunk;
    icc_status status;
} loop;

static void run_chunk(loop *l, size_t index)
{
    const size_t begin = index * l->grain;
    const size_t end = l->n - begin < l->grain ? l->n : begin + l->grain;
    const icc_status status = l->chunk(l->argument, begin, end);
    if (status == ICC_OK)
        return;
    while (atomic_flag_test_and_set(&l->lock)) {
    }
    if (l->status == ICC_OK || index < l->failed_chunk) {
        l->status = status;
        l->failed_chunk = index;
    }
    atomic_flag_clear(&l->lock);
    atomic_store(&l->stop, true);
}

/* Gives out the next chunk. Chunks go out in order, so every chunk before a failed one has run or
 * is running. So the first failure is the same for every number of threads. */
static bool take_chunk(loop *l, size_t *index)
{
    if (atomic_load(&l->stop))
        return false;
    *index = atomic_fetch_add(&l->next, 1);
    return *index < l->n_chunks;
}

/* The calling thread takes chunks like the others. Only it reports progress, so the callback need
 * not be thread-safe. */
static icc_status run_this_thread(loop *l, const iccp_env *env, const char *stage)
{
    icc_status status = ICC_OK;
    size_t index;
    while (status == ICC_OK && take_chunk(l, &index)) {
        status = iccp_progress(env, stage, (double)index / (double)l->n_chunks);
        if (status == ICC_OK)
            run_chunk(l, index);
        else
            atomic_store(&l->stop, true);
    }
    return status;
}

static void take_chunks(void *argument)
{
    loop *l = argument;
    size_t index;
    while (take_chunk(l, &index))
        run_chunk(l, index);
}

/* Reports progress once before other threads come, because they may take all the chunks. */
static icc_status run_own_threads(loop *l, const iccp_env *env, const char *stage)
{
    if (env->threads <= 1 || l->n_chunks <= 1)
        return run_this_thread(l, env, stage);
    iccp_job job = {.work = take_chunks, .argument = l, .wanted = l->n_chunks - 1};
    iccp_team own;
    iccp_env with;
    icc_status status = iccp_progress(env, stage, 0);
    if (status != ICC_OK)
        return status;
    iccp_with_team(&with, &own, env);
    iccp_team_post(with.team, &job);
    status = run_this_thread(l, env, stage);
    iccp_team_recall(with.team, &job);
    iccp_without_team(&with, env);
    return status;
}

/* Number of tasks that the caller's parallel_for gets at once. Progress is reported between
 * rounds. */
enum { ROUND = 256 };

typedef struct task_round {
    loop *l;
    size_t first; /* chunk of task 0 */
    atomic_flag taken[ROUND];
} task_round;

static void round_task(void *argument, size_t index)
{
    ICCP_ENTER;
    task_round *r = argument;
    if (!atomic_flag_test_and_set(&r->taken[index]))
        run_chunk(r->l, r->first + index);
}

/* Certificates must not depend on a parallel_for that skips tasks or runs some twice. So each task
 * runs exactly once, if necessary on this thread. */
static icc_status run_callers_threads(loop *l, const iccp_env *env, const char *stage)
{
    task_round r = {.l = l};
    for (r.first = 0; r.first < l->n_chunks && !atomic_load(&l->stop); r.first += ROUND) {
        const icc_status status = iccp_progress(env, stage, (double)r.first / (double)l->n_chunks);
        if (status != ICC_OK)
            return status;
        const size_t left = l->n_chunks - r.first, n = left < ROUND ? left : ROUND;
        for (size_t k = 0; k < n; ++k)
            atomic_flag_clear(&r.taken[k]);
        env->parallel_for(env->user, n, round_task, &r);
        for (size_t k = 0; k < n; ++k)
            round_task(&r, k);
    }
    return ICC_OK;
}

icc_status iccp_for_chunks(const iccp_env *env, const char *stage, size_t n, size_t grain,
                           iccp_chunk chunk, void *argument)
{
    loop l = {
        .chunk = chunk, .argument = argument, .n = n, .grain = grain, .lock = ATOMIC_FLAG_INIT};
    l.n_chunks = n / grain + (n % grain != 0);
    const icc_status status = env->parallel_for != NULL ? run_callers_threads(&l, env, stage)
                                                        : run_own_threads(&l, env, stage);
    return status != ICC_OK ? status : l.status;
}

/* ---- tasks side by side ---- */

typedef struct sides {
    const iccp_env *env;
    iccp_team *team;
    iccp_side task;
    void *argument;
    size_t n;
    const void *caller; /* identifies the calling thread */
    atomic_size_t stop; /* tasks from this one on need not continue */
    struct side *side;
} sides;

/* One task, and the lines that it logs. They wait until all tasks are done. */
enum { MOST_LINES = 4, LINE = 240 };

typedef struct side {
    sides *all;
    size_t k, n_lines;
    icc_error error;
    char line[MOST_LINES][LINE];
} side;

/* Every thread has its own errno in C, so the address of errno identifies the thread. */
static const void *this_thread(void)
{
    return &errno;
}

/* Stops the tasks after a failed task k. Those before it continue, because they still decide the
 * result. */
static void stop_from(sides *s, size_t k)
{
    size_t stop = atomic_load(&s->stop);
    while (k < stop && !atomic_compare_exchange_weak(&s->stop, &stop, k))
        continue;
}

/* The progress callback inside a task. */
static int32_t report(void *user, const char *stage, double share)
{
    const side *s = user;
    if (s->k >= atomic_load(&s->all->stop))
        return 1;
    if (this_thread() == s->all->caller && iccp_progress(s->all->env, stage, share) != ICC_OK)
        stop_from(s->all, 0);
    return s->k >= atomic_load(&s->all->stop);
}

/* The log callback inside a task. */
static void keep_line(void *user, const char *message)
{
    side *s = user;
    if (s->n_lines < MOST_LINES)
        (void)snprintf(s->line[s->n_lines++], LINE, "%s", message);
}

static icc_status run_side(void *argument, size_t begin, size_t end)
{
    const sides *all = argument;
    const iccp_env *env = all->env;
    side *s = &all->side[begin];
    const iccp_env own = {.memory = env->memory,
                          .user = s,
                          .log = env->log != NULL ? keep_line : NULL,
                          .progress = report,
                          .threads = env->parallel_for == NULL ? env->threads : 1,
                          .team = all->team,
                          .load_limit = env->load_limit};
    const icc_status status = all->task(all->argument, begin, &own, &s->error);
    if (status != ICC_OK)
        stop_from(s->all, end);
    return status;
}

/* The loop itself reports nothing and stops only at a failure. Tasks report and stop. */
static icc_status run_sides(const iccp_env *env, size_t n, iccp_side task, void *argument,
                            icc_error *err)
{
    side own[ICCP_MOST_SIDES];
    iccp_team team;
    iccp_env quiet;
    iccp_with_team(&quiet, &team, env);
    quiet.progress = NULL;
    sides s = {.env = env, .task = task, .argument = argument, .n = n, .stop = n, .side = own};
    s.team = quiet.team;
    s.caller = this_thread();
    for (size_t k = 0; k < n; ++k) {
        own[k].all = &s;
        own[k].k = k;
        own[k].n_lines = 0;
        own[k].error = (icc_error){.size = sizeof own[k].error};
    }
    icc_status status = iccp_for_chunks(&quiet, "solve", n, 1, run_side, &s);
    iccp_without_team(&quiet, env);
    for (size_t k = 0; k < n; ++k)
        for (size_t i = 0; i < own[k].n_lines; ++i)
            iccp_log(env, "%s", own[k].line[i]);
    if (atomic_load(&s.stop) == 0)
        return iccp_explain(err, ICC_ERR_CANCELLED);
    const size_t failed = atomic_load(&s.stop) - 1;
    if (status != ICC_OK && own[failed].error.status == status)
        iccp_error_copy(err, &own[failed].error);
    return status;
}

icc_status iccp_side_by_side(const iccp_env *env, size_t n, iccp_side task, void *argument,
                             icc_error *err)
{
    assert(n <= ICCP_MOST_SIDES);
    icc_status status = ICC_OK;
    if (n > 1 && iccp_has_threads(env) && env->budget == NULL)
        return run_sides(env, n, task, argument, err);
    for (size_t k = 0; status == ICC_OK && k < n; ++k) {
        const iccp_env part =
            iccp_part(env, NULL, (double)k / (double)n, (double)(k + 1) / (double)n);
        status = task(argument, k, &part, err);
    }
    return status;
}

#include "base/threads.h"

#include <stdatomic.h>
#include <stdbool.h>

#ifdef ICC_WITH_THREADS
#include <pthread.h>
#endif

typedef struct loop {
    iccp_chunk chunk;
    void *argument;
    size_t n, grain, n_chunks;
    size_t first;       /* chunk that task 0 of a parallel_for round stands for */
    atomic_size_t next; /* next chunk to hand out */
    atomic_bool stop;
    atomic_flag lock; /* guards the two below; held for a few instructions, after failures only */
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

/* Hands out the next chunk. Chunks are handed out in order, so every chunk before one that failed
 * has run or is running: the first failure is the same for every number of threads. */
static bool take_chunk(loop *l, size_t *index)
{
    if (atomic_load(&l->stop))
        return false;
    *index = atomic_fetch_add(&l->next, 1);
    return *index < l->n_chunks;
}

/* The calling thread takes chunks like the others and is the only one that reports progress, so
 * that the callback need not be safe for threads. */
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

#ifdef ICC_WITH_THREADS

enum { MAX_WORKERS = 64 };

static void *worker(void *argument)
{
    loop *l = argument;
    size_t index;
    while (take_chunk(l, &index))
        run_chunk(l, index);
    return NULL;
}

/* Progress is reported once before there are other threads, which may take all the chunks. Threads
 * that cannot be started are done without. */
static icc_status run_own_threads(loop *l, const iccp_env *env, const char *stage)
{
    pthread_t threads[MAX_WORKERS];
    size_t n_threads = 0;
    icc_status status = iccp_progress(env, stage, 0);
    if (status != ICC_OK)
        return status;
    const size_t wanted = env->threads < MAX_WORKERS ? (size_t)env->threads : MAX_WORKERS;
    while (n_threads + 1 < wanted && n_threads + 1 < l->n_chunks &&
           pthread_create(&threads[n_threads], NULL, worker, l) == 0)
        ++n_threads;
    status = run_this_thread(l, env, stage);
    while (n_threads > 0)
        pthread_join(threads[--n_threads], NULL);
    return status;
}

#else

#define run_own_threads run_this_thread

#endif

static void round_task(void *argument, size_t index)
{
    loop *l = argument;
    run_chunk(l, l->first + index);
}

/* The caller's parallel_for gets rounds of a fixed size, so that progress is reported between
 * them from the calling thread. */
static icc_status run_callers_threads(loop *l, const iccp_env *env, const char *stage)
{
    enum { ROUND = 256 };
    for (l->first = 0; l->first < l->n_chunks && !atomic_load(&l->stop); l->first += ROUND) {
        const icc_status status = iccp_progress(env, stage, (double)l->first / (double)l->n_chunks);
        if (status != ICC_OK)
            return status;
        const size_t left = l->n_chunks - l->first;
        env->parallel_for(env->user, left < ROUND ? left : ROUND, round_task, l);
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

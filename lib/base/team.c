/* Threads that live as long as one call. An idle thread watches for the next job for a while,
 * because loops follow each other quickly, and then sleeps. There are few jobs at a time, and
 * threads join them under one lock. */
#include "base/team.h"

#ifdef ICC_WITH_THREADS

#include "base/clock.h"

/* Seconds that a thread watches before it sleeps: twice the time to wake a thread. */
static const double WATCH = 1e-4;

/* How often a watching thread looks before it checks the clock again. */
enum { LOOKS = 64 };

/* Tells a processor that runs two threads that this one only waits. */
static void relax(void)
{
#if defined(__GNUC__) && (defined(__x86_64__) || defined(__i386__))
    __builtin_ia32_pause();
#endif
}

/* Watches *value for a limited time, until it differs from `old`, or until it equals `old`. */
static void watch(const atomic_size_t *value, size_t old, bool until_equal)
{
    const double end = iccp_seconds() + WATCH;
    do
        for (int k = 0; k < LOOKS; ++k) {
            if ((atomic_load(value) == old) == until_equal)
                return;
            relax();
        }
    while (iccp_seconds() < end);
}

/* ---- helpers ---- */

/* Returns the newest job that wants another thread. A job that was posted inside another one delays
 * that one, so it goes first. */
static iccp_job *find_job(const iccp_team *team)
{
    iccp_job *job = team->last;
    while (job != NULL && !(job->is_open && job->n_joined < job->wanted))
        job = job->below;
    return job;
}

/* The lock is held before and after. A job may be gone as soon as its last helper has left. */
static void help(iccp_team *team, iccp_job *job)
{
    ++job->n_joined;
    atomic_fetch_add(&job->n_helpers, 1);
    pthread_mutex_unlock(&team->lock);
    job->work(job->argument);
    pthread_mutex_lock(&team->lock);
    job->is_open = false;
    if (atomic_fetch_sub(&job->n_helpers, 1) == 1)
        pthread_cond_broadcast(&team->left);
}

/* Helps with jobs. If there are none, watches for a while and then sleeps. */
static void *serve(void *argument)
{
    iccp_team *team = argument;
    pthread_mutex_lock(&team->lock);
    for (bool is_rested = false; !team->has_ended;) {
        iccp_job *job = find_job(team);
        if (job != NULL) {
            help(team, job);
            is_rested = false;
        } else if (!is_rested) {
            const size_t n_news = atomic_load(&team->n_news);
            pthread_mutex_unlock(&team->lock);
            watch(&team->n_news, n_news, false);
            pthread_mutex_lock(&team->lock);
            is_rested = atomic_load(&team->n_news) == n_news;
        } else {
            ++team->n_asleep;
            pthread_cond_wait(&team->posted, &team->lock);
            --team->n_asleep;
            is_rested = false;
        }
    }
    pthread_mutex_unlock(&team->lock);
    return NULL;
}

/* ---- posting ---- */

void iccp_team_begin(iccp_team *team, size_t n_threads)
{
    *team = (iccp_team){.most = n_threads < ICCP_TEAM_MOST ? n_threads : ICCP_TEAM_MOST};
    atomic_init(&team->n_news, 0);
    if (pthread_mutex_init(&team->lock, NULL) != 0)
        return;
    if (pthread_cond_init(&team->posted, NULL) == 0) {
        team->is_ready = pthread_cond_init(&team->left, NULL) == 0;
        if (!team->is_ready)
            pthread_cond_destroy(&team->posted);
    }
    if (!team->is_ready)
        pthread_mutex_destroy(&team->lock);
}

void iccp_team_end(iccp_team *team)
{
    if (!team->is_ready)
        return;
    pthread_mutex_lock(&team->lock);
    team->has_ended = true;
    atomic_fetch_add(&team->n_news, 1);
    pthread_cond_broadcast(&team->posted);
    pthread_mutex_unlock(&team->lock);
    while (team->n > 0)
        pthread_join(team->thread[--team->n], NULL);
    pthread_cond_destroy(&team->posted);
    pthread_cond_destroy(&team->left);
    pthread_mutex_destroy(&team->lock);
}

/* After one failure to start a thread, tries no other. */
static void start_threads(iccp_team *team, size_t wanted)
{
    while (team->n < wanted && team->n < team->most)
        if (pthread_create(&team->thread[team->n], NULL, serve, team) == 0)
            ++team->n;
        else
            team->most = team->n;
}

void iccp_team_post(iccp_team *team, iccp_job *job)
{
    if (!team->is_ready)
        return;
    job->n_joined = 0;
    job->is_open = true;
    atomic_init(&job->n_helpers, 0);
    pthread_mutex_lock(&team->lock);
    job->below = team->last;
    team->last = job;
    start_threads(team, job->wanted);
    atomic_fetch_add(&team->n_news, 1);
    if (team->n_asleep > 0)
        pthread_cond_broadcast(&team->posted);
    pthread_mutex_unlock(&team->lock);
}

void iccp_team_recall(iccp_team *team, iccp_job *job)
{
    if (!team->is_ready)
        return;
    pthread_mutex_lock(&team->lock);
    iccp_job **place = &team->last;
    while (*place != job)
        place = &(*place)->below;
    *place = job->below;
    if (atomic_load(&job->n_helpers) > 0) {
        pthread_mutex_unlock(&team->lock);
        watch(&job->n_helpers, 0, true);
        pthread_mutex_lock(&team->lock);
    }
    while (atomic_load(&job->n_helpers) > 0)
        pthread_cond_wait(&team->left, &team->lock);
    pthread_mutex_unlock(&team->lock);
}

#else

void iccp_team_begin(iccp_team *team, size_t n_threads)
{
    (void)n_threads;
    *team = (iccp_team){0};
}

void iccp_team_end(iccp_team *team)
{
    (void)team;
}

void iccp_team_post(iccp_team *team, iccp_job *job)
{
    (void)team;
    (void)job;
}

void iccp_team_recall(iccp_team *team, iccp_job *job)
{
    (void)team;
    (void)job;
}

#endif

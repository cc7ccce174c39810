/* Threads that stay for as long as one call lasts, and jobs that they help with. To start a thread
 * takes some 50 us, to pass a job on to one that is there a few. */
#ifndef ICCP_TEAM_H
#define ICCP_TEAM_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

#ifdef ICC_WITH_THREADS
#include <pthread.h>
#endif

/* What several threads work at: work() of each of them returns when nothing is left to begin. */
typedef struct iccp_job {
    void (*work)(void *argument);
    void *argument;
    size_t wanted;           /* threads that may help */
    struct iccp_job *below;  /* the rest is the team's: the job that was posted before, */
    size_t n_joined;         /* how many threads have come, */
    atomic_size_t n_helpers; /* how many of them have not left, */
    bool is_open;            /* and whether more may come */
} iccp_job;

enum { ICCP_TEAM_MOST = 63 };

typedef struct iccp_team {
#ifdef ICC_WITH_THREADS
    pthread_mutex_t lock;
    pthread_cond_t posted, left; /* for those who sleep until there is a job, or helpers are gone */
    pthread_t thread[ICCP_TEAM_MOST];
#endif
    size_t most, n, n_asleep; /* threads: at most, started, waiting for `posted` */
    iccp_job *last;           /* posted and not recalled */
    atomic_size_t n_news;     /* jobs that have been posted, and the end */
    bool is_ready, has_ended; /* `is_ready`: it may have threads */
} iccp_team;

/* A team of up to n_threads besides those that post jobs; they are started when the first jobs
 * want them. Where it cannot be, and where the library has no threads, it has none. */
void iccp_team_begin(iccp_team *team, size_t n_threads);

/* After all jobs. */
void iccp_team_end(iccp_team *team);

/* Invites the team to help with a job; threads that cannot be started are done without. Threads may
 * post jobs of their own while they help with one. */
void iccp_team_post(iccp_team *team, iccp_job *job);

/* Lets nobody else come, and waits until those who help have left. */
void iccp_team_recall(iccp_team *team, iccp_job *job);

#endif

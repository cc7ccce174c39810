/* Threads that live as long as one call, and jobs that they help with. Starting a thread takes
 * about 50 us, passing a job to a running one takes a few. */
#ifndef ICCP_TEAM_H
#define ICCP_TEAM_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

#ifdef ICC_WITH_THREADS
#include <pthread.h>
#endif

/* Work for several threads. Each of them calls work(), which returns when nothing is left to
 * begin. */
typedef struct iccp_job {
    void (*work)(void *argument);
    void *argument;
    size_t wanted;           /* threads that may help */
    struct iccp_job *below;  /* set by the team, like the rest: the job posted before, */
    size_t n_joined;         /* number of threads that have joined, */
    atomic_size_t n_helpers; /* number of them that have not left, */
    bool is_open;            /* true while more may join */
} iccp_job;

enum { ICCP_TEAM_MOST = 63 };

typedef struct iccp_team {
#ifdef ICC_WITH_THREADS
    pthread_mutex_t lock;
    pthread_cond_t posted, left; /* wake threads that wait for a job, or for helpers to leave */
    pthread_t thread[ICCP_TEAM_MOST];
#endif
    size_t most, n, n_asleep; /* threads: at most, started, waiting for `posted` */
    iccp_job *last;           /* the last job that was posted and not recalled */
    atomic_size_t n_news;     /* counts posted jobs, and the end */
    bool is_ready, has_ended; /* is_ready: the team may have threads */
} iccp_team;

/* Makes a team of up to n_threads besides the threads that post jobs. Threads start when the first
 * job wants them. If that is impossible, or the library is built without threads, the team has
 * none. */
void iccp_team_begin(iccp_team *team, size_t n_threads);

/* Call it after all jobs. */
void iccp_team_end(iccp_team *team);

/* Invites the team to help with a job. If threads cannot be started, the job runs with fewer.
 * Threads may post jobs of their own while they help with one. */
void iccp_team_post(iccp_team *team, iccp_job *job);

/* Lets no other thread join, and waits until all helpers have left. */
void iccp_team_recall(iccp_team *team, iccp_job *job);

#endif

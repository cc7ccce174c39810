/* Threads that begin together. */
#ifndef TESTS_TOGETHER_H
#define TESTS_TOGETHER_H

#include <check.h>
#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>

enum { TOGETHER = 6 };

typedef struct together {
    pthread_mutex_t lock;
    pthread_cond_t all_there;
    size_t n_there;
    void *(*work)(void *argument);
    char *arguments;
    size_t size, n_begun;
} together;

static inline void *together_begin(void *argument)
{
    together *t = argument;
    pthread_mutex_lock(&t->lock);
    void *own = t->arguments + t->size * t->n_begun++;
    if (++t->n_there == TOGETHER)
        pthread_cond_broadcast(&t->all_there);
    while (t->n_there < TOGETHER)
        pthread_cond_wait(&t->all_there, &t->lock);
    pthread_mutex_unlock(&t->lock);
    return t->work(own);
}

/* Runs work() on TOGETHER arguments of `size` bytes at the same time; it returns NULL. */
static inline void run_together(void *(*work)(void *argument), void *arguments, size_t size)
{
    together t = {.lock = PTHREAD_MUTEX_INITIALIZER,
                  .all_there = PTHREAD_COND_INITIALIZER,
                  .work = work,
                  .arguments = arguments,
                  .size = size};
    pthread_t threads[TOGETHER];
    for (int k = 0; k < TOGETHER; ++k)
        ck_assert_int_eq(pthread_create(&threads[k], NULL, together_begin, &t), 0);
    for (int k = 0; k < TOGETHER; ++k) {
        void *failed;
        ck_assert_int_eq(pthread_join(threads[k], &failed), 0);
        ck_assert_ptr_null(failed);
    }
    pthread_cond_destroy(&t.all_there);
    pthread_mutex_destroy(&t.lock);
}

#endif

/* An environment whose allocations, or whose patience, end at the k-th call, and which notices what
 * is written behind the end of an allocation. */
#ifndef TESTS_FAULTY_H
#define TESTS_FAULTY_H

#include "icc/base.h"

#include "share.h"

#include <check.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* Behind each allocation lie so many bytes that nobody may write to; before it, as many with its
 * size, so that it stays aligned. The address sanitizer has its own, which notices reading, too. */
#ifdef __has_feature
#if __has_feature(address_sanitizer)
#define FAULTY_GUARD 0
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define FAULTY_GUARD 0
#endif
#ifndef FAULTY_GUARD
#define FAULTY_GUARD 64
#endif
enum { FAULTY_BYTE = 0xa5 };

typedef struct faulty {
    atomic_size_t n_live; /* allocations not yet given back */
    atomic_size_t n_allocs;
    size_t fail_at; /* this allocation fails, and only this one; 0: none */
    size_t n_reports;
    size_t cancel_at; /* this progress report is answered with "stop"; 0: none */
} faulty;

static inline void *faulty_alloc(void *user, size_t size)
{
    faulty *f = user;
    if (++f->n_allocs == f->fail_at)
        return NULL;
    if (size > SIZE_MAX - 2 * FAULTY_GUARD)
        return NULL;
    unsigned char *const block = malloc(size + 2 * FAULTY_GUARD);
    if (block == NULL)
        return NULL;
    ++f->n_live;
    if (FAULTY_GUARD > 0)
        memcpy(block, &size, sizeof size);
    memset(block + FAULTY_GUARD + size, FAULTY_BYTE, FAULTY_GUARD);
    return block + FAULTY_GUARD;
}

static inline void faulty_dealloc(void *user, void *memory)
{
    unsigned char *const block = (unsigned char *)memory - FAULTY_GUARD;
    size_t size = 0;
    if (FAULTY_GUARD > 0)
        memcpy(&size, block, sizeof size);
    for (size_t k = FAULTY_GUARD; k-- > 0;)
        if (block[FAULTY_GUARD + size + k] != FAULTY_BYTE)
            ck_abort_msg("written %zu bytes behind the end of %zu", k + 1, size);
    --((faulty *)user)->n_live;
    free(block);
}

static inline int32_t faulty_progress(void *user, const char *stage, double share)
{
    faulty *f = user;
    ck_assert(stage != NULL && share >= 0 && share <= 1);
    return ++f->n_reports == f->cancel_at;
}

static inline icc_env faulty_env(faulty *f)
{
    return (icc_env){.size = sizeof(icc_env),
                     .user = f,
                     .alloc = faulty_alloc,
                     .dealloc = faulty_dealloc,
                     .progress = faulty_progress};
}

/* Makes something and frees it again; its status. */
typedef icc_status (*faulty_call)(const icc_env *env, icc_error *err, void *argument);

/* Lets every allocation and every progress report fail in turn, or a share of them: each gives its
 * status and a text, and nothing is left behind. */
static inline void faulty_sweep(faulty_call call, void *argument)
{
    for (int cancels = 0; cancels < 2; ++cancels) {
        icc_status status = -1;
        size_t k = 0;
        while (status != ICC_OK) {
            k = share_next(k);
            faulty f = {.fail_at = cancels ? 0 : k, .cancel_at = cancels ? k : 0};
            icc_error err = {.size = sizeof err};
            const icc_env env = faulty_env(&f);
            status = call(&env, &err, argument);
            ck_assert_uint_eq(f.n_live, 0);
            if (status == ICC_OK)
                break;
            ck_assert_int_eq(status, cancels ? ICC_ERR_CANCELLED : ICC_ERR_MEMORY);
            ck_assert_int_eq(err.status, status);
            ck_assert(err.message[0] != '\0');
        }
        ck_assert_msg(k > 1, "nothing could be made to fail");
    }
}

#endif

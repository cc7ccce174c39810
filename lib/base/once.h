/* What is made when it is first asked for, and then shared by all that ask. Any number of threads
 * may ask at the same time: they may then make one each, of which the first to be done stays. There
 * is no lock, so that nobody waits for a thread that has been stopped, and no library of threads is
 * needed. */
#ifndef ICCP_ONCE_H
#define ICCP_ONCE_H

#include <stdatomic.h>
#include <stddef.h>

/* Zeros are as good as iccp_once_init(). */
typedef struct iccp_once {
    _Atomic(void *) made;
} iccp_once;

static inline void iccp_once_init(iccp_once *once)
{
    atomic_init(&once->made, NULL);
}

/* NULL: not yet. */
static inline void *iccp_once_get(const iccp_once *once)
{
    return atomic_load_explicit(&((iccp_once *)once)->made, memory_order_acquire);
}

/* Keeps `fresh`, which is not NULL, unless another thread was faster. Returns what stays: if that
 * is not `fresh`, the caller frees `fresh`. Who asks sees no change, so `once` is const, but it
 * must lie in memory that may be written. */
static inline void *iccp_once_keep(const iccp_once *once, void *fresh)
{
    void *known = NULL;
    if (atomic_compare_exchange_strong_explicit(&((iccp_once *)once)->made, &known, fresh,
                                                memory_order_acq_rel, memory_order_acquire))
        return fresh;
    return known;
}

#endif

/* A cached object that is made on first use and then shared. Any number of threads may ask for it
 * at the same time. Each of them may then make a copy, and the first copy that is ready stays.
 * There is no lock, so nobody waits for a stopped thread, and no thread library is needed. */
#ifndef ICCP_ONCE_H
#define ICCP_ONCE_H

#include <stdatomic.h>
#include <stddef.h>

/* All zeros is equivalent to iccp_once_init(). */
typedef struct iccp_once {
    _Atomic(void *) made;
} iccp_once;

static inline void iccp_once_init(iccp_once *once)
{
    atomic_init(&once->made, NULL);
}

/* Returns NULL if the object does not exist yet. */
static inline void *iccp_once_get(const iccp_once *once)
{
    return atomic_load_explicit(&((iccp_once *)once)->made, memory_order_acquire);
}

/* Keeps `fresh`, which is not NULL, unless another thread was faster. Returns the object that
 * stays; if that is not `fresh`, the caller frees `fresh`. `once` is const because its users see no
 * change, but it must lie in writable memory. */
static inline void *iccp_once_keep(const iccp_once *once, void *fresh)
{
    void *known = NULL;
    if (atomic_compare_exchange_strong_explicit(&((iccp_once *)once)->made, &known, fresh,
                                                memory_order_acq_rel, memory_order_acquire))
        return fresh;
    return known;
}

#endif

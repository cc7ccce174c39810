/* How much of a long sweep a test runs: ICC_TEST_SHARE percent, all of it where that is not set.
 * tests/run.sh sets it. */
#ifndef TESTS_SHARE_H
#define TESTS_SHARE_H

#include <stdlib.h>

static inline int test_share(void)
{
    const char *text = getenv("ICC_TEST_SHARE");
    const long percent = text != NULL ? strtol(text, NULL, 10) : 100;
    return percent < 1 ? 1 : percent > 100 ? 100 : (int)percent;
}

/* Of n cases, at least one. */
static inline int share_of(int n)
{
    const int some = (int)((long long)n * test_share() / 100);
    return n > 0 && some < 1 ? 1 : some;
}

/* The case after k in a sweep: the first FEW are all run, and of the others test_share() percent,
 * which lie at irregular distances, so that nothing periodic is missed. */
static inline size_t share_next(size_t k)
{
    enum { FEW = 20 };
    const size_t mean = 100 / (size_t)test_share();
    return k < FEW || mean == 1 ? k + 1 : k + 1 + k * 2654435761u % (2 * mean - 1);
}

#endif

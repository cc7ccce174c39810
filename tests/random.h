/* The same random numbers on every machine. */
#ifndef TESTS_RANDOM_H
#define TESTS_RANDOM_H

#include <stdint.h>

typedef struct random_source {
    uint64_t state;
} random_source;

/* SplitMix64. */
static inline uint64_t random_bits(random_source *r)
{
    uint64_t z = r->state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

static inline int random_below(random_source *r, int n)
{
    return (int)(random_bits(r) % (uint64_t)n);
}

/* In [0, 1). */
static inline double random_unit(random_source *r)
{
    return (double)(random_bits(r) >> 11) * 0x1p-53;
}

static inline double random_between(random_source *r, double low, double high)
{
    return low + (high - low) * random_unit(r);
}

#endif

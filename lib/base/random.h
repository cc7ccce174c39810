/* Pseudorandom numbers for random decisions that are the same in every run. */
#ifndef ICCP_RANDOM_H
#define ICCP_RANDOM_H

#include <stdint.h>

/* SplitMix64: G. Steele, D. Lea, C. Flood, Fast splittable pseudorandom number generators, 2014.
 * Any initial state will do. */
static inline uint64_t iccp_random(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/* Returns a number in [0, 1). */
static inline double iccp_random_unit(uint64_t *state)
{
    return (double)(iccp_random(state) >> 11) * 0x1p-53;
}

#endif

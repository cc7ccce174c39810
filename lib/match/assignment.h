/* The assignment problem in the plane: pairs n places with n others at the least cost. */
#ifndef ICCP_ASSIGNMENT_H
#define ICCP_ASSIGNMENT_H

#include "base/env.h"

#include <stdbool.h>

/* Differences of places below this share of the target's diameter mean nothing. */
static const double iccp_place_noise = 1e-3;

/* A place, and a size and a count that should be similar to its partner's. */
typedef struct iccp_spot {
    double at[2], size, count;
    uint32_t number; /* the caller's number */
} iccp_spot;

/* The squared distance of two spots. */
double iccp_spot_distance(const iccp_spot *a, const iccp_spot *b);

/* Reorders b so that spot k goes with spot k of a. The sum of squared distances is the least
 * possible. O(n) memory; O(n^3) time at worst, O(n^2) if most partners are nearest. */
icc_status iccp_assign(const iccp_spot *a, iccp_spot *b, size_t n, const iccp_env *env);

/* Looks for two of n pairs, i and k, that could exchange partners nearly as well, up to the factor
 * `sure`. `least` is added to costs before they are compared. */
bool iccp_can_exchange(size_t *i, size_t *k, const iccp_spot *a, const iccp_spot *b, size_t n,
                       double least, double sure);

/* Pairs each of n spots with one of m >= n others: partner[k] is the place of the other in b. The
 * sum of squared distances is the least possible. Memory and time are those of iccp_assign() for m
 * spots. */
icc_status iccp_assign_some(uint32_t *partner, const iccp_spot *a, size_t n, const iccp_spot *b,
                            size_t m, const iccp_env *env);

#endif

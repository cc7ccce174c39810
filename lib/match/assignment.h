/* The assignment problem in the plane: which of n places goes with which of n others. */
#ifndef ICCP_ASSIGNMENT_H
#define ICCP_ASSIGNMENT_H

#include "base/env.h"

/* A place, and a size that should be like the other's. */
typedef struct iccp_spot {
    double at[2], size;
    uint32_t number; /* the caller's */
} iccp_spot;

/* The squared distance of two spots. */
double iccp_spot_distance(const iccp_spot *a, const iccp_spot *b);

/* Puts b in the order in which its spots go with those of a: the one with the least sum of squared
 * distances. O(n) memory; O(n^3) time at worst, O(n^2) where most are nearest. */
icc_status iccp_assign(const iccp_spot *a, iccp_spot *b, size_t n, const iccp_env *env);

#endif

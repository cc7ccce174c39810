/* The assignment problem in the plane: pairs n places with n others at the least cost. */
#ifndef ICCP_ASSIGNMENT_H
#define ICCP_ASSIGNMENT_H

#include "base/env.h"

/* A place, and a size that should be similar to its partner's. */
typedef struct iccp_spot {
    double at[2], size;
    uint32_t number; /* the caller's number */
} iccp_spot;

/* The squared distance of two spots. */
double iccp_spot_distance(const iccp_spot *a, const iccp_spot *b);

/* Reorders b so that spot k goes with spot k of a. The sum of squared distances is the least
 * possible. O(n) memory; O(n^3) time at worst, O(n^2) if most partners are nearest. */
icc_status iccp_assign(const iccp_spot *a, iccp_spot *b, size_t n, const iccp_env *env);

#endif

/* A list of points that grows, and thinning it out. */
#ifndef ICCP_PLACES_H
#define ICCP_PLACES_H

#include "kernel/cells.h"

#include <stdbool.h>

/* In the order in which they were added; dim coordinates each. */
typedef struct iccp_places {
    iccp_memory memory;
    size_t dim, n, capacity;
    double *points;
    bool failed; /* out of memory: nothing has been added since */
} iccp_places;

void iccp_places_start(iccp_places *places, size_t dim, const iccp_env *env);
void iccp_places_add(iccp_places *places, const double *point);
void iccp_places_free(iccp_places *places);

/* Drops places from the first `n_kept` on that are nearer than a radius to an earlier one that
 * stays. */
icc_status iccp_places_thin(iccp_places *places, size_t n_kept, double radius, const iccp_env *env);

/* The distance of each of n points to the nearest other one; HUGE_VAL for a single point. */
icc_status iccp_places_spacing(size_t dim, size_t n, const double *points, double *distance,
                               const iccp_env *env);

#endif

/* A list of points that grows and can be thinned out. */
#ifndef ICCP_POINT_LIST_H
#define ICCP_POINT_LIST_H

#include "kernel/sampling/cells.h"

#include <stdbool.h>

/* In spacings: samples nearer to each other than this are one too many. */
#define ICCP_SAMPLE_GAP 0.55

/* Points of dim coordinates each, in the order in which they were added. */
typedef struct iccp_point_list {
    iccp_memory memory;
    size_t dim, n, capacity;
    double *points;
    bool failed; /* out of memory; nothing was added since */
} iccp_point_list;

void iccp_point_list_start(iccp_point_list *list, size_t dim, const iccp_env *env);
void iccp_point_list_add(iccp_point_list *list, const double *point);
void iccp_point_list_free(iccp_point_list *list);

/* Drops points from number `n_kept` on that are nearer than a radius to an earlier point that
 * stays. */
icc_status iccp_point_list_thin(iccp_point_list *list, size_t n_kept, double radius,
                                const iccp_env *env);

/* Computes the distance of each of n points to the nearest other one. HUGE_VAL for a single
 * point. */
icc_status iccp_nearest_distances(size_t dim, size_t n, const double *points, double *distance,
                                  const iccp_env *env);

#endif

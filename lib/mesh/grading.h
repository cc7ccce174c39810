/* Points inside a domain, as dense as its boundary where that is near and sparser away from it. */
#ifndef ICCP_GRADING_H
#define ICCP_GRADING_H

#include "domain/domain.h"

/* The corners of a cage cut into pieces: n points counter-clockwise, each with the length of the
 * longer of its two edges. */
typedef struct iccp_samples {
    size_t n;
    const double *points; /* 2 n */
    const double *length; /* n */
} iccp_samples;

/* Centres of the leaves of a quadtree that keep away from the boundary. A leaf is no wider than
 * `step`, nor than the length at any sample plus the distance to it. `points` gets an array of the
 * domain's memory, 2 doubles for each of `n_points`; the caller frees it. */
icc_status iccp_graded_points(const icc_domain *domain, const iccp_samples *samples, double step,
                              double **points, size_t *n_points, const iccp_env *env);

#endif

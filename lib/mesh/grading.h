/* Points inside a domain: as dense as the boundary near it, and sparser away from it. */
#ifndef ICCP_GRADING_H
#define ICCP_GRADING_H

#include "domain/domain.h"

/* The corners of a cage that is cut into pieces: n points, counter-clockwise. Each has the length
 * of the longer of its two edges. */
typedef struct iccp_samples {
    size_t n;
    const double *points; /* 2 n */
    const double *length; /* n */
} iccp_samples;

/* Returns the centres of the leaves of a quadtree, except those close to the boundary. A leaf is no
 * wider than `step`. Nor is it wider than a sample's length plus the distance to the sample, for
 * any sample. `points` becomes an array in the domain's memory with 2 doubles for each of
 * `n_points`; the caller frees it. */
icc_status iccp_graded_points(const icc_domain *domain, const iccp_samples *samples, double step,
                              double **points, size_t *n_points, const iccp_env *env);

#endif

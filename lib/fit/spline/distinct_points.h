/* Control points as a fit needs them: different points, and the affine map that fits them best. */
#ifndef ICCP_DISTINCT_POINTS_H
#define ICCP_DISTINCT_POINTS_H

#include "base/env.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct iccp_distinct_points {
    iccp_memory memory;
    size_t n;           /* different points, in the order in which they are given */
    uint32_t *number;   /* of each given point: its number among them */
    double *points;     /* 2 n */
    double *targets;    /* 2 n */
    double *tolerances; /* n: 0: exact */
} iccp_distinct_points;

/* Merges points that coincide. `tolerances`: one for each point, or NULL if all are exact. Returns
 * ICC_ERR_ARGUMENT if points coincide and have different targets, unless both have a tolerance, or
 * if different exact points have the same target. `err` then names one of them, and its message
 * both. On failure nothing stays allocated. O(n log n). */
icc_status iccp_distinct_points_create(iccp_distinct_points *control, size_t n,
                                       const double *points, const double *targets,
                                       const double *tolerances, const iccp_env *env,
                                       icc_error *err);
void iccp_distinct_points_free(iccp_distinct_points *control);

/* y = to + matrix (x - from) */
typedef struct iccp_trend {
    double matrix[4], from[2], to[2];
    double residual; /* root mean square distance of the images from the targets */
    bool is_line;    /* the points lie on one line, or are fewer than three */
} iccp_trend;

/* Fits an affine map by least squares. Points on one line give a similarity, one point gives a
 * shift. If the affine map would mirror, but a similarity fits about as well, takes the similarity.
 * Returns ICC_ERR_ARGUMENT if the targets mirror the points, or lie on a line when the points do
 * not. */
icc_status iccp_trend_fit(iccp_trend *trend, size_t n, const double *points, const double *targets,
                          icc_error *err);
void iccp_trend_apply(const iccp_trend *trend, const double p[2], double image[2]);

#endif

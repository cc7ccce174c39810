/* Sorts the landmarks of domains with features: those on the outer ring, and those on a hole, line
 * or point. */
#ifndef ICCP_FEATURE_LANDMARKS_H
#define ICCP_FEATURE_LANDMARKS_H

#include "domain/domain.h"

/* A landmark on a feature of each side. */
typedef struct iccp_feature_landmark {
    size_t number; /* in the call */
    uint32_t feature[2];
} iccp_feature_landmark;

typedef struct iccp_parted_landmarks {
    size_t n_ring, n_inside;
    size_t *number; /* of the landmarks on the outer ring, */
    double *ring;   /* and their 4 coordinates */
    iccp_feature_landmark *inside;
    const double *given; /* borrowed */
} iccp_parted_landmarks;

/* Assigns each landmark to the nearest ring, line or point. ICC_ERR_ARGUMENT unless both points are
 * on the outer ring, or on features that may be partners. Each feature has one partner. */
icc_status iccp_landmarks_part(iccp_parted_landmarks *out, size_t n, const double *given,
                               const icc_domain *source, const icc_domain *target,
                               const iccp_memory *memory, icc_error *err);

/* Accepts a struct of zeros. */
void iccp_parted_landmarks_free(iccp_parted_landmarks *landmarks, const iccp_memory *memory);

#endif

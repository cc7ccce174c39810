/* Sorts the landmarks of a domain by the outline, hole, line or point on which they lie. */
#ifndef ICCP_FEATURE_LANDMARKS_H
#define ICCP_FEATURE_LANDMARKS_H

#include "match/domain_parts.h"

/* A landmark on a feature of each side. ICCP_NO_FEATURE: the outer ring. */
typedef struct iccp_feature_landmark {
    size_t number; /* in the call */
    uint32_t feature[2];
} iccp_feature_landmark;

typedef struct iccp_sorted_landmarks {
    size_t n;
    iccp_feature_landmark *item;
    const double *given; /* borrowed */
} iccp_sorted_landmarks;

/* Assigns each landmark to the nearest ring, line or point. ICC_ERR_ARGUMENT unless both points are
 * on outlines of parts, or on features that may be partners. Each part and feature has one
 * partner. */
icc_status iccp_landmarks_sort(iccp_sorted_landmarks *out, size_t n, const double *given,
                               const icc_domain *const *domains, const iccp_domain_parts *parts,
                               const iccp_memory *memory, icc_error *err);

/* Copies the numbers and coordinates of the landmarks on one feature of the source. Returns how
 * many there are. */
size_t iccp_landmarks_on(const iccp_sorted_landmarks *landmarks, uint32_t feature, size_t *number,
                         double *given);

/* Accepts a struct of zeros. */
void iccp_sorted_landmarks_free(iccp_sorted_landmarks *landmarks, const iccp_memory *memory);

#endif

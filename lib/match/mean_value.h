/* Predicts roughly where a pairing of two outlines takes their inside. */
#ifndef ICCP_MEAN_VALUE_H
#define ICCP_MEAN_VALUE_H

#include "match/outline/union_outline.h"

/* Places of the source's outline, in order, and the places of the target that are paired with
 * them. */
typedef struct iccp_mean_value {
    double from[2 * ICCP_MATCH_SAMPLES], to[2 * ICCP_MATCH_SAMPLES];
} iccp_mean_value;

void iccp_mean_value_sample(iccp_mean_value *out, const iccp_union_outline *common,
                            const iccp_outline *source, const iccp_outline *target);

/* Moves n local points of the source, in place. */
void iccp_mean_value_move(const iccp_mean_value *at, size_t n, double *points);

#endif

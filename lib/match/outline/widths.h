/* The widths of two outlines, and how a pairing changes them. */
#ifndef ICCP_WIDTHS_H
#define ICCP_WIDTHS_H

#include "match/outline/elastic.h"

typedef struct iccp_widths {
    double point[2][ICCP_MATCH_SAMPLES][2];
    int32_t across[2][ICCP_MATCH_SAMPLES]; /* the sample opposite, inside; -1: none */
} iccp_widths;

/* O(N^2) for N samples. */
void iccp_widths_measure(iccp_widths *w, const iccp_outline *source, const iccp_outline *target);

/* How unevenly widths change where sample k of the source becomes place[k], in samples of the
 * target: the variance of the logarithms of ratios. O(N). */
double iccp_widths_change(const iccp_widths *w, const float *place);

#endif

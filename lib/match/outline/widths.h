/* The widths of two outlines, and how a pairing changes them. */
#ifndef ICCP_WIDTHS_H
#define ICCP_WIDTHS_H

#include "match/outline/elastic.h"

typedef struct iccp_widths {
    double point[2][ICCP_MATCH_SAMPLES][2];
    int32_t across[2][ICCP_MATCH_SAMPLES]; /* the opposite sample, through the inside; -1 if
                                              there is none */
} iccp_widths;

/* O(N^2) for N samples. */
void iccp_widths_measure(iccp_widths *w, const iccp_outline *source, const iccp_outline *target);

/* Returns how unevenly widths change if sample k of the source goes to place[k], in samples of the
 * target. This is the variance of the logarithms of the ratios. O(N). */
double iccp_widths_change(const iccp_widths *w, const float *place);

#endif

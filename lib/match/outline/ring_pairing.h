/* Pairs two outlines from start to end: finds a pairing and makes their vertices common. */
#ifndef ICCP_RING_PAIRING_H
#define ICCP_RING_PAIRING_H

#include "match/outline/union_outline.h"

/* A pairing is refused unless it fits this many times better than any other. A mirror image that
 * fits this many times better is reported. Among the development pairs (tests/bench/bench_match.c)
 * right answers have at least 1.13. Arbitrary answers for discs and squares have at most 1.05. Of
 * 40 outlines drawn twice, mirrored ones have at least 1.12, and upright ones at most 0.89. */
static const double iccp_clearly_better = 1.06;

/* The meaning of icc_match_options::least_sure. */
double iccp_least_sure(const icc_match_options *options);

/* Pairs outer rings through n landmarks (pairs of shares, as made by iccp_landmarks_place()).
 * ICC_ERR_AMBIGUOUS. */
icc_status iccp_pair_rings(iccp_union_outline *common, iccp_elastic_report *report,
                           const iccp_outline *source, const iccp_outline *target, size_t n,
                           const double *landmarks, const icc_match_options *options,
                           const iccp_env *env, icc_error *err);

/* Pairs outlines after the source has been moved to where the target should be. Without landmarks,
 * close places are paired. Reports the cost, which is HUGE_VAL by arc length. */
icc_status iccp_pair_moved(iccp_union_outline *common, iccp_elastic_report *report,
                           const iccp_outline *source, const iccp_outline *target, size_t n,
                           const double *landmarks, const icc_match_options *options,
                           const iccp_env *env, icc_error *err);

#endif

/* Takes points from one boundary of a match to the other. */
#ifndef ICCP_MATCH_APPLY_H
#define ICCP_MATCH_APPLY_H

#include "match/match.h"

/* Prepares a match that has both domains for iccp_match_apply(). */
void iccp_match_index(icc_match *match);

/* See icc_match_apply(). `side`: the side of the points, 0 for the source. */
icc_status iccp_match_apply(const icc_match *match, int side, size_t n, const double *points,
                            double *images, double *off, const iccp_env *env);

#endif

/* Points of one boundary of a match, taken to the other. */
#ifndef ICCP_MATCH_APPLY_H
#define ICCP_MATCH_APPLY_H

#include "match/match.h"

/* Prepares a match for iccp_match_apply(), once it has both domains. */
void iccp_match_index(icc_match *match);

/* See icc_match_apply(); `side`: that the points are on, 0 the source's. */
icc_status iccp_match_apply(const icc_match *match, int side, size_t n, const double *points,
                            double *images, double *off, const iccp_env *env);

#endif

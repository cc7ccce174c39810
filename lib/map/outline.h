/* The boundary of a triangle mesh as one polygon. */
#ifndef ICCP_OUTLINE_H
#define ICCP_OUTLINE_H

#include "domain/polygon.h"

/* Follows next[v], the boundary vertex after boundary vertex v, from `first`, over n edges. False unless
 * they form one ring, which `ring` (room for n) then lists. */
bool iccp_outline_follow(const uint32_t *next, uint32_t first, size_t n, uint32_t *ring);

/* ICC_ERR_BOUNDARY unless the polygon of the n vertices, at the given local points, is simple. */
icc_status iccp_outline_check(const double *points, const uint32_t *ring, size_t n,
                              const iccp_env *env);

#endif

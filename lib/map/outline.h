/* The boundary of a triangle mesh as one polygon. */
#ifndef ICCP_OUTLINE_H
#define ICCP_OUTLINE_H

#include "base/env.h"
#include "mesh/corners.h"

/* ICC_ERR_BOUNDARY unless the half-edges without twins form one polygon that is simple before and after
 * the map, where the n_vertices vertices are at the given local points. */
icc_status iccp_outline_check(const iccp_corners *corners, size_t n_vertices, const double *before,
                              const double *after, const iccp_env *env);

#endif

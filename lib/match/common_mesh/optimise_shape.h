/* Two surfaces with common triangles, made coarser and their triangles rounder, as measured. */
#ifndef ICCP_OPTIMISE_SHAPE_H
#define ICCP_OPTIMISE_SHAPE_H

#include "match/common_mesh/shape_patch.h"
#include "match/common_mesh/simplify.h"

/* What iccp_simplify() has left of `whole`, whose vertices are points of both surfaces (`left`:
 * what these have become). Edges are collapsed and flipped, and vertices put in the places of
 * others of the whole, on either side by itself, so that all vertices of the whole stay within
 * limits->off of the two surfaces, and the middles of triangles and of their sides of those given,
 * and nothing meets, exactly, if nothing did. limits->keep: by vertex of `common`; limits->cells:
 * of the whole. `became` and errors as for iccp_simplify(); common->within is not kept. *rise: so
 * many times as much is the mean energy of the map afterwards; with ICCP_PATCH_CALM no change
 * raises it. O(n log n) for n vertices of the whole that are spread evenly over what is left. */
icc_status iccp_optimise_shape(iccp_common_surface *common, uint32_t *became, double *rise,
                               iccp_patch_caution caution, const iccp_common_surface *whole,
                               const uint32_t *left, const iccp_half_edges *const given[2],
                               const double *const x[2], const iccp_simplify_limits *limits,
                               const iccp_env *env);

#endif

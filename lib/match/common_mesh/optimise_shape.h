/* Makes two surfaces with common triangles coarser and their triangles rounder. */
#ifndef ICCP_OPTIMISE_SHAPE_H
#define ICCP_OPTIMISE_SHAPE_H

#include "match/common_mesh/shape_patch.h"
#include "match/common_mesh/simplify.h"

/* Improves the result of iccp_simplify() on `whole`. The vertices of `whole` are points of both
 * surfaces, and `left` tells what they have become. Edges are collapsed and flipped, and vertices
 * move to places of other vertices of `whole`, separately on each side.
 *
 * All vertices of `whole` stay within limits->off of the two surfaces. So do the middles of
 * triangles and sides from the given surfaces. No triangles meet, exactly, if none did before.
 * limits->keep is by vertex of `common`, and limits->cells are those of `whole`.
 *
 * `became` and errors are as for iccp_simplify(). common->within is lost. *rise is the factor by
 * which the map's mean energy grew. With ICCP_PATCH_CALM, no change raises it. O(n log n) for n
 * vertices of `whole` that are spread evenly over the result. */
icc_status iccp_optimise_shape(iccp_common_surface *common, uint32_t *became, double *rise,
                               iccp_patch_caution caution, const iccp_common_surface *whole,
                               const uint32_t *left, const iccp_half_edges *const given[2],
                               const double *const x[2], const iccp_simplify_limits *limits,
                               const iccp_env *env);

#endif

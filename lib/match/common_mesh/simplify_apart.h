/* Makes two surfaces with common triangles coarse, both together, such that neither intersects
 * itself. */
#ifndef ICCP_SIMPLIFY_APART_H
#define ICCP_SIMPLIFY_APART_H

#include "match/common_mesh/simplify.h"

/* Calls iccp_simplify() in rounds. If triangles of a surface then meet, or are too far from the
 * given surface, the vertices there are kept and everything is done again. Vertices where the whole
 * surface meets itself are not kept for that reason. If this fails, or if `only_flaws` is set, only
 * vertices where the whole meets itself are removed. Otherwise the result's shape is optimised
 * (match/common_mesh/optimise_shape.h) as long as no triangles meet.
 *
 * limits->off is the largest distance allowed. *off is the share of it that was reached, measured
 * both ways: from all vertices of `common`, and from the middles of triangles and sides of the
 * result. It is 0 if nothing was removed. ICC_ERR_MEMORY, ICC_ERR_CANCELLED without a text.
 *
 * Intersections are found exactly. If the given `common` meets itself and this cannot be mended, it
 * stays as it was, and nothing is promised. */
icc_status iccp_simplify_apart(iccp_common_surface *common, double *off,
                               const iccp_half_edges *const given[2], const double *const x[2],
                               const iccp_simplify_limits *limits, bool only_flaws,
                               const iccp_env *env);

#endif

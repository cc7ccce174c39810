/* Two surfaces with common triangles, made coarse together as far as neither meets itself. */
#ifndef ICCP_SIMPLIFY_APART_H
#define ICCP_SIMPLIFY_APART_H

#include "match/common_mesh/simplify.h"

/* Does what iccp_simplify() does. Where triangles of a surface then meet that should not, or are
 * too far off the surface that was given, all that went there stays and it is done once more, but
 * for vertices that meet others before anything goes; at last these alone go, as they do from the
 * start if `only_flaws`. Where they are not alone, what is left is touched up
 * (match/common_mesh/optimise_shape.h), as far as nothing meets. limits->off is the most allowed, and
 * *off the share of it that has come about, as measured both ways: from all vertices of `common`,
 * and from the middles of what is left and of its sides; 0 where nothing goes. ICC_ERR_MEMORY,
 * ICC_ERR_CANCELLED without a text. What meets is told exactly; nothing is promised where `common`
 * meets itself as it is given and that cannot be mended: it is as it was then. */
icc_status iccp_simplify_apart(iccp_common_surface *common, double *off,
                               const iccp_half_edges *const given[2], const double *const x[2],
                               const iccp_simplify_limits *limits, bool only_flaws,
                               const iccp_env *env);

#endif

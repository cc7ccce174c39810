/* Makes two surfaces with common triangles coarse, both together. */
#ifndef ICCP_SIMPLIFY_H
#define ICCP_SIMPLIFY_H

#include "match/common_mesh/kept_cells.h"

typedef struct iccp_simplify_limits {
    double off[2];       /* by side: how far a vertex may leave the planes of the given surface
                            for which the removed vertex stood; > 0 */
    double edge[2];      /* by side: longest new edge */
    const uint8_t *keep; /* by vertex: if not 0, it is kept; bits 1 and 2: its place on that side
                            is kept */
    const iccp_kept_cells *cells; /* of the first surface if it keeps its shape; or NULL */
} iccp_simplify_limits;

/* iccp_fair_sine: triangles whose least angle has this sine are fair. iccp_worse_if_kept: if a
 * surface keeps its vertices, fewer collapses are possible, and vertices may have to come to them
 * one by one. So a collapse may leave this share of the least sine before. iccp_readily: the factor
 * on the costs of vertices at thin triangles, which go first. */
static const double iccp_fair_sine = 0.2, iccp_worse_if_kept = 0.1, iccp_readily = 0.05;

/* The factor on the cost of a collapse that leaves a least angle with this sine. */
static inline double iccp_thinness(double sine)
{
    return 1 + 0.1 / (sine + 0.02);
}

/* Collapses edges of both surfaces at once. Their triangles stay the same, and each surface keeps
 * its shape. Triangles do not become much thinner. Remaining vertices do not move. `given` are the
 * two surfaces that `common` was made from, with coordinates `x`. Parts of a surface may come to
 * meet; nothing prevents that here.
 *
 * Afterwards common->within names a face that contained part of each triangle. `became`: for each
 * old vertex, the number of the vertex that it was merged into, or its own. ICC_ERR_MEMORY,
 * ICC_ERR_CANCELLED without a text, and `common` is unchanged. O(n log n) for n vertices. */
icc_status iccp_simplify(iccp_common_surface *common, uint32_t *became,
                         const iccp_half_edges *const given[2], const double *const x[2],
                         const iccp_simplify_limits *limits, const iccp_env *env);

#endif

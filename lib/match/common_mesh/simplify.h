/* Two surfaces with common triangles, both made coarse together. */
#ifndef ICCP_SIMPLIFY_H
#define ICCP_SIMPLIFY_H

#include "match/common_mesh/kept_cells.h"

typedef struct iccp_simplify_limits {
    double off[2];       /* on either side: how far a vertex that goes may leave the planes of the
                              given surface that it stood for; > 0 */
    double edge[2];      /* on either side: longest edge that comes about */
    const uint8_t *keep; /* by vertex: not 0: it stays; 1 and 2, as bits: its place on either
                              side does */
    const iccp_kept_cells *cells; /* of the first surface, which keeps its shape; or NULL */
} iccp_simplify_limits;

/* Collapses edges of both surfaces at a time, so that their triangles stay the same and each
 * surface keeps its shape; triangles do not become much thinner than they are. Vertices that are
 * left are where they were. `given`: the two surfaces that `common` was made from, with coordinates
 * `x`. Nothing is said about parts of a surface that come to meet. common->within then tells of
 * each triangle a face of which it has been a part. `became`: of each vertex that was there the
 * number of the one that it has come to, itself or another. ICC_ERR_MEMORY, ICC_ERR_CANCELLED
 * without a text: `common` is as it was. O(n log n) for n vertices. */
icc_status iccp_simplify(iccp_common_surface *common, uint32_t *became,
                         const iccp_half_edges *const given[2], const double *const x[2],
                         const iccp_simplify_limits *limits, const iccp_env *env);

#endif

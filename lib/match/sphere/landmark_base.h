/* Two surfaces that are reduced to the same few triangles, and a drawing of these on the sphere. */
#ifndef ICCP_LANDMARK_BASE_H
#define ICCP_LANDMARK_BASE_H

#include "match/sphere/split_surface.h"

typedef struct iccp_landmark_base {
    iccp_split_surface s[2];
    iccp_half_edges m[2];  /* only landmarks are left */
    double *directions[2]; /* of all vertices; 0 for vertices not present */
    double worst;          /* the greatest ratio of a path's two lengths */
} iccp_landmark_base;

/* Makes the base of two surfaces with landmarks, as described at iccp_landmark_paths(). x has
 * coordinates by vertex, and scale one factor for each surface. Edges may be halved. Paths are
 * short, and the start is chosen so that none is much longer on one surface than on the other.
 * If most_ratio is finite, the paths are even. Then ICC_ERR_RESOLUTION means that some path
 * exceeds this ratio.
 *
 * Free it in any case. ICC_ERR_RESOLUTION, ICC_ERR_CERTIFICATE, ICC_ERR_MEMORY,
 * ICC_ERR_CANCELLED. */
icc_status iccp_landmark_base_create(iccp_landmark_base *b, const iccp_half_edges *const given[2],
                                     const double *const x[2], const double scale[2], size_t n,
                                     const uint32_t *const vertices[2], double most_ratio,
                                     const iccp_env *env, icc_error *err);
void iccp_landmark_base_free(iccp_landmark_base *b, const iccp_memory *memory);

#endif

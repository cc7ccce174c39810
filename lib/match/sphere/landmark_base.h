/* Two surfaces that have been shrunk to the same few triangles, drawn on the sphere. */
#ifndef ICCP_LANDMARK_BASE_H
#define ICCP_LANDMARK_BASE_H

#include "match/sphere/split_surface.h"

typedef struct iccp_landmark_base {
    iccp_split_surface s[2];
    iccp_half_edges m[2];  /* landmarks alone are left */
    double *directions[2]; /* of all vertices; 0 for those that are not there */
    double worst;          /* the greatest ratio of a path's two lengths */
} iccp_landmark_base;

/* Surfaces that are given, x by vertex, scale for each, and landmarks, as iccp_landmark_paths()
 * has them; edges of the surfaces are halved as there. Paths are short and begin where none is much
 * longer on one surface than on the other, if that can be; if most_ratio is finite they are even,
 * and ICC_ERR_RESOLUTION if one is more than so many times as long. To be freed in any case.
 * ICC_ERR_RESOLUTION, ICC_ERR_CERTIFICATE, ICC_ERR_MEMORY, ICC_ERR_CANCELLED. */
icc_status iccp_landmark_base_create(iccp_landmark_base *b, const iccp_half_edges *const given[2],
                                     const double *const x[2], const double scale[2], size_t n,
                                     const uint32_t *const vertices[2], double most_ratio,
                                     const iccp_env *env, icc_error *err);
void iccp_landmark_base_free(iccp_landmark_base *b, const iccp_memory *memory);

#endif

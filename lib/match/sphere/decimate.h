/* Makes a surface coarse by collapses of edges. */
#ifndef ICCP_DECIMATE_H
#define ICCP_DECIMATE_H

#include "match/surface/half_edges.h"

/* Collapses edges until n_left >= 4 vertices are present. Collapses that change the shape least
 * come first. x has the coordinates by vertex, of size about 1. ICC_OK, ICC_ERR_MEMORY or
 * ICC_ERR_CANCELLED, without a text. O(n log n) for n vertices with a bounded number of
 * neighbours. */
icc_status iccp_decimate(iccp_half_edges *m, const double *x, size_t n_left, const iccp_env *env);

/* Paths on a surface: see match/sphere/landmark_paths.h. */
typedef struct iccp_decimate_web {
    const uint32_t *holder;
    uint32_t *path;
    size_t n_landmarks;
    const uint32_t (*ends)[2];
    const uint8_t *joined;
} iccp_decimate_web;

/* Returns true if two vertices belong to one path, whose ends belong to it. */
bool iccp_share_path(const iccp_decimate_web *web, uint32_t a, uint32_t b);

/* Collapses edges until only landmarks are left, whose edges are then the paths. Vertices of a path
 * move along it. ICC_ERR_RESOLUTION, without a text, if no collapse is possible before that.
 * Updates web->path. */
icc_status iccp_decimate_along(iccp_half_edges *m, const double *x, const iccp_decimate_web *web,
                               const iccp_env *env);

#endif

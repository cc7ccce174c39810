/* A surface is made coarse by collapses of edges. */
#ifndef ICCP_DECIMATE_H
#define ICCP_DECIMATE_H

#include "match/surface/half_edges.h"

/* Collapses edges, those first that change the shape least, until n_left >= 4 vertices are there.
 * x: coordinates by vertex, of size about 1. ICC_OK, ICC_ERR_MEMORY or ICC_ERR_CANCELLED, both
 * without a text. O(n log n) for n vertices with a bounded number of neighbours. */
icc_status iccp_decimate(iccp_half_edges *m, const double *x, size_t n_left, const iccp_env *env);

/* Paths on a surface: see match/sphere/landmark_paths.h. */
typedef struct iccp_decimate_web {
    const uint32_t *holder;
    uint32_t *path;
    size_t n_landmarks;
    const uint32_t (*ends)[2];
    const uint8_t *joined;
} iccp_decimate_web;

/* Whether two vertices are of one path, its ends included. */
bool iccp_share_path(const iccp_decimate_web *web, uint32_t a, uint32_t b);

/* The same until only landmarks are left, whose edges are then the paths: vertices of a path go
 * along it. ICC_ERR_RESOLUTION, without a text, if no more collapse is possible before. web->path
 * changes along. */
icc_status iccp_decimate_along(iccp_half_edges *m, const double *x, const iccp_decimate_web *web,
                               const iccp_env *env);

#endif

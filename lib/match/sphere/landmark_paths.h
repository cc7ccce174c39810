/* Landmarks of two surfaces, joined by paths so that both are triangulated alike. */
#ifndef ICCP_LANDMARK_PATHS_H
#define ICCP_LANDMARK_PATHS_H

#include "match/sphere/split_surface.h"

typedef struct iccp_paths_report {
    double worst; /* the greatest ratio of a path's two lengths */
    int side;     /* where there are too many vertices, and the landmark that the path begins at */
    uint32_t landmark;
} iccp_paths_report;

/* vertices[side][k]: of landmark k, 4 <= n <= 128, all different on either side. Paths along edges
 * that have only landmarks in common, 3 n - 6 of them, come in the same order round every landmark
 * of both surfaces; edges are halved where there is no room for them. Afterwards `path` of
 * half-edges and `holder` of vertices are the number of their path, and `holder` of landmark k is
 * ICCP_LANDMARK + k. ends: the landmarks that each path joins. joined: n * n, whether there is a
 * path between two landmarks.
 *
 * Short paths first, by the sum of both lengths, each times `scale`, and if `is_even` by how much
 * they differ, too; the first one from landmark `root`. Where report->worst is far above 1 a path
 * goes round something on one surface that it does not go round on the other. ICC_ERR_RESOLUTION if
 * it would be above most_ratio, or more than 20 times as many vertices would be added as there are,
 * ICC_ERR_MEMORY, ICC_ERR_CANCELLED, without a text. O(n^2 m log m) for m vertices. */
icc_status iccp_landmark_paths(iccp_split_surface s[2], size_t n, const uint32_t *const vertices[2],
                               const double scale[2], uint32_t root, bool is_even,
                               double most_ratio, uint32_t (*ends)[2], uint8_t *joined,
                               iccp_paths_report *report, const iccp_env *env);

enum { ICCP_MOST_SURFACE_LANDMARKS = 128 };
#define ICCP_LANDMARK ((uint32_t)1 << 31)

#endif

/* Joins the landmarks of two surfaces by paths that triangulate both in the same way. */
#ifndef ICCP_LANDMARK_PATHS_H
#define ICCP_LANDMARK_PATHS_H

#include "match/sphere/split_surface.h"

typedef struct iccp_paths_report {
    double worst; /* the greatest ratio of a path's two lengths */
    int side;     /* where too many vertices would be added: the side, and the landmark where the
                     path begins */
    uint32_t landmark;
} iccp_paths_report;

/* vertices[side][k] is landmark k, ICCP_LEAST_SURFACE_LANDMARKS <= n <=
 * ICCP_MOST_SURFACE_LANDMARKS, all different on each side. Finds 3 n - 6 paths
 * along edges that meet only at landmarks. They leave each landmark in the same order on both
 * surfaces. Edges are halved if there is no room for a path.
 *
 * Afterwards `path` of half-edges and `holder` of vertices are the number of their path. `holder`
 * of landmark k is ICCP_LANDMARK + k. `ends` has the landmarks of each path. `joined`, n * n, tells
 * if two landmarks are joined.
 *
 * Short paths come first, by the sum of both lengths, each times `scale`. With `is_even`, paths
 * whose lengths differ come later. The first path begins at landmark `root`. If report->worst is
 * far above 1, a path passes something on one surface that it does not pass on the other.
 *
 * ICC_ERR_RESOLUTION if the ratio would exceed most_ratio, or if more than 20 times as many
 * vertices would be added as there are. ICC_ERR_MEMORY, ICC_ERR_CANCELLED. All without a text.
 * O(n^2 m log m) for m vertices. */
icc_status iccp_landmark_paths(iccp_split_surface s[2], size_t n, const uint32_t *const vertices[2],
                               const double scale[2], uint32_t root, bool is_even,
                               double most_ratio, uint32_t (*ends)[2], uint8_t *joined,
                               iccp_paths_report *report, const iccp_env *env);

enum { ICCP_LEAST_SURFACE_LANDMARKS = 4, ICCP_MOST_SURFACE_LANDMARKS = 128 };
#define ICCP_LANDMARK ((uint32_t)1 << 31)

#endif

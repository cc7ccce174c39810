/* Where lines, rays and segments cross a boundary, in any dimension. Whether a facet is crossed is
 * decided by exact signs up to dimension 3, so that nothing slips through between two facets;
 * beyond by math/orient.h. Points have finite coordinates, 0 or of magnitude 2^-200 to 2^200. */
#ifndef ICCP_CROSSINGS_H
#define ICCP_CROSSINGS_H

#include "geometry/facet_tree.h"

typedef struct iccp_line_crossing {
    double at; /* the coordinate along the line */
    uint32_t facet;
} iccp_line_crossing;

/* Whether a line along an axis, through p moved aside by infinitesimals, crosses a facet: it never
 * meets an edge. Returns 0, or the orientation of the facet's shadow along the axis. */
int iccp_facet_crossed(const iccp_facet_tree *tree, uint32_t facet, size_t axis, const double *p);

/* All crossings with that line, sorted; writes up to `capacity` and returns how many there are. An
 * even number for a closed boundary (up to dimension 4, where it is exact), and for a simple one
 * the inside lies between the first and second, third and fourth and so on. The coordinates are
 * rounded. */
size_t iccp_line_crossings(const iccp_facet_tree *tree, size_t axis, const double *p,
                           size_t capacity, iccp_line_crossing *crossings);

/* Whether an odd number of facets is crossed on the way from p to infinity. */
bool iccp_ray_parity(const iccp_facet_tree *tree, size_t axis, bool upwards, const double *p);

/* Whether a closed segment meets a facet, and the share of the way to it. A segment that runs
 * within a facet does not meet it. */
bool iccp_segment_meets(const iccp_facet_tree *tree, uint32_t facet, const double *from,
                        const double *to, double *share);

/* The first facet that a closed segment meets (of several, the one with the smallest number) and
 * the share of the way to it. */
bool iccp_segment_crossing(const iccp_facet_tree *tree, const double *from, const double *to,
                           double *share, uint32_t *facet);

#endif

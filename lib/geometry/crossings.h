/* Where lines, rays and segments cross a boundary, in any dimension. Up to dimension 3, exact signs
 * decide whether a facet is crossed, so nothing slips through between two facets. In higher
 * dimensions math/orient.h decides. Points have finite coordinates, 0 or of magnitude 2^-200 to
 * 2^200. */
#ifndef ICCP_CROSSINGS_H
#define ICCP_CROSSINGS_H

#include "geometry/facet_tree.h"

typedef struct iccp_line_crossing {
    double at; /* coordinate along the line */
    uint32_t facet;
} iccp_line_crossing;

/* Tests whether a line along an axis crosses a facet. The line passes through p moved aside by
 * infinitesimals, so it never meets an edge. Returns 0 for no, else the orientation of the facet's
 * shadow along the axis. */
int iccp_facet_crossed(const iccp_facet_tree *tree, uint32_t facet, size_t axis, const double *p);

/* Finds all crossings with that line, sorted. Writes up to `capacity` and returns how many there
 * are. For a closed boundary the number is even, up to dimension 4, where it is exact. If the
 * boundary is simple, the inside lies between the first and second crossing, the third and fourth,
 * and so on. Coordinates are rounded. */
size_t iccp_line_crossings(const iccp_facet_tree *tree, size_t axis, const double *p,
                           size_t capacity, iccp_line_crossing *crossings);

/* A ray from a point to infinity. */
typedef struct iccp_ray {
    iccp_facet_query query;
    const double *from; /* borrowed */
    size_t axis;        /* it runs along this axis */
    bool upwards;       /* towards greater coordinates */
} iccp_ray;

/* Starts the ray that leaves the box of the whole boundary on the shortest way. Returns false if
 * the point lies outside that box. The tree has boxes. */
bool iccp_ray_start(iccp_ray *ray, const iccp_facet_tree *tree, const double *p);

/* Finds the next facet that the ray crosses, in the order of the tree. A point that lies on no
 * facet is inside a closed boundary if the number of crossings is odd. */
bool iccp_ray_next(iccp_ray *ray, uint32_t *facet);

/* Tests whether a closed segment meets a facet. Returns the position along the segment as a share.
 * A segment that runs within a facet does not meet it. */
bool iccp_segment_meets(const iccp_facet_tree *tree, uint32_t facet, const double *from,
                        const double *to, double *share);

/* Finds the first facet that a closed segment meets, the smallest number if there are several.
 * Returns the position along the segment as a share. */
bool iccp_segment_crossing(const iccp_facet_tree *tree, const double *from, const double *to,
                           double *share, uint32_t *facet);

#endif

/* Points and segments of the plane, and some of space, exact unless said otherwise.
 *
 * Words of this folder, which works on raw coordinates. Begin with this file, then polygon.h and
 * simplices.h.
 * - local coordinates: the caller's coordinates, shifted and scaled exactly to a size of about 1
 *   (frame.h).
 * - facet: an edge of a polygon, a triangle of a surface, and so on: a simplex of the boundary.
 * - position, place: an index in walking order of a polygon, or in the order of a tree of boxes.
 * - side: a facet of a mesh as seen from one of its simplices (simplices.h).
 * - defect: a reason why a polygon is not simple (defect.h).
 * - band: points so close to a boundary that they count as on it (band.h).
 * - far away, order value: how distances from distant points are compared (away.h).
 * - share: a position along a segment, from 0 to 1.
 * - piece, group: parts of items that near_pairs.h compares, and items that it does not compare.
 *
 * Ways
 * - Polygons: polygon_check.h says what is wrong. simple.h decides most, sweep.h the others, and
 *   also whether chains stay apart. defects.h lists all defects.
 * - Triangles that meet: triangles.h, which skips what fans.h clears. needles.h, on near_pairs.h,
 *   takes over where too many boxes overlap.
 * - Point in polygon: locate.h, by buckets.h, and boxtree.h for the nearest edge. In any dimension:
 *   inside.h, by crossings.h, and facet_nearest.c on the boxes of facet_tree.h.
 * - Nearest point of one simplex: simplex.h. Meshes: simplices.h, simplices_check.c (topology).
 * - Lattices: octants.h. Curves: path.h. Equal lists of vertices: tuples.h.
 *
 * Invariants: decisions about meeting, inside and orientation are exact up to dimension 3. If
 * several answers are equally good, the one with the smallest number wins, so results do not depend
 * on trees. */
#ifndef ICCP_SEGMENT_H
#define ICCP_SEGMENT_H

#include "icc/icc.h"

#include <stdbool.h>

/* The order in which a sweep visits points: by x, then by y. */
static inline bool iccp_point_less(const double *p, const double *q)
{
    return p[0] < q[0] || (p[0] == q[0] && p[1] < q[1]);
}

static inline bool iccp_point_equal(const double *p, const double *q)
{
    return p[0] == q[0] && p[1] == q[1];
}

/* Returns true if p and q, both different from v, lie in the same direction from v. */
bool iccp_point_folds(const double *v, const double *p, const double *q);

/* Returns true if p lies on the closed segment from a to b. */
bool iccp_segment_has(const double *a, const double *b, const double *p);

/* Tells how the closed segments ab and cd meet; neither has length zero. Returns 0 if they do not,
 * ICC_DEFECT_CROSSING for one point inside both, else ICC_DEFECT_TOUCH. */
int32_t iccp_segments_meet(const double *a, const double *b, const double *c, const double *d);

/* Returns true if the closed segments ab and cd in space meet. Both may be points. */
bool iccp_segments_meet_in_space(const double *a, const double *b, const double *c,
                                 const double *d);

/* Computes a common point of segments that meet, up to rounding. */
void iccp_segments_point(const double *a, const double *b, const double *c, const double *d,
                         double *point);

/* Returns the squared distance of p from segment ab, up to rounding. *t is the position of the
 * nearest point as a share, exactly 0 at a and 1 at b. */
double iccp_segment_nearest(const double *a, const double *b, const double *p, double *t);

#endif

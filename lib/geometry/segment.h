/* Points and segments of the plane, exact unless said otherwise. */
#ifndef ICCP_SEGMENT_H
#define ICCP_SEGMENT_H

#include "icc/icc.h"

#include <stdbool.h>

/* The order in which a sweep meets points: by x, then by y. */
static inline bool iccp_point_less(const double *p, const double *q)
{
    return p[0] < q[0] || (p[0] == q[0] && p[1] < q[1]);
}

static inline bool iccp_point_equal(const double *p, const double *q)
{
    return p[0] == q[0] && p[1] == q[1];
}

/* Whether p and q, both different from v, lie in the same direction from v. */
bool iccp_point_folds(const double *v, const double *p, const double *q);

/* Whether p lies on the closed segment from a to b. */
bool iccp_segment_has(const double *a, const double *b, const double *p);

/* How the closed segments ab and cd, neither of length zero, meet: 0 not at all,
 * ICC_DEFECT_CROSSING in one point inside both, ICC_DEFECT_TOUCH otherwise. */
int32_t iccp_segments_meet(const double *a, const double *b, const double *c, const double *d);

/* A point where segments that meet do so, up to rounding. */
void iccp_segments_point(const double *a, const double *b, const double *c, const double *d,
                         double *point);

/* The squared distance of p from segment ab and the share *t of the way from a to b of the nearest
 * point, up to rounding; t is exactly 0 at a and 1 at b. */
double iccp_segment_nearest(const double *a, const double *b, const double *p, double *t);

#endif

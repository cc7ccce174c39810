/* Points and segments of the plane. */
#include "geometry/segment.h"

#include "math/predicates.h"

#include <float.h>

bool iccp_point_folds(const double *v, const double *p, const double *q)
{
    return iccp_point_less(p, v) == iccp_point_less(q, v) && iccp_orient2d(p, v, q) == 0;
}

static bool spans(double a, double b, double x)
{
    return a < b ? a <= x && x <= b : b <= x && x <= a;
}

bool iccp_segment_has(const double *a, const double *b, const double *p)
{
    return spans(a[0], b[0], p[0]) && spans(a[1], b[1], p[1]) && iccp_orient2d(a, b, p) == 0;
}

static bool apart(double a, double b, double c, double d)
{
    const double low1 = a < b ? a : b, high1 = a < b ? b : a;
    const double low2 = c < d ? c : d, high2 = c < d ? d : c;
    return high1 < low2 || high2 < low1;
}

/* Segments on one line meet if and only if their boxes do. So the four signs need no special
 * case. */
int32_t iccp_segments_meet(const double *a, const double *b, const double *c, const double *d)
{
    if (apart(a[0], b[0], c[0], d[0]) || apart(a[1], b[1], c[1], d[1]))
        return 0;
    const int cd = iccp_orient2d(a, b, c) * iccp_orient2d(a, b, d);
    if (cd > 0)
        return 0;
    const int ab = iccp_orient2d(c, d, a) * iccp_orient2d(c, d, b);
    if (ab > 0)
        return 0;
    return ab < 0 && cd < 0 ? ICC_DEFECT_CROSSING : ICC_DEFECT_TOUCH;
}

/* Segments in one plane meet if and only if their shadows along all three axes do. The reason is
 * that along one of the axes, the shadow shows the plane without loss. */
bool iccp_segments_meet_in_space(const double *a, const double *b, const double *c, const double *d)
{
    const double *const points[4] = {a, b, c, d};
    double shadow[4][2];
    if (iccp_orient3d(a, b, c, d) != 0)
        return false;
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < 4; ++i) {
            shadow[i][0] = points[i][(axis + 1) % 3];
            shadow[i][1] = points[i][(axis + 2) % 3];
        }
        if (iccp_segments_meet(shadow[0], shadow[1], shadow[2], shadow[3]) == 0)
            return false;
    }
    return true;
}

void iccp_segments_point(const double *a, const double *b, const double *c, const double *d,
                         double *point)
{
    const double *ends[4] = {a, b, c, d};
    for (int i = 0; i < 4; ++i)
        if (iccp_segment_has(ends[i < 2 ? 2 : 0], ends[i < 2 ? 3 : 1], ends[i])) {
            point[0] = ends[i][0];
            point[1] = ends[i][1];
            return;
        }
    const double u[2] = {b[0] - a[0], b[1] - a[1]}, v[2] = {d[0] - c[0], d[1] - c[1]};
    const double w[2] = {c[0] - a[0], c[1] - a[1]};
    const double det = u[0] * v[1] - u[1] * v[0];
    double t = det == 0 ? 0.5 : (w[0] * v[1] - w[1] * v[0]) / det;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    point[0] = a[0] + t * u[0];
    point[1] = a[1] + t * u[1];
}

/* Rounding may put a vertex on a nearby edge. So the distance is 0 only at an end, and a vertex is
 * always found as itself. */
double iccp_segment_nearest(const double *a, const double *b, const double *p, double *t)
{
    const double d[2] = {b[0] - a[0], b[1] - a[1]};
    double w[2] = {p[0] - a[0], p[1] - a[1]};
    const double along = w[0] * d[0] + w[1] * d[1], length2 = d[0] * d[0] + d[1] * d[1];
    if (along > 0 && along < length2) {
        const double across = d[0] * w[1] - d[1] * w[0];
        *t = along / length2;
        return across * across / length2 + DBL_MIN;
    }
    *t = along > 0 ? 1 : 0;
    if (along > 0) {
        w[0] = p[0] - b[0];
        w[1] = p[1] - b[1];
    }
    return w[0] * w[0] + w[1] * w[1];
}

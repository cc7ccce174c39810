/* Shares of crossings. */
#include "geo/crossing.h"

/* The distance of p from the line a b that crosses an edge at whose end p is, in any unit. The
 * closer end of the line comes first, and its direction is scaled. So lines from far away neither
 * overflow nor lose the edge in rounding. */
static double height(const double a[2], const double b[2], const double p[2])
{
    double dx = b[0] / 2 - a[0] / 2, dy = b[1] / 2 - a[1] / 2, scale = fmax(fabs(dx), fabs(dy));
    const double *ref = point_distance(a, p) < point_distance(b, p) ? a : b;
    return dx / scale * (p[1] - ref[1]) - dy / scale * (p[0] - ref[0]);
}

double crossing_share(const double a[2], const double b[2], const double c[2], const double d[2])
{
    bool swapped = point_before(b, a);
    const double *from = swapped ? b : a, *to = swapped ? a : b;
    double u = height(from, to, c), v = height(from, to, d), share = u / (u - v);
    return share >= 0 && share <= 1 ? share : 0.5;
}

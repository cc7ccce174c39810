/* Takes the lowest corner v and its neighbours a and b. If no vertex lies in the triangle a v b,
 * its centre is inside. Otherwise it takes the vertex in the triangle that is farthest from the
 * line a b. The middle between this vertex and v is inside, because nothing lies between the two
 * (J. O'Rourke, Computational Geometry in C, 1.5). */
#include "geo/inner_point.h"

#include "base/orientation.h"

#include <math.h>

static const double *lowest(size_t n, const double *ring, const double **before,
                            const double **after)
{
    size_t low = 0;
    for (size_t i = 1; i < n; i++) {
        const double *p = ring + 2 * i, *q = ring + 2 * low;
        if (p[1] < q[1] || (p[1] <= q[1] && p[0] < q[0]))
            low = i;
    }
    *before = ring + 2 * ((low + n - 1) % n);
    *after = ring + 2 * ((low + 1) % n);
    return ring + 2 * low;
}

void inner_point(size_t n, const double *ring, double out[2])
{
    const double *a, *b, *v = lowest(n, ring, &a, &b), *inner = NULL;
    int turn = orientation(a, v, b);
    double most = 0;
    for (size_t i = 0; i < n; i++) {
        const double *p = ring + 2 * i;
        if (p == a || p == b || p == v || orientation(a, v, p) * turn < 0 ||
            orientation(v, b, p) * turn < 0 || orientation(b, a, p) * turn < 0)
            continue;
        double height = fabs((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]));
        if (inner == NULL || height > most) {
            inner = p;
            most = height;
        }
    }
    for (size_t k = 0; k < 2; k++)
        out[k] = inner != NULL ? v[k] / 2 + inner[k] / 2 : a[k] / 3 + v[k] / 3 + b[k] / 3;
}

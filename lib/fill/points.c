/* The points of a mesh under construction. */
#include "fill/points.h"

#include "base/minmax.h"
#include "fill/fixed.h"

static void make_fixed(iccp_fixed *fixed, const iccp_points *points, uint32_t p)
{
    *fixed = (iccp_fixed){{{0}}};
    if (!iccp_is_dyadic(points, p)) {
        iccp_fixed_add(fixed, iccp_point(points, p), 1.0);
        return;
    }
    const iccp_dyadic *const d = &points->dyadic[p - points->n_fixed];
    for (int i = 0; i < 3; ++i)
        if (d->share[i] > 0.0)
            iccp_fixed_add(fixed, iccp_point(points, d->of[i]), d->share[i]);
}

/* The filter: coordinates are at most 1 where they are rounded, by at most 5 2^-54. So the error of
 * each entry is at most 5 2^-53. The error of the determinant is at most 6 times that and the
 * products of two rows. */
int iccp_points_orient_dyadic(const iccp_points *points, const uint32_t corner[4])
{
    const double rounding = 0x1p-47; /* 64 2^-53 */
    const double *const d = iccp_point(points, corner[3]);
    double row[3][3], size[3];
    for (int i = 0; i < 3; ++i) {
        const double *const p = iccp_point(points, corner[i]);
        size[i] = 0x1p-50;
        for (int k = 0; k < 3; ++k) {
            row[i][k] = p[k] - d[k];
            size[i] = iccp_max(size[i], fabs(row[i][k]));
        }
    }
    const double *const a = row[0], *const b = row[1], *const c = row[2];
    const double det = b[2] * (a[0] * c[1] - c[0] * a[1]) + a[2] * (c[0] * b[1] - b[0] * c[1]) +
                       c[2] * (b[0] * a[1] - a[0] * b[1]);
    const double bound = 6.0 * ICCP_ORIENT3D_ERROR * size[0] * size[1] * size[2] +
                         rounding * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0]);
    if (fabs(det) > bound)
        return (det > 0.0) - (det < 0.0);
    iccp_fixed fixed[4];
    for (int i = 0; i < 4; ++i)
        make_fixed(&fixed[i], points, corner[i]);
    return iccp_fixed_orient3d(&fixed[0], &fixed[1], &fixed[2], &fixed[3]);
}

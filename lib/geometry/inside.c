/* Where points lie with respect to a boundary. The distance decides whether a point is on the
 * boundary. Otherwise the parity of crossings decides, on the shortest way out along an axis (C.
 * Ericson, Real-Time Collision Detection, section 5.4.1, with exact signs). */
#include "geometry/inside.h"

#include "geometry/crossings.h"
#include "geometry/simplex.h"
#include "icc/icc.h"

#include <math.h>

enum { MAX = ICC_MAX_DIM };

/* Returns true if p belongs to the band of a facet, at the point of the facet with these
 * coordinates. */
static bool in_band(const iccp_band *band, size_t dim, const double *const *corners,
                    const double *share, const double *p)
{
    double gap[MAX];
    if (!iccp_band_is_wide(band))
        return true;
    for (size_t k = 0; k < dim; ++k) {
        gap[k] = corners[0][k] - p[k];
        for (size_t i = 1; i < dim; ++i)
            gap[k] += share[i] * (corners[i][k] - corners[0][k]);
    }
    return iccp_band_holds(band, dim, gap);
}

/* Finds the nearest facet whose band contains p, the smallest number if there are several. */
static bool on_boundary(const iccp_facet_tree *tree, const iccp_band *band, const double *p,
                        uint32_t *facet, double *bary)
{
    double box[2 * MAX], best = band->reach * band->reach;
    iccp_facet_query query;
    uint32_t next;
    bool found = false;
    for (size_t k = 0; k < tree->dim; ++k) {
        box[k] = p[k] - band->reach;
        box[tree->dim + k] = p[k] + band->reach;
    }
    iccp_facet_query_start(&query, tree, box);
    while (iccp_facet_query_next(&query, &next)) {
        const double *corners[MAX];
        double share[MAX];
        iccp_facet_corners(tree, next, corners);
        const double distance2 = iccp_simplex_nearest(tree->dim, tree->dim, corners, p, share);
        if (distance2 > best || (found && !(distance2 < best) && next > *facet) ||
            !in_band(band, tree->dim, corners, share, p))
            continue;
        found = true;
        best = distance2;
        *facet = next;
        for (size_t i = 0; i < tree->dim; ++i)
            bary[i] = share[i];
    }
    return found;
}

int32_t iccp_inside_find(const iccp_facet_tree *tree, const iccp_band *band, const double *p,
                         uint32_t *facet, double *bary)
{
    iccp_ray ray;
    uint32_t crossed;
    bool odd = false;
    if (on_boundary(tree, band, p, facet, bary))
        return ICC_BOUNDARY;
    if (!iccp_ray_start(&ray, tree, p))
        return ICC_OUTSIDE;
    while (iccp_ray_next(&ray, &crossed))
        odd = !odd;
    return odd ? ICC_INSIDE : ICC_OUTSIDE;
}

/* Maps points through two charts: the image of a point has the same coordinates in the other
 * domain.
 *
 * Source: Huynh and Gingold, Bijective Deformations in R^n via Integral Curve Coordinates,
 * section 4, steps 3-5. */
#include "map/curves/curves.h"

#include "chart/encode_points.h"
#include "math/elementary.h"

#include <math.h>

/* Applies the chain rule through the coordinates, and the scales of the two frames. */
static void multiply(const icc_chart *from, const icc_chart *to, const iccp_decode_jet *outer,
                     const iccp_encode_jet *inner, double *jacobian)
{
    const int32_t dim = to->info.dim;
    const double *in = from->domain->frame.in, *out = to->domain->frame.out;
    for (int32_t i = 0; i < dim; ++i)
        for (int32_t j = 0; j < dim; ++j) {
            double sum = outer->t[i] * inner->t[j];
            for (int32_t k = 0; k < dim; ++k)
                sum += outer->bary[i * dim + k] * inner->bary[k * dim + j];
            jacobian[i * dim + j] = sum * (in[0] * out[0]) * (in[1] * out[1]);
        }
}

icc_status iccp_curves_point(const icc_chart *from, const icc_chart *to, const double *point,
                             double *image, double *jacobian, iccp_path *path)
{
    iccp_coords coords;
    iccp_encode_jet inner;
    iccp_decode_jet outer;
    const bool jets = jacobian != NULL;
    icc_status status = iccp_encode_point(from, point, &coords, jets ? &inner : NULL);
    if (status == ICC_OK)
        status = iccp_decode_point(to, &coords, image, jets ? &outer : NULL, path);
    else
        for (int32_t k = 0; k < to->info.dim; ++k)
            image[k] = NAN;
    if (status == ICC_OK && jets)
        multiply(from, to, &outer, &inner, jacobian);
    return status;
}

/* The extent of a facet, up to a factor that is the same for all facets. Gram-Schmidt keeps the
 * digits of slivers. */
static double extent_of(const icc_domain *domain, uint32_t facet)
{
    const int32_t dim = domain->dim;
    const double *corner[ICC_MAX_DIM];
    double edge[ICC_MAX_DIM][ICC_MAX_DIM], extent = 1;
    iccp_facet_corners(&domain->tree, facet, corner);
    for (int32_t i = 0; i + 1 < dim; ++i) {
        double length2 = 0;
        for (int32_t k = 0; k < dim; ++k)
            edge[i][k] = corner[i + 1][k] - corner[0][k];
        for (int32_t j = 0; j < i; ++j) {
            double along = 0;
            for (int32_t k = 0; k < dim; ++k)
                along += edge[i][k] * edge[j][k];
            for (int32_t k = 0; k < dim; ++k)
                edge[i][k] -= along * edge[j][k];
        }
        for (int32_t k = 0; k < dim; ++k)
            length2 += edge[i][k] * edge[i][k];
        const double length = sqrt(length2);
        for (int32_t k = 0; k < dim; ++k)
            edge[i][k] /= length;
        extent *= length;
    }
    return extent;
}

static double share_of(const icc_chart *chart, const iccp_coords *coords, double volume)
{
    if (!(coords->t > 0 && coords->t < 1))
        return 0;
    return volume + iccp_ln(extent_of(chart->domain, coords->facet) / fabs(chart->domain->measure));
}

icc_status iccp_curves_points(const icc_chart *from, const icc_chart *to, size_t n,
                              const double *points, double *images, iccp_shares *shares,
                              icc_status *status, iccp_path *path)
{
    iccp_coords coords[ICCP_CHART_MANY];
    double before[ICCP_CHART_MANY], after[ICCP_CHART_MANY];
    const bool wanted = shares != NULL;
    icc_status all =
        iccp_encode_points(from, n, points, coords, wanted ? before : NULL, status, path);
    if (all == ICC_OK)
        all = iccp_decode_points(to, n, coords, images, wanted ? after : NULL, status, path);
    for (size_t i = 0; wanted && all == ICC_OK && i < n; ++i)
        if (status[i] == ICC_OK)
            shares[i] = (iccp_shares){share_of(from, &coords[i], before[i]),
                                      share_of(to, &coords[i], after[i])};
    return all;
}

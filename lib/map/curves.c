/* Based on: Huynh and Gingold, Bijective Deformations in R^n via Integral Curve Coordinates, section
 * 4, steps 3-5: the image of a point has the same coordinates in the other domain. */
#include "map/curves.h"

#include "chart/bulk.h"

#include <math.h>

/* The chain rule through the coordinates, and the scales of the two frames. */
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
    icc_status status = iccp_encode_point(from, point, &coords, jets ? &inner : NULL, path);
    if (status == ICC_OK)
        status = iccp_decode_point(to, &coords, image, jets ? &outer : NULL, path);
    else
        for (int32_t k = 0; k < to->info.dim; ++k)
            image[k] = NAN;
    if (status == ICC_OK && jets)
        multiply(from, to, &outer, &inner, jacobian);
    return status;
}

icc_status iccp_curves_points(const icc_chart *from, const icc_chart *to, size_t n,
                              const double *points, double *images, icc_status *status,
                              iccp_path *path)
{
    iccp_coords coords[ICCP_CHART_MANY];
    const icc_status all = iccp_encode_points(from, n, points, coords, status, path);
    return all == ICC_OK ? iccp_decode_points(to, n, coords, images, status, path) : all;
}

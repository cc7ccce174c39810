/* Converts one point, or a few together, between the caller's coordinates and a chart's. */
#include "chart/encode_points.h"

#include <math.h>
#include <string.h>

/* How far the sum of barycentric coordinates may be from 1. Text files with nine digits are
 * accepted. */
static const double SUM_TOLERANCE = 1e-9;

static icc_status to_local(const icc_chart *chart, const double *point, double *local)
{
    const int32_t dim = chart->domain->dim;
    for (int32_t k = 0; k < dim; ++k)
        if (!isfinite(point[k]))
            return ICC_ERR_ARGUMENT;
    iccp_frame_in(&chart->domain->frame, dim, point, local);
    return ICC_OK;
}

icc_status iccp_encode_point(const icc_chart *chart, const double *point, iccp_coords *coords,
                             iccp_encode_jet *jet)
{
    double local[ICC_MAX_DIM];
    const icc_status status = to_local(chart, point, local);
    return status == ICC_OK ? iccp_chart_encode(chart, local, coords, jet) : status;
}

/* Checks the ranges, with comparisons that fail for NaN. Scales a sum within the tolerance to 1. */
static bool normalise(const icc_domain *domain, iccp_coords *coords)
{
    double sum = 0;
    for (int32_t k = 0; k < domain->dim; ++k) {
        if (!(coords->bary[k] >= 0))
            return false;
        sum += coords->bary[k];
    }
    if (!(fabs(sum - 1) <= SUM_TOLERANCE) || !(coords->t >= 0 && coords->t <= 1) ||
        coords->facet >= domain->n_facets)
        return false;
    for (int32_t k = 0; k < domain->dim; ++k)
        coords->bary[k] /= sum;
    return true;
}

/* Converts a point to the caller's coordinates, or to NaN if it failed. */
static void from_local(const icc_chart *chart, icc_status status, const double *local,
                       double *point)
{
    const int32_t dim = chart->domain->dim;
    if (status == ICC_OK)
        iccp_frame_out(&chart->domain->frame, dim, local, point);
    else
        for (int32_t k = 0; k < dim; ++k)
            point[k] = NAN;
}

icc_status iccp_decode_point(const icc_chart *chart, const iccp_coords *coords, double *point,
                             iccp_decode_jet *jet, iccp_path *path)
{
    iccp_coords checked = *coords;
    double local[ICC_MAX_DIM];
    icc_status status = ICC_ERR_ARGUMENT;
    if (normalise(chart->domain, &checked))
        status = iccp_chart_decode(chart, &checked, local, jet, path);
    from_local(chart, status, local, point);
    return status;
}

/* ---- many points ---- */

/* Passes the points that have a curve of their own to the method together. */
static icc_status encode_many(const icc_chart *chart, size_t n, const double *points,
                              iccp_coords *coords, double *volume, icc_status *status,
                              iccp_path *path)
{
    iccp_chart_place place[ICCP_CHART_MANY];
    size_t which[ICCP_CHART_MANY], n_which = 0;
    for (size_t i = 0; i < n; ++i) {
        double local[ICC_MAX_DIM];
        if (volume != NULL)
            volume[i] = NAN;
        status[i] = to_local(chart, points + (size_t)chart->domain->dim * i, local);
        if (status[i] == ICC_OK &&
            !iccp_chart_is_trivial(chart, local, &place[n_which], &coords[i], &status[i]))
            which[n_which++] = i;
    }
    if (n_which == 0)
        return ICC_OK;
    return chart->ops->encode_many(chart, n_which, which, place, coords, volume, status, path);
}

icc_status iccp_encode_points(const icc_chart *chart, size_t n, const double *points,
                              iccp_coords *coords, double *volume, icc_status *status,
                              iccp_path *path)
{
    const size_t dim = (size_t)chart->domain->dim;
    icc_status all = ICC_OK;
    if (chart->ops->encode_many != NULL)
        return encode_many(chart, n, points, coords, volume, status, path);
    for (size_t i = 0; i < n && iccp_is_point_status(all); ++i)
        all = status[i] = iccp_encode_point(chart, points + dim * i, &coords[i], NULL);
    return iccp_is_point_status(all) ? ICC_OK : all;
}

/* Passes the coordinates whose points have a curve of their own to the method together. */
static icc_status decode_many(const icc_chart *chart, size_t n, const iccp_coords *coords,
                              double *local, double *volume, icc_status *status, iccp_path *path)
{
    size_t which[ICCP_CHART_MANY], n_which = 0;
    for (size_t i = 0; i < n; ++i) {
        if (volume != NULL)
            volume[i] = NAN;
        if (status[i] == ICC_OK &&
            !iccp_chart_is_end(chart, &coords[i], local + (size_t)chart->domain->dim * i))
            which[n_which++] = i;
    }
    if (n_which == 0)
        return ICC_OK;
    return chart->ops->decode_many(chart, n_which, which, coords, local, volume, status, path);
}

icc_status iccp_decode_points(const icc_chart *chart, size_t n, iccp_coords *coords, double *points,
                              double *volume, icc_status *status, iccp_path *path)
{
    const size_t dim = (size_t)chart->domain->dim;
    double local[ICCP_CHART_MANY * ICC_MAX_DIM];
    icc_status all = ICC_OK;
    for (size_t i = 0; i < n; ++i)
        if (status[i] == ICC_OK && !normalise(chart->domain, &coords[i]))
            status[i] = ICC_ERR_ARGUMENT;
    if (chart->ops->decode_many != NULL)
        all = decode_many(chart, n, coords, local, volume, status, path);
    for (size_t i = 0; i < n && iccp_is_point_status(all); ++i) {
        if (chart->ops->decode_many == NULL && status[i] == ICC_OK)
            all = status[i] = iccp_chart_decode(chart, &coords[i], local + dim * i, NULL, path);
        from_local(chart, status[i], local + dim * i, points + dim * i);
    }
    return iccp_is_point_status(all) ? ICC_OK : all;
}

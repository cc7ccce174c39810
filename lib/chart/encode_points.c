/* Batch conversions: points in chunks, in parallel, between the caller's coordinates and a
 * chart's. */
#include "chart/encode_points.h"

#include "base/threads.h"

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

typedef struct batch {
    const icc_chart *chart;
    const iccp_memory *memory;
    double *points;
    uint32_t *facet;
    double *bary, *t;
    icc_status *status;
    atomic_size_t n_failed;
} batch;

static void note(batch *b, size_t begin, size_t end, const icc_status *status)
{
    size_t n_failed = 0;
    for (size_t i = begin; i < end; ++i) {
        if (b->status != NULL)
            b->status[i] = status[i - begin];
        n_failed += status[i - begin] != ICC_OK;
    }
    atomic_fetch_add(&b->n_failed, n_failed);
}

static void write_coords(batch *b, size_t i, const iccp_coords *coords, icc_status status)
{
    const size_t dim = (size_t)b->chart->domain->dim;
    b->facet[i] = status == ICC_OK ? coords->facet : UINT32_MAX;
    b->t[i] = status == ICC_OK ? coords->t : NAN;
    for (size_t k = 0; k < dim; ++k)
        b->bary[dim * i + k] = status == ICC_OK ? coords->bary[k] : NAN;
}

static icc_status encode_chunk(void *argument, size_t begin, size_t end)
{
    batch *b = argument;
    const size_t dim = (size_t)b->chart->domain->dim, n = end - begin;
    iccp_coords coords[ICCP_CHART_MANY];
    icc_status status[ICCP_CHART_MANY];
    iccp_path path;
    iccp_path_init(&path, b->memory);
    const icc_status all =
        iccp_encode_points(b->chart, n, b->points + dim * begin, coords, NULL, status, &path);
    iccp_path_clear(&path);
    if (all != ICC_OK)
        return all;
    for (size_t i = 0; i < n; ++i)
        write_coords(b, begin + i, &coords[i], status[i]);
    note(b, begin, end, status);
    return ICC_OK;
}

/* One path serves all points of a chunk, so its memory is the only allocation. */
static icc_status decode_chunk(void *argument, size_t begin, size_t end)
{
    batch *b = argument;
    const size_t dim = (size_t)b->chart->domain->dim, n = end - begin;
    iccp_coords coords[ICCP_CHART_MANY];
    icc_status status[ICCP_CHART_MANY] = {ICC_OK};
    iccp_path path;
    for (size_t i = 0; i < n; ++i) {
        coords[i].facet = b->facet[begin + i];
        coords[i].t = b->t[begin + i];
        memcpy(coords[i].bary, b->bary + dim * (begin + i), dim * sizeof(double));
    }
    iccp_path_init(&path, b->memory);
    const icc_status all =
        iccp_decode_points(b->chart, n, coords, b->points + dim * begin, NULL, status, &path);
    iccp_path_clear(&path);
    if (all == ICC_OK)
        note(b, begin, end, status);
    return all;
}

static icc_status run(batch *b, size_t n, iccp_chunk chunk, size_t *n_failed, const iccp_env *env)
{
    icc_status status = n > 0 ? iccp_chart_ready(b->chart, chunk == decode_chunk) : ICC_OK;
    if (status == ICC_OK)
        status = iccp_for_chunks(env, "trace", n, ICCP_CHART_MANY, chunk, b);
    if (n_failed != NULL)
        *n_failed = atomic_load(&b->n_failed);
    return status;
}

icc_status iccp_encode_all(const icc_chart *chart, size_t n, const double *points, uint32_t *facet,
                           double *bary, double *t, icc_status *status, size_t *n_failed,
                           const iccp_env *env)
{
    /* encode_chunk only reads the points. */
    batch b = {chart, &env->memory, (double *)points, facet, bary, t, status, 0};
    return run(&b, n, encode_chunk, n_failed, env);
}

icc_status iccp_decode_all(const icc_chart *chart, size_t n, const uint32_t *facet,
                           const double *bary, const double *t, double *points, icc_status *status,
                           size_t *n_failed, const iccp_env *env)
{
    /* decode_chunk only reads the coordinates. */
    batch b = {chart,          &env->memory, points, (uint32_t *)facet,
               (double *)bary, (double *)t,  status, 0};
    return run(&b, n, decode_chunk, n_failed, env);
}

#include "chart/bulk.h"

#include "base/threads.h"

#include <math.h>
#include <string.h>

/* Points per task: long enough to outweigh the handing out, short enough to cancel quickly. */
enum { GRAIN = 128 };

/* How far barycentric coordinates may miss a sum of 1: a text file with nine digits will do. */
static const double SUM_TOLERANCE = 1e-9;

icc_status iccp_encode_point(const icc_chart *chart, const double *point, iccp_coords *coords,
                             iccp_encode_jet *jet, iccp_path *path)
{
    const int32_t dim = chart->domain->dim;
    double local[ICC_MAX_DIM];
    for (int32_t k = 0; k < dim; ++k)
        if (!isfinite(point[k]))
            return ICC_ERR_ARGUMENT;
    iccp_frame_in(&chart->domain->frame, dim, point, local);
    return chart->ops->encode(chart, local, coords, jet, path);
}

/* Range checks in the form that NaN fails. Scales a sum that is off within tolerance to 1. */
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

icc_status iccp_decode_point(const icc_chart *chart, const iccp_coords *coords, double *point,
                             iccp_decode_jet *jet, iccp_path *path)
{
    const int32_t dim = chart->domain->dim;
    iccp_coords checked = *coords;
    double local[ICC_MAX_DIM];
    icc_status status = ICC_ERR_ARGUMENT;
    if (normalise(chart->domain, &checked))
        status = chart->ops->decode(chart, &checked, local, jet, path);
    if (status == ICC_OK)
        iccp_frame_out(&chart->domain->frame, dim, local, point);
    else
        for (int32_t k = 0; k < dim; ++k)
            point[k] = NAN;
    return status;
}

typedef struct bulk {
    const icc_chart *chart;
    const iccp_memory *memory;
    double *points;
    uint32_t *facet;
    double *bary, *t;
    icc_status *status;
    atomic_size_t n_failed;
} bulk;

static void note(bulk *b, size_t i, icc_status status)
{
    if (b->status != NULL)
        b->status[i] = status;
    if (status != ICC_OK)
        atomic_fetch_add(&b->n_failed, 1);
}

static icc_status encode_chunk(void *argument, size_t begin, size_t end)
{
    bulk *b = argument;
    const size_t dim = (size_t)b->chart->domain->dim;
    icc_status status = ICC_OK;
    iccp_path path;
    iccp_path_init(&path, b->memory);
    for (size_t i = begin; i < end && iccp_is_point_status(status); ++i) {
        iccp_coords coords = {0};
        status = iccp_encode_point(b->chart, b->points + dim * i, &coords, NULL, &path);
        if (status != ICC_OK) {
            coords.facet = UINT32_MAX;
            coords.t = NAN;
            for (size_t k = 0; k < dim; ++k)
                coords.bary[k] = NAN;
        }
        b->facet[i] = coords.facet;
        b->t[i] = coords.t;
        memcpy(b->bary + dim * i, coords.bary, dim * sizeof(double));
        note(b, i, status);
    }
    iccp_path_clear(&path);
    return iccp_is_point_status(status) ? ICC_OK : status;
}

static icc_status decode_chunk(void *argument, size_t begin, size_t end)
{
    bulk *b = argument;
    const size_t dim = (size_t)b->chart->domain->dim;
    icc_status status = ICC_OK;
    iccp_path path;
    iccp_path_init(&path, b->memory);
    for (size_t i = begin; i < end && iccp_is_point_status(status); ++i) {
        iccp_coords coords = {.facet = b->facet[i], .t = b->t[i]};
        memcpy(coords.bary, b->bary + dim * i, dim * sizeof(double));
        status = iccp_decode_point(b->chart, &coords, b->points + dim * i, NULL, &path);
        note(b, i, status);
    }
    iccp_path_clear(&path);
    return iccp_is_point_status(status) ? ICC_OK : status;
}

static icc_status run(bulk *b, const char *stage, size_t n, iccp_chunk chunk, size_t *n_failed,
                      const iccp_env *env)
{
    const icc_status status = iccp_for_chunks(env, stage, n, GRAIN, chunk, b);
    if (n_failed != NULL)
        *n_failed = atomic_load(&b->n_failed);
    return status;
}

icc_status iccp_encode_all(const icc_chart *chart, size_t n, const double *points, uint32_t *facet,
                           double *bary, double *t, icc_status *status, size_t *n_failed,
                           const iccp_env *env)
{
    /* encode_chunk only reads the points. */
    bulk b = {chart, &env->memory, (double *)points, facet, bary, t, status, 0};
    return run(&b, "encode", n, encode_chunk, n_failed, env);
}

icc_status iccp_decode_all(const icc_chart *chart, size_t n, const uint32_t *facet,
                           const double *bary, const double *t, double *points,
                           icc_status *status, size_t *n_failed, const iccp_env *env)
{
    /* decode_chunk only reads the coordinates. */
    bulk b = {chart, &env->memory, points, (uint32_t *)facet, (double *)bary, (double *)t, status, 0};
    return run(&b, "decode", n, decode_chunk, n_failed, env);
}

/* Batch conversions: points in chunks, in parallel, between the caller's coordinates and a
 * chart's. */
#include "chart/encode_all.h"

#include "base/threads.h"
#include "chart/encode_points.h"
#include "chart/losses.h"

#include <math.h>
#include <string.h>

typedef struct batch {
    const icc_chart *chart;
    const iccp_memory *memory;
    double *points;
    uint32_t *facet;
    double *bary, *t;
    icc_status *status;
    int32_t *flags; /* or NULL */
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
    const double *points = b->points + dim * begin;
    icc_status all = iccp_encode_points(b->chart, n, points, coords, NULL, status, &path);
    if (all == ICC_OK && b->flags != NULL)
        all = iccp_encode_losses(b->chart, n, points, coords, status, b->flags + begin, &path);
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
    double *points = b->points + dim * begin;
    icc_status all = iccp_decode_points(b->chart, n, coords, points, NULL, status, &path);
    if (all == ICC_OK && b->flags != NULL)
        all = iccp_decode_losses(b->chart, n, coords, points, status, b->flags + begin, &path);
    iccp_path_clear(&path);
    if (all == ICC_OK)
        note(b, begin, end, status);
    return all;
}

/* The flags need the way back, too. */
static icc_status prepare(const batch *b, bool decodes)
{
    const icc_status status = iccp_chart_ready(b->chart, decodes);
    return status == ICC_OK && b->flags != NULL ? iccp_chart_ready(b->chart, !decodes) : status;
}

static icc_status run(batch *b, size_t n, iccp_chunk chunk, size_t *n_failed, const iccp_env *env)
{
    icc_status status = n > 0 ? prepare(b, chunk == decode_chunk) : ICC_OK;
    if (status == ICC_OK)
        status = iccp_for_chunks(env, "trace", n, ICCP_CHART_MANY, chunk, b);
    if (n_failed != NULL)
        *n_failed = atomic_load(&b->n_failed);
    return status;
}

icc_status iccp_encode_all(const icc_chart *chart, size_t n, const double *points, uint32_t *facet,
                           double *bary, double *t, icc_status *status, int32_t *flags,
                           size_t *n_failed, const iccp_env *env)
{
    /* encode_chunk only reads the points. */
    batch b = {chart, &env->memory, (double *)points, facet, bary, t, status, flags, 0};
    return run(&b, n, encode_chunk, n_failed, env);
}

icc_status iccp_decode_all(const icc_chart *chart, size_t n, const uint32_t *facet,
                           const double *bary, const double *t, double *points, icc_status *status,
                           int32_t *flags, size_t *n_failed, const iccp_env *env)
{
    /* decode_chunk only reads the coordinates. */
    batch b = {chart,  &env->memory, points, (uint32_t *)facet, (double *)bary, (double *)t,
               status, flags,        0};
    return run(&b, n, decode_chunk, n_failed, env);
}

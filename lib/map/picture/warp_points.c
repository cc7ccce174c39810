/* Warps a picture by any map, pixel by pixel. Every pixel of the target takes its colour from the
 * origin of its centre. The map shrinks the picture where neighbouring centres have origins more
 * than a pixel apart. There the pixel is the mean of a grid of samples, each mapped back on its
 * own. So nothing from outside the source domain or from the far side of a fold gets in. */
#include "map/picture/warp_points.h"

#include "base/minmax.h"
#include "base/threads.h"
#include "map/picture/picture_values.h"
#include "map/picture/sampler.h"
#include "map/picture/scan.h"
#include "math/elementary.h"

#include <math.h>

/* Rows in a task. The rows before and after are mapped as well, for comparison. */
enum { ROWS = 16 };

typedef struct warp {
    const icc_map *map;
    const icc_picture *target;
    const icc_picture *values; /* the source if its samples are values, else NULL */
    iccp_sampler source;
    iccp_env alone; /* environment for calls from within a task */
    atomic_size_t n_failed;
} warp;

/* Origins of the centres in the rows of one task and in the rows beside them. NaN if a centre has
 * none. */
typedef struct band {
    double *origins;
    icc_status *status;
    int32_t first, n_rows; /* of the origins */
} band;

static icc_status find_origins(warp *w, band *b)
{
    const size_t width = (size_t)w->target->width, n = width * (size_t)b->n_rows;
    for (size_t k = 0; k < n; ++k) {
        b->origins[2 * k] = (double)(k % width) + 0.5;
        b->origins[2 * k + 1] = (double)b->first + (double)(k / width) + 0.5;
    }
    return iccp_map_apply(w->map, true, n, b->origins, b->origins, b->status, NULL, &w->alone);
}

static double distance(const double *a, const double *b)
{
    return iccp_hypot(a[0] - b[0], a[1] - b[1]);
}

/* Only the nearer neighbour counts. At a jump of the map the other one tells nothing about this
 * pixel. iccp_min() skips NaN. */
static int32_t samples_between(const double *before, const double *here, const double *after)
{
    return iccp_samples_for(iccp_min(before != NULL ? distance(before, here) : NAN,
                                     after != NULL ? distance(here, after) : NAN));
}

static void add_sample(const iccp_sampler *source, const double place[2], iccp_gathered *gathered)
{
    const iccp_line line = {place[0] - 0.5, place[1] - 0.5, 0, 0, 1};
    if (!isnan(place[0]))
        iccp_sampler_gather(source, &line, 1, 0, 1, gathered);
}

/* Paints the mean of the picture's samples at the known places, or its sample at `else_at` if no
 * place is known. */
static void paint_places(const warp *w, size_t n, const double *places, const double *else_at,
                         uint8_t *to)
{
    iccp_gathered gathered = {{0}, 0};
    size_t n_known = 0;
    for (size_t k = 0; k < n; ++k)
        n_known += isnan(places[2 * k]) ? 0 : 1;
    if (n_known == 0) {
        places = else_at;
        n = 1;
    }
    if (w->values != NULL) {
        iccp_picture_values_paint(w->values, n, places, to);
        return;
    }
    for (size_t k = 0; k < n; ++k)
        add_sample(&w->source, places + 2 * k, &gathered);
    iccp_sampler_store(&w->source, &gathered, 1, to);
}

/* Paints the mean of a grid of samples, or the sample of the centre if no other sample has an
 * origin. */
static icc_status paint_mean(const warp *w, const double *centre_origin, int32_t column,
                             int32_t row, int32_t columns, int32_t rows, uint8_t *to)
{
    double points[2 * ICCP_MOST_SAMPLES * ICCP_MOST_SAMPLES];
    const size_t n = (size_t)(columns * rows);
    for (int32_t k = 0; k < columns * rows; ++k) {
        points[2 * k] = column + (k % columns + 0.5) / columns;
        points[2 * k + 1] = row + (k / columns + 0.5) / rows;
    }
    const icc_status status =
        iccp_map_apply(w->map, true, n, points, points, NULL, NULL, &w->alone);
    paint_places(w, n, points, centre_origin, to);
    return status;
}

static icc_status paint_pixel(const warp *w, const band *b, int32_t column, int32_t row)
{
    const icc_picture *to = w->target;
    const size_t width = (size_t)to->width;
    const int32_t r = row - b->first;
    const double *here = b->origins + 2 * ((size_t)r * width + (size_t)column);
    uint8_t *pixel = (uint8_t *)to->pixels + (size_t)row * to->stride +
                     (size_t)column * (size_t)(to->channels * to->bytes);
    const int32_t columns = samples_between(column > 0 ? here - 2 : NULL, here,
                                            column + 1 < to->width ? here + 2 : NULL);
    const int32_t rows = samples_between(r > 0 ? here - 2 * width : NULL, here,
                                         r + 1 < b->n_rows ? here + 2 * width : NULL);
    const bool nearest = w->values != NULL && w->values->interpolation == ICC_INTERPOLATION_NEAREST;
    if (columns * rows > 1 && !nearest)
        return paint_mean(w, here, column, row, columns, rows, pixel);
    const iccp_line line = {here[0] - 0.5, here[1] - 0.5, 0, 0, 1};
    if (w->values != NULL)
        iccp_picture_values_paint(w->values, 1, here, pixel);
    else
        iccp_sampler_paint(&w->source, &line, pixel);
    return ICC_OK;
}

static icc_status paint_rows(warp *w, const band *b, int32_t begin, int32_t end)
{
    size_t n_failed = 0;
    icc_status status = ICC_OK;
    for (int32_t row = begin; row < end && status == ICC_OK; ++row)
        for (int32_t column = 0; column < w->target->width && status == ICC_OK; ++column) {
            const icc_status found =
                b->status[(size_t)(row - b->first) * (size_t)w->target->width + (size_t)column];
            n_failed += found != ICC_OK && found != ICC_ERR_OUTSIDE;
            if (found == ICC_OK)
                status = paint_pixel(w, b, column, row);
        }
    atomic_fetch_add(&w->n_failed, n_failed);
    return status;
}

static icc_status paint_chunk(void *argument, size_t begin, size_t end)
{
    warp *w = argument;
    const int32_t last = (int32_t)end < w->target->height ? (int32_t)end : w->target->height - 1;
    band b = {.first = begin > 0 ? (int32_t)begin - 1 : 0};
    b.n_rows = last - b.first + 1;
    const size_t n = (size_t)w->target->width * (size_t)b.n_rows;
    b.origins = iccp_alloc(&w->alone.memory, n, 2 * sizeof *b.origins);
    b.status = iccp_alloc(&w->alone.memory, n, sizeof *b.status);
    icc_status status = b.origins != NULL && b.status != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = find_origins(w, &b);
    if (status == ICC_OK)
        status = paint_rows(w, &b, (int32_t)begin, (int32_t)end);
    iccp_free(&w->alone.memory, b.origins);
    iccp_free(&w->alone.memory, b.status);
    return status;
}

icc_status iccp_warp_points(const icc_map *map, const icc_picture *source,
                            const icc_picture *target, size_t *n_failed, const iccp_env *env)
{
    warp w = {.map = map,
              .target = target,
              .alone = {.memory = env->memory, .user = env->user, .threads = 1}};
    if (iccp_picture_has_values(source))
        w.values = source;
    else
        iccp_sampler_init(&w.source, source);
    const icc_status status =
        iccp_for_chunks(env, "warp", (size_t)target->height, ROWS, paint_chunk, &w);
    if (n_failed != NULL)
        *n_failed = atomic_load(&w.n_failed);
    return status;
}

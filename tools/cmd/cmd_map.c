/* libicc map: maps points from source to target or back. */
#include "cmd/commands.h"

#include "base/allocate.h"
#include "base/system.h"
#include "job/mesh_out.h"
#include "job/point_file.h"
#include "job/require.h"
#include "job/ties_file.h"
#include "job/triangulation.h"

#include <stdlib.h>
#include <string.h>

/* Points without an image stay where they are, or become nan. */
static void settle_outside(const job *j, const table *points, double *images,
                           const icc_status *status)
{
    size_t dim = points->columns;
    for (size_t i = 0; i < points->n && j->args->outside == OUTSIDE_KEEP; i++)
        if (status[i] != ICC_OK)
            memcpy(images + dim * i, points->values + dim * i, dim * sizeof *images);
}

/* Names the line of the first point without an image, if all must have one or the input would be
 * lost. */
static int refuse(const job *j, const table *points, const icc_status *status, size_t n_failed)
{
    size_t i = 0;
    while (status[i] == ICC_OK)
        i++;
    bool is_outside = status[i] == ICC_ERR_OUTSIDE;
    const char *why = is_outside ? "lies outside " : "has no image";
    const char *of = is_outside ? job_bound(j) : "";
    if (j->args->outside == OUTSIDE_FAIL)
        return failed(j->args->points, points->lines[i],
                      "this point %s%s (%zu of %zu have no image), so nothing is written", why, of,
                      n_failed, points->n);
    return failed(j->args->points, points->lines[i],
                  "this point %s%s (%zu of %zu have no image), and the result would overwrite it; "
                  "write to another file",
                  why, of, n_failed, points->n);
}

static int write_points(job *j, const table *points, double *images, const icc_status *status,
                        double seconds)
{
    const char *out = j->args->output ? j->args->output : "-";
    size_t n_failed = 0;
    bool over = file_is_same(j->args->points, out);
    for (size_t i = 0; i < points->n; i++)
        n_failed += status[i] != ICC_OK;
    if (n_failed > 0 && (j->args->outside == OUTSIDE_FAIL || over))
        return refuse(j, points, status, n_failed);
    settle_outside(j, points, images, status);
    int result = triangulation_write(j);
    if (result == DONE)
        result = ties_write(j);
    if (result == DONE)
        result = rows_write(out, points->n, points->columns, images);
    if (result == DONE && over)
        note("%s: the points are replaced by their images", out);
    if (result == DONE)
        result = report_points(j, points->n, n_failed, seconds);
    if (result != DONE)
        return result;
    result = triangulation_tell(j);
    int outside = job_partial(j, points->n, status, "points");
    return outside != DONE ? outside : result;
}

static int map_points(job *j, const table *points)
{
    icc_status *status = need(points->n, sizeof *status);
    double *images = need(points->n, points->columns * sizeof *images);
    carrier c;
    double began = seconds_now();
    int result = job_start_carrier(j, &c);
    if (result == DONE) {
        progress_expect(&j->bar, 1);
        icc_status ran = carrier_map(&c, points->n, points->values, images, status, NULL);
        double seconds = seconds_now() - began;
        progress_end(&j->bar);
        result = ran == ICC_OK ? write_points(j, points, images, status, seconds)
                               : job_failed_status(j, ran);
    }
    carrier_free(&c);
    free(images);
    free(status);
    return result;
}

int map_apply(job *j)
{
    table points;
    int result = triangulation_check(j);
    if (result == DONE)
        result = ties_check(j);
    if (result == DONE)
        result = mesh_out_check(j);
    if (result == DONE)
        result = job_make_map(j);
    if (result == DONE)
        result = require_maps(j);
    if (result == DONE)
        result = mesh_out_write(j);
    if (result == DONE && mesh_out_is_wanted(j) && j->args->points == NULL)
        return report_points(j, 0, 0, 0);
    if (result == DONE) {
        table_form form = rows_of_points(job_dim(j));
        result = rows_read(&points, j->args->points, &form);
    }
    if (result == DONE) {
        result = map_points(j, &points);
        table_free(&points);
    }
    return result;
}

int run_map(const args *a)
{
    job j;
    job_start(&j, a);
    int result = a->geojson ? geojson_apply(&j) : map_apply(&j);
    job_end(&j);
    return result;
}

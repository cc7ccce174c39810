/* libicc map: carries points from source to target or back. */
#include "cmd/commands.h"

#include "base/allocate.h"
#include "job/point_file.h"

#include <stdlib.h>

static int map_points(job *j, table *points)
{
    size_t n_failed = 0;
    icc_status *status = need(points->n, sizeof *status);
    double began = seconds_now();
    progress_expect(&j->bar, 1);
    icc_status ran = (j->args->inverse ? icc_map_apply_inverse : icc_map_apply)(
        j->map, points->n, points->values, points->values, status, &n_failed, &j->env);
    double seconds = seconds_now() - began;
    progress_end(&j->bar);
    int result = ran == ICC_OK ? DONE : job_failed_status(j, ran);
    if (result == DONE)
        result = rows_write(j->args->output ? j->args->output : "-", points->n, points->columns,
                            points->values);
    if (result == DONE)
        result = report_points(j, points->n, n_failed, seconds);
    if (result == DONE)
        result = job_partial(j, points->n, status, "points");
    free(status);
    return result;
}

int run_map(const args *a)
{
    if (a->geojson)
        return run_geojson(a);
    job j;
    table points;
    job_start(&j, a);
    int result = job_make_map(&j);
    if (result == DONE) {
        table_form form = rows_of_points(job_dim(&j));
        result = rows_read(&points, a->points, &form);
    }
    if (result == DONE) {
        result = map_points(&j, &points);
        table_free(&points);
    }
    job_end(&j);
    return result;
}

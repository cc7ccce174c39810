/* libicc weights: computes the weights of all handles at points. */
#include "cmd/commands.h"

#include "base/allocate.h"
#include "base/system.h"
#include "job/point_file.h"
#include "kernel/kernel_job.h"
#include "kernel/weight_plot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PLACES_ALONG = 401 };

/* Spreads points along the segment of --along. */
static int spread_along(const kernel_job *k, table *points)
{
    const args *a = k->job.args;
    size_t dim = k->set.dim;
    if (a->n_along != 2 * dim)
        return misused(a->command, "--along has %zu coordinates; it needs %zu here", a->n_along,
                       2 * dim);
    *points = (table){.n = PLACES_ALONG, .columns = dim};
    points->values = need(points->n, dim * sizeof *points->values);
    for (size_t i = 0; i < points->n; i++) {
        double t = (double)i / (PLACES_ALONG - 1);
        for (size_t c = 0; c < dim; c++)
            points->values[dim * i + c] = a->along[c] * (1 - t) + a->along[dim + c] * t;
    }
    return DONE;
}

static int read_points(const kernel_job *k, table *points)
{
    const args *a = k->job.args;
    *points = (table){.columns = k->set.dim};
    if (a->n_along > 0)
        return spread_along(k, points);
    if (a->points == NULL)
        return DONE;
    table_form form = rows_of_points(k->set.dim);
    return rows_read(points, a->points, &form);
}

/* Writes the weights. Along a segment the first column is the place on it. */
static int write_rows(const kernel_job *k, size_t n, const double *weights)
{
    size_t m = k->set.n_handles;
    if (k->job.args->output == NULL)
        return DONE;
    if (k->job.args->n_along == 0)
        return rows_write(k->job.args->output, n, m, weights);
    double *rows = need(n, (m + 1) * sizeof *rows);
    for (size_t i = 0; i < n; i++) {
        rows[(m + 1) * i] = (double)i / (double)(n - 1);
        memcpy(rows + (m + 1) * i + 1, weights + m * i, m * sizeof *rows);
    }
    int result = rows_write(k->job.args->output, n, m + 1, rows);
    free(rows);
    return result;
}

/* Saves the points with their weights for `libicc pose --binding`. A point that is not finite is
 * named by its line in the points' file. */
static int write_binding(kernel_job *k, const table *points)
{
    const char *name = k->job.args->binding;
    icc_binding *binding;
    icc_error err = {.size = sizeof err, .index = -1};
    if (name == NULL)
        return DONE;
    if (icc_binding_create(&binding, k->weights, points->n, points->values, 0, &k->job.env, &err) !=
        ICC_OK)
        return failed(k->job.args->points,
                      err.index >= 0 && points->lines != NULL ? points->lines[err.index] : 0, "%s",
                      err.message);
    size_t n_bytes = 0;
    icc_binding_save(binding, 0, NULL, &n_bytes);
    void *bytes = need(n_bytes, 1);
    icc_status status = icc_binding_save(binding, n_bytes, bytes, &n_bytes);
    icc_binding_free(binding);
    outfile file;
    int result = status == ICC_OK ? DONE : job_failed_status(&k->job, status);
    if (result == DONE)
        result = outfile_open(&file, name) ? DONE : FAILED;
    if (result == DONE) {
        fwrite(bytes, 1, n_bytes, file.stream);
        result = outfile_close(&file) ? DONE : FAILED;
    }
    free(bytes);
    return result;
}

/* The reported quality is measured at the points that have weights. */
static int report_weights(kernel_job *k, const table *points, size_t n_failed, double seconds)
{
    if (!k->job.args->json)
        return DONE;
    size_t dim = k->set.dim, n = 0;
    double *finite = need(points->n, dim * sizeof *finite);
    for (size_t i = 0; i < points->n; i++) {
        bool good = true;
        for (size_t c = 0; c < dim; c++)
            good = good && isfinite(points->values[dim * i + c]);
        if (good)
            memcpy(finite + dim * n++, points->values + dim * i, dim * sizeof *finite);
    }
    report r;
    int result = kernel_report_open(&r, k, n, finite);
    free(finite);
    if (result != DONE)
        return result;
    json_count(&r.json, "without_weights", n_failed);
    json_number(&r.json, "seconds_points", seconds);
    return report_close(&r) ? DONE : FAILED;
}

/* Computes the weights of all points, a row of n_handles each, and writes everything that was asked
 * for: binding, picture, table, report. */
static int weigh(kernel_job *k, const table *points)
{
    const args *a = k->job.args;
    size_t n_failed = 0;
    double *weights = need(points->n, k->set.n_handles * sizeof *weights);
    double began = seconds_now();
    icc_status status = icc_weights_evaluate(k->weights, points->n, points->values, weights, NULL,
                                             NULL, &n_failed, &k->job.env);
    double seconds = seconds_now() - began;
    progress_end(&k->job.bar);
    int result = status == ICC_OK ? write_binding(k, points) : job_failed_status(&k->job, status);
    if (result == DONE && a->picture != NULL)
        result = a->n_along > 0 ? plot_along(k, points->n, weights) : plot_weight(k);
    if (result == DONE)
        result = write_rows(k, points->n, weights);
    free(weights);
    if (result == DONE)
        result = report_weights(k, points, n_failed, seconds);
    if (result != DONE || n_failed == 0)
        return result;
    note("%zu of %zu points have no weights: they are not finite", n_failed, points->n);
    return PARTIAL;
}

int run_weights(const args *a)
{
    kernel_job k;
    table points = {0};
    kernel_job_start(&k, a);
    int result = kernel_job_read(&k);
    if (result == DONE)
        result = read_points(&k, &points);
    if (result == DONE)
        result = kernel_job_make(&k);
    if (result == DONE)
        result = weigh(&k, &points);
    table_free(&points);
    kernel_job_end(&k);
    return result;
}

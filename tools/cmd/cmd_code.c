/* libicc encode, libicc decode: convert Cartesian coordinates to integral curve coordinates and
 * back.
 *
 * A row of coordinates is `facet b0 b1 t`. The curve starts on the edge from vertex `facet` (from
 * 0), at b0 of that vertex plus b1 of the next one. The point lies at the share t of its length. In
 * space the facet is a face, which has three corners, and so on. */
#include "cmd/commands.h"

#include "base/allocate.h"
#include "base/system.h"
#include "job/point_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Coordinates of n points, in the library's arrays. */
typedef struct coordinates {
    uint32_t *facet;
    double *bary, *t;
    icc_status *status;
} coordinates;

static coordinates coordinates_make(size_t n, size_t dim)
{
    return (coordinates){
        .facet = need(n, sizeof(uint32_t)),
        .bary = need(n, dim * sizeof(double)),
        .t = need(n, sizeof(double)),
        .status = need(n, sizeof(icc_status)),
    };
}

static void coordinates_free(coordinates *c)
{
    free(c->facet);
    free(c->bary);
    free(c->t);
    free(c->status);
}

static int finish(job *j, const coordinates *c, icc_status ran, size_t n, size_t columns,
                  const double *rows, double began, const char *what)
{
    double seconds = seconds_now() - began;
    progress_end(&j->bar);
    if (ran != ICC_OK)
        return job_failed_status(j, ran);
    size_t n_failed = 0;
    for (size_t i = 0; i < n; i++)
        n_failed += c->status[i] != ICC_OK;
    int result = rows_write(j->args->output ? j->args->output : "-", n, columns, rows);
    if (result == DONE)
        result = report_points(j, n, n_failed, seconds);
    return result == DONE ? job_partial(j, n, c->status, what) : result;
}

static int encode(job *j, const table *points)
{
    size_t n = points->n, dim = points->columns, columns = dim + 2;
    coordinates c = coordinates_make(n, dim);
    double *rows = need(n, columns * sizeof *rows), began = seconds_now();
    icc_status ran = icc_chart_encode(j->chart, n, points->values, c.facet, c.bary, c.t, c.status,
                                      NULL, &j->env);
    for (size_t i = 0; ran == ICC_OK && i < n; i++) {
        double *row = rows + columns * i;
        row[0] = c.status[i] == ICC_OK ? (double)c.facet[i] : NAN;
        memcpy(row + 1, c.bary + dim * i, dim * sizeof *row);
        row[dim + 1] = c.t[i];
    }
    int result = finish(j, &c, ran, n, columns, rows, began, "points");
    free(rows);
    coordinates_free(&c);
    return result;
}

/* Splits the rows into the library's arrays. A row of NaN is a point that encode did not find. */
static int take_rows(const job *j, const table *rows, coordinates *c)
{
    const cage *source = &j->cages[0];
    size_t dim = source->dim, n_facets = source->n_facets > 0 ? source->n_facets : source->n;
    for (size_t i = 0; i < rows->n; i++) {
        const double *row = rows->values + rows->columns * i;
        c->facet[i] = UINT32_MAX;
        if (!isnan(row[0])) {
            if (!(row[0] >= 0 && row[0] < (double)n_facets && floor(row[0]) == row[0]))
                return failed(j->args->coords, rows->lines[i],
                              "%.17g is not %s; the cage has the %ss 0 to %zu", row[0],
                              dim == 2 ? "an edge" : "a facet", dim == 2 ? "edge" : "facet",
                              n_facets - 1);
            c->facet[i] = (uint32_t)row[0];
        }
        memcpy(c->bary + dim * i, row + 1, dim * sizeof *row);
        c->t[i] = row[dim + 1];
    }
    return DONE;
}

static int decode(job *j, const table *rows)
{
    size_t n = rows->n, dim = job_dim(j);
    coordinates c = coordinates_make(n, dim);
    double *points = need(n, dim * sizeof *points), began = seconds_now();
    int result = take_rows(j, rows, &c);
    if (result == DONE) {
        icc_status ran =
            icc_chart_decode(j->chart, n, c.facet, c.bary, c.t, points, c.status, NULL, &j->env);
        result = finish(j, &c, ran, n, dim, points, began, "coordinates");
    }
    free(points);
    coordinates_free(&c);
    return result;
}

static int run(const args *a, const char *name, table_form (*form_of)(size_t),
               int (*code)(job *, const table *))
{
    job j;
    table rows;
    job_start(&j, a);
    int result = job_make_chart(&j);
    if (result == DONE) {
        table_form form = form_of(job_dim(&j));
        result = rows_read(&rows, name, &form);
    }
    if (result == DONE) {
        result = code(&j, &rows);
        table_free(&rows);
    }
    job_end(&j);
    return result;
}

int run_encode(const args *a)
{
    return run(a, a->points, rows_of_points, encode);
}

int run_decode(const args *a)
{
    return run(a, a->coords, rows_of_coordinates, decode);
}

/* libicc warp: every pixel of the target fetches its colour from the source.
 *
 * The centres of all pixels inside the target cage are mapped back. Where neighbouring centres come
 * from more than a pixel apart the map shrinks the picture; the pixel is then the mean of a grid of
 * samples, each mapped back by itself, so that nothing outside the source cage and nothing from the
 * far side of a fold gets in. */
#include "commands.h"

#include "job.h"
#include "memory.h"
#include "resample.h"

#include <math.h>
#include <stdlib.h>

enum {
    MAX_SAMPLES_A_SIDE = 8, /* a shrinkage of 8 is smooth, more is merely better than nothing */
    MAX_BATCH = 1 << 18     /* samples mapped in one call; bounds the memory */
};

typedef struct warp {
    job job;
    picture from, to;
    unsigned char *inside; /* 1 for pixels whose centre is in the target cage */
    double *origin;        /* where each of these comes from, else NaN */
    size_t n_pixels;       /* inside */
    size_t n_failed;
    icc_status *status; /* of the pixels inside, in order */
} warp;

/* Marks the pixels whose centre lies in the target cage, row by row. */
static int find_inside(warp *w)
{
    size_t width = w->to.width;
    double *centres = need(width, 2 * sizeof *centres);
    int32_t *where = need(width, sizeof *where);
    icc_status ran = ICC_OK;
    for (size_t y = 0; y < w->to.height && ran == ICC_OK; y++) {
        for (size_t x = 0; x < width; x++) {
            centres[2 * x] = (double)x + 0.5;
            centres[2 * x + 1] = (double)y + 0.5;
        }
        ran = icc_domain_locate(w->job.domains[1], width, centres, where, NULL, NULL, &w->job.env);
        for (size_t x = 0; x < width && ran == ICC_OK; x++) {
            w->inside[y * width + x] = where[x] != ICC_OUTSIDE;
            w->n_pixels += where[x] != ICC_OUTSIDE;
        }
    }
    free(centres);
    free(where);
    return ran == ICC_OK ? DONE : job_failed_status(&w->job, ran);
}

/* Maps the centres of the pixels inside back to the source. */
static int find_origins(warp *w)
{
    size_t n_all = w->to.width * w->to.height, n = 0;
    double *points = need(w->n_pixels, 2 * sizeof *points);
    w->status = need(w->n_pixels, sizeof *w->status);
    for (size_t i = 0; i < n_all; i++)
        if (w->inside[i]) {
            points[2 * n] = (double)(i % w->to.width) + 0.5;
            points[2 * n++ + 1] = (double)(i / w->to.width) + 0.5;
        }
    icc_status ran =
        icc_map_apply_inverse(w->job.map, n, points, points, w->status, &w->n_failed, &w->job.env);
    n = 0;
    for (size_t i = 0; i < n_all; i++) {
        bool found = ran == ICC_OK && w->inside[i];
        w->origin[2 * i] = found ? points[2 * n] : NAN;
        w->origin[2 * i + 1] = found ? points[2 * n + 1] : NAN;
        n += w->inside[i];
    }
    free(points);
    return ran == ICC_OK ? DONE : job_failed_status(&w->job, ran);
}

static double distance(const warp *w, size_t i, size_t k)
{
    return hypot(w->origin[2 * i] - w->origin[2 * k], w->origin[2 * i + 1] - w->origin[2 * k + 1]);
}

/* A grid of samples in a pixel. */
typedef struct sampling {
    size_t columns, rows;
} sampling;

/* Of the two neighbours along an axis the nearer one counts: at a jump of the map the other one tells
 * nothing about this pixel. fmin passes over NaN. A bilinear sample is two pixels wide, so that steps
 * of 1.25 pixels still cover everything. */
static size_t samples_along(double before, double after)
{
    double n = ceil(fmin(before, after) / 1.25);
    return !(n > 1) ? 1 : n >= MAX_SAMPLES_A_SIDE ? MAX_SAMPLES_A_SIDE : (size_t)n;
}

static sampling choose_sampling(const warp *w, size_t i)
{
    size_t width = w->to.width, x = i % width, y = i / width;
    return (sampling){
        .columns = samples_along(x > 0 ? distance(w, i, i - 1) : NAN,
                                 x + 1 < width ? distance(w, i, i + 1) : NAN),
        .rows = samples_along(y > 0 ? distance(w, i, i - width) : NAN,
                              y + 1 < w->to.height ? distance(w, i, i + width) : NAN),
    };
}

/* A batch of pixels that take several samples. */
typedef struct batch {
    double *points;
    size_t n_points, n_pixels;
    struct {
        size_t pixel, n_samples;
    } * pixels;
} batch;

static icc_status finish_batch(warp *w, batch *b)
{
    icc_status ran = icc_map_apply_inverse(w->job.map, b->n_points, b->points, b->points, NULL,
                                           NULL, &w->job.env);
    const double *p = b->points;
    for (size_t k = 0; k < b->n_pixels && ran == ICC_OK; k++) {
        size_t i = b->pixels[k].pixel;
        mixture m = {0};
        for (size_t s = b->pixels[k].n_samples; s > 0; s--, p += 2)
            if (!isnan(p[0]))
                mixture_add(&m, &w->from, p[0], p[1]);
        if (!(m.n > 0))
            mixture_add(&m, &w->from, w->origin[2 * i], w->origin[2 * i + 1]);
        mixture_store(&m, &w->to, i);
    }
    b->n_points = b->n_pixels = 0;
    return ran;
}

static void add_to_batch(const warp *w, batch *b, size_t i, sampling grid)
{
    size_t n = grid.columns * grid.rows;
    b->pixels[b->n_pixels].pixel = i;
    b->pixels[b->n_pixels++].n_samples = n;
    for (size_t s = 0; s < n; s++) {
        double u = ((double)(s % grid.columns) + 0.5) / (double)grid.columns;
        double v = ((double)(s / grid.columns) + 0.5) / (double)grid.rows;
        b->points[2 * b->n_points] = (double)(i % w->to.width) + u;
        b->points[2 * b->n_points++ + 1] = (double)(i / w->to.width) + v;
    }
}

static int paint(warp *w)
{
    size_t n_all = w->to.width * w->to.height;
    batch b = {.points = need(MAX_BATCH, 2 * sizeof *b.points),
               .pixels = need(MAX_BATCH, sizeof *b.pixels)};
    icc_status ran = ICC_OK;
    for (size_t i = 0; i < n_all && ran == ICC_OK; i++) {
        if (isnan(w->origin[2 * i]))
            continue;
        sampling grid = choose_sampling(w, i);
        if (grid.columns * grid.rows > 1) {
            if (b.n_points + grid.columns * grid.rows > MAX_BATCH)
                ran = finish_batch(w, &b);
            add_to_batch(w, &b, i, grid);
            continue;
        }
        mixture m = {0};
        mixture_add(&m, &w->from, w->origin[2 * i], w->origin[2 * i + 1]);
        mixture_store(&m, &w->to, i);
    }
    if (ran == ICC_OK && b.n_points > 0)
        ran = finish_batch(w, &b);
    free(b.points);
    free(b.pixels);
    return ran == ICC_OK ? DONE : job_failed_status(&w->job, ran);
}

/* Outside the cage, and where there is no image, the background shows. */
static void clear(warp *w)
{
    const unsigned char *rgba = w->job.args->background;
    for (size_t i = 0; i < w->to.width * w->to.height; i++)
        if (isnan(w->origin[2 * i]))
            picture_set(&w->to, i, rgba);
}

static int read_picture(warp *w)
{
    const args *a = w->job.args;
    size_t n;
    char *bytes = file_read(a->operands[0], &n);
    if (bytes == NULL)
        return FAILED;
    problem wrong;
    bool good = picture_decode(&w->from, bytes, n, &wrong);
    free(bytes);
    if (!good)
        return failed(a->operands[0], 0, "%s", wrong.text);
    if (a->has_background)
        picture_widen(&w->from,
                      a->background[0] != a->background[1] || a->background[0] != a->background[2],
                      a->background[3] < 255);
    w->to = picture_copy(&w->from);
    w->inside = need(w->to.width * w->to.height, 1);
    w->origin = need(w->to.width * w->to.height, 2 * sizeof *w->origin);
    return DONE;
}

static int write_picture(const warp *w)
{
    const char *name = w->job.args->operands[1];
    problem wrong;
    size_t n;
    unsigned char *bytes = picture_encode(&w->to, w->from.keep, &n, &wrong);
    if (bytes == NULL)
        return failed(name, 0, "%s", wrong.text);
    outfile file;
    int result = outfile_open(&file, name) ? DONE : FAILED;
    if (result == DONE) {
        fwrite(bytes, 1, n, file.stream);
        result = outfile_close(&file) ? DONE : FAILED;
    }
    free(bytes);
    return result;
}

static int warp_picture(warp *w)
{
    double began = seconds_now();
    int result = find_inside(w);
    if (result == DONE)
        result = find_origins(w);
    if (result == DONE)
        result = paint(w);
    if (result != DONE)
        return result;
    if (w->job.args->has_background)
        clear(w);
    double seconds = seconds_now() - began;
    progress_end(&w->job.bar);
    result = write_picture(w);
    if (result == DONE)
        result = report_points(&w->job, w->n_pixels, w->n_failed, seconds);
    return result == DONE ? job_partial(&w->job, w->n_pixels, w->status, "pixels") : result;
}

int run_warp(const args *a)
{
    warp w = {0};
    job_start(&w.job, a);
    int result = job_make_map(&w.job);
    if (result == DONE)
        result = read_picture(&w);
    if (result == DONE)
        result = warp_picture(&w);
    picture_free(&w.from);
    picture_free(&w.to);
    free(w.inside);
    free(w.origin);
    free(w.status);
    job_end(&w.job);
    return result;
}

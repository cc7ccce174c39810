/* A map goes from pixels to pixels, both with y down. The pixels of the result are squares of the
 * target's plane, with the first row on top. A world file has six numbers: the size of a pixel,
 * two zeros, the size with a minus, and the place of the centre of the first pixel.
 *
 * The scan gets a border of uncovered pixels, because pictures continue beyond their edges. So all
 * its pixels are counted from (RIM, RIM).
 *
 * The size of the result is known only when the scan's corners have been mapped, so the fit is made
 * twice: the second time with the origin in the result's corner. */
#include "fit/rectify.h"

#include "base/allocate.h"
#include "base/system.h"
#include "job/output_name.h"
#include "job/require.h"
#include "picture/picture_file.h"
#include "plot/picture_begin.h"
#include "plot/picture_warp.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Places on each edge of the scan whose images bound the result. */
enum { N_EDGE = 256 };

/* The width of the border. */
enum { RIM = 2 };

/* The largest width and height of the result. */
static const double MOST_PIXELS = 30000;

typedef struct sheet {
    fit_job *fit;
    picture from, to;
    picture_style style;
    double size;      /* of a pixel in the target */
    double origin[2]; /* the upper left corner of the result in the target */
    double *targets;  /* of the points, as their file has them */
} sheet;

/* ------------------------------------------------------------------- pixels */

/* The size of a pixel of the scan in the target: the square root of the areas' ratio, by the second
 * moments of the points. */
static double pixel_size(const control_points *c)
{
    double area[2];
    for (int side = 0; side < 2; side++) {
        const double *x = side == 0 ? c->from : c->to;
        double mean[2] = {0, 0}, m[3] = {0, 0, 0};
        for (size_t i = 0; i < 2 * c->n; i++)
            mean[i % 2] += x[i] / (double)c->n;
        for (size_t i = 0; i < c->n; i++) {
            double u = x[2 * i] - mean[0], v = x[2 * i + 1] - mean[1];
            m[0] += u * u;
            m[1] += u * v;
            m[2] += v * v;
        }
        double flat = m[0] + m[2], spread = m[0] * m[2] - m[1] * m[1];
        area[side] = c->n < 3 ? flat : sqrt(fmax(spread, 0));
    }
    return sqrt(area[1] / area[0]);
}

/* Makes y of the source point down, as it does in the scan. It does already if the fit would turn
 * the source over. Otherwise rows have negative numbers, as those of QGIS. */
static int take_pixels(sheet *s)
{
    fit_job *f = s->fit;
    control_points *c = &f->points;
    if (!f->turned)
        points_flip_y(c->n, c->from);
    f->turned = false;
    for (size_t i = 0; i < c->n; i++) {
        double x = c->from[2 * i], y = c->from[2 * i + 1];
        if (!(x >= 0 && x <= (double)s->from.width && y >= 0 && y <= (double)s->from.height))
            return failed(f->job.args->source, c->lines[i],
                          "this point is not in the picture of %zu x %zu pixels", s->from.width,
                          s->from.height);
        c->from[2 * i] += RIM;
        c->from[2 * i + 1] += RIM;
    }
    return DONE;
}

/* Turns the targets into pixels of the result. */
static void take_targets(sheet *s)
{
    control_points *c = &s->fit->points;
    for (size_t i = 0; i < c->n; i++) {
        c->to[2 * i] = (s->targets[2 * i] - s->origin[0]) / s->size;
        c->to[2 * i + 1] = (s->origin[1] - s->targets[2 * i + 1]) / s->size;
    }
}

/* The frame is the scan, unless the user has given a box. */
static void choose_box(sheet *s)
{
    args *a = &s->fit->job.own;
    if (a->n_box > 0)
        return;
    a->n_box = 4;
    a->box[0] = a->box[1] = RIM;
    a->box[2] = (double)s->from.width + RIM;
    a->box[3] = (double)s->from.height + RIM;
}

/* ------------------------------------------------------------------- result */

/* Maps the edges of the scan and finds their box. */
static int find_bounds(const sheet *s, double lower[2], double upper[2])
{
    job *j = &s->fit->job;
    double *points = need(4 * N_EDGE, 2 * sizeof *points);
    double w = (double)s->from.width, h = (double)s->from.height;
    for (size_t i = 0; i < N_EDGE; i++) {
        double t = (double)i / N_EDGE;
        const double edges[4][2] = {{w * t, 0}, {w, h * t}, {w * (1 - t), h}, {0, h * (1 - t)}};
        memcpy(points + 8 * i, edges, sizeof edges);
        for (size_t k = 0; k < 8; k++)
            points[8 * i + k] += RIM;
    }
    size_t n_failed;
    icc_status status = icc_map_apply(j->map, 4 * N_EDGE, points, points, NULL, &n_failed, &j->env);
    for (size_t k = 0; k < 2; k++) {
        lower[k] = HUGE_VAL;
        upper[k] = -HUGE_VAL;
    }
    for (size_t i = 0; i < 8 * N_EDGE && status == ICC_OK; i++) {
        lower[i % 2] = fmin(lower[i % 2], points[i]);
        upper[i % 2] = fmax(upper[i % 2], points[i]);
    }
    free(points);
    return status == ICC_OK ? DONE : job_failed_status(j, status);
}

/* Makes the fit, and again with the origin at the corner of the result. */
static int make_map(sheet *s, size_t *width, size_t *height)
{
    fit_job *f = s->fit;
    double lower[2], upper[2];
    take_targets(s);
    int result = fit_job_make(f);
    if (result == DONE)
        result = find_bounds(s, lower, upper);
    if (result != DONE)
        return result;
    double x = floor(lower[0]), y = floor(lower[1]);
    double w = ceil(upper[0]) - x, h = ceil(upper[1]) - y;
    if (!(w >= 1 && h >= 1 && w <= MOST_PIXELS && h <= MOST_PIXELS))
        return failed(f->job.args->source, 0,
                      "the result would have %.0f x %.0f pixels; choose their size by --resolution",
                      w, h);
    s->origin[0] += x * s->size;
    s->origin[1] -= y * s->size;
    *width = (size_t)w;
    *height = (size_t)h;
    take_targets(s);
    return fit_job_make(f);
}

/* Uncovered pixels are transparent, or white if the format has no transparency. */
static void choose_background(args *a, const picture *from, const char *name)
{
    static const unsigned char white[4] = {255, 255, 255, 255}, clear[4] = {0, 0, 0, 0};
    const char *format = output_format(name);
    bool opaque = format != NULL && (strcmp(format, "JPEG") == 0 || strcmp(format, "PGM") == 0 ||
                                     strcmp(format, "PPM") == 0 || strcmp(format, "PNM") == 0);
    opaque = opaque || (format == NULL && from->format != PICTURE_PNG);
    if (a->has_background)
        return;
    if (!picture_is_plain(from)) {
        a->outside = OUTSIDE_NULL;
        return;
    }
    a->has_background = true;
    memcpy(a->background, opaque ? white : clear, 4);
}

/* A picture whose pixels are all like the first of another one. */
static picture fill(const picture *like, size_t width, size_t height)
{
    picture p = picture_make(width, height, like->channels, like->depth);
    for (size_t i = 0; i < width * height * like->channels; i++)
        if (like->values != NULL)
            p.values[i] = like->values[i % like->channels];
        else
            p.samples[i] = like->samples[i % like->channels];
    return p;
}

/* Puts a border of empty pixels around the scan. */
static void add_rim(sheet *s, const picture *empty)
{
    picture *from = &s->from, wide = fill(empty, from->width + 2 * RIM, from->height + 2 * RIM);
    size_t n = from->width * from->channels;
    for (size_t y = 0; y < from->height; y++) {
        size_t at = ((y + RIM) * wide.width + RIM) * from->channels;
        if (from->values != NULL)
            memcpy(wide.values + at, from->values + y * n, n * sizeof *wide.values);
        else
            memcpy(wide.samples + at, from->samples + y * n, n * sizeof *wide.samples);
    }
    wide.format = from->format;
    wide.notes = from->notes;
    from->notes = (picture_notes){.has_gamma = false};
    picture_free(from);
    *from = wide;
}

/* Makes the empty result, from an empty picture of the scan's size. */
static int make_canvas(sheet *s, size_t width, size_t height)
{
    args *a = &s->fit->job.own;
    picture empty;
    choose_background(a, &s->from, a->operands[1]);
    int result = picture_begin(&empty, &s->style, &s->from, a, a->operands[1]);
    if (result == DONE) {
        s->to = fill(&empty, width, height);
        add_rim(s, &empty);
    }
    picture_free(&empty);
    return result;
}

/* ------------------------------------------------------------------ writing */

/* The name of a world file: the first and the last letter of the extension, and a w. */
static char *world_name(const char *picture_name)
{
    size_t n = strlen(picture_name);
    char *name = need(n + 5, 1);
    const char *dot = strrchr(system_last_part(picture_name), '.');
    size_t stem = dot != NULL ? (size_t)(dot - picture_name) : n;
    memcpy(name, picture_name, n);
    if (dot == NULL || strlen(dot) < 3)
        memcpy(name + stem, ".wld", 5);
    else
        memcpy(name + stem, (const char[]){'.', dot[1], picture_name[n - 1], 'w', '\0'}, 5);
    return name;
}

static int write_world(const sheet *s)
{
    const args *a = s->fit->job.args;
    char *name = world_name(a->operands[1]);
    outfile file;
    bool good = outfile_open(&file, name);
    if (good) {
        fprintf(file.stream, "%.17g\n0\n0\n%.17g\n%.17g\n%.17g\n", s->size, -s->size,
                s->origin[0] + s->size / 2, s->origin[1] - s->size / 2);
        good = outfile_close(&file);
    }
    if (good)
        note("%s: %zu x %zu pixels of %.6g; %s says where they lie%s%s", a->operands[1],
             s->to.width, s->to.height, s->size, name, s->fit->points.crs != NULL ? ", in " : "",
             s->fit->points.crs != NULL ? s->fit->points.crs : "");
    free(name);
    return good ? DONE : FAILED;
}

static int write_all(sheet *s)
{
    job *j = &s->fit->job;
    icc_error err = {.size = sizeof err, .index = -1};
    double began = seconds_now();
    size_t n_failed = 0;
    int result = require_maps(j);
    if (result != DONE)
        return result;
    progress_expect(&j->bar, 1);
    icc_status status = picture_warp(j->map, &s->from, &s->to, &n_failed, &j->env, &err);
    progress_end(&j->bar);
    result = status == ICC_OK ? picture_save(&s->to, &s->style, j->args->operands[1])
                              : job_failed(j, &err);
    if (result == DONE)
        result = write_world(s);
    return result == DONE
               ? report_points(j, s->to.width * s->to.height, n_failed, seconds_now() - began)
               : result;
}

/* Residuals are told in units of the target. */
static void restore_units(sheet *s)
{
    fit_job *f = s->fit;
    for (size_t i = 0; i < 2 * f->points.n; i++) {
        f->residuals[i] *= s->size;
        f->left_out[i] *= s->size;
    }
    f->info.residual *= s->size;
    f->info.left_out *= s->size;
    f->info.affine_residual *= s->size;
}

static int run(sheet *s)
{
    fit_job *f = s->fit;
    const args *a = f->job.args;
    size_t width = 0, height = 0;
    int result = take_pixels(s);
    if (result != DONE)
        return result;
    s->size = a->resolution > 0 ? a->resolution : pixel_size(&f->points);
    if (!(isfinite(s->size) && s->size > 0))
        return failed(a->source, 0,
                      "the points do not tell the size of a pixel; give --resolution");
    memcpy(s->targets, f->points.to, f->points.n * 2 * sizeof *s->targets);
    memcpy(s->origin, s->targets, sizeof s->origin);
    choose_box(s);
    result = make_map(s, &width, &height);
    if (result == DONE)
        restore_units(s);
    if (result == DONE)
        result = make_canvas(s, width, height);
    return result == DONE ? write_all(s) : result;
}

int rectify(fit_job *f)
{
    sheet s = {.fit = f, .targets = need(f->points.n, 2 * sizeof(double))};
    int result = picture_read(&s.from, f->job.args->operands[0]);
    if (result == DONE)
        result = run(&s);
    picture_free(&s.from);
    picture_free(&s.to);
    free(s.targets);
    return result;
}

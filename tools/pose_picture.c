/* Pictures are posed forwards: a grid over the shape is posed, and each of its triangles drawn where it has gone
 * to, with the colours from where it was. What turns over is drawn first, so that the rest hides it. */
#include "pose.h"

#include "memory.h"
#include "orient.h"
#include "picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Pixels between vertices of the grid; pixels that wait to be looked up. */
enum { STEP = 4, WAITING = 1 << 15 };

typedef struct drawing {
    pose *pose;
    picture from, to;
    size_t columns, rows; /* vertices of the grid */
    double *rest, *posed; /* columns * rows * 2 */
    size_t n_waiting;
    size_t *pixels;  /* of the result */
    double *sources; /* where they come from, 2 each */
    bool *inside;
    size_t n_triangles, n_inverted; /* with their middle in the shape */
} drawing;

static void make_grid(drawing *d)
{
    d->columns = (d->from.width + STEP - 1) / STEP + 1;
    d->rows = (d->from.height + STEP - 1) / STEP + 1;
    d->rest = need(d->columns * d->rows, 2 * sizeof *d->rest);
    d->posed = need(d->columns * d->rows, 2 * sizeof *d->posed);
    for (size_t i = 0; i < d->columns * d->rows; i++) {
        d->rest[2 * i] = fmin((double)(i % d->columns * STEP), (double)d->from.width);
        d->rest[2 * i + 1] = fmin((double)(i / d->columns * STEP), (double)d->from.height);
    }
}

/* Two triangles in a cell of the grid. */
static void corners_of(const drawing *d, size_t triangle, size_t corners[3])
{
    size_t cell = triangle / 2, x = cell % (d->columns - 1), y = cell / (d->columns - 1);
    size_t first = y * d->columns + x, last = first + d->columns + 1;
    corners[0] = first;
    corners[1] = triangle % 2 == 0 ? first + 1 : last;
    corners[2] = triangle % 2 == 0 ? last : last - 1;
}

/* +1: as it was, -1: turned over, 0: flat. At rest y points down, which corners_of() knows: they are all
 * positive then. */
static int sign_of(const drawing *d, const size_t corners[3])
{
    return orientation(d->posed + 2 * corners[0], d->posed + 2 * corners[1],
                       d->posed + 2 * corners[2]);
}

/* ------------------------------------------------------------------ colours */

/* Bilinear, each colour by its alpha. `at` is in the picture. */
static void mix(const picture *p, const double at[2], uint16_t *to)
{
    double x = fmin(fmax(at[0] - 0.5, 0), (double)p->width - 1),
           y = fmin(fmax(at[1] - 0.5, 0), (double)p->height - 1);
    size_t left = (size_t)x, top = (size_t)y;
    unsigned n_colours = p->channels >= 3 ? 3 : 1;
    double sums[4] = {0, 0, 0, 0}, alphas = 0, u = x - (double)left, v = y - (double)top;
    for (size_t k = 0; k < 4; k++) {
        size_t column = left + (k % 2 == 1 && left + 1 < p->width),
               row = top + (k / 2 == 1 && top + 1 < p->height);
        const uint16_t *sample = p->samples + p->channels * (row * p->width + column);
        double share = (k % 2 == 1 ? u : 1 - u) * (k / 2 == 1 ? v : 1 - v);
        double alpha = p->channels > n_colours ? share * sample[n_colours] : share;
        for (unsigned c = 0; c < n_colours; c++)
            sums[c] += alpha * sample[c];
        alphas += alpha;
    }
    for (unsigned c = 0; c < n_colours; c++)
        to[c] = alphas > 0 ? (uint16_t)(sums[c] / alphas + 0.5) : 0;
    if (p->channels > n_colours)
        to[n_colours] = (uint16_t)(alphas + 0.5);
}

/* Draws what waits and comes from inside the shape. */
static int flush(drawing *d)
{
    int result = kernel_job_locate(&d->pose->kernel, d->n_waiting, d->sources, d->inside);
    for (size_t i = 0; i < d->n_waiting && result == DONE; i++)
        if (d->inside[i])
            mix(&d->from, d->sources + 2 * i, d->to.samples + d->to.channels * d->pixels[i]);
    d->n_waiting = 0;
    return result;
}

/* ---------------------------------------------------------------- triangles */

/* Pixels from `low` to `high` whose centres may lie between a and b. */
static void span(double a, double b, size_t n, size_t *low, size_t *high)
{
    double first = fmin(fmax(ceil(a - 0.5), 0), (double)n),
           last = fmin(fmax(floor(b - 0.5) + 1, 0), (double)n);
    *low = (size_t)first;
    *high = last > first ? (size_t)last : *low;
}

/* 1e-9: what lies on an edge belongs to both sides, so that rounding opens no gaps. */
static const double slack = 1e-9;

static bool find_source(const drawing *d, const size_t corners[3], double x, double y, double out[2])
{
    const double *a = d->posed + 2 * corners[0], *b = d->posed + 2 * corners[1],
                 *c = d->posed + 2 * corners[2];
    double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    double v = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area;
    double w = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area;
    if (!(v >= -slack && w >= -slack && v + w <= 1 + slack))
        return false;
    for (size_t k = 0; k < 2; k++)
        out[k] = (1 - v - w) * d->rest[2 * corners[0] + k] + v * d->rest[2 * corners[1] + k] +
                 w * d->rest[2 * corners[2] + k];
    return true;
}

static int draw_triangle(drawing *d, const size_t corners[3])
{
    size_t low[2], high[2];
    const double *a = d->posed + 2 * corners[0], *b = d->posed + 2 * corners[1],
                 *c = d->posed + 2 * corners[2];
    for (size_t k = 0; k < 2; k++)
        span(fmin(a[k], fmin(b[k], c[k])), fmax(a[k], fmax(b[k], c[k])),
             k == 0 ? d->to.width : d->to.height, &low[k], &high[k]);
    int result = DONE;
    for (size_t y = low[1]; y < high[1]; y++)
        for (size_t x = low[0]; x < high[0] && result == DONE; x++) {
            double *source = d->sources + 2 * d->n_waiting;
            if (!find_source(d, corners, (double)x + 0.5, (double)y + 0.5, source))
                continue;
            d->pixels[d->n_waiting++] = y * d->to.width + x;
            if (d->n_waiting == WAITING)
                result = flush(d);
        }
    return result;
}

static int draw_triangles(drawing *d, int sign)
{
    size_t n = 2 * (d->columns - 1) * (d->rows - 1), corners[3];
    int result = DONE;
    for (size_t t = 0; t < n && result == DONE; t++) {
        corners_of(d, t, corners);
        if (sign_of(d, corners) == sign)
            result = draw_triangle(d, corners);
    }
    return result == DONE ? flush(d) : result;
}

/* Counts triangles by their middles. */
static int count_triangles(drawing *d)
{
    size_t n = 2 * (d->columns - 1) * (d->rows - 1), corners[3];
    double *middles = need(n, 2 * sizeof *middles);
    bool *inside = need(n, sizeof *inside);
    for (size_t t = 0; t < n; t++) {
        corners_of(d, t, corners);
        for (size_t k = 0; k < 6; k++)
            middles[2 * t + k % 2] += d->rest[2 * corners[k / 2] + k % 2] / 3;
    }
    int result = kernel_job_locate(&d->pose->kernel, n, middles, inside);
    for (size_t t = 0; t < n && result == DONE; t++) {
        corners_of(d, t, corners);
        d->n_triangles += inside[t];
        d->n_inverted += inside[t] && sign_of(d, corners) < 0;
    }
    free(middles);
    free(inside);
    return result;
}

/* ------------------------------------------------------------------ results */

static int report_picture(drawing *d, double seconds)
{
    pose *p = d->pose;
    double folded = d->n_triangles > 0 ? (double)d->n_inverted / (double)d->n_triangles : 0;
    char text[80];
    report r;
    snprintf(text, sizeof text, "%.2g %% of the shape is turned over", 100 * folded);
    if (!p->kernel.job.args->json) {
        if (d->n_inverted > 0)
            pose_say(p, text);
        return DONE;
    }
    if (pose_report_open(&r, p, d->columns * d->rows, d->rest, 0, seconds) != DONE)
        return FAILED;
    json_number(&r.json, "folded", folded);
    return report_close(&r) ? DONE : FAILED;
}

static int draw(drawing *d)
{
    size_t n_failed;
    double began = seconds_now();
    d->pixels = need(WAITING, sizeof *d->pixels);
    d->sources = need(WAITING, 2 * sizeof *d->sources);
    d->inside = need(WAITING, sizeof *d->inside);
    make_grid(d);
    int result = pose_points(d->pose, d->columns * d->rows, d->rest, d->posed, NULL, &n_failed);
    if (result == DONE)
        result = draw_triangles(d, -1);
    if (result == DONE)
        result = draw_triangles(d, 1);
    if (result == DONE)
        result = count_triangles(d);
    double seconds = seconds_now() - began;
    progress_end(&d->pose->kernel.job.bar);
    if (result == DONE)
        result = picture_save(&d->to, d->from.keep, pose_output(d->pose));
    return result == DONE ? report_picture(d, seconds) : result;
}

int pose_picture(pose *p, const char *bytes, size_t n)
{
    const args *a = p->kernel.job.args;
    drawing d = {.pose = p};
    if (p->kernel.set.dim != 2)
        return failed(a->operands[0], 0, "this is a picture, but the handles are in space");
    if (p->kernel.job.domains[0] == NULL && p->kernel.set.n_regions == 0)
        return failed(a->operands[0], 0, "a picture needs a shape with a region, not only curves");
    int result = picture_take(&d.from, a->operands[0], bytes, n);
    if (result == DONE) {
        d.to = picture_canvas(&d.from, a->has_background ? a->background : NULL);
        result = draw(&d);
    }
    picture_free(&d.from);
    picture_free(&d.to);
    free(d.rest);
    free(d.posed);
    free(d.pixels);
    free(d.sources);
    free(d.inside);
    return result;
}

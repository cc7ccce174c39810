/* Draws one weight as a raster with the shape on top. */
#include "kernel/weight_plot.h"

#include "base/allocate.h"
#include "plot/svg.h"

#include <math.h>
#include <stdlib.h>

enum { SIZE = 560, MARGIN = 24, LEGEND = 92, BATCH = 4096 };
static const double curve_width = 9;

/* The place of the shape's bounding box in a drawing. */
typedef struct sheet {
    kernel_job *job;
    FILE *svg;
    size_t handle;
    double lower[2], upper[2], scale, width, height;
    bool y_down, logarithmic;
} sheet;

static void include(sheet *s, size_t n, const double *points)
{
    for (size_t i = 0; i < 2 * n; i++) {
        s->lower[i % 2] = fmin(s->lower[i % 2], points[i]);
        s->upper[i % 2] = fmax(s->upper[i % 2], points[i]);
    }
}

static int lay_out(sheet *s)
{
    const handle_set *set = &s->job->set;
    for (size_t k = 0; k < 2; k++) {
        s->lower[k] = HUGE_VAL;
        s->upper[k] = -HUGE_VAL;
    }
    include(s, s->job->job.cages[0].n, s->job->job.cages[0].points);
    for (size_t r = 0; r < set->n_regions; r++)
        include(s, set->regions[r].n, set->regions[r].points);
    include(s, set->n_vertices, set->vertices);
    include(s, set->n_handles, set->handles);
    double width = s->upper[0] - s->lower[0], height = s->upper[1] - s->lower[1];
    s->scale = SIZE / fmax(width, height);
    if (!(isfinite(s->scale) && s->scale > 0))
        return failed(job_file(&s->job->job, 1), 0, "the shape is too large or too small to draw");
    s->width = ceil(fmax(s->scale * width, 2 * curve_width));
    s->height = ceil(fmax(s->scale * height, 2 * curve_width));
    return DONE;
}

static void place(const sheet *s, const double at[2], double out[2])
{
    out[0] = MARGIN + s->scale * (at[0] - s->lower[0]);
    out[1] = MARGIN + s->scale * (s->y_down ? at[1] - s->lower[1] : s->upper[1] - at[1]);
}

static void locate(const sheet *s, double x, double y, double out[2])
{
    out[0] = s->lower[0] + x / s->scale;
    out[1] = s->y_down ? s->lower[1] + y / s->scale : s->upper[1] - y / s->scale;
}

/* ------------------------------------------------------------------- shape */

static void write_ring(const sheet *s, size_t n, const double *points)
{
    double *ring = need(n, 2 * sizeof *ring);
    for (size_t i = 0; i < n; i++)
        place(s, points + 2 * i, ring + 2 * i);
    svg_polyline(s->svg, n, ring);
    fputc('Z', s->svg);
    free(ring);
}

static void write_regions(const sheet *s)
{
    const handle_set *set = &s->job->set;
    const cage *source = &s->job->job.cages[0];
    if (source->n > 0)
        write_ring(s, source->n, source->points);
    for (size_t r = 0; r < set->n_regions; r++)
        write_ring(s, set->regions[r].n, set->regions[r].points);
}

static void write_segment(const sheet *s, const double *from, const double *to)
{
    double ends[4];
    place(s, from, ends);
    place(s, to, ends + 2);
    svg_polyline(s->svg, 2, ends);
}

static void write_curves(const sheet *s)
{
    const handle_set *set = &s->job->set;
    for (size_t i = 0; i < set->n_segments; i++)
        write_segment(s, set->vertices + 2 * set->segments[2 * i],
                      set->vertices + 2 * set->segments[2 * i + 1]);
}

/* Draws the mask of the raster: regions, and curves with some width. */
static void draw_mask(const sheet *s)
{
    fputs("<mask id=\"shape\" maskUnits=\"userSpaceOnUse\" x=\"0\" y=\"0\" width=\"100%\" "
          "height=\"100%\"><path fill=\"white\" d=\"M0 0",
          s->svg);
    write_regions(s);
    fprintf(s->svg,
            "\"/><path fill=\"none\" stroke=\"white\" stroke-linecap=\"round\" "
            "stroke-width=\"%g\" d=\"M0 0",
            curve_width);
    write_curves(s);
    fputs("\"/></mask>\n", s->svg);
}

/* Draws regions, edges between handles, lines that stay straight, and handles over the picture of
 * the weight. The handle of the weight is red. */
static void draw_structure(const sheet *s)
{
    const handle_set *set = &s->job->set;
    fputs("<path fill=\"none\" stroke=\"#111\" stroke-width=\"1.2\" stroke-linejoin=\"round\" "
          "d=\"M0 0",
          s->svg);
    write_regions(s);
    fputs("\"/>\n<path fill=\"none\" stroke=\"white\" stroke-width=\"1.2\" "
          "stroke-dasharray=\"4 3\" d=\"M0 0",
          s->svg);
    for (size_t i = 0; i < set->n_edges; i++)
        write_segment(s, set->handles + 2 * set->edges[2 * i],
                      set->handles + 2 * set->edges[2 * i + 1]);
    fputs("\"/>\n<path fill=\"none\" stroke=\"white\" stroke-width=\"2\" d=\"M0 0", s->svg);
    for (size_t i = 0; i < set->n_lines; i++)
        write_segment(s, set->lines[i].from, set->lines[i].to);
    fputs("\"/>\n", s->svg);
    for (size_t i = 0; i < set->n_handles; i++) {
        double at[2];
        place(s, set->handles + 2 * i, at);
        fprintf(s->svg, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%g\" fill=\"%s\" stroke=\"#111\"/>\n",
                at[0], at[1], i == s->handle ? 5.0 : 3.2, i == s->handle ? "#e8482c" : "white");
    }
}

/* ------------------------------------------------------------------ raster */

/* The share of a pixel that an isoline of one pixel's width covers. The gradient gives the distance
 * to the line. */
static double isoline(const sheet *s, double weight, const double gradient[2])
{
    double steps = s->logarithmic ? DECADES : 10;
    double level = steps * weight_level(weight, s->logarithmic), line = floor(level + 0.5);
    double slope = steps * hypot(gradient[0], gradient[1]) / s->scale;
    if (s->logarithmic)
        slope /= DECADES * log(10) * fabs(weight);
    if (weight < 0 || line < 1 || line > steps - 1 || !(slope > 0))
        return 0;
    return fmin(fmax(1 - fabs(level - line) / slope, 0), 1);
}

static void paint(const sheet *s, uint16_t *to, double weight, const double gradient[2])
{
    double rgb[3], shade = 1 - 0.45 * isoline(s, weight, gradient);
    weight_colour(weight, s->logarithmic, rgb);
    for (size_t k = 0; k < 3; k++)
        to[k] = (uint16_t)(shade * rgb[k] + 0.5);
}

/* Evaluates the weight at pixel centres. Batches limit the memory for n_handles weights and
 * gradients each. */
static icc_status fill(const sheet *s, picture *image)
{
    size_t m = s->job->set.n_handles, n = image->width * image->height;
    double *points = need(BATCH, 2 * sizeof *points), *weights = need(BATCH, m * sizeof *weights),
           *gradients = need(BATCH, 2 * m * sizeof *gradients);
    icc_status status = ICC_OK;
    for (size_t begin = 0; begin < n && status == ICC_OK; begin += BATCH) {
        size_t count = n - begin < BATCH ? n - begin : BATCH;
        for (size_t i = 0; i < count; i++)
            locate(s, (double)((begin + i) % image->width) + 0.5,
                   (double)((begin + i) / image->width) + 0.5, points + 2 * i);
        status = icc_weights_evaluate(s->job->weights, count, points, weights, gradients, NULL,
                                      NULL, &s->job->job.env);
        for (size_t i = 0; i < count && status == ICC_OK; i++)
            paint(s, image->samples + 3 * (begin + i), weights[m * i + s->handle],
                  gradients + 2 * (m * i + s->handle));
    }
    free(points);
    free(weights);
    free(gradients);
    return status;
}

static int draw_raster(const sheet *s)
{
    picture image = picture_make((size_t)s->width, (size_t)s->height, 3, 8);
    icc_status status = fill(s, &image);
    progress_end(&s->job->job.bar);
    fprintf(s->svg, "<clipPath id=\"box\"><rect width=\"100%%\" height=\"100%%\"/></clipPath>\n"
                    "<g mask=\"url(#shape)\">\n");
    int result = status == ICC_OK
                     ? svg_picture(s->svg, MARGIN, MARGIN, s->width, s->height, "box", &image)
                     : job_failed_status(&s->job->job, status);
    fputs("</g>\n", s->svg);
    picture_free(&image);
    return result;
}

/* ------------------------------------------------------------------ legend */

/* Draws a bar with the picture's colours beside it, linear or by powers of ten. */
static int draw_legend(const sheet *s)
{
    double x = s->width + 2 * MARGIN, size = fmin(s->height, 300);
    picture bar = picture_make(1, 256, 3, 8);
    for (size_t i = 0; i < 256; i++) {
        double rgb[3], level = 1 - ((double)i + 0.5) / 256;
        weight_colour(s->logarithmic ? pow(10, DECADES * (level - 1)) : level, s->logarithmic, rgb);
        for (size_t k = 0; k < 3; k++)
            bar.samples[3 * i + k] = (uint16_t)(rgb[k] + 0.5);
    }
    int result = svg_picture(s->svg, x, MARGIN, 16, size, "box", &bar);
    picture_free(&bar);
    for (int i = 0; i <= 5; i++) {
        char text[16];
        if (s->logarithmic)
            snprintf(text, sizeof text, i == 5 ? "1" : "1e-%d", DECADES - i * DECADES / 5);
        else
            snprintf(text, sizeof text, "%.1f", i / 5.0);
        fprintf(s->svg,
                "<text x=\"%g\" y=\"%g\" font-family=\"Helvetica, Arial, sans-serif\" "
                "font-size=\"12\" fill=\"#444\">%s</text>\n",
                x + 22, MARGIN + size * (1 - i / 5.0) + 4, text);
    }
    return result;
}

int plot_weight(kernel_job *k)
{
    const args *a = k->job.args;
    sheet s = {
        .job = k, .handle = (size_t)a->handle, .y_down = a->y_down, .logarithmic = a->logarithmic};
    if (k->set.dim != 2)
        return failed(a->handles, 0,
                      "3 dimensions; --picture needs a shape in the plane, or --along");
    if (s.handle >= k->set.n_handles)
        return failed(a->handles, 0, "there is no handle %zu for --handle; the last is %zu",
                      s.handle, k->set.n_handles - 1);
    int result = lay_out(&s);
    outfile file;
    if (result != DONE || !outfile_open(&file, a->picture))
        return FAILED;
    s.svg = file.stream;
    svg_begin(s.svg, s.width + 2 * MARGIN + LEGEND, s.height + 2 * MARGIN);
    draw_mask(&s);
    result = draw_raster(&s);
    if (result == DONE)
        result = draw_legend(&s);
    draw_structure(&s);
    svg_end(s.svg);
    if (result == DONE)
        return outfile_close(&file) ? DONE : FAILED;
    outfile_abandon(&file);
    return result;
}

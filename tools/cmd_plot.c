/* libicc plot: the papers' figures. One column for the source, one for the target; rows for the
 * function with its curves, its elevation, the checkerboard and the u v map. */
#define _POSIX_C_SOURCE 200809L

#include "commands.h"

#include "plot.h"

#include <math.h>
#include <stdlib.h>

enum { ROW_SHAPE, ROW_SURFACE, ROW_CHECKERBOARD, ROW_UV, N_ROWS };

static const double panel_size = 640, margin = 36, caption = 30;

typedef struct plot {
    job job;
    stages stages[2];
    size_t n_sides;
    places places[2]; /* for the patterns */
    bool rows[N_ROWS];
    double widths[2], height; /* of the columns, and of the rows but that of the surface */
    FILE *svg;
    char *text; /* what was written to `svg` */
    size_t n_text;
} plot;

/* The shapes are drawn with the same longest side. */
static int lay_out(plot *x)
{
    x->height = 0;
    for (size_t side = 0; side < x->n_sides; side++) {
        const icc_domain_info *box = &x->stages[side].box;
        double width = box->upper[0] - box->lower[0], height = box->upper[1] - box->lower[1];
        double scale = panel_size / fmax(width, height);
        if (!(isfinite(scale) && scale > 0 && isfinite(width) && isfinite(height)))
            return failed(job_file(&x->job, (int)side + 1), 0,
                          "the shape is too large or too small to draw");
        x->widths[side] = fmax(scale * width, (x->rows[ROW_SURFACE] ? 0.8 : 0.4) * panel_size);
        x->height = fmax(x->height, fmax(scale * height, 0.2 * panel_size));
    }
    return DONE;
}

static double row_height(const plot *x, int what)
{
    return what == ROW_SURFACE ? 0.7 * panel_size : x->height;
}

static double row_top(const plot *x, int what)
{
    double top = margin;
    for (int above = 0; above < what; above++)
        top += x->rows[above] ? row_height(x, above) + caption + margin : 0;
    return top;
}

/* The panel in a row and column; a shape is centred in its box, a surface fills it. */
static panel make_panel(const plot *x, int what, size_t side)
{
    const icc_domain_info *box = &x->stages[side].box;
    double width = box->upper[0] - box->lower[0], height = box->upper[1] - box->lower[1];
    panel p = {.svg = x->svg,
               .stages = &x->stages[side],
               .side = (int)side + 1,
               .y_down = x->job.args->y_down};
    snprintf(p.clip, sizeof p.clip, "shape-%d-%zu", what, side);
    p.scale = panel_size / fmax(width, height);
    p.width = what == ROW_SURFACE ? x->widths[side] : p.scale * width;
    p.height = what == ROW_SURFACE ? row_height(x, what) : p.scale * height;
    p.left = margin + (side == 1 ? x->widths[0] + margin : 0) + (x->widths[side] - p.width) / 2;
    p.top = row_top(x, what) + (row_height(x, what) - p.height) / 2;
    return p;
}

static int draw_pattern(plot *x, const panel *p, pattern what)
{
    places *from = &x->places[p->side == 2];
    int result = from->points == NULL ? places_make(from, p, &x->job) : DONE;
    return result == DONE ? plot_pattern(p, &x->job, from, what) : result;
}

static int draw_panel(plot *x, int what, size_t side)
{
    static const char *const captions[N_ROWS] = {"function and integral curves", "elevation",
                                                 "checkerboard", "uv map"};
    panel p = make_panel(x, what, side);
    char label[64];
    bool bare = what == ROW_SHAPE && x->stages[side].field == NULL;
    snprintf(label, sizeof label, "%s%s",
             x->n_sides == 1 ? ""
             : side == 0     ? "source: "
                             : "target: ",
             bare ? (x->job.args->triangles ? "triangles" : "integral curves") : captions[what]);
    svg_label(x->svg, p.left + p.width / 2, row_top(x, what) + row_height(x, what) + caption,
              label);
    plot_clip(&p, &x->job.cages[side]);
    switch (what) {
    case ROW_SHAPE:
        return plot_shape(&p, &x->job);
    case ROW_SURFACE:
        return plot_surface(&p, &x->job);
    case ROW_CHECKERBOARD:
        return draw_pattern(x, &p, PATTERN_CHECKERBOARD);
    default:
        return draw_pattern(x, &p, PATTERN_UV);
    }
}

static int draw(plot *x)
{
    int result = lay_out(x);
    if (result != DONE)
        return result;
    svg_begin(x->svg, margin + x->widths[0] + margin + (x->n_sides > 1 ? x->widths[1] + margin : 0),
              row_top(x, N_ROWS));
    for (int what = 0; what < N_ROWS; what++)
        for (size_t side = 0; side < x->n_sides && x->rows[what] && result == DONE; side++)
            result = draw_panel(x, what, side);
    svg_end(x->svg);
    return result;
}

static int write_drawing(plot *x)
{
    outfile file;
    if (!outfile_open(&file, x->job.args->operands[0]))
        return FAILED;
    fwrite(x->text, 1, x->n_text, file.stream);
    return outfile_close(&file) ? DONE : FAILED;
}

static int make_stages(plot *x)
{
    bool pair = x->job.args->target != NULL;
    int result = pair ? job_make_map(&x->job) : job_make_chart(&x->job);
    x->rows[ROW_SHAPE] = true;
    x->rows[ROW_SURFACE] = x->job.args->elevation;
    x->rows[ROW_CHECKERBOARD] = x->rows[ROW_UV] = pair;
    x->n_sides = pair ? 2 : 1;
    for (size_t side = 0; side < x->n_sides && result == DONE; side++)
        result = stages_make(&x->stages[side], &x->job, (int)side + 1);
    return result;
}

static int make_drawing(plot *x)
{
    x->svg = open_memstream(&x->text, &x->n_text);
    if (x->svg == NULL)
        return failed(NULL, 0, "not enough memory for the drawing");
    int result = draw(x);
    bool good = !ferror(x->svg);
    good = fclose(x->svg) == 0 && good;
    progress_end(&x->job.bar);
    return result == DONE && !good ? failed(NULL, 0, "not enough memory for the drawing") : result;
}

int run_plot(const args *a)
{
    plot x = {0};
    double began = seconds_now();
    job_start(&x.job, a);
    int result = make_stages(&x);
    if (result == DONE)
        result = make_drawing(&x);
    if (result == DONE)
        result = write_drawing(&x);
    if (result == DONE)
        result = report_points(&x.job, 0, 0, seconds_now() - began);
    for (size_t side = 0; side < 2; side++) {
        stages_free(&x.stages[side]);
        places_free(&x.places[side]);
    }
    free(x.text);
    job_end(&x.job);
    return result;
}

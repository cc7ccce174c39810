/* libicc plot: the papers' figures. The rows are those of figure 6 of the paper: the u v map, the
 * checkerboard, the function with its curves; then its elevation. There is one column for the
 * source and one for the target. With several functions there is one for each, after one for the
 * source if there is a target. */
#include "cmd/commands.h"

#include "base/system.h"
#include "job/output_name.h"
#include "plot/plot.h"
#include "plot/plot_page.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROW_UV, ROW_CHECKERBOARD, ROW_SHAPE, ROW_SURFACE, N_ROWS };
enum { MAX_COLUMNS = MAX_FUNCTIONS + 1 };

static const double margin = 36, caption = 30, line = 20;

typedef struct column {
    stages stages;
    int side;     /* 1 source, 2 target */
    bool undrawn; /* the function is not drawn: the column is for the patterns only */
    double left, width;
} column;

typedef struct plot {
    job *job;
    const char *name; /* of the file */
    size_t n_functions;
    icc_map *maps[MAX_FUNCTIONS];
    icc_chart *charts[MAX_FUNCTIONS];
    column columns[MAX_COLUMNS];
    size_t n_columns;
    bool rows[N_ROWS];
    double size;   /* of the longest side of a shape */
    double height; /* of all rows except that of the surface */
    collector drawing;
    FILE *svg; /* its stream */
} plot;

/* ------------------------------------------------------------------ layout */

/* Lays out the shapes, which have the same longest side in the drawing. */
static int lay_out(plot *x)
{
    double left = margin;
    x->size = x->n_columns > 2 ? 400 : 640;
    x->height = 0;
    for (size_t i = 0; i < x->n_columns; i++) {
        column *c = &x->columns[i];
        const icc_domain_info *box = &c->stages.box;
        double width = box->upper[0] - box->lower[0], height = box->upper[1] - box->lower[1];
        double scale = x->size / fmax(width, height);
        if (!(isfinite(scale) && scale > 0 && isfinite(width) && isfinite(height)))
            return failed(job_file(x->job, c->side), 0,
                          "the shape is too large or too small to draw");
        c->left = left;
        c->width =
            fmax(fmax(scale * width, 0.4 * x->size), x->rows[ROW_SURFACE] ? 0.8 * x->size : 280);
        left += c->width + margin;
        x->height = fmax(x->height, fmax(scale * height, 0.2 * x->size));
    }
    return DONE;
}

static double row_height(const plot *x, int what)
{
    return what == ROW_SURFACE ? 0.7 * x->size : x->height;
}

/* The height of a row with the captions below it. A function has up to three lines of them. */
static double row_extent(const plot *x, int what)
{
    bool function = what == ROW_SHAPE && x->columns[x->n_columns - 1].stages.field != NULL;
    return row_height(x, what) + caption + margin + (function ? line : 0);
}

static double row_top(const plot *x, int what)
{
    double top = x->n_functions > 1 ? margin + caption : margin;
    for (int above = 0; above < what; above++)
        top += x->rows[above] ? row_extent(x, above) : 0;
    return top;
}

/* The panel in a row and column. A shape is centred in its box, and a surface fills it. */
static panel make_panel(const plot *x, int what, size_t i)
{
    const column *c = &x->columns[i];
    const icc_domain_info *box = &c->stages.box;
    double width = box->upper[0] - box->lower[0], height = box->upper[1] - box->lower[1];
    panel p = {.svg = x->svg, .stages = &c->stages, .side = c->side};
    const args *a = x->job->args;
    p.y_down = a->y_down && (a->y_down_side == 0 || a->y_down_side == SIDE_BOTH);
    snprintf(p.clip, sizeof p.clip, "shape-%d-%zu", what, i);
    p.scale = x->size / fmax(width, height);
    p.width = what == ROW_SURFACE ? c->width : p.scale * width;
    p.height = what == ROW_SURFACE ? row_height(x, what) : p.scale * height;
    p.left = c->left + (c->width - p.width) / 2;
    p.top = row_top(x, what) + (row_height(x, what) - p.height) / 2;
    return p;
}

/* ---------------------------------------------------------------- captions */

/* Writes captions below the panels: what they show, and how to read the shades of the function. */
static void write_captions(const plot *x, int what, const column *c, bool triangles)
{
    static const char *const captions[N_ROWS] = {"uv map", "checkerboard",
                                                 "function and integral curves", "elevation"};
    const stages *s = &c->stages;
    double middle = c->left + c->width / 2,
           below = row_top(x, what) + row_height(x, what) + caption;
    char text[96], scale[48] = "";
    bool bare = what == ROW_SHAPE && s->field == NULL;
    snprintf(text, sizeof text, "%s%s",
             x->n_columns != 2 || x->n_functions > 1 ? ""
             : c->side == 1                          ? "source: "
                                                     : "target: ",
             bare ? (triangles ? "triangles of the map" : "integral curves") : captions[what]);
    svg_label(x->svg, middle, below, text);
    if (s->field == NULL || what < ROW_SHAPE)
        return;
    if (s->logarithmic)
        snprintf(scale, sizeof scale, "logarithm, over %.0f decades", (s->high - s->low) / log(10));
    if (what == ROW_SHAPE)
        snprintf(text, sizeof text, "%zu expansion edges, %zu inside", s->n_expansion,
                 s->n_inner_expansion);
    if (what == ROW_SHAPE)
        svg_label(x->svg, middle, below += line, text);
    if (s->logarithmic)
        svg_label(x->svg, middle, below + line, scale);
}

/* Writes the names of several functions above their columns. */
static void write_heading(const plot *x, const column *c)
{
    char text[48];
    svg_label(x->svg, c->left + c->width / 2, margin + caption / 2,
              c->undrawn ? "source" : function_label(text, &c->stages.field_info));
}

/* ----------------------------------------------------------------- drawing */

static int draw_panel(plot *x, int what, size_t i, places *from)
{
    const column *c = &x->columns[i];
    job *j = x->job;
    panel p = make_panel(x, what, i);
    int result = DONE;
    write_captions(x, what, c, shows_triangles(&c->stages, j));
    plot_clip(&p, &j->cages[c->side == 2]);
    if (what == ROW_SHAPE)
        return plot_shape(&p, j);
    if (what == ROW_SURFACE)
        return plot_surface(&p, j);
    if (from->points == NULL)
        result = places_make(from, &p, j);
    return result != DONE
               ? result
               : plot_pattern(&p, j, from, what == ROW_UV ? PATTERN_UV : PATTERN_CHECKERBOARD);
}

static int draw_column(plot *x, size_t i)
{
    const column *c = &x->columns[i];
    places from = {0}; /* shared by the patterns */
    int result = DONE;
    if (x->n_functions > 1)
        write_heading(x, c);
    for (int what = 0; what < N_ROWS && result == DONE; what++)
        if (x->rows[what] && !(c->undrawn && what >= ROW_SHAPE))
            result = draw_panel(x, what, i, &from);
    places_free(&from);
    return result;
}

static int draw(plot *x)
{
    int result = lay_out(x);
    if (result != DONE)
        return result;
    const column *last = &x->columns[x->n_columns - 1];
    svg_begin(x->svg, last->left + last->width + margin, row_top(x, N_ROWS));
    for (size_t i = 0; i < x->n_columns && result == DONE; i++)
        result = draw_column(x, i);
    svg_end(x->svg);
    return result;
}

static int make_drawing(plot *x)
{
    if (!collector_begin(&x->drawing))
        return failed(NULL, 0, "not enough memory for the drawing");
    x->svg = x->drawing.stream;
    int result = draw(x);
    bool good = collector_end(&x->drawing);
    progress_end(&x->job->bar);
    return result == DONE && !good ? failed(NULL, 0, "not enough memory for the drawing") : result;
}

static int write_drawing(plot *x)
{
    outfile file;
    if (!outfile_open(&file, x->name))
        return FAILED;
    fwrite(x->drawing.bytes, 1, x->drawing.n, file.stream);
    return outfile_close(&file) ? DONE : FAILED;
}

/* ------------------------------------------------------------------ making */

static int add_column(plot *x, int side, bool undrawn)
{
    column *c = &x->columns[x->n_columns++];
    *c = (column){.side = side, .undrawn = undrawn};
    return stages_make(&c->stages, x->job, side);
}

/* Makes the chart or the map of one function, and its columns. */
static int make_function(plot *x, size_t i)
{
    job *j = x->job;
    bool pair = j->args->target != NULL, several = x->n_functions > 1;
    j->function = i;
    int result = pair ? job_make_map(j) : job_make_chart(j);
    if (result == DONE && (i == 0 || !pair))
        result = add_column(x, 1, pair && several);
    if (result == DONE && pair)
        result = add_column(x, 2, false);
    if (j->fit == NULL) {
        x->maps[i] = j->map;
        j->map = NULL;
    }
    x->charts[i] = j->chart;
    j->chart = NULL;
    return result;
}

static int make_columns(plot *x)
{
    const args *a = x->job->args;
    int result = DONE;
    x->n_functions = a->n_functions > 1 ? a->n_functions : 1;
    x->rows[ROW_CHECKERBOARD] = a->target != NULL;
    x->rows[ROW_UV] = a->target != NULL && a->drawing == NULL;
    x->rows[ROW_SHAPE] = true;
    x->rows[ROW_SURFACE] = a->elevation;
    for (size_t i = 0; i < x->n_functions && result == DONE; i++)
        result = make_function(x, i);
    return result;
}

/* Draws figures of the plane. */
static int plot_plane(plot *x)
{
    const args *a = x->job->args;
    const char *format = output_format(x->name);
    if (a->n_slice > 0 || a->n_view > 0)
        return misused(a->command, "--%s is for shapes in space",
                       a->n_slice > 0 ? "slice" : "view");
    if (format != NULL && strcmp(format, "PNG") == 0)
        return misused(a->command, "in the plane OUT is an SVG or a VTK file; "
                                   "'rsvg-convert OUT.svg -o OUT.png' makes a PNG of OUT.svg");
    int result = job_read_plane(x->job, "an SVG (unlike OUT.vtk)");
    if (result == DONE && a->triangles && a->target == NULL)
        result = misused(a->command, "--triangles needs a mesh map: --target FILE --map mesh");
    if (result == DONE)
        result = make_columns(x);
    if (result == DONE && a->lines > 0 && shows_triangles(&x->columns[0].stages, x->job))
        result = misused(
            a->command,
            "--lines draws integral curves, which a mesh map does not have; add --map curves");
    if (result == DONE)
        result = make_drawing(x);
    return result == DONE ? write_drawing(x) : result;
}

int plot_apply(job *j, const char *name)
{
    plot x = {.job = j, .name = name};
    int result = plot_plane(&x);
    for (size_t i = 0; i < x.n_columns; i++)
        stages_free(&x.columns[i].stages);
    for (size_t i = 0; i < x.n_functions; i++) {
        icc_map_free(x.maps[i]);
        icc_chart_free(x.charts[i]);
    }
    free(x.drawing.bytes);
    return result;
}

int run_plot(const args *a)
{
    const char *dot = strrchr(a->operands[0], '.');
    bool vtk = dot != NULL && strcmp(dot, ".vtk") == 0;
    if (vtk && a->y_down)
        return misused(a->command, "--y-down is for drawings in the plane");
    if (vtk)
        return plot_vtk(a);
    double began = seconds_now();
    job j;
    job_start(&j, a);
    int result = job_read_cages(&j);
    const char *format = output_format(a->operands[0]);
    bool page = format != NULL && strcmp(format, "HTML") == 0;
    if (result == DONE && page)
        result = plot_page(&j);
    else if (result == DONE)
        result = job_dim(&j) == 3 ? plot_solid(&j) : plot_apply(&j, a->operands[0]);
    if (result == DONE)
        result = report_points(&j, 0, 0, seconds_now() - began);
    job_end(&j);
    return result;
}

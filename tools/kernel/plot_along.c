/* Draws curves of weights along a segment. */
#include "kernel/weight_plot.h"

#include "base/allocate.h"
#include "plot/svg.h"

#include <math.h>
#include <stdlib.h>

enum { WIDTH = 640, HEIGHT = 360, LEFT = 56, TOP = 20, BOTTOM = 34, COLUMN = 26, ROWS = 21 };

/* The contents of the axes: levels from `low` to `high`. */
typedef struct chart {
    FILE *svg;
    size_t n, m;
    const double *weights; /* n * m */
    bool logarithmic;
    double low, high;
} chart;

static double x_of(const chart *c, size_t i)
{
    return LEFT + WIDTH * (double)i / (double)(c->n - 1);
}

static double y_of(const chart *c, double level)
{
    double share = (level - c->low) / (c->high - c->low);
    return TOP + HEIGHT * (1 - fmin(fmax(share, 0), 1));
}

/* Chooses tenths as far as the weights go, at least from 0 to 1. */
static void find_range(chart *c)
{
    c->low = 0;
    c->high = 1;
    for (size_t i = 0; !c->logarithmic && i < c->n * c->m; i++) {
        c->low = fmin(c->low, floor(10 * c->weights[i] + 1e-6) / 10);
        c->high = fmax(c->high, ceil(10 * c->weights[i] - 1e-6) / 10);
    }
}

static void draw_tick(const chart *c, double level, const char *text)
{
    double y = y_of(c, level);
    fprintf(c->svg,
            "<path stroke=\"#ddd\" d=\"M%d %.2fH%d\"/><text x=\"%d\" y=\"%.2f\" "
            "text-anchor=\"end\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\" "
            "fill=\"#444\">%s</text>\n",
            LEFT, y, LEFT + WIDTH, LEFT - 8, y + 4, text);
}

static void draw_axes(const chart *c)
{
    char text[32];
    int n_ticks = c->logarithmic ? DECADES / 2 : (int)((c->high - c->low) * 10 + 0.5);
    int step = n_ticks > 24 ? 10 : n_ticks > 14 ? 5 : 2;
    for (int i = 0; i <= n_ticks; i++)
        if (c->logarithmic) {
            snprintf(text, sizeof text, i == n_ticks ? "1" : "1e-%d", DECADES - 2 * i);
            draw_tick(c, (double)i / n_ticks, text);
        } else if ((i + (int)floor(c->low * 10 + 0.5)) % step == 0) {
            snprintf(text, sizeof text, "%.1f", c->low + i / 10.0);
            draw_tick(c, c->low + i / 10.0, text);
        }
    for (int i = 0; i <= 4; i++) {
        snprintf(text, sizeof text, "%g", i / 4.0);
        svg_label(c->svg, LEFT + WIDTH * i / 4.0, TOP + HEIGHT + 20, text);
    }
    fprintf(c->svg, "<path fill=\"none\" stroke=\"#444\" d=\"M%d %dV%dH%d\"/>\n", LEFT, TOP,
            TOP + HEIGHT, LEFT + WIDTH);
}

/* Draws runs of one sign, so that negative weights can be dotted on a logarithmic scale. */
static void draw_curve(const chart *c, size_t handle)
{
    char colour[8];
    double *line = need(c->n, 2 * sizeof *line);
    for (size_t begin = 0, end; begin + 1 < c->n; begin = end) {
        bool negative = c->logarithmic && c->weights[c->m * begin + handle] < 0;
        for (end = begin; end < c->n; end++) {
            double weight = c->weights[c->m * end + handle];
            line[2 * (end - begin)] = x_of(c, end);
            line[2 * (end - begin) + 1] = y_of(c, weight_level(weight, c->logarithmic));
            if (end > begin && c->logarithmic && (weight < 0) != negative)
                break;
        }
        fprintf(c->svg, "<path fill=\"none\" stroke=\"%s\" stroke-width=\"1.8\"%s d=\"",
                curve_colour(colour, handle, c->m), negative ? " stroke-dasharray=\"2 3\"" : "");
        svg_polyline(c->svg, (end < c->n ? end + 1 : end) - begin, line);
        fputs("\"/>\n", c->svg);
    }
    free(line);
}

/* Draws the numbers of handles in the colours of their curves, in columns. */
static void draw_names(const chart *c)
{
    char colour[8];
    for (size_t j = 0; j < c->m; j++)
        fprintf(c->svg,
                "<text x=\"%zu\" y=\"%zu\" font-family=\"Helvetica, Arial, sans-serif\" "
                "font-size=\"13\" font-weight=\"bold\" fill=\"%s\">%zu</text>\n",
                LEFT + WIDTH + 14 + COLUMN * (j / ROWS), TOP + 12 + 17 * (j % ROWS),
                curve_colour(colour, j, c->m), j);
}

int plot_along(const kernel_job *k, size_t n, const double *weights)
{
    const args *a = k->job.args;
    chart c = {.n = n, .m = k->set.n_handles, .weights = weights, .logarithmic = a->logarithmic};
    outfile file;
    if (!outfile_open(&file, a->picture))
        return FAILED;
    c.svg = file.stream;
    find_range(&c);
    double names = 20.0 + COLUMN * (double)((c.m + ROWS - 1) / ROWS);
    svg_begin(c.svg, LEFT + WIDTH + names, TOP + HEIGHT + BOTTOM);
    draw_axes(&c);
    for (size_t j = 0; j < c.m; j++)
        draw_curve(&c, j);
    draw_names(&c);
    svg_end(c.svg);
    return outfile_close(&file) ? DONE : FAILED;
}

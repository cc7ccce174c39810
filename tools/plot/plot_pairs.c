/* Draws numbers on two matched shapes: corresponding places of the outlines, and paired holes,
 * lines and points. */
#include "plot/plot.h"

#include <math.h>

enum { N_PAIRS = 24 };

static const double radius = 8;

static double step(const cage *c, size_t i)
{
    const double *a = c->points + 2 * i, *b = c->points + 2 * ((i + 1) % c->n);
    return hypot(b[0] - a[0], b[1] - a[1]);
}

/* Colours run around the outline once, and continue. */
static void draw_number(const panel *p, const double *point, size_t number)
{
    double at[2];
    panel_place(p, point, at);
    fprintf(p->svg,
            "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%g\" fill=\"hsl(%zu,75%%,38%%)\" "
            "stroke=\"white\"/><text x=\"%.2f\" y=\"%.2f\" font-family=\"sans-serif\" "
            "font-size=\"9\" text-anchor=\"middle\" fill=\"white\">%zu</text>\n",
            at[0], at[1], radius, number % N_PAIRS * 360 / N_PAIRS, at[0], at[1] + 3.2, number + 1);
}

/* Numbers the first vertex after each of several even places along the source, then the first
 * vertex of each feature. */
void plot_pairs(const panel *p, const job *j)
{
    const cage *source = &j->cages[0], *shown = &j->cages[p->side == 2];
    double total = 0, walked = 0;
    for (size_t i = 0; i < source->n; i++)
        total += step(source, i);
    size_t number = 0;
    for (size_t i = 0; i < source->n && number < N_PAIRS; i++) {
        if (walked >= (double)number * total / N_PAIRS)
            draw_number(p, shown->points + 2 * i, number++);
        walked += step(source, i);
    }
    for (size_t i = 0; i < shown->n_features; i++)
        draw_number(p, shown->features[i].points, number++);
}

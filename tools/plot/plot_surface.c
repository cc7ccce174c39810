/* Draws the function as a surface, as in figure 4.5 of the thesis, seen at a slant from above.
 *
 * Painter's algorithm: everything is cut into pieces that lie in one cell of the grid. Cells are
 * drawn from the farthest to the nearest, each followed by its pieces of curves and outline. So
 * near slopes cover those behind them. Cells on the boundary are drawn as fine tiles, and only the
 * tiles inside the shape. */
#include "plot/plot.h"

#include "base/allocate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MAX_CELLS = 120,   /* along a side; finer grids are thinned out */
    BOUNDARY_TILES = 8 /* along a side of a cell on the boundary */
};

typedef struct view {
    const panel *panel;
    double turn[2]; /* cosine and sine of the turn around the vertical */
    double tilt[2]; /* cosine and sine of the height of the eye */
    double centre[2], size, relief;
    double fit, at[2];            /* from the plane of view to the drawing */
    size_t stride, columns, rows; /* of the drawn cells, in cells of the grid */
} view;

/* A piece of a line, and the cell to which it belongs. */
typedef struct stroke {
    size_t cell;
    bool outline;
    double middle[2]; /* in the shape */
    double ends[4];   /* in the drawing */
} stroke;

typedef struct ink {
    stroke *strokes;
    size_t n, room;
} ink;

static double height_share(const view *v, double value)
{
    const stages *s = v->panel->stages;
    return s->high > s->low ? (value - s->low) / (s->high - s->low) : 1;
}

/* Projects a point to the plane of view: right and down. Returns its distance. */
static double project(const view *v, const double p[2], double value, double out[2])
{
    double x = (p[0] - v->centre[0]) / v->size, y = (p[1] - v->centre[1]) / v->size;
    y = v->panel->y_down ? -y : y;
    double away = v->turn[1] * x + v->turn[0] * y;
    out[0] = v->turn[0] * x - v->turn[1] * y;
    out[1] = -(away * v->tilt[1] + v->relief * height_share(v, value) * v->tilt[0]);
    return away;
}

static void place(const view *v, const double p[2], double value, double out[2])
{
    project(v, p, value, out);
    for (size_t k = 0; k < 2; k++)
        out[k] = v->at[k] + v->fit * out[k];
}

/* The cell that contains a point, and the place in it: (0,0) is its lowest corner, (1,1) the
 * highest. */
static size_t cell_of(const view *v, const double p[2])
{
    const icc_grid_info *g = &v->panel->stages->lattice;
    double size = g->spacing * (double)v->stride;
    double x = fmin(fmax(floor((p[0] - g->origin[0]) / size), 0), (double)(v->columns - 1));
    double y = fmin(fmax(floor((p[1] - g->origin[1]) / size), 0), (double)(v->rows - 1));
    return (size_t)y * v->columns + (size_t)x;
}

static void cell_point(const view *v, size_t cell, double u, double w, double out[2])
{
    const icc_grid_info *g = &v->panel->stages->lattice;
    double size = g->spacing * (double)v->stride;
    out[0] = g->origin[0] + size * ((double)(cell % v->columns) + u);
    out[1] = g->origin[1] + size * ((double)(cell / v->columns) + w);
}

/* ------------------------------------------------------------------- tiles */

/* Steel blue at the bottom, through pale green, to warm white at the top. Darker where the slope
 * faces away from the light. */
static void tile_colour(double height, double light, int rgb[3])
{
    static const double ramp[5][3] = {
        {102, 136, 172}, {128, 166, 192}, {166, 202, 206}, {212, 231, 216}, {255, 250, 234}};
    double x = fmin(fmax(height, 0), 1) * 4;
    int i = x >= 4 ? 3 : (int)x;
    for (int k = 0; k < 3; k++)
        rgb[k] =
            (int)(fmin(255, light * (ramp[i][k] + (ramp[i + 1][k] - ramp[i][k]) * (x - i))) + 0.5);
}

/* Light comes from the left and the front, so a slope that rises to the right and to the back is
 * bright. */
static double tile_light(const view *v, const double values[4], double side)
{
    double step = side / v->size / v->relief, h[4];
    for (int k = 0; k < 4; k++)
        h[k] = height_share(v, values[k]);
    double across = (h[1] + h[2] - h[0] - h[3]) / 2 / step,
           along = (h[2] + h[3] - h[0] - h[1]) / 2 / step;
    along = v->panel->y_down ? -along : along;
    double light =
        (1 + 0.35 * across + 0.2 * along) / sqrt(1 + 0.2 * (across * across + along * along));
    return fmin(fmax(light, 0.68), 1.1);
}

/* Draws the part of a cell between (u, w) and (u + side, w + side), unless a corner has no
 * value. */
static void draw_tile(const view *v, size_t cell, double u, double w, double side)
{
    static const double round[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    double values[4], outline[8], mean = 0;
    for (size_t c = 0; c < 4; c++) {
        double p[2];
        /* Slightly inside, because at the border of the cell the next one may have no value. */
        cell_point(v, cell, u + side * (round[c][0] * (1 - 1e-9)),
                   w + side * (round[c][1] * (1 - 1e-9)), p);
        values[c] = stages_value(v->panel->stages, p);
        if (!isfinite(values[c]))
            return;
        place(v, p, values[c], outline + 2 * c);
        mean += values[c] / 4;
    }
    int rgb[3];
    double length = side * v->panel->stages->lattice.spacing * (double)v->stride;
    tile_colour(height_share(v, mean), tile_light(v, values, length), rgb);
    fprintf(v->panel->svg, "<path fill=\"#%02x%02x%02x\" stroke=\"#%02x%02x%02x\" d=\"", rgb[0],
            rgb[1], rgb[2], rgb[0], rgb[1], rgb[2]);
    svg_polyline(v->panel->svg, 4, outline);
    fputs("Z\"/>\n", v->panel->svg);
}

/* Tests if the middles of a cell's tiles are inside, n along a side. */
static void tiles_inside(const view *v, job *j, size_t cell, size_t n, int32_t *where)
{
    double middles[2 * BOUNDARY_TILES * BOUNDARY_TILES];
    for (size_t i = 0; i < n * n; i++)
        cell_point(v, cell, ((double)(i % n) + 0.5) / (double)n,
                   ((double)(i / n) + 0.5) / (double)n, middles + 2 * i);
    if (icc_domain_locate(v->panel->stages->domain, n * n, middles, where, NULL, NULL, &j->env) !=
        ICC_OK)
        for (size_t i = 0; i < n * n; i++)
            where[i] = ICC_OUTSIDE;
}

/* Draws the farthest tiles of a cell first, in the order of the cells. */
static void draw_cell(const view *v, job *j, size_t cell, bool crossed)
{
    size_t n = crossed ? BOUNDARY_TILES : 1;
    int32_t where[BOUNDARY_TILES * BOUNDARY_TILES];
    tiles_inside(v, j, cell, n, where);
    for (size_t i = 0; i < n; i++)
        for (size_t k = n; k-- > 0;) {
            size_t row = v->panel->y_down ? i : n - 1 - i;
            if (where[row * n + k] != ICC_OUTSIDE)
                draw_tile(v, cell, (double)k / (double)n, (double)row / (double)n, 1 / (double)n);
        }
}

/* -------------------------------------------------------------------- ink */

static void add_stroke(const view *v, ink *i, const double a[2], const double b[2], bool outline)
{
    double from = stages_value(v->panel->stages, a), to = stages_value(v->panel->stages, b);
    if (!isfinite(from) || !isfinite(to))
        return;
    i->strokes = grow(i->strokes, &i->room, i->n + 1, sizeof *i->strokes);
    stroke *s = &i->strokes[i->n++];
    *s = (stroke){.middle = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2}, .outline = outline};
    s->cell = cell_of(v, s->middle);
    place(v, a, from, s->ends);
    place(v, b, to, s->ends + 2);
}

/* Adds a line in steps of a quarter of a cell. Each step follows the surface and belongs to one
 * cell. */
static void add_line(const view *v, ink *i, const double a[2], const double b[2], bool outline)
{
    double step = v->panel->stages->lattice.spacing / 4;
    size_t n = (size_t)ceil(hypot(b[0] - a[0], b[1] - a[1]) / step);
    double last[2] = {a[0], a[1]};
    for (size_t k = 1; k <= n; k++) {
        double t = (double)k / (double)n,
               next[2] = {a[0] * (1 - t) + b[0] * t, a[1] * (1 - t) + b[1] * t};
        add_stroke(v, i, last, next, outline);
        last[0] = next[0];
        last[1] = next[1];
    }
}

/* A curve may leave the shape for a while. Outside there is no surface to draw it on, so that part
 * is dropped. */
static icc_status drop_outside(const view *v, job *j, ink *i)
{
    double *middles = need(i->n, 2 * sizeof *middles);
    int32_t *where = need(i->n, sizeof *where);
    size_t kept = 0;
    for (size_t k = 0; k < i->n; k++)
        memcpy(middles + 2 * k, i->strokes[k].middle, sizeof i->strokes[k].middle);
    icc_status ran =
        icc_domain_locate(v->panel->stages->domain, i->n, middles, where, NULL, NULL, &j->env);
    for (size_t k = 0; k < i->n && ran == ICC_OK; k++)
        if (i->strokes[k].outline || where[k] != ICC_OUTSIDE)
            i->strokes[kept++] = i->strokes[k];
    i->n = kept;
    free(middles);
    free(where);
    return ran;
}

static int compare_strokes(const void *a, const void *b)
{
    const stroke *s = a, *t = b;
    if (s->cell != t->cell)
        return s->cell < t->cell ? -1 : 1;
    return s->outline - t->outline;
}

static int gather_ink(const view *v, job *j, ink *i)
{
    const cage *c = &j->cages[v->panel->side == 2];
    for (size_t k = 0; k < c->n; k++)
        add_line(v, i, c->points + 2 * k, c->points + 2 * ((k + 1) % c->n), true);
    curves lines;
    int result = curves_make(&lines, v->panel, j);
    for (size_t k = 0; k < lines.n; k++)
        for (size_t q = lines.starts[k]; q + 1 < lines.starts[k + 1]; q++)
            add_line(v, i, lines.points + 2 * q, lines.points + 2 * (q + 1), false);
    curves_free(&lines);
    if (i->n == 0 || result != DONE)
        return result;
    icc_status ran = drop_outside(v, j, i);
    if (ran != ICC_OK)
        return job_failed_status(j, ran);
    qsort(i->strokes, i->n, sizeof *i->strokes, compare_strokes);
    return DONE;
}

/* Draws the strokes of a cell. *next is the first of them and moves after the last. */
static void draw_ink(const view *v, const ink *i, size_t cell, bool outline, size_t *next)
{
    bool any = false;
    for (; *next < i->n && i->strokes[*next].cell == cell && i->strokes[*next].outline == outline;
         ++*next) {
        if (!any)
            fprintf(v->panel->svg, "<path class=\"%s\" d=\"", outline ? "outline" : "curve");
        any = true;
        svg_polyline(v->panel->svg, 2, i->strokes[*next].ends);
    }
    if (any)
        fputs("\"/>\n", v->panel->svg);
}

/* --------------------------------------------------------------- the whole */

static view make_view(const panel *p)
{
    const double turn = 0.45, tilt = 0.72; /* radians */
    const stages *s = p->stages;
    size_t longest =
        s->lattice.shape[0] > s->lattice.shape[1] ? s->lattice.shape[0] : s->lattice.shape[1];
    view v = {.panel = p, .relief = 0.45, .stride = longest / MAX_CELLS + 1, .fit = 1};
    v.columns = (s->lattice.shape[0] - 1) / v.stride;
    v.rows = (s->lattice.shape[1] - 1) / v.stride;
    v.turn[0] = cos(turn);
    v.turn[1] = sin(turn);
    v.tilt[0] = cos(tilt);
    v.tilt[1] = sin(tilt);
    v.size = fmax(s->box.upper[0] - s->box.lower[0], s->box.upper[1] - s->box.lower[1]);
    for (size_t k = 0; k < 2; k++)
        v.centre[k] = s->box.lower[k] + (s->box.upper[k] - s->box.lower[k]) / 2;
    return v;
}

static void stretch(const view *v, const double p[2], double value, double box[4])
{
    double seen[2];
    project(v, p, value, seen);
    for (size_t k = 0; k < 2; k++) {
        box[k] = fmin(box[k], seen[k]);
        box[k + 2] = fmax(box[k + 2], seen[k]);
    }
}

/* Scales the visible part to the panel. */
static void fit_view(view *v, const cage *c)
{
    const panel *p = v->panel;
    const stages *s = p->stages;
    const uint8_t *inside = icc_grid_inside(s->grid);
    double box[4] = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (uint32_t i = 0; i < s->lattice.n_vertices; i++) {
        double at[2];
        stages_position(s, i, at);
        if (inside[i] && !isnan(s->values[i]))
            stretch(v, at, s->values[i], box);
    }
    for (size_t i = 0; i < c->n; i++) {
        double value = stages_value(s, c->points + 2 * i);
        if (isfinite(value))
            stretch(v, c->points + 2 * i, value, box);
    }
    /* A single vertex inside has no extent. */
    const double least = s->lattice.spacing / v->size;
    for (size_t k = 0; k < 2; k++)
        box[k + 2] = fmax(box[k + 2], box[k] + least);
    v->fit = fmin(p->width / (box[2] - box[0]), p->height / (box[3] - box[1]));
    v->at[0] = p->left + p->width / 2 - v->fit * (box[0] + box[2]) / 2;
    v->at[1] = p->top + p->height / 2 - v->fit * (box[1] + box[3]) / 2;
}

typedef struct ranked {
    size_t cell;
    double away;
} ranked;

static int compare_ranked(const void *a, const void *b)
{
    const ranked *s = a, *t = b;
    if (s->away < t->away || s->away > t->away)
        return s->away > t->away ? -1 : 1;
    return (s->cell > t->cell) - (s->cell < t->cell);
}

/* Sorts all cells from the farthest to the nearest. */
static ranked *rank_cells(const view *v)
{
    size_t n = v->columns * v->rows;
    ranked *cells = need(n, sizeof *cells);
    for (size_t i = 0; i < n; i++) {
        double middle[2], seen[2];
        cell_point(v, i, 0.5, 0.5, middle);
        cells[i] = (ranked){i, project(v, middle, 0, seen)};
    }
    qsort(cells, n, sizeof *cells, compare_ranked);
    return cells;
}

/* Finds where each cell begins in the sorted strokes. */
static size_t *index_ink(const view *v, const ink *i)
{
    size_t n = v->columns * v->rows, next = 0;
    size_t *first = need(n, sizeof *first);
    for (size_t cell = 0; cell < n; cell++) {
        while (next < i->n && i->strokes[next].cell < cell)
            next++;
        first[cell] = next;
    }
    return first;
}

int plot_surface(const panel *p, job *j)
{
    view v = make_view(p);
    ink lines = {0};
    fit_view(&v, &j->cages[p->side == 2]);
    int result = gather_ink(&v, j, &lines);
    ranked *cells = rank_cells(&v);
    size_t *first = index_ink(&v, &lines);
    fputs("<g stroke-width=\"0.6\" stroke-linejoin=\"round\" stroke-linecap=\"round\" "
          "fill=\"none\">\n"
          "<style>.outline{stroke:#111;stroke-width:1.6}.curve{stroke:#1d4ed8;stroke-width:.8}</"
          "style>\n",
          p->svg);
    for (size_t i = 0; i < v.columns * v.rows; i++) {
        size_t cell = cells[i].cell, next = first[cell], last = next;
        while (last < lines.n && lines.strokes[last].cell == cell)
            last++;
        bool crossed = last > next && lines.strokes[last - 1].outline;
        draw_cell(&v, j, cell, crossed);
        draw_ink(&v, &lines, cell, false, &next);
        draw_ink(&v, &lines, cell, true, &next);
    }
    double at[2];
    place(&v, p->stages->chart_info.maximum, p->stages->high, at);
    fprintf(p->svg,
            "</g>\n<circle cx=\"%.2f\" cy=\"%.2f\" r=\"5.5\" fill=\"#dc2626\" stroke=\"white\" "
            "stroke-width=\"1.5\"/>\n",
            at[0], at[1]);
    free(first);
    free(cells);
    free(lines.strokes);
    return result;
}

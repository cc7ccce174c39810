/* Draws a shape with its chart, as in figure 6 of the paper, third row: function values (background
 * lightness), maximum (red circle), integral lines (blue), the cousin tree, expansion edges
 * (purple). */
#include "plot/plot.h"

#include "base/allocate.h"
#include "cage/cage_features.h"
#include "geo/clip.h"
#include "job/ties_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MIN_TREE_SPACING = 5, MAX_HANDLES = 64, DEFAULT_LINES = 120 };

void panel_place(const panel *p, const double at[2], double out[2])
{
    const icc_domain_info *box = &p->stages->box;
    out[0] = p->left + p->scale * (at[0] - box->lower[0]);
    out[1] = p->top + p->scale * (p->y_down ? at[1] - box->lower[1] : box->upper[1] - at[1]);
}

void panel_locate(const panel *p, double x, double y, double out[2])
{
    const icc_domain_info *box = &p->stages->box;
    out[0] = box->lower[0] + (x - p->left) / p->scale;
    out[1] = p->y_down ? box->lower[1] + (y - p->top) / p->scale
                       : box->upper[1] - (y - p->top) / p->scale;
}

static void write_path(const panel *p, size_t n, const double *points, bool closed)
{
    double *path = need(n, 2 * sizeof *path);
    for (size_t i = 0; i < n; i++)
        panel_place(p, points + 2 * i, path + 2 * i);
    svg_polyline(p->svg, n, path);
    if (closed && n > 0)
        fputc('Z', p->svg);
    free(path);
}

/* Writes all rings and lines. */
static void write_outline(const panel *p, const cage *c)
{
    write_path(p, c->n, c->points, true);
    for (size_t i = 0; i < c->n_features; i++) {
        const cage_feature *f = &c->features[i];
        if (f->kind != ICC_FEATURE_POINT)
            write_path(p, f->n, f->points, feature_is_ring(f));
    }
}

/* Writes a ring that turns to the left, or if `hole` to the right. */
static void write_turned(const panel *p, size_t n, const double *points, bool hole)
{
    if ((ring_area(n, points, 2) < 0) == hole) {
        write_path(p, n, points, true);
        return;
    }
    double *turned = need(n, 2 * sizeof *turned);
    for (size_t i = 0; i < n; i++)
        memcpy(turned + 2 * i, points + 2 * (n - 1 - i), 2 * sizeof *turned);
    write_path(p, n, turned, true);
    free(turned);
}

/* A place belongs to the shape if it lies in more outer rings and regions than holes. SVG's
 * `nonzero` counts in this way, because holes turn the other way round. */
void plot_clip(const panel *p, const cage *c)
{
    fprintf(p->svg, "<clipPath id=\"%s\"><path d=\"", p->clip);
    write_turned(p, c->n, c->points, false);
    for (size_t i = 0; i < c->n_features; i++)
        if (feature_is_ring(&c->features[i]))
            write_turned(p, c->features[i].n, c->features[i].points,
                         c->features[i].kind == ICC_FEATURE_HOLE);
    fputs("\"/></clipPath>\n", p->svg);
}

/* Draws vertices. Points inside have a pale rim, so that they are visible on any background. */
static void draw_vertices(const panel *p, size_t n, const double *points, double radius, bool rim)
{
    for (size_t i = 0; i < n; i++) {
        double at[2];
        panel_place(p, points + 2 * i, at);
        fprintf(p->svg, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%g\" fill=\"#111\"%s/>\n", at[0],
                at[1], radius, rim ? " stroke=\"white\"" : "");
    }
}

/* Draws the ties, dashed, and a pale background of lines, regions and ties, so that they are visible
 * on any pattern. */
static void draw_lines(const panel *p, const cage *c)
{
    fputs("<path fill=\"none\" stroke=\"white\" stroke-width=\"4\" stroke-linejoin=\"round\" "
          "stroke-opacity=\"0.7\" d=\"",
          p->svg);
    for (size_t i = 0; i < c->n_ties; i++)
        write_path(p, c->ties[i].n, c->ties[i].points, false);
    for (size_t i = 0; i < c->n_features; i++) {
        const cage_feature *f = &c->features[i];
        if (f->kind == ICC_FEATURE_LINE || (f->item > 0 && !f->of_outline))
            write_path(p, f->n, f->points, feature_is_ring(f));
    }
    fputs("\"/>\n", p->svg);
    for (size_t i = 0; i < c->n_ties; i++) {
        fputs("<path fill=\"none\" stroke=\"#dc2626\" stroke-width=\"1.8\" "
              "stroke-dasharray=\"6 3\" d=\"",
              p->svg);
        write_path(p, c->ties[i].n, c->ties[i].points, false);
        fputs("\"/>\n", p->svg);
    }
}

/* Draws circles for points with a radius. */
static void draw_circles(const panel *p, const cage *c)
{
    for (size_t i = 0; i < c->n_features; i++) {
        double at[2], radius = c->features[i].radius * p->scale;
        if (!(radius > 0))
            continue;
        panel_place(p, c->features[i].points, at);
        fprintf(p->svg,
                "<g fill=\"none\"><circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\" stroke=\"white\" "
                "stroke-width=\"4\" stroke-opacity=\"0.7\"/><circle cx=\"%.2f\" cy=\"%.2f\" "
                "r=\"%.2f\" stroke=\"#111\" stroke-width=\"1.5\"/></g>\n",
                at[0], at[1], radius, at[0], at[1], radius);
    }
}

/* Draws dots for vertices unless there are too many, and for points inside always. */
static void draw_cage(const panel *p, const cage *c)
{
    size_t n = c->n;
    if (c->n_features > 0)
        draw_lines(p, c);
    fputs("<path fill=\"none\" stroke=\"#111\" stroke-width=\"1.5\" stroke-linejoin=\"round\" d=\"",
          p->svg);
    write_outline(p, c);
    fputs("\"/>\n", p->svg);
    draw_circles(p, c);
    for (size_t i = 0; i < c->n_features; i++)
        n += c->features[i].kind == ICC_FEATURE_POINT ? 0 : c->features[i].n;
    if (n <= MAX_HANDLES)
        draw_vertices(p, c->n, c->points, 2.4, false);
    for (size_t i = 0; i < c->n_features; i++) {
        const cage_feature *f = &c->features[i];
        if (f->kind == ICC_FEATURE_POINT || n <= MAX_HANDLES)
            draw_vertices(p, f->n, f->points, f->kind == ICC_FEATURE_POINT ? 3.6 : 2.4,
                          f->kind == ICC_FEATURE_POINT);
    }
}

void plot_cage(const panel *p, const job *j)
{
    cage shown = j->cages[p->side == 2];
    cage_feature *own = NULL;
    size_t n_own = 0;
    if (shown.n_features > 0 && p->stages->map != NULL)
        n_own = ties_of_map(p->stages->map, j->domains[p->side == 2], p->side, &own);
    if (n_own > 0) {
        shown.n_ties = n_own;
        shown.ties = own;
    }
    draw_cage(p, &shown);
    ties_free(n_own, own);
}

/* ------------------------------------------------------------------ curves */

/* Spreads points evenly over the length of the boundary. */
static double *spread(const cage *c, size_t n)
{
    double *points = need(n, 2 * sizeof *points), total = 0, walked = 0;
    for (size_t i = 0; i < c->n; i++) {
        const double *a = c->points + 2 * i, *b = c->points + 2 * ((i + 1) % c->n);
        total += hypot(b[0] - a[0], b[1] - a[1]);
    }
    size_t k = 0;
    for (size_t i = 0; i < c->n && k < n; i++) {
        const double *a = c->points + 2 * i, *b = c->points + 2 * ((i + 1) % c->n);
        double length = hypot(b[0] - a[0], b[1] - a[1]);
        for (; k < n && ((double)k + 0.5) * total / (double)n <= walked + length; k++) {
            double t = (((double)k + 0.5) * total / (double)n - walked) / length;
            points[2 * k] = a[0] * (1 - t) + b[0] * t;
            points[2 * k + 1] = a[1] * (1 - t) + b[1] * t;
        }
        walked += length;
    }
    for (; k < n; k++) /* rounding may leave the last one without a place */
        memcpy(points + 2 * k, c->points, 2 * sizeof *points);
    return points;
}

int curves_make(curves *out, const panel *p, job *j)
{
    size_t n = j->args->lines > 0 ? (size_t)j->args->lines : DEFAULT_LINES, room = 4096, used = 0;
    double *starts = spread(&j->cages[p->side == 2], n);
    *out = (curves){.starts = need(n + 1, sizeof *out->starts),
                    .points = need(room, 2 * sizeof *out->points)};
    icc_status status = ICC_OK;
    for (size_t i = 0; i < n && status != ICC_ERR_MEMORY; i++) {
        size_t length = 0;
        status = icc_chart_trace(p->stages->chart, starts + 2 * i, room - used,
                                 out->points + 2 * used, &length, &j->env, NULL);
        if (status == ICC_OK && length > room - used) {
            room = 2 * (used + length);
            size_t bytes = 2 * used * sizeof *out->points;
            double *longer = need(room, 2 * sizeof *longer);
            memcpy(longer, out->points, bytes);
            free(out->points);
            out->points = longer;
            status = icc_chart_trace(p->stages->chart, starts + 2 * i, length, longer + 2 * used,
                                     &length, &j->env, NULL);
        }
        if (status == ICC_OK) {
            used += length;
            out->starts[++out->n] = used;
        }
    }
    free(starts);
    return status == ICC_ERR_MEMORY ? job_failed_status(j, status) : DONE;
}

void curves_free(curves *c)
{
    free(c->starts);
    free(c->points);
}

static int draw_curves(const panel *p, job *j)
{
    curves c;
    int result = curves_make(&c, p, j);
    fputs("<path fill=\"none\" stroke=\"#1d4ed8\" stroke-width=\"0.9\" stroke-linejoin=\"round\" "
          "stroke-opacity=\"0.85\" d=\"",
          p->svg);
    for (size_t i = 0; i < c.n; i++) {
        for (size_t k = c.starts[i]; k < c.starts[i + 1]; k++)
            panel_place(p, c.points + 2 * k, c.points + 2 * k);
        svg_polyline(p->svg, c.starts[i + 1] - c.starts[i], c.points + 2 * c.starts[i]);
    }
    fputs("\"/>\n", p->svg);
    curves_free(&c);
    return result;
}

/* ------------------------------------------------------------------ shades */

/* From slate at the lowest value to white at the maximum, and rose without a value. */
static void shade(const stages *s, double value, unsigned char rgba[4])
{
    static const double low[3] = {148, 163, 184}, high[3] = {255, 255, 255};
    static const unsigned char none[4] = {253, 205, 211, 255};
    memcpy(rgba, none, 4);
    if (isnan(value))
        return;
    double t = s->high > s->low ? fmin(fmax((value - s->low) / (s->high - s->low), 0), 1) : 1;
    for (int k = 0; k < 3; k++)
        rgba[k] = (unsigned char)(low[k] + t * (high[k] - low[k]) + 0.5);
}

/* Draws one picture with the panel's pixels below the drawing: the colour of the value at each
 * centre. */
static int draw_shades(const panel *p, job *j)
{
    picture image = picture_make((size_t)ceil(p->width), (size_t)ceil(p->height), 3, 8);
    size_t n = image.width * image.height;
    double *points = need(n, 2 * sizeof *points), *values = need(n, sizeof *values);
    for (size_t i = 0; i < n; i++)
        panel_locate(p,
                     p->left + ((double)(i % image.width) + 0.5) * p->width / (double)image.width,
                     p->top + ((double)(i / image.width) + 0.5) * p->height / (double)image.height,
                     points + 2 * i);
    int result = stages_values(p->stages, j, n, points, values);
    for (size_t i = 0; i < n && result == DONE; i++) {
        unsigned char rgba[4];
        shade(p->stages, values[i], rgba);
        picture_set(&image, i, rgba);
    }
    if (result == DONE)
        result = svg_picture(p->svg, p->left, p->top, p->width, p->height, p->clip, &image);
    picture_free(&image);
    free(points);
    free(values);
    return result;
}

/* ---------------------------------------------------------- tree and edges */

static void draw_segment(const panel *p, uint32_t a, uint32_t b)
{
    double ends[4];
    stages_position(p->stages, a, ends);
    stages_position(p->stages, b, ends + 2);
    panel_place(p, ends, ends);
    panel_place(p, ends + 2, ends + 2);
    svg_polyline(p->svg, 2, ends);
}

/* Draws the tree where a vertex inside is the parent. It is left out where its lines would merge to
 * grey. */
static void draw_tree(const panel *p)
{
    const uint32_t *parents = icc_tree_parents(p->stages->tree);
    const uint8_t *inside = icc_grid_inside(p->stages->grid);
    if (p->stages->lattice.spacing * p->scale < MIN_TREE_SPACING)
        return;
    fputs(
        "<path fill=\"none\" stroke=\"#64748b\" stroke-width=\"0.7\" stroke-opacity=\"0.75\" d=\"",
        p->svg);
    for (size_t i = 0; i < p->stages->lattice.n_vertices; i++)
        if (parents[i] != UINT32_MAX && inside[parents[i]])
            draw_segment(p, parents[i], (uint32_t)i);
    fputs("\"/>\n", p->svg);
}

static void draw_edges(const panel *p, int32_t kind, const char *colour)
{
    fprintf(p->svg,
            "<path fill=\"none\" stroke=\"%s\" stroke-width=\"2\" stroke-linecap=\"round\" d=\"",
            colour);
    for (size_t i = 0; i < p->stages->n_edges; i++)
        if (p->stages->kinds[i] == kind)
            draw_segment(p, p->stages->edges[2 * i], p->stages->edges[2 * i + 1]);
    fputs("\"/>\n", p->svg);
}

static void draw_maximum(const panel *p)
{
    double at[2];
    panel_place(p, p->stages->chart_info.maximum, at);
    fprintf(p->svg,
            "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"5.5\" fill=\"#dc2626\" stroke=\"white\" "
            "stroke-width=\"1.5\"/>\n",
            at[0], at[1]);
}

/* Draws the mesh of the map, every edge once. */
static int draw_triangles(const panel *p)
{
    icc_map_info info = {.size = sizeof info};
    const icc_map *map = p->stages->map;
    icc_map_get_info(map, &info);
    if (info.kind != ICC_MAP_MESH)
        return failed(NULL, 0,
                      "no mesh map was found, so there are no triangles; plot without --triangles");
    double *points = need(info.n_vertices, 2 * sizeof *points);
    uint32_t *triangles = need(info.n_simplices, 3 * sizeof *triangles);
    icc_mesh mesh = {.size = sizeof mesh,
                     .n_vertices = info.n_vertices,
                     .vertices = p->side == 1 ? points : NULL,
                     .n_cells = info.n_simplices,
                     .cells = triangles};
    icc_map_get_mesh(map, &mesh, p->side == 2 ? points : NULL);
    for (size_t i = 0; i < info.n_vertices; i++)
        panel_place(p, points + 2 * i, points + 2 * i);
    fputs("<path fill=\"none\" stroke=\"#334155\" stroke-width=\"0.4\" d=\"", p->svg);
    for (size_t i = 0; i < 3 * info.n_simplices; i++) {
        uint32_t a = triangles[i], b = triangles[i % 3 == 2 ? i - 2 : i + 1];
        double ends[4] = {points[2 * a], points[2 * a + 1], points[2 * b], points[2 * b + 1]};
        /* The triangle on the other side has the edge from b to a. Without one, the outline is
         * there. */
        if (a < b)
            svg_polyline(p->svg, 2, ends);
    }
    fputs("\"/>\n", p->svg);
    free(points);
    free(triangles);
    return DONE;
}

bool shows_triangles(const stages *s, const job *j)
{
    icc_map_info info = {.size = sizeof info};
    if (s->map != NULL)
        icc_map_get_info(s->map, &info);
    return j->args->triangles || info.kind == ICC_MAP_MESH;
}

int plot_shape(const panel *p, job *j)
{
    bool has_tree = p->stages->tree != NULL, triangles = shows_triangles(p->stages, j);
    int result = triangles ? DONE : draw_shades(p, j);
    fprintf(p->svg, "<g clip-path=\"url(#%s)\">\n", p->clip);
    if (has_tree)
        draw_tree(p);
    if (result == DONE)
        result = triangles ? draw_triangles(p) : draw_curves(p, j);
    if (j->args->compression)
        draw_edges(p, ICC_EDGE_COMPRESSION, "#f59e0b");
    if (has_tree)
        draw_edges(p, ICC_EDGE_EXPANSION, "#a21caf");
    fputs("</g>\n", p->svg);
    plot_cage(p, j);
    if (j->matched.size > 0)
        plot_pairs(p, j);
    if (!triangles)
        draw_maximum(p);
    return result;
}

/* Draws a map in space: both solids, of which a plane has removed a half. The cut is a sheet with a
 * regular grid. In the target it is the image of the sheet and its grid. */
#include "plot/plot.h"

#include "base/allocate.h"
#include "job/output_name.h"
#include "picture/picture_file.h"
#include "plot/solid_cut.h"
#include "plot/z_buffer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 440, MARGIN = 8, GAP = 36, CAPTION = 30 };

/* ------------------------------------------------------------------- drawing */

typedef struct paper {
    double steps[2]; /* half the width of a line of the grid, in cells */
    double light;
} paper;

/* Paints fields of two pale colours, and lines that are as thin everywhere as on the source. */
static void paint_sheet(const void *of, const double value[3], double rgb[3])
{
    static const double light[3] = {255, 250, 234}, dark[3] = {222, 232, 244},
                        line[3] = {60, 90, 160};
    const paper *p = of;
    bool odd = fmod(fabs(floor(value[0]) + floor(value[1])), 2) > 0.5, on = false;
    for (size_t k = 0; k < 2; k++)
        on = on || fabs(value[k] - floor(value[k] + 0.5)) < p->steps[k];
    for (size_t k = 0; k < 3; k++)
        rgb[k] = on ? line[k] : p->light * (odd ? dark[k] : light[k]);
}

static void paint_shell(const void *of, const double value[3], double rgb[3])
{
    static const double dark[3] = {102, 136, 172}, pale[3] = {232, 238, 243};
    const double *light = of;
    double length = sqrt(value[0] * value[0] + value[1] * value[1] + value[2] * value[2]);
    double share = (value[0] * light[0] + value[1] * light[1] + value[2] * light[2]) / length;
    share = length > 0 ? 0.5 + 0.5 * share : 1;
    for (size_t k = 0; k < 3; k++)
        rgb[k] = dark[k] + (pale[k] - dark[k]) * share;
}

/* The rate at which the values change in the picture is constant on a triangle. */
static paper take_paper(const z_buffer_corner *c, double half_width)
{
    paper p = {.light = 1};
    double x[2], y[2];
    for (size_t k = 0; k < 2; k++) {
        x[k] = c[k + 1].at[0] - c[0].at[0];
        y[k] = c[k + 1].at[1] - c[0].at[1];
    }
    double area = x[0] * y[1] - x[1] * y[0];
    for (size_t k = 0; k < 2; k++) {
        double first = c[1].value[k] - c[0].value[k], second = c[2].value[k] - c[0].value[k];
        p.steps[k] = half_width *
                     hypot(first * y[1] - second * y[0], second * x[0] - first * x[1]) / fabs(area);
    }
    return p;
}

static void draw_sheet(const solid *x, z_buffer *s, size_t side)
{
    const solid_view *v = &x->views[side];
    for (size_t i = 0; i + 2 < x->sheet.n; i += 3) {
        z_buffer_corner c[3] = {{{0}, {0}}};
        for (size_t k = 0; k < 3; k++) {
            const cut_corner *from = &x->sheet.all[i + k];
            view_place(v, MARGIN * Z_BUFFER_SAMPLES, from->at[side], c[k].at);
            for (size_t m = 0; m < 2; m++)
                for (size_t n = 0; n < 3; n++)
                    c[k].value[m] += (from->at[0][n] - x->plane.at[n]) * x->ground[m][n] / x->cell;
        }
        paper p = take_paper(c, 0.45 * Z_BUFFER_SAMPLES);
        z_buffer_triangle(s, c, paint_sheet, &p);
    }
}

static void draw_shell(const solid *x, z_buffer *s, size_t side, double sign)
{
    const solid_view *v = &x->views[side];
    double light[3], length = sqrt(1 + 0.45 * 0.45 + 0.7 * 0.7);
    for (size_t k = 0; k < 3; k++)
        light[k] = sign * (v->axes[2][k] - 0.45 * v->axes[0][k] + 0.7 * v->axes[1][k]) / length;
    for (size_t i = 0; i + 2 < x->shell.n; i += 3) {
        z_buffer_corner c[3];
        for (size_t k = 0; k < 3; k++) {
            view_place(v, MARGIN * Z_BUFFER_SAMPLES, x->shell.all[i + k].at[side], c[k].at);
            memcpy(c[k].value, x->shell.all[i + k].normal[side], sizeof c[k].value);
        }
        z_buffer_triangle(s, c, paint_shell, light);
    }
}

static void draw_rim(const solid *x, z_buffer *s, size_t side)
{
    static const unsigned char ink[3] = {17, 17, 17};
    for (size_t i = 0; i + 1 < x->rim.n; i += 2) {
        double ends[2][3];
        for (size_t k = 0; k < 2; k++)
            view_place(&x->views[side], MARGIN * Z_BUFFER_SAMPLES, x->rim.all[i + k].at[side],
                       ends[k]);
        z_buffer_line(s, ends[0], ends[1], 0.65 * Z_BUFFER_SAMPLES, 1.5 * Z_BUFFER_SAMPLES, ink);
    }
}

static int draw_side(solid *x, size_t side, picture *out)
{
    static const unsigned char grey[3] = {71, 85, 105};
    const args *a = x->job->args;
    solid_view *v = &x->views[side];
    double eye[3];
    icc_domain_info info = {.size = sizeof info};
    icc_domain_get_info(x->job->domains[0], &info);
    view_default_eye(x->plane.normal, eye);
    *v = view_make(a->n_view > 0 ? a->view : eye);
    view_widen(v, &x->shell, side);
    view_widen(v, &x->rim, side);
    double width = v->box[2] - v->box[0], height = v->box[3] - v->box[1];
    v->scale = SIZE * Z_BUFFER_SAMPLES / fmax(width, height);
    if (!(isfinite(v->scale) && v->scale > 0 && isfinite(width) && isfinite(height)))
        return failed(job_file(x->job, (int)side + 1), 0,
                      "the shape is too large or too small to draw");
    z_buffer s = z_buffer_make((size_t)ceil(v->scale * width / Z_BUFFER_SAMPLES) + 2 * MARGIN,
                               (size_t)ceil(v->scale * height / Z_BUFFER_SAMPLES) + 2 * MARGIN);
    draw_shell(x, &s, side, info.orientation);
    draw_sheet(x, &s, side);
    z_buffer_contours(&s, Z_BUFFER_SAMPLES / 2, 0.03 * SIZE * Z_BUFFER_SAMPLES, grey);
    draw_rim(x, &s, side);
    *out = z_buffer_picture(&s);
    z_buffer_free(&s);
    return DONE;
}

/* ------------------------------------------------------------------- writing */

static size_t greatest(size_t a, size_t b)
{
    return a > b ? a : b;
}

/* Puts both pictures side by side, each in the middle of the height. */
static picture join(const picture p[2])
{
    picture whole =
        picture_make(p[0].width + p[1].width + GAP, greatest(p[0].height, p[1].height), 3, 8);
    for (size_t i = 0; i < 3 * whole.width * whole.height; i++)
        whole.samples[i] = 255;
    for (size_t side = 0; side < 2; side++) {
        size_t left = side == 0 ? 0 : p[0].width + GAP, top = (whole.height - p[side].height) / 2;
        for (size_t row = 0; row < p[side].height; row++)
            memcpy(whole.samples + 3 * ((top + row) * whole.width + left),
                   p[side].samples + 3 * row * p[side].width, 3 * p[side].width * sizeof(uint16_t));
    }
    return whole;
}

static int write_svg(const picture pictures[2], FILE *svg)
{
    static const char *const captions[2] = {"source: cut", "target: image of the cut"};
    size_t height = greatest(pictures[0].height, pictures[1].height);
    double left = GAP;
    int result = DONE;
    svg_begin(svg, (double)(pictures[0].width + pictures[1].width + 3 * GAP),
              (double)(height + 2 * GAP + CAPTION));
    for (size_t side = 0; side < 2 && result == DONE; side++) {
        const picture *p = &pictures[side];
        double width = (double)p->width, top = GAP + (double)(height - p->height) / 2;
        fprintf(svg,
                "<clipPath id=\"side-%zu\"><rect x=\"%.0f\" y=\"%.1f\" width=\"%.0f\" "
                "height=\"%zu\"/></clipPath>\n",
                side, left, top, width, p->height);
        char clip[16];
        snprintf(clip, sizeof clip, "side-%zu", side);
        result = svg_picture(svg, left, top, width, (double)p->height, clip, p);
        svg_label(svg, left + width / 2, (double)height + GAP + CAPTION, captions[side]);
        left += width + GAP;
    }
    svg_end(svg);
    return result;
}

static int write_solid(const picture pictures[2], const char *name)
{
    const char *format = output_format(name);
    if (format != NULL && strcmp(format, "PNG") == 0) {
        picture whole = join(pictures);
        int result = picture_save(&whole, &(picture_style){.format = PICTURE_PNG}, name);
        picture_free(&whole);
        return result;
    }
    outfile file;
    if (!outfile_open(&file, name))
        return FAILED;
    int result = write_svg(pictures, file.stream);
    return outfile_close(&file) && result == DONE ? DONE : FAILED;
}

/* Refuses options for pictures of the plane. */
static int check_options(const args *a)
{
    const char *flat = a->triangles     ? "triangles"
                       : a->elevation   ? "elevation"
                       : a->compression ? "compression"
                       : a->y_down      ? "y-down"
                       : a->lines > 0   ? "lines"
                                        : NULL;
    if (flat != NULL)
        return misused(a->command, "--%s is for drawings in the plane", flat);
    if (a->target == NULL)
        return misused(a->command,
                       "a drawing in space shows a map: add --target FILE (or write OUT.vtk)");
    return DONE;
}

int plot_solid(job *j)
{
    solid x = {.job = j};
    picture pictures[2] = {{0}, {0}};
    int result = check_options(j->args);
    if (result == DONE)
        result = solid_make(&x, j);
    for (size_t side = 0; side < 2 && result == DONE; side++)
        result = draw_side(&x, side, &pictures[side]);
    progress_end(&j->bar);
    if (result == DONE)
        result = write_solid(pictures, j->args->operands[0]);
    for (size_t side = 0; side < 2; side++)
        picture_free(&pictures[side]);
    solid_free(&x);
    return result;
}

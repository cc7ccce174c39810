/* Figure 6 of the paper, first and second row: the images of a checkerboard and of the coordinates
 * u (red) and v (green), painted on the source. */
#include "plot/plot.h"

#include "base/allocate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SQUARES = 16 };
static const size_t samples = 2; /* samples along the side of a pixel */

static void pattern_colour(const icc_domain_info *box, pattern what, const double at[2],
                           double rgb[3])
{
    static const double light[3] = {244, 211, 120}, dark[3] = {60, 90, 160},
                        none[3] = {253, 205, 211};
    double size = fmax(box->upper[0] - box->lower[0], box->upper[1] - box->lower[1]);
    double u = (at[0] - box->lower[0]) / size, v = (at[1] - box->lower[1]) / size;
    memcpy(rgb, none, sizeof none);
    if (isnan(u) || isnan(v))
        return;
    if (what == PATTERN_CHECKERBOARD) {
        double odd = fmod(floor(u * SQUARES) + floor(v * SQUARES), 2);
        memcpy(rgb, fabs(odd) > 0.5 ? dark : light, sizeof light);
        return;
    }
    rgb[0] = 255 * fmin(fmax((at[0] - box->lower[0]) / (box->upper[0] - box->lower[0]), 0), 1);
    rgb[1] = 255 * fmin(fmax((at[1] - box->lower[1]) / (box->upper[1] - box->lower[1]), 0), 1);
    rgb[2] = 64;
}

int places_make(places *out, const panel *p, job *j)
{
    *out = (places){.width = (size_t)ceil(p->width), .height = (size_t)ceil(p->height)};
    size_t columns = out->width * samples, rows = out->height * samples;
    out->points = need(columns * rows, 2 * sizeof *out->points);
    for (size_t i = 0; i < columns * rows; i++)
        panel_locate(p, p->left + ((double)(i % columns) + 0.5) * p->width / (double)columns,
                     p->top + ((double)(i / columns) + 0.5) * p->height / (double)rows,
                     out->points + 2 * i);
    if (p->side == 1)
        return DONE;
    icc_status ran = icc_map_apply_inverse(p->stages->map, columns * rows, out->points, out->points,
                                           NULL, NULL, &j->env);
    return ran == ICC_OK ? DONE : job_failed_status(j, ran);
}

void places_free(places *s)
{
    free(s->points);
}

int plot_pattern(const panel *p, job *j, const places *from, pattern what)
{
    picture image = picture_make(from->width, from->height, 3, 8);
    icc_domain_info box = {.size = sizeof box};
    icc_domain_get_info(j->domains[0], &box);
    for (size_t i = 0; i < image.width * image.height; i++) {
        double sum[3] = {0, 0, 0};
        for (size_t s = 0; s < samples * samples; s++) {
            double rgb[3];
            size_t x = i % image.width * samples + s % samples,
                   y = i / image.width * samples + s / samples;
            pattern_colour(&box, what, from->points + 2 * (y * image.width * samples + x), rgb);
            for (size_t k = 0; k < 3; k++)
                sum[k] += rgb[k];
        }
        for (size_t k = 0; k < 3; k++)
            image.samples[3 * i + k] = (uint16_t)(sum[k] / (double)(samples * samples) + 0.5);
    }
    int result = svg_picture(p->svg, p->left, p->top, p->width, p->height, p->clip, &image);
    plot_cage(p, j);
    picture_free(&image);
    return result;
}

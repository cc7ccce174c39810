/* A buffer of depths: E. Catmull, A Subdivision Algorithm for Computer Display of Curved Surfaces,
 * thesis, University of Utah, 1974. */
#include "plot/z_buffer.h"

#include "base/allocate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

z_buffer z_buffer_make(size_t width, size_t height)
{
    z_buffer s = {.width = Z_BUFFER_SAMPLES * width, .height = Z_BUFFER_SAMPLES * height};
    s.depths = need(s.width * s.height, sizeof *s.depths);
    s.rgb = need(s.width * s.height, 3);
    for (size_t i = 0; i < s.width * s.height; i++)
        s.depths[i] = -HUGE_VALF;
    memset(s.rgb, 255, 3 * s.width * s.height);
    return s;
}

void z_buffer_free(z_buffer *s)
{
    free(s->depths);
    free(s->rgb);
}

/* The samples between two coordinates that are in the picture: from low to below high. */
static void find_range(double lower, double upper, size_t n, size_t range[2])
{
    range[0] = lower > 0 ? (size_t)fmin(ceil(lower - 0.5), (double)n) : 0;
    range[1] = upper > 0 ? (size_t)fmin(floor(upper + 0.5), (double)n) : 0;
}

/* Computes the barycentric coordinates of each sample in the bounding box, by constant steps. */
void z_buffer_triangle(z_buffer *s, const z_buffer_corner corners[3], z_buffer_paint paint,
                       const void *of)
{
    const double *a = corners[0].at, *b = corners[1].at, *c = corners[2].at;
    double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    size_t x[2], y[2];
    if (!(fabs(area) > 1e-12))
        return;
    find_range(fmin(a[0], fmin(b[0], c[0])), fmax(a[0], fmax(b[0], c[0])), s->width, x);
    find_range(fmin(a[1], fmin(b[1], c[1])), fmax(a[1], fmax(b[1], c[1])), s->height, y);
    for (size_t row = y[0]; row < y[1]; row++)
        for (size_t column = x[0]; column < x[1]; column++) {
            double px = (double)column + 0.5, py = (double)row + 0.5, w[3], value[3], rgb[3];
            w[1] = ((px - a[0]) * (c[1] - a[1]) - (py - a[1]) * (c[0] - a[0])) / area;
            w[2] = ((b[0] - a[0]) * (py - a[1]) - (b[1] - a[1]) * (px - a[0])) / area;
            w[0] = 1 - w[1] - w[2];
            size_t at = row * s->width + column;
            double depth = w[0] * a[2] + w[1] * b[2] + w[2] * c[2];
            if (w[0] < 0 || w[1] < 0 || w[2] < 0 || depth <= (double)s->depths[at])
                continue;
            for (size_t k = 0; k < 3; k++)
                value[k] = w[0] * corners[0].value[k] + w[1] * corners[1].value[k] +
                           w[2] * corners[2].value[k];
            paint(of, value, rgb);
            s->depths[at] = (float)depth;
            for (size_t k = 0; k < 3; k++)
                s->rgb[3 * at + k] = (unsigned char)(fmin(fmax(rgb[k], 0), 255) + 0.5);
        }
}

void z_buffer_line(z_buffer *s, const double a[3], const double b[3], double radius, double lift,
                   const unsigned char rgb[3])
{
    double along[2] = {b[0] - a[0], b[1] - a[1]},
           square = along[0] * along[0] + along[1] * along[1];
    size_t x[2], y[2];
    find_range(fmin(a[0], b[0]) - radius, fmax(a[0], b[0]) + radius, s->width, x);
    find_range(fmin(a[1], b[1]) - radius, fmax(a[1], b[1]) + radius, s->height, y);
    for (size_t row = y[0]; row < y[1]; row++)
        for (size_t column = x[0]; column < x[1]; column++) {
            double px = (double)column + 0.5 - a[0], py = (double)row + 0.5 - a[1];
            double t = square > 0 ? fmin(fmax((px * along[0] + py * along[1]) / square, 0), 1) : 0;
            double depth = a[2] + t * (b[2] - a[2]) + lift;
            size_t at = row * s->width + column;
            if (hypot(px - t * along[0], py - t * along[1]) > radius ||
                depth <= (double)s->depths[at])
                continue;
            s->depths[at] = (float)depth;
            memcpy(s->rgb + 3 * at, rgb, 3);
        }
}

/* A sample is on a contour if it is much nearer than a neighbour. Depths do not change. */
void z_buffer_contours(z_buffer *s, size_t radius, double jump, const unsigned char rgb[3])
{
    for (size_t row = radius; row + radius < s->height; row++)
        for (size_t column = radius; column + radius < s->width; column++) {
            size_t at = row * s->width + column;
            const float *d = s->depths + at;
            float least = fminf(fminf(d[-(ptrdiff_t)radius], d[radius]),
                                fminf(d[-(ptrdiff_t)(radius * s->width)], d[radius * s->width]));
            if (least < *d && (double)*d - (double)least > jump)
                memcpy(s->rgb + 3 * at, rgb, 3);
        }
}

picture z_buffer_picture(const z_buffer *s)
{
    picture p = picture_make(s->width / Z_BUFFER_SAMPLES, s->height / Z_BUFFER_SAMPLES, 3, 8);
    for (size_t i = 0; i < 3 * p.width * p.height; i++) {
        size_t x = i / 3 % p.width, y = i / 3 / p.width, sum = 0;
        for (size_t k = 0; k < Z_BUFFER_SAMPLES * Z_BUFFER_SAMPLES; k++)
            sum += s->rgb[3 * ((y * Z_BUFFER_SAMPLES + k / Z_BUFFER_SAMPLES) * s->width +
                               x * Z_BUFFER_SAMPLES + k % Z_BUFFER_SAMPLES) +
                          i % 3];
        p.samples[i] = (uint16_t)((sum + Z_BUFFER_SAMPLES * Z_BUFFER_SAMPLES / 2) /
                                  (Z_BUFFER_SAMPLES * Z_BUFFER_SAMPLES));
    }
    return p;
}

/* Polygons to test with. All are simple and turn counter-clockwise with y upwards. */
#ifndef TESTS_SHAPES_H
#define TESTS_SHAPES_H

#include <math.h>
#include <stddef.h>
#include <string.h>

enum { SHAPE_MAX = 128 };

typedef struct shape {
    size_t n;
    double xy[2 * SHAPE_MAX];
} shape;

static inline shape shape_of(size_t n, const double *xy)
{
    shape s = {.n = n};
    memcpy(s.xy, xy, 2 * n * sizeof *xy);
    return s;
}

static inline shape shape_square(void)
{
    return shape_of(4, (double[]){0, 0, 1, 0, 1, 1, 0, 1});
}

static inline shape shape_l(void)
{
    return shape_of(6, (double[]){0, 0, 3, 0, 3, 1, 1, 1, 1, 3, 0, 3});
}

static inline shape shape_dart(void)
{
    return shape_of(4, (double[]){0, 0, 1, 0, .3, .3, 0, 1});
}

static inline shape shape_e(void)
{
    return shape_of(
        12, (double[]){0, 0, 4, 0, 4, 1, 1, 1, 1, 2, 3, 2, 3, 3, 1, 3, 1, 4, 4, 4, 4, 5, 0, 5});
}

/* Regular, with `spikes` tips of radius 1 and dents of the given radius, turned by `angle`. */
static inline shape shape_star(size_t spikes, double dent, double angle)
{
    shape s = {.n = 2 * spikes};
    for (size_t k = 0; k < s.n; ++k) {
        const double a = angle + 3.14159265358979323846 * (double)k / (double)spikes;
        const double r = k % 2 == 0 ? 1 : dent;
        s.xy[2 * k] = r * cos(a);
        s.xy[2 * k + 1] = r * sin(a);
    }
    return s;
}

/* A band of the given width round a sine wave. */
static inline shape shape_worm(size_t pieces, double width, double bend)
{
    shape s = {.n = 2 * (pieces + 1)};
    for (size_t k = 0; k <= pieces; ++k) {
        const double x = 4 * (double)k / (double)pieces, y = bend * sin(2 * x);
        const double down[2] = {x, y - width / 2}, up[2] = {x, y + width / 2};
        memcpy(s.xy + 2 * k, down, sizeof down);
        memcpy(s.xy + 2 * (s.n - 1 - k), up, sizeof up);
    }
    return s;
}

/* A back with teeth upwards. */
static inline shape shape_comb(size_t teeth)
{
    shape s = {.n = 4 * teeth + 2};
    const double width = (double)(2 * teeth);
    double *p = s.xy;
    *p++ = 0;
    *p++ = 0;
    *p++ = width;
    *p++ = 0;
    for (size_t k = teeth; k-- > 0;) {
        const double x = (double)(2 * k);
        const double tooth[8] = {x + 2, 1, x + 1.75, 4, x + 0.75, 4, x + 0.5, 1};
        memcpy(p, tooth, sizeof tooth);
        p += 8;
    }
    return s;
}

static inline shape shape_needle(void)
{
    return shape_of(3, (double[]){0, 0, 1, 0.01, 0, 0.02});
}

/* Star-shaped round its centre, otherwise wild. `random` gives numbers in [0, 1). */
static inline shape shape_blob(size_t n, double (*random)(void *), void *source)
{
    shape s = {.n = n};
    for (size_t k = 0; k < n; ++k) {
        const double a = 6.28318530717958647692 * ((double)k + 0.8 * random(source)) / (double)n;
        const double r = 0.2 + 0.8 * random(source);
        s.xy[2 * k] = r * cos(a);
        s.xy[2 * k + 1] = r * sin(a);
    }
    return s;
}

/* The other way round. Vertex 0 stays. */
static inline shape shape_reversed(const shape *s)
{
    shape r = *s;
    for (size_t k = 1; k < s->n; ++k)
        memcpy(r.xy + 2 * k, s->xy + 2 * (s->n - k), 2 * sizeof(double));
    return r;
}

static inline shape shape_moved(const shape *s, double scale, double dx, double dy)
{
    shape r = *s;
    for (size_t k = 0; k < s->n; ++k) {
        r.xy[2 * k] = s->xy[2 * k] * scale + dx;
        r.xy[2 * k + 1] = s->xy[2 * k + 1] * scale + dy;
    }
    return r;
}

enum { N_SHAPES = 9 };

/* Every kind once. */
static inline shape shape_number(int k)
{
    switch (k) {
    case 0:
        return shape_square();
    case 1:
        return shape_l();
    case 2:
        return shape_dart();
    case 3:
        return shape_e();
    case 4:
        return shape_star(5, 0.4, 0.1);
    case 5:
        return shape_star(7, 0.7, 0.0);
    case 6:
        return shape_worm(24, 0.5, 0.6);
    case 7:
        return shape_comb(4);
    default:
        return shape_needle();
    }
}

/* Pairs with the same number of vertices. */
enum { N_SHAPE_PAIRS = 5 };

static inline void shape_pair(int k, shape *source, shape *target)
{
    switch (k) {
    case 0:
        *source = shape_square();
        *target = shape_dart();
        break;
    case 1:
        *source = shape_l();
        *target = shape_star(3, 0.45, 0.2);
        break;
    case 2:
        *source = shape_star(5, 0.4, 0.1);
        *target = shape_star(5, 0.7, 0.5);
        break;
    case 3:
        *source = shape_worm(12, 0.8, 0.2);
        *target = shape_worm(12, 0.9, -0.5);
        break;
    default:
        *source = shape_e();
        *target = shape_star(6, 0.6, 0.3);
    }
}

#endif

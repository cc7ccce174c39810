/* Polygons that are hard to mesh or to map. All are simple and turn counter-clockwise. */
#ifndef TESTS_HARD_SHAPES_H
#define TESTS_HARD_SHAPES_H

#include "random.h"
#include "shapes.h"

/* A band that winds inwards. */
static inline shape shape_spiral(size_t pieces, double turns)
{
    shape s = {.n = 2 * (pieces + 1)};
    for (size_t k = 0; k <= pieces; ++k) {
        const double share = (double)k / (double)pieces;
        const double a = 6.28318530717958647692 * turns * share, r = 0.3 + turns * share;
        const double inner[2] = {r * cos(a), r * sin(a)};
        const double outer[2] = {(r + 0.4) * cos(a), (r + 0.4) * sin(a)};
        memcpy(s.xy + 2 * k, outer, sizeof outer);
        memcpy(s.xy + 2 * (s.n - 1 - k), inner, sizeof inner);
    }
    return s;
}

/* A round body with spikes of the given angle, in degrees. */
static inline shape shape_spikes(size_t n, double degrees)
{
    shape s = {.n = 3 * n};
    const double half = degrees / 2 * 3.14159265358979323846 / 180;
    for (size_t k = 0; k < n; ++k) {
        const double a = 6.28318530717958647692 * (double)k / (double)n;
        double *p = s.xy + 6 * k;
        for (int j = 0; j < 3; ++j) {
            const double b = a + (j - 1) * half, r = j == 1 ? 2 : 1;
            p[2 * j] = r * cos(b);
            p[2 * j + 1] = r * sin(b);
        }
    }
    return s;
}

/* A square with a slit that leaves the two sides so far apart. */
static inline shape shape_slit(double gap)
{
    const double low = 0.5 - gap / 2, high = 0.5 + gap / 2;
    return shape_of(8, (double[]){0, 0, 1, 0, 1, low, .5, low, .5, high, 1, high, 1, 1, 0, 1});
}

/* Two squares joined by a corridor of the given width. */
static inline shape shape_dumbbell(double width)
{
    const double low = 0.5 - width / 2, high = 0.5 + width / 2;
    return shape_of(12, (double[]){0,   0, 1,   0, 1,   low,  1.2, low,  1.2, 0, 2.2, 0,
                                   2.2, 1, 1.2, 1, 1.2, high, 1,   high, 1,   1, 0,   1});
}

static inline shape shape_channel(double aspect)
{
    return shape_of(4, (double[]){0, 0, aspect, 0, aspect, 1, 0, 1});
}

static inline shape shape_splinter(double aspect)
{
    return shape_of(3, (double[]){0, 0, aspect, 0.5, 0, 1});
}

static inline double random_for_blob(void *source)
{
    return random_unit(source);
}

static inline shape shape_wild(size_t n, uint64_t seed)
{
    random_source r = {seed};
    return shape_blob(n, random_for_blob, &r);
}

/* A square with a corner rounded off by so small a radius that the edges there are a few rounding
 * errors long on the scale of the whole. */
static inline shape shape_fillet(double radius)
{
    enum { N = 16 };
    shape s = {.n = 3 + N};
    const double corners[6] = {0, 1, 0, 0, 1, 0};
    memcpy(s.xy, corners, sizeof corners);
    for (size_t k = 0; k < N; ++k) {
        const double a = 1.5707963267948966 * (double)k / (N - 1);
        s.xy[6 + 2 * k] = 1 - radius + radius * cos(a);
        s.xy[7 + 2 * k] = 1 - radius + radius * sin(a);
    }
    return s;
}

enum { N_HARD_SHAPES = 17 };

static inline shape shape_hard(int k)
{
    switch (k) {
    case 0:
        return shape_spiral(40, 2.5);
    case 1:
        return shape_spikes(24, 0.01);
    case 2:
        return shape_slit(1e-9);
    case 3:
        return shape_slit(1e-14);
    case 4:
        return shape_dumbbell(1e-3);
    case 5:
        return shape_dumbbell(1e-9);
    case 6:
        return shape_dumbbell(1e-14);
    case 7:
        return shape_channel(1000);
    case 8:
        return shape_splinter(1000);
    case 9:
        return shape_comb(20);
    case 10:
        return shape_star(30, 0.05, 0.3);
    case 11:
        return shape_wild(120, 4);
    case 12:
        return shape_worm(60, 0.02, 0.9);
    case 13:
        return shape_fillet(1e-8);
    case 14:
        return shape_fillet(1e-9);
    case 15:
        return shape_fillet(1e-12);
    default:
        return shape_wild(11, 9);
    }
}

/* How much the rounding of a point may change what depends on its place across the shape. */
static inline double shape_hard_slack(int k)
{
    return k == 3 || k == 6 ? 0.2 : k == 15 ? 1e-4 : k == 2 || k == 5 || k == 14 ? 1e-5 : 1e-7;
}

#endif

/* Masks of grids to solve on, in 2-D, 3-D and any dimension, drawn at any resolution. */
#ifndef TESTS_HARD_MASKS_H
#define TESTS_HARD_MASKS_H

#include "icc/base.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

/* Vertices outside that are added on every side: a grid needs two for both layers of a tree. */
enum { MASK_MARGIN = 2 };

typedef struct mask {
    int32_t dim;
    size_t shape[ICC_MAX_DIM];
    size_t n_vertices, n_inside;
    uint8_t *inside; /* first axis fastest */
} mask;

/* Whether a point of the unit cube is inside; `cells` across the cube, for shapes whose walls are
 * counted in cells. */
typedef bool (*mask_shape)(const double *p, int32_t dim, double cells);

static inline double mask_distance(const double *p, int32_t dim, double centre)
{
    double sum = 0;
    for (int32_t k = 0; k < dim; ++k)
        sum += (p[k] - centre) * (p[k] - centre);
    return sqrt(sum);
}

/* Distance in space to the segment from a to b. */
static inline double mask_to_segment(const double *p, const double a[3], const double b[3])
{
    double along = 0, length = 0, distance = 0;
    for (int k = 0; k < 3; ++k) {
        along += (p[k] - a[k]) * (b[k] - a[k]);
        length += (b[k] - a[k]) * (b[k] - a[k]);
    }
    const double t = length > 0 ? fmin(1, fmax(0, along / length)) : 0;
    for (int k = 0; k < 3; ++k) {
        const double d = p[k] - a[k] - t * (b[k] - a[k]);
        distance += d * d;
    }
    return sqrt(distance);
}

static inline bool mask_box(const double *p, int32_t dim, double cells)
{
    (void)p, (void)dim, (void)cells;
    return true;
}

static inline bool mask_ball(const double *p, int32_t dim, double cells)
{
    (void)cells;
    return mask_distance(p, dim, 0.5) < 0.5;
}

/* Arms of width 0.45 along the first two axes. */
static inline bool mask_l(const double *p, int32_t dim, double cells)
{
    (void)dim, (void)cells;
    return p[0] < 0.45 || p[1] < 0.45;
}

/* A ring with a gap of 30 degrees. */
static inline bool mask_c(const double *p, int32_t dim, double cells)
{
    (void)dim, (void)cells;
    const double x = p[0] - 0.5, y = p[1] - 0.5, r = hypot(x, y);
    return r > 0.2 && r < 0.45 && fabs(atan2(y, x)) > 0.2618;
}

/* Five tips of radius 0.5, dents of radius 0.2. */
static inline bool mask_star(const double *p, int32_t dim, double cells)
{
    (void)dim, (void)cells;
    const double half = 3.14159265358979323846 / 5;
    const double x = p[0] - 0.5, y = p[1] - 0.5;
    const double angle = fmod(fabs(atan2(x, y)), 2 * half),
                 from_tip = fmin(angle, 2 * half - angle);
    const double u = hypot(x, y) * cos(from_tip), v = hypot(x, y) * sin(from_tip);
    const double a = 0.2 * cos(half), b = 0.2 * sin(half);
    return (u - 0.5) * b + v * (0.5 - a) < 0;
}

/* A corridor of 18 cells between walls of 2, to and fro along the first axis: cells^2 / 360
 * times as long as wide, so 111 times at 200 cells and 2778 times at 1000. */
static inline bool mask_serpentine(const double *p, int32_t dim, double cells)
{
    (void)dim;
    const double row = floor(p[1] * cells), turn = floor(row / 20);
    if (row - 20 * turn < 18)
        return true;
    const bool right = fmod(turn, 2) < 1;
    return (right ? 1 - p[0] : p[0]) * cells < 18 && 20 * (turn + 1) < cells;
}

/* Rooms joined by corridors one vertex wide. */
static inline bool mask_rooms(const double *p, int32_t dim, double cells)
{
    (void)dim;
    const double x = fmod(floor(p[0] * cells), 16), y = fmod(floor(p[1] * cells), 16);
    return (x < 12 && y < 12) || (x < 6 && x > 4) || (y < 6 && y > 4);
}

/* A wide way round and one straight across that is one vertex wide: shorter, but far less gets
 * through. */
static inline bool mask_two_ways(const double *p, int32_t dim, double cells)
{
    (void)dim;
    const double x = fabs(p[0] - 0.5), y = fabs(p[1] - 0.5);
    return fmax(x, y) > 0.4 || fabs(floor(p[1] * cells) - floor(cells / 2)) < 0.5;
}

/* A back with teeth 1, 2, 3, .. vertices wide. */
static inline bool mask_comb(const double *p, int32_t dim, double cells)
{
    (void)dim;
    double start = 2, x = floor(p[0] * cells);
    for (double width = 1; start + width <= x; ++width)
        start += width + 2;
    return p[1] < 0.1 || x >= start;
}

/* A tube of radius 0.13 round a C. */
static inline bool mask_c_tube(const double *p, int32_t dim, double cells)
{
    (void)dim, (void)cells;
    const double x = p[0] - 0.5, y = p[1] - 0.5, z = p[2] - 0.5;
    return hypot(hypot(x, y) - 0.33, z) < 0.13 && fabs(atan2(y, x)) > 0.2618;
}

/* Two balls and a bar. */
static inline bool mask_dumbbell(const double *p, int32_t dim, double cells)
{
    (void)dim, (void)cells;
    const double a[3] = {0.22, 0.5, 0.5}, b[3] = {0.78, 0.5, 0.5};
    return mask_to_segment(p, a, a) < 0.22 || mask_to_segment(p, a, b) < 0.07 ||
           mask_to_segment(p, b, b) < 0.22;
}

/* Three legs from one point: 5 % of the cube. */
static inline bool mask_tripod(const double *p, int32_t dim, double cells)
{
    (void)dim, (void)cells;
    const double top[3] = {0.5, 0.5, 0.9};
    const double feet[3][3] = {{0.9, 0.5, 0.1}, {0.3, 0.85, 0.1}, {0.3, 0.15, 0.1}};
    for (int k = 0; k < 3; ++k)
        if (mask_to_segment(p, top, feet[k]) < 0.075)
            return true;
    return false;
}

/* A solid torus and a thin disc that closes its hole: Laplace's function has two saddles. */
static inline bool mask_drum(const double *p, int32_t dim, double cells)
{
    (void)dim, (void)cells;
    const double r = hypot(p[0] - 0.5, p[1] - 0.5), z = p[2] - 0.5;
    return hypot(r - 0.33, z) < 0.14 || (r < 0.33 && fabs(z) < 0.035);
}

/* A box with a blind square pit, where a tree in space is no cousin tree. */
static inline bool mask_pit(const double *p, int32_t dim, double cells)
{
    (void)dim, (void)cells;
    return !(p[0] > 7. / 16 && p[0] < 11. / 16 && p[1] > 7. / 16 && p[1] < 11. / 16 &&
             p[2] > 11. / 16);
}

/* All shapes but the ring with two ways and the comb. `dim` 0 for any dimension. */
typedef struct mask_kind {
    const char *name;
    int32_t dim;
    mask_shape shape;
} mask_kind;

enum { N_MASKS = 12 };

static inline mask_kind mask_number(int k)
{
    const mask_kind kinds[N_MASKS] = {
        {"box", 0, mask_box},       {"ball", 0, mask_ball},     {"L", 2, mask_l},
        {"C", 2, mask_c},           {"star", 2, mask_star},     {"serpentine", 2, mask_serpentine},
        {"rooms", 2, mask_rooms},   {"C tube", 3, mask_c_tube}, {"dumbbell", 3, mask_dumbbell},
        {"tripod", 3, mask_tripod}, {"drum", 3, mask_drum},     {"pit", 3, mask_pit}};
    return kinds[k];
}

/* `cells` vertices across the unit cube; ended by mask_free(). The array is NULL when there is no
 * memory. */
static inline mask mask_draw(mask_shape shape, int32_t dim, size_t cells)
{
    mask m = {.dim = dim, .n_vertices = 1};
    for (int32_t k = 0; k < dim; ++k)
        m.n_vertices *= m.shape[k] = cells + 2 * MASK_MARGIN;
    m.inside = calloc(m.n_vertices, 1);
    for (size_t v = 0; m.inside != NULL && v < m.n_vertices; ++v) {
        double p[ICC_MAX_DIM];
        size_t rest = v;
        bool within = true;
        for (int32_t k = 0; k < dim; ++k, rest /= cells + 2 * MASK_MARGIN) {
            const size_t i = rest % (cells + 2 * MASK_MARGIN);
            within = within && i >= MASK_MARGIN && i < cells + MASK_MARGIN;
            p[k] = ((double)i - MASK_MARGIN + 0.5) / (double)cells;
        }
        m.inside[v] = within && shape(p, dim, (double)cells);
        m.n_inside += m.inside[v];
    }
    return m;
}

static inline void mask_free(mask *m)
{
    free(m->inside);
    m->inside = NULL;
}

#endif

/* Warps of a square that fold, of five kinds, sampled on a lattice. */
#ifndef TESTS_WARPS_H
#define TESTS_WARPS_H

#include "random.h"

#include <check.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { WARP_FIELD, WARP_POLYNOMIAL, WARP_SWIRL, WARP_JITTER, WARP_SWAP, N_WARPS };

/* A lattice of n x n cells, of which some in the middle may be missing. */
typedef struct warp {
    size_t n, n_vertices, n_triangles, n_held;
    double *points, *images; /* 2 n_vertices */
    uint32_t *triangles;     /* 3 n_triangles, in both orientations */
    uint32_t held[2];
} warp;

static inline bool warp_is_hole(size_t n, size_t hole, size_t i, size_t j)
{
    return i >= (n - hole) / 2 && i < (n + hole) / 2 && j >= (n - hole) / 2 && j < (n + hole) / 2;
}

/* `hole`: so many cells are missing each way, 0 or at least 2. */
static inline warp warp_lattice(size_t n, size_t hole)
{
    const size_t room = (n + 1) * (n + 1);
    warp w = {.n = n,
              .points = malloc(2 * room * sizeof(double)),
              .images = malloc(2 * room * sizeof(double)),
              .triangles = malloc(6 * n * n * sizeof(uint32_t))};
    uint32_t *name = malloc(room * sizeof *name);
    ck_assert(w.points != NULL && w.images != NULL && w.triangles != NULL && name != NULL);
    memset(name, 0xff, room * sizeof *name);
    for (size_t cell = 0; cell < n * n; ++cell) {
        const size_t i = cell % n, j = cell / n, a = j * (n + 1) + i,
                     corner[4] = {0, 1, n + 1, n + 2};
        static const int SPLIT[2][6] = {{0, 1, 2, 2, 1, 3}, {0, 3, 1, 0, 2, 3}};
        if (warp_is_hole(n, hole, i, j))
            continue;
        for (int k = 0; k < 4; ++k)
            if (name[a + corner[k]] == UINT32_MAX) {
                double *p = w.points + 2 * w.n_vertices;
                p[0] = (double)((a + corner[k]) % (n + 1)) / (double)n;
                p[1] = (double)((a + corner[k]) / (n + 1)) / (double)n;
                name[a + corner[k]] = (uint32_t)w.n_vertices++;
            }
        for (int k = 0; k < 6; ++k)
            w.triangles[3 * w.n_triangles + (size_t)k] = name[a + corner[SPLIT[(i + j) % 2][k]]];
        w.n_triangles += 2;
    }
    memcpy(w.images, w.points, 2 * w.n_vertices * sizeof(double));
    free(name);
    return w;
}

static inline void warp_free(warp *w)
{
    free(w->points);
    free(w->images);
    free(w->triangles);
}

/* 0 at the frame, and 1 away from it. */
static inline double warp_fade(const double *p)
{
    return fmin(6 * fmin(fmin(p[0], 1 - p[0]), fmin(p[1], 1 - p[1])), 1);
}

static inline double warp_normal(random_source *r)
{
    double sum = 0;
    for (int k = 0; k < 12; ++k)
        sum += random_between(r, -0.5, 0.5);
    return sum;
}

/* A smooth displacement field: random waves. */
static inline void warp_field(warp *w, double amount, random_source *r)
{
    for (int k = 0; k < 24; ++k) {
        const double x = 10 * warp_normal(r), y = 10 * warp_normal(r), dx = warp_normal(r),
                     dy = warp_normal(r), phase = random_between(r, 0, 6.28);
        for (size_t v = 0; v < w->n_vertices; ++v) {
            const double *p = w->points + 2 * v;
            const double c = amount * warp_fade(p) * cos(x * p[0] + y * p[1] + phase) / 5;
            w->images[2 * v] += c * dx;
            w->images[2 * v + 1] += c * dy;
        }
    }
}

static inline void warp_polynomial(warp *w, double amount, random_source *r)
{
    const double a = amount * random_between(r, 30, 60), b = amount * random_between(r, 30, 60);
    for (size_t v = 0; v < w->n_vertices; ++v) {
        const double *p = w->points + 2 * v, x = p[0] - 0.5, y = p[1] - 0.5;
        const double s = 16 * p[0] * (1 - p[0]) * p[1] * (1 - p[1]);
        w->images[2 * v] += s * (a * x * x - b * y * y * y - 0.7 * a * x);
        w->images[2 * v + 1] += s * (b * x * y + a * y * y * y);
    }
}

static inline void warp_swirl(warp *w, double amount, random_source *r)
{
    const double turn = 60 * amount * (random_between(r, 0, 1) < 0.5 ? -1 : 1);
    for (size_t v = 0; v < w->n_vertices; ++v) {
        const double *p = w->points + 2 * v, x = p[0] - 0.5, y = p[1] - 0.5;
        const double t = turn * exp(-20 * (x * x + y * y)) * warp_fade(p);
        w->images[2 * v] = 0.5 + x * cos(t) - y * sin(t);
        w->images[2 * v + 1] = 0.5 + x * sin(t) + y * cos(t);
    }
}

/* Every vertex inside is moved at random. */
static inline void warp_jitter(warp *w, double amount, random_source *r)
{
    for (size_t v = 0; v < w->n_vertices; ++v)
        for (size_t d = 0; d < 2; ++d)
            if (warp_fade(w->points + 2 * v) > 0)
                w->images[2 * v + d] += 10 * amount * warp_normal(r) / (double)w->n;
}

static inline uint32_t warp_nearest_vertex(const warp *w, double x, double y)
{
    size_t best = 0;
    double least = HUGE_VAL;
    for (size_t v = 0; v < w->n_vertices; ++v) {
        const double dx = w->points[2 * v] - x, dy = w->points[2 * v + 1] - y;
        if (dx * dx + dy * dy < least) {
            best = v;
            least = dx * dx + dy * dy;
        }
    }
    return (uint32_t)best;
}

/* Two held vertices swap their places, smoothly. */
static inline void warp_swap(warp *w, random_source *r)
{
    w->n_held = 2;
    w->held[0] = warp_nearest_vertex(w, random_between(r, 0.3, 0.45), random_between(r, 0.3, 0.7));
    w->held[1] = warp_nearest_vertex(w, random_between(r, 0.55, 0.7), random_between(r, 0.3, 0.7));
    const double *a = w->points + 2 * (size_t)w->held[0], *b = w->points + 2 * (size_t)w->held[1];
    const double d[2] = {b[0] - a[0], b[1] - a[1]}, length2 = d[0] * d[0] + d[1] * d[1];
    for (size_t v = 0; v < w->n_vertices; ++v) {
        const double *p = w->points + 2 * v;
        const double s = (p[0] - a[0]) * (p[0] - a[0]) + (p[1] - a[1]) * (p[1] - a[1]);
        const double t = (p[0] - b[0]) * (p[0] - b[0]) + (p[1] - b[1]) * (p[1] - b[1]);
        const double g = (exp(-3 * s / length2) - exp(-3 * t / length2)) / (1 - exp(-3.));
        for (size_t k = 0; k < 2; ++k)
            w->images[2 * v + k] += warp_fade(p) * g * d[k];
    }
    memcpy(w->images + 2 * (size_t)w->held[0], b, 2 * sizeof *b);
    memcpy(w->images + 2 * (size_t)w->held[1], a, 2 * sizeof *a);
}

/* Puts the vertices around the hole back. */
static inline void warp_keep_hole(warp *w, size_t hole)
{
    const double low = (double)((w->n - hole) / 2) / (double)w->n,
                 high = (double)((w->n + hole) / 2) / (double)w->n;
    for (size_t v = 0; v < w->n_vertices; ++v) {
        const double *p = w->points + 2 * v;
        if (p[0] >= low && p[0] <= high && p[1] >= low && p[1] <= high)
            memcpy(w->images + 2 * v, p, 2 * sizeof *p);
    }
}

/* The images on the frame and around a hole stay. `amount` from 0.05, which folds little or not at
 * all, to 0.4. */
static inline warp warp_of(int kind, size_t n, size_t hole, double amount, uint64_t seed)
{
    warp w = warp_lattice(n, hole);
    random_source r = {seed};
    if (kind == WARP_FIELD)
        warp_field(&w, amount, &r);
    else if (kind == WARP_POLYNOMIAL)
        warp_polynomial(&w, amount, &r);
    else if (kind == WARP_SWIRL)
        warp_swirl(&w, amount, &r);
    else if (kind == WARP_JITTER)
        warp_jitter(&w, amount, &r);
    else
        warp_swap(&w, &r);
    if (hole > 0)
        warp_keep_hole(&w, hole);
    return w;
}

#endif

/* Control points for which a thin plate folds: random problems of six kinds, with 6 to 300 points in
 * the unit square. */
#ifndef TESTS_FOLDING_POINTS_H
#define TESTS_FOLDING_POINTS_H

#include "random.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { FOLD_SWAP, FOLD_PUSH, FOLD_SHEAR, FOLD_ROWS, FOLD_FACE, FOLD_RANDOM, N_FOLD_KINDS };
enum { FOLD_MOST = 320 };

typedef struct folding_points {
    size_t n;
    double points[2 * FOLD_MOST], targets[2 * FOLD_MOST];
} folding_points;

/* Adds a point that stays, at first. */
static inline void fold_add(folding_points *f, double x, double y)
{
    f->points[2 * f->n] = f->targets[2 * f->n] = x;
    f->points[2 * f->n + 1] = f->targets[2 * f->n + 1] = y;
    ++f->n;
}

/* The distance to the nearest of the first `n` other points, which becomes *other. */
static inline double fold_nearest(const folding_points *f, size_t n, size_t i, size_t *other)
{
    double least = HUGE_VAL;
    for (size_t k = 0; k < n; ++k) {
        const double distance =
            hypot(f->points[2 * i] - f->points[2 * k], f->points[2 * i + 1] - f->points[2 * k + 1]);
        if (k != i && distance < least) {
            least = distance;
            *other = k;
        }
    }
    return least;
}

/* Points that are not too close to each other. */
static inline void fold_scatter(folding_points *f, random_source *r)
{
    const size_t n = (size_t)(6 * pow(50, random_unit(r)));
    while (f->n < n) {
        size_t other = 0;
        int tries = 0;
        fold_add(f, 0, 0);
        do {
            f->targets[2 * f->n - 2] = f->points[2 * f->n - 2] = random_between(r, 0.03, 0.97);
            f->targets[2 * f->n - 1] = f->points[2 * f->n - 1] = random_between(r, 0.03, 0.97);
        } while (fold_nearest(f, f->n, f->n - 1, &other) < 0.35 / sqrt((double)n) && ++tries < 200);
    }
}

static inline size_t fold_pick(const folding_points *f, random_source *r)
{
    return (size_t)random_below(r, (int)f->n);
}

/* Neighbours change places. */
static inline void fold_swap(folding_points *f, random_source *r)
{
    fold_scatter(f, r);
    for (int k = 0; k <= random_below(r, 1 + (int)f->n / 10); ++k) {
        const size_t a = fold_pick(f, r);
        size_t b = a;
        double place[2];
        (void)fold_nearest(f, f->n, a, &b);
        memcpy(place, f->targets + 2 * a, sizeof place);
        memcpy(f->targets + 2 * a, f->targets + 2 * b, sizeof place);
        memcpy(f->targets + 2 * b, place, sizeof place);
    }
}

/* Points are pushed past their neighbours. */
static inline void fold_push(folding_points *f, random_source *r)
{
    fold_scatter(f, r);
    for (int k = 0; k <= random_below(r, 1 + (int)f->n / 7); ++k) {
        const size_t a = fold_pick(f, r);
        size_t other;
        const double angle = random_between(r, 0, 6.28),
                     far = random_between(r, 0.6, 1.8) * fold_nearest(f, f->n, a, &other);
        f->targets[2 * a] += far * cos(angle);
        f->targets[2 * a + 1] += far * sin(angle);
    }
}

/* The upper part slides over the lower one. */
static inline void fold_shear(folding_points *f, random_source *r)
{
    fold_scatter(f, r);
    const double y = random_between(r, 0.3, 0.7), width = random_between(r, 0.01, 0.06),
                 far = random_between(r, 0.1, 0.35);
    for (size_t i = 0; i < f->n; ++i)
        f->targets[2 * i] += far * tanh((f->points[2 * i + 1] - y) / width);
}

/* Two rows slide along each other, inside four corners that stay. */
static inline void fold_rows(folding_points *f, random_source *r)
{
    const int m = 3 + random_below(r, 60);
    const double gap = random_between(r, 0.02, 0.07);
    const double far = random_between(r, 0.3, 3) / (double)(m - 1);
    for (int row = 0; row < 2; ++row)
        for (int i = 0; i < m; ++i) {
            fold_add(f, 0.1 + 0.8 * i / (m - 1), row == 0 ? 0.5 - gap : 0.5 + gap);
            f->targets[2 * f->n - 2] += row == 0 ? far : -far;
        }
    for (int k = 0; k < 4; ++k)
        fold_add(f, k % 2, k / 2);
}

static inline void fold_ellipse(folding_points *f, int n, double x, double y, double a, double b,
                                double by)
{
    for (int i = 0; i < n; ++i) {
        const double t = 6.2831853 * i / n;
        fold_add(f, x + a * cos(t), y + b * sin(t));
        f->targets[2 * f->n - 1] += by * sin(t);
    }
}

/* Landmarks of a face that turns, shuts its eyes and opens its mouth. */
static inline void fold_face(folding_points *f, random_source *r)
{
    const double shut = -0.035 * random_between(r, 0.6, 1.4), open = random_between(r, 0.02, 0.14),
                 turn = random_between(r, -0.15, 0.15);
    for (int i = 0; i < 17; ++i)
        fold_add(f, 0.5 + 0.35 * cos(3.1416 * (1 + i / 16.)),
                 0.55 + 0.4 * sin(3.1416 * (1 + i / 16.)));
    fold_ellipse(f, 8, 0.35, 0.62, 0.07, 0.035, shut);
    fold_ellipse(f, 8, 0.65, 0.62, 0.07, 0.035, shut);
    fold_ellipse(f, 12, 0.5, 0.35, 0.12, 0.03, open);
    for (int i = 0; i < 4; ++i)
        fold_add(f, 0.5, 0.62 - 0.04 * i);
    for (size_t i = 0; i < f->n; ++i) {
        const double x = f->points[2 * i], y = f->points[2 * i + 1];
        f->targets[2 * i] +=
            turn * (0.5 - fabs(x - 0.5)) * (y - 0.2) + random_between(r, -0.006, 0.006);
        f->targets[2 * i + 1] += random_between(r, -0.006, 0.006);
    }
}

static inline void fold_random(folding_points *f, random_source *r)
{
    const double share = random_between(r, 0.5, 1.7);
    fold_scatter(f, r);
    for (size_t i = 0; i < f->n; ++i) {
        size_t other;
        const double far = share * fold_nearest(f, f->n, i, &other);
        for (size_t d = 0; d < 2; ++d)
            f->targets[2 * i + d] += random_between(r, -far, far);
    }
}

static inline folding_points folding_points_of(int kind, uint64_t seed)
{
    folding_points f = {.n = 0};
    random_source r = {1000 * (uint64_t)kind + seed};
    if (kind == FOLD_SWAP)
        fold_swap(&f, &r);
    else if (kind == FOLD_PUSH)
        fold_push(&f, &r);
    else if (kind == FOLD_SHEAR)
        fold_shear(&f, &r);
    else if (kind == FOLD_ROWS)
        fold_rows(&f, &r);
    else if (kind == FOLD_FACE)
        fold_face(&f, &r);
    else
        fold_random(&f, &r);
    return f;
}

#endif

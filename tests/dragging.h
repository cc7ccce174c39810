/* Points dragged about in a square, and whether a map still takes paths round them as it should.
 *
 * What a path from the left side to the right one passes, above or below, is its word: the rays
 * that go straight up from the points, in the order in which the path crosses them, where crossings
 * forth and back of a ray in turn cancel out. While points move, the words of the paths' images
 * change only where one point passes above another (E. Artin, Theory of braids, 1947). */
#ifndef TESTS_DRAGGING_H
#define TESTS_DRAGGING_H

#include "flat_mesh.h"
#include <icc/icc.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "random.h"

enum { DRAG_MOST = 24, DRAG_PATHS = 5, DRAG_LETTERS = 1 << 16 };

/* Points that move on circles of one size, not at the same time at the same place. */
typedef struct drag {
    int n;
    double travel, start[DRAG_MOST][2], phase[DRAG_MOST];
} drag;

static inline void drag_place(const drag *d, int k, double angle, double p[2])
{
    const double r = 0.5 * d->travel;
    p[0] = d->start[k][0] + r * (sin(angle + d->phase[k]) - sin(d->phase[k]));
    p[1] = d->start[k][1] + r * (cos(angle + d->phase[k]) - cos(d->phase[k]));
}

/* Whether point k stays off the sides and off those before it. */
static inline bool drag_fits(const drag *d, int k, double gap)
{
    for (int step = 0; step < 240; ++step) {
        const double angle = 6.28318530717958647692 * step / 240;
        double p[2], q[2];
        drag_place(d, k, angle, p);
        if (fmin(fmin(p[0], 1 - p[0]), fmin(p[1], 1 - p[1])) < 2 * gap)
            return false;
        for (int i = 0; i < k; ++i) {
            drag_place(d, i, angle, q);
            if (hypot(p[0] - q[0], p[1] - q[1]) < gap)
                return false;
        }
    }
    return true;
}

/* They start `apart` from each other, and stay `gap` apart. */
static inline drag drag_create(int n, double travel, double apart, double gap, uint64_t seed)
{
    random_source r = {seed};
    drag d = {.n = n, .travel = travel};
    for (int k = 0; k < n;) {
        bool fits = true;
        for (int i = 0; i < 2; ++i)
            d.start[k][i] = random_between(&r, apart / 2, 1 - apart / 2);
        d.phase[k] = random_between(&r, 0, 6.28318530717958647692);
        for (int i = 0; i < k; ++i)
            fits =
                fits && hypot(d.start[k][0] - d.start[i][0], d.start[k][1] - d.start[i][1]) > apart;
        k += fits && drag_fits(&d, k, gap);
    }
    return d;
}

/* The square with the points at an angle. */
static inline icc_status drag_domain(icc_domain **out, const drag *d, double angle, icc_error *err)
{
    static const double SQUARE[8] = {0, 0, 1, 0, 1, 1, 0, 1};
    double places[DRAG_MOST][2];
    icc_feature features[DRAG_MOST];
    for (int k = 0; k < d->n; ++k) {
        drag_place(d, k, angle, places[k]);
        features[k] = (icc_feature){sizeof *features, ICC_FEATURE_POINT, 1, places[k], 0, 0, NULL};
    }
    return icc_domain_create_features(out, 4, SQUARE, (size_t)d->n, features, NULL, err);
}

/* ---- words ---- */

/* Letters: 1 + point from left to right across its ray, -1 - point back. */
typedef struct drag_word {
    size_t n; /* DRAG_LETTERS: it has become too long */
    int letter[DRAG_LETTERS];
} drag_word;

static inline void drag_add(drag_word *w, int letter)
{
    if (w->n == DRAG_LETTERS)
        return;
    if (w->n > 0 && w->letter[w->n - 1] == -letter)
        --w->n;
    else
        w->letter[w->n++] = letter;
}

static inline bool drag_same(const drag_word *a, const drag_word *b)
{
    return a->n == b->n && memcmp(a->letter, b->letter, a->n * sizeof *a->letter) == 0;
}

/* What becomes of a word when one point passes below another. */
static inline void drag_swap(drag_word *w, int upper, int lower, bool upper_goes_right)
{
    static drag_word old;
    const int l = upper_goes_right ? 1 + lower : -1 - lower;
    old = *w;
    w->n = 0;
    for (size_t i = 0; i < old.n; ++i)
        if (abs(old.letter[i]) == 1 + upper) {
            drag_add(w, l);
            drag_add(w, old.letter[i]);
            drag_add(w, -l);
        } else
            drag_add(w, old.letter[i]);
}

typedef struct drag_pass {
    double when;
    int i, j;
} drag_pass;

static inline int drag_by_time(const void *a, const void *b)
{
    const double x = ((const drag_pass *)a)->when, y = ((const drag_pass *)b)->when;
    return (x > y) - (x < y);
}

/* What becomes of words while all points go straight from their places at one angle to another. */
static inline void drag_move(const drag *d, double from, double to, size_t n, drag_word *words)
{
    drag_pass pass[DRAG_MOST * DRAG_MOST];
    size_t n_passes = 0;
    for (int i = 0; i < d->n; ++i)
        for (int j = 0; j < i; ++j) {
            double p[2][2], q[2][2];
            drag_place(d, i, from, p[0]);
            drag_place(d, i, to, p[1]);
            drag_place(d, j, from, q[0]);
            drag_place(d, j, to, q[1]);
            const double before = q[0][0] - p[0][0], after = q[1][0] - p[1][0];
            if ((before > 0) == (after > 0))
                continue;
            const double t = before / (before - after);
            const double y = p[0][1] + t * (p[1][1] - p[0][1]) - q[0][1] - t * (q[1][1] - q[0][1]);
            pass[n_passes++] = (drag_pass){t, y > 0 ? i : j, y > 0 ? j : i};
        }
    qsort(pass, n_passes, sizeof *pass, drag_by_time);
    for (size_t k = 0; k < n_passes; ++k) {
        double u[2], l[2];
        drag_place(d, pass[k].i, from, u);
        drag_place(d, pass[k].j, from, l);
        for (size_t w = 0; w < n; ++w)
            drag_swap(&words[w], pass[k].i, pass[k].j, u[0] < l[0]);
    }
}

/* ---- images of paths ---- */

typedef struct drag_piece {
    double begin, from[2], to[2];
} drag_piece;

static inline int drag_by_begin(const void *a, const void *b)
{
    const double x = ((const drag_piece *)a)->begin, y = ((const drag_piece *)b)->begin;
    return (x > y) - (x < y);
}

/* The piece of a level path in a triangle, left end first. */
static inline bool drag_clip(const double *p[3], const double *q[3], double level,
                             drag_piece *piece)
{
    double x[2], image[2][2];
    int n = 0;
    for (int k = 0; k < 3; ++k) {
        const int l = (k + 1) % 3;
        if ((p[k][1] < level) == (p[l][1] < level))
            continue;
        const double t = (level - p[k][1]) / (p[l][1] - p[k][1]);
        x[n] = p[k][0] + t * (p[l][0] - p[k][0]);
        for (int i = 0; i < 2; ++i)
            image[n][i] = q[k][i] + t * (q[l][i] - q[k][i]);
        ++n;
    }
    if (n < 2)
        return false;
    const int first = x[0] < x[1] ? 0 : 1;
    piece->begin = 0.5 * (x[0] + x[1]);
    memcpy(piece->from, image[first], sizeof piece->from);
    memcpy(piece->to, image[1 - first], sizeof piece->to);
    return true;
}

/* The word of a piece: the rays it crosses, sorted. */
static inline void drag_cross(drag_word *w, const drag_piece *piece, int n, double (*places)[2])
{
    drag_pass pass[DRAG_MOST];
    size_t m = 0;
    const double *a = piece->from, *b = piece->to;
    for (int k = 0; k < n; ++k) {
        if ((a[0] < places[k][0]) == (b[0] < places[k][0]))
            continue;
        const double t = (places[k][0] - a[0]) / (b[0] - a[0]);
        if (a[1] + t * (b[1] - a[1]) > places[k][1])
            pass[m++] = (drag_pass){t, a[0] < b[0] ? 1 + k : -1 - k, 0};
    }
    qsort(pass, m, sizeof *pass, drag_by_time);
    for (size_t k = 0; k < m; ++k)
        drag_add(w, pass[k].i);
}

static inline double drag_level(int path)
{
    return (path + 0.5 + 1e-4) / DRAG_PATHS;
}

/* The words of the images of level paths through the source. */
static inline void drag_words(const icc_map *map, const drag *d, double angle, drag_word *words)
{
    icc_map_info info = {.size = sizeof info};
    double places[DRAG_MOST][2];
    (void)icc_map_get_info(map, &info);
    double *points = malloc(4 * info.n_vertices * sizeof *points);
    uint32_t *triangles = malloc(3 * info.n_simplices * sizeof *triangles);
    drag_piece *pieces = malloc(info.n_simplices * sizeof *pieces);
    if (points == NULL || triangles == NULL || pieces == NULL)
        abort();
    double *images = points + 2 * info.n_vertices;
    (void)flat_get_mesh(map, points, images, triangles);
    for (int k = 0; k < d->n; ++k)
        drag_place(d, k, angle, places[k]);
    for (int path = 0; path < DRAG_PATHS; ++path) {
        size_t n = 0;
        for (size_t t = 0; t < info.n_simplices; ++t) {
            const double *p[3], *q[3];
            for (int k = 0; k < 3; ++k) {
                p[k] = points + 2 * (size_t)triangles[3 * t + (size_t)k];
                q[k] = images + 2 * (size_t)triangles[3 * t + (size_t)k];
            }
            n += drag_clip(p, q, drag_level(path), &pieces[n]);
        }
        qsort(pieces, n, sizeof *pieces, drag_by_begin);
        words[path].n = 0;
        for (size_t k = 0; k < n; ++k)
            drag_cross(&words[path], &pieces[k], d->n, places);
    }
    free(points);
    free(triangles);
    free(pieces);
}

#endif

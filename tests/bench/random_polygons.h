/* Random simple polygons of many kinds. Every one follows from its seed alone. */
#ifndef TESTS_BENCH_RANDOM_POLYGONS_H
#define TESTS_BENCH_RANDOM_POLYGONS_H

#include "bench.h"
#include "random.h"

#include <stdbool.h>

enum { POLYGON_MOST = 200 };

typedef struct polygon {
    size_t n;
    double xy[POLYGON_MOST][2];
} polygon;

static const double POLYGON_TURN = 6.28318530717958647692;

/* Log-uniform. */
static inline double polygon_scale(random_source *r, double low, double high)
{
    return low * exp(random_unit(r) * log(high / low));
}

static inline void polygon_add(polygon *p, double x, double y)
{
    p->xy[p->n][0] = x;
    p->xy[p->n][1] = y;
    ++p->n;
}

static inline void polygon_random_point(double c[2], random_source *r)
{
    c[0] = random_unit(r);
    c[1] = random_unit(r);
}

static inline void polygon_add_random(polygon *p, random_source *r)
{
    double c[2];
    polygon_random_point(c, r);
    polygon_add(p, c[0], c[1]);
}

static inline void polygon_insert(polygon *p, size_t at, double x, double y)
{
    memmove(p->xy[at + 1], p->xy[at], (p->n - at) * sizeof *p->xy);
    p->xy[at][0] = x;
    p->xy[at][1] = y;
    ++p->n;
}

/* Plain doubles will do: what comes out is checked exactly before it is used. */
static inline double polygon_side(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static inline bool polygon_cross(const double *a, const double *b, const double *c, const double *d)
{
    return polygon_side(a, b, c) * polygon_side(a, b, d) <= 0 &&
           polygon_side(c, d, a) * polygon_side(c, d, b) <= 0;
}

/* Seen from the origin every boundary point once: random angles, random radii. */
static inline void polygon_star(polygon *p, size_t n, random_source *r)
{
    double angle[POLYGON_MOST], sum = 0;
    for (size_t k = 0; k < n; ++k)
        sum += angle[k] = polygon_scale(r, 0.01, 1);
    double a = 0;
    for (size_t k = 0; k < n; ++k) {
        const double radius = polygon_scale(r, 0.03, 1);
        polygon_add(p, radius * cos(a * POLYGON_TURN / sum), radius * sin(a * POLYGON_TURN / sum));
        a += angle[k];
    }
}

static inline void polygon_reverse(polygon *p, size_t first, size_t last)
{
    for (; first < last; ++first, --last) {
        const double x = p->xy[first][0], y = p->xy[first][1];
        memcpy(p->xy[first], p->xy[last], sizeof *p->xy);
        p->xy[last][0] = x;
        p->xy[last][1] = y;
    }
}

/* Random points in random order; crossing edges are swapped until none are left, which each swap
 * brings nearer, since it shortens the ring. */
static inline void polygon_untangled(polygon *p, size_t n, random_source *r)
{
    for (size_t k = 0; k < n; ++k)
        polygon_add_random(p, r);
    for (bool crossed = true; crossed;) {
        crossed = false;
        for (size_t i = 0; i + 2 < n; ++i)
            for (size_t j = i + 2; j < n; ++j) {
                if (i == 0 && j == n - 1)
                    continue;
                if (polygon_cross(p->xy[i], p->xy[i + 1], p->xy[j], p->xy[(j + 1) % n])) {
                    polygon_reverse(p, i + 1, j);
                    crossed = true;
                }
            }
    }
}

/* Whether the segment from vertex k to c meets another edge. */
static inline bool polygon_blocked(const polygon *p, size_t k, const double *c)
{
    for (size_t i = 0; i < p->n; ++i) {
        const size_t j = (i + 1) % p->n;
        if (i != k && j != k && polygon_cross(p->xy[k], c, p->xy[i], p->xy[j]))
            return true;
    }
    return false;
}

/* Random points, each put into a random edge that it can be joined to. Makes deep, narrow bays. */
static inline void polygon_grown(polygon *p, size_t n, random_source *r)
{
    for (int k = 0; k < 3; ++k)
        polygon_add_random(p, r);
    for (size_t tries = 0; p->n < n && tries < 40 * n; ++tries) {
        double c[2];
        polygon_random_point(c, r);
        const size_t start = (size_t)random_below(r, (int)p->n);
        for (size_t m = 0; m < p->n; ++m) {
            const size_t i = (start + m) % p->n, j = (i + 1) % p->n;
            if (!polygon_blocked(p, i, c) && !polygon_blocked(p, j, c)) {
                polygon_insert(p, i + 1, c[0], c[1]);
                break;
            }
        }
    }
}

/* A band that winds inwards, of changing width. */
static inline void polygon_spiral(polygon *p, size_t n, random_source *r)
{
    const size_t pieces = n / 2;
    const double turns = random_between(r, 0.5, 4), width = polygon_scale(r, 0.02, 0.8);
    const double rough = random_between(r, 0, 0.4);
    for (size_t k = 0; k < pieces; ++k) {
        const double share = (double)k / (double)(pieces - 1);
        const double a = POLYGON_TURN * turns * share, radius = 0.5 + turns * share;
        const double outer = radius + width * (1 - rough * random_unit(r));
        polygon_insert(p, k, outer * cos(a), outer * sin(a));
        polygon_insert(p, k + 1, radius * cos(a), radius * sin(a));
    }
}

/* A back with teeth upwards; gaps may be narrow. Integer lengths every other time, for ties. */
static inline void polygon_comb(polygon *p, size_t n, random_source *r)
{
    const size_t teeth = (n - 2) / 4 > 0 ? (n - 2) / 4 : 1;
    const bool whole = random_below(r, 2) == 0;
    const double gap = polygon_scale(r, 1e-6, 1), tooth = polygon_scale(r, 1e-3, 1);
    double x = 0;
    for (size_t k = 0; k < teeth && p->n + 6 <= n; ++k) {
        const double length = whole ? 1 + random_below(r, 6) : random_between(r, 0.1, 10);
        polygon_add(p, x, whole ? 1 : 0.3);
        polygon_add(p, x, length + 1);
        polygon_add(p, x + (whole ? 1 : tooth), length + 1);
        polygon_add(p, x + (whole ? 1 : tooth), whole ? 1 : 0.3);
        x += whole ? 2 : tooth + gap;
    }
    polygon_add(p, x, 0);
    polygon_add(p, 0, 0);
    polygon_reverse(p, 0, p->n - 1);
}

/* A round body with up to 24 spikes of about 0.01 degrees. */
static inline void polygon_spikes(polygon *p, size_t n, random_source *r)
{
    const size_t spikes = n / 3 < 24 ? n / 3 : 24;
    const double half = polygon_scale(r, 0.002, 0.05) / 360 * POLYGON_TURN;
    for (size_t k = 0; k < spikes; ++k) {
        const double a = POLYGON_TURN * ((double)k + 0.4 * random_unit(r)) / (double)spikes;
        const double tip = random_between(r, 1.2, 4);
        for (int j = -1; j <= 1; ++j) {
            const double radius = j == 0 ? tip : 1;
            polygon_add(p, radius * cos(a + j * half), radius * sin(a + j * half));
        }
    }
}

/* Columns of whole heights on a common line: everything is axis-parallel and full of ties. */
static inline void polygon_columns(polygon *p, size_t n, random_source *r)
{
    const size_t columns = (n - 2) / 2 > 0 ? (n - 2) / 2 : 1;
    int last = 0;
    for (size_t k = 0; k < columns && p->n + 4 <= n; ++k) {
        int height = 1 + random_below(r, 12);
        if (height == last)
            ++height;
        polygon_add(p, (double)k, height);
        polygon_add(p, (double)k + 1, height);
        last = height;
    }
    polygon_add(p, (double)((p->n) / 2), 0);
    polygon_add(p, 0, 0);
    polygon_reverse(p, 0, p->n - 1);
}

/* A coast: the longest edges get a middle that is moved sideways. */
static inline void polygon_coast(polygon *p, size_t n, random_source *r)
{
    const double rough = random_between(r, 0.05, 0.35);
    polygon_add(p, 0, 0);
    polygon_add(p, 1, 0);
    polygon_add(p, 0.5, 0.9);
    while (p->n < n) {
        size_t longest = 0;
        double most = 0;
        for (size_t k = 0; k < p->n; ++k) {
            const double *a = p->xy[k], *b = p->xy[(k + 1) % p->n];
            const double length = hypot(b[0] - a[0], b[1] - a[1]);
            if (length > most) {
                most = length;
                longest = k;
            }
        }
        const double *a = p->xy[longest], *b = p->xy[(longest + 1) % p->n];
        const double side = random_between(r, -rough, rough);
        polygon_insert(p, longest + 1, (a[0] + b[0]) / 2 - side * (b[1] - a[1]),
                       (a[1] + b[1]) / 2 + side * (b[0] - a[0]));
    }
}

/* Stretches by up to 1000 in a random direction. */
static inline void polygon_stretch(polygon *p, double stretch, random_source *r)
{
    const double a = random_between(r, 0, POLYGON_TURN), c = cos(a), s = sin(a);
    for (size_t k = 0; k < p->n; ++k) {
        const double x = c * p->xy[k][0] + s * p->xy[k][1];
        const double y = c * p->xy[k][1] - s * p->xy[k][0];
        p->xy[k][0] = stretch * x;
        p->xy[k][1] = y;
    }
}

/* Puts vertices on random edges, as near to one end as 1 : unevenness, until there are n. */
static inline void polygon_pad(polygon *p, size_t n, double unevenness, random_source *r)
{
    while (p->n < n) {
        const size_t k = (size_t)random_below(r, (int)p->n);
        const double *a = p->xy[k], *b = p->xy[(k + 1) % p->n];
        double share = 0.5 * polygon_scale(r, 1 / unevenness, 1);
        if (random_below(r, 2) == 0)
            share = 1 - share;
        polygon_insert(p, k + 1, a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]));
    }
}

enum { POLYGON_KINDS = 10 };

static inline const char *polygon_kind_name(int kind)
{
    static const char *const NAMES[POLYGON_KINDS] = {"star",   "untangled", "grown",   "spiral",
                                                     "comb",   "spikes",    "columns", "coast",
                                                     "needle", "splinter"};
    return NAMES[kind];
}

static inline void polygon_draw(polygon *p, int kind, size_t n, random_source *r)
{
    static void (*const DRAW[])(polygon *, size_t, random_source *) = {
        polygon_star,   polygon_untangled, polygon_grown, polygon_spiral, polygon_comb,
        polygon_spikes, polygon_columns,   polygon_coast, polygon_star,   polygon_untangled};
    p->n = 0;
    if (n < 9 && (kind == 3 || kind == 5))
        kind = 0;
    DRAW[kind](p, n, r);
    if (kind >= 8)
        polygon_stretch(p, 1000, r);
}

/* A simple polygon of n vertices, n >= 5, counter-clockwise. Of `n` only `n_corners` are drawn, the
 * others are put onto its edges (needed to make pairs). NULL when none was found. */
static inline icc_domain *polygon_domain(polygon *p, int kind, size_t n_corners, size_t n,
                                         double unevenness, random_source *r)
{
    for (int tries = 0; tries < 100; ++tries) {
        icc_domain *domain;
        polygon_draw(p, kind, n_corners, r);
        polygon_pad(p, n, unevenness, r);
        if (icc_domain_create(&domain, 2, p->n, p->xy[0], 0, NULL, NULL, NULL) != ICC_OK)
            continue;
        icc_domain_info info = {.size = sizeof info};
        (void)icc_domain_get_info(domain, &info);
        if (info.orientation > 0)
            return domain;
        icc_domain_free(domain);
        polygon_reverse(p, 0, p->n - 1);
        if (icc_domain_create(&domain, 2, p->n, p->xy[0], 0, NULL, NULL, NULL) == ICC_OK)
            return domain;
    }
    return NULL;
}

#endif

/* Random pairs of domains with up to 4 holes, 8 points and 3 lines inside, in unrelated places.
 * Every one follows from its seed alone. */
#ifndef TESTS_FEATURE_MIXES_H
#define TESTS_FEATURE_MIXES_H

#include "icc/icc.h"

#include "random.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum {
    MIX_HOLES = 4,
    MIX_LINES = 3,
    MIX_POINTS = 8,
    MIX_FEATURES = MIX_HOLES + MIX_LINES + MIX_POINTS,
    MIX_OUTER = 16,  /* vertices of the outer ring at most, */
    MIX_FEATURE = 8, /* and of a feature */
    MIX_VERTICES = MIX_OUTER + MIX_FEATURE * MIX_FEATURES
};

static const double MIX_TURN = 6.28318530717958647692;

typedef struct feature_mix {
    size_t n_outer, n_features, n_vertices;
    int32_t kind[MIX_FEATURES];
    size_t size[MIX_FEATURES];            /* of each feature: its vertices */
    double vertices[2][2 * MIX_VERTICES]; /* the outer ring's, then the features' */
    double offset;                        /* how far from zero all of it is */
    double digits;                        /* 0, or features crowd: as near as so many say */
    icc_domain *domain[2];
} feature_mix;

/* The first n features with the outer ring. */
static inline icc_status mix_domain(icc_domain **out, const feature_mix *m, int side, size_t n)
{
    icc_feature features[MIX_FEATURES] = {{0}};
    const double *own = m->vertices[side] + 2 * m->n_outer;
    for (size_t f = 0; f < n; ++f) {
        features[f] = (icc_feature){.size = sizeof *features,
                                    .kind = m->kind[f],
                                    .n_vertices = m->size[f],
                                    .vertices = own};
        own += 2 * m->size[f];
    }
    return icc_domain_create_features(out, m->n_outer, m->vertices[side], n, features, NULL, NULL);
}

/* n vertices round a centre, counter-clockwise, at radii down to `least`. */
static inline void mix_draw_ring(double *xy, size_t n, const double centre[2], double radius,
                                 double least, random_source *r)
{
    const double first = random_between(r, 0, MIX_TURN);
    for (size_t k = 0; k < n; ++k) {
        const double angle = first + MIX_TURN * ((double)k + 0.8 * random_unit(r)) / (double)n;
        const double own = radius * random_between(r, least, 1);
        xy[2 * k] = centre[0] + own * cos(angle);
        xy[2 * k + 1] = centre[1] + own * sin(angle);
    }
}

static inline void mix_draw_outer(double *xy, size_t n, bool is_square, double offset,
                                  random_source *r)
{
    const double centre[2] = {offset, offset};
    if (!is_square) {
        mix_draw_ring(xy, n, centre, 1, 0.3, r);
        return;
    }
    for (size_t k = 0; k < n; ++k) {
        static const double corner[5][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
        const size_t edge = 4 * k / n, first = (edge * n + 3) / 4, next = ((edge + 1) * n + 3) / 4;
        const double share = (double)(k - first) / (double)(next - first);
        for (size_t d = 0; d < 2; ++d)
            xy[2 * k + d] = offset + (1 - share) * corner[edge][d] + share * corner[edge + 1][d];
    }
}

/* Anywhere, or beside one of the first n vertices. */
static inline void mix_draw_place(double at[2], const feature_mix *m, int side, size_t n,
                                  random_source *r)
{
    at[0] = m->offset + random_between(r, -1, 1);
    at[1] = m->offset + random_between(r, -1, 1);
    if (!(m->digits > 0))
        return;
    const double *beside = m->vertices[side] + 2 * (size_t)random_below(r, (int)n);
    const double off = pow(10, -random_between(r, 0, m->digits));
    for (size_t k = 0; k < 2; ++k)
        at[k] = beside[k] + off * (at[k] - m->offset);
}

static inline void mix_draw_feature(double *xy, int32_t kind, size_t n, double size, double at[2],
                                    random_source *r)
{
    if (kind == ICC_FEATURE_HOLE) {
        mix_draw_ring(xy, n, at, size, 0.3, r);
        return;
    }
    double angle = random_between(r, 0, MIX_TURN);
    for (size_t k = 0; k < n; ++k) {
        memcpy(xy + 2 * k, at, 2 * sizeof *at);
        angle += random_between(r, -2, 2);
        at[0] += size * cos(angle);
        at[1] += size * sin(angle);
    }
}

/* One feature after the other at random until it fits, smaller with each try. */
static inline void mix_draw_side(feature_mix *m, int side, bool is_square, random_source *r)
{
    mix_draw_outer(m->vertices[side], m->n_outer, is_square, m->offset, r);
    double *own = m->vertices[side] + 2 * m->n_outer;
    while (mix_domain(&m->domain[side], m, side, 0) != ICC_OK)
        mix_draw_outer(m->vertices[side], m->n_outer, is_square, m->offset, r);
    for (size_t f = 0; f < m->n_features; own += 2 * m->size[f++]) {
        double size = random_between(r, 0.1, 0.6);
        do {
            icc_domain_free(m->domain[side]);
            double at[2];
            mix_draw_place(at, m, side, (size_t)(own - m->vertices[side]) / 2, r);
            mix_draw_feature(own, m->kind[f], m->size[f], size, at, r);
            size *= 0.9;
        } while (mix_domain(&m->domain[side], m, side, f + 1) != ICC_OK);
    }
}

/* As far apart as chance has it, or `digits` decimals together. */
static inline void mix_create_crowded(feature_mix *m, uint64_t seed, double digits)
{
    random_source r = {seed};
    *m = (feature_mix){.n_outer = 4 + (size_t)random_below(&r, MIX_OUTER - 3),
                       .offset = random_below(&r, 4) == 0 ? 100 : 0,
                       .digits = digits};
    const int n_holes = random_below(&r, MIX_HOLES + 1), n_lines = random_below(&r, MIX_LINES + 1);
    const int n_points = random_below(&r, MIX_POINTS + 1);
    for (int k = 0; k < n_holes + n_lines + n_points; ++k) {
        const int32_t kind = k < n_holes             ? ICC_FEATURE_HOLE
                             : k < n_holes + n_lines ? ICC_FEATURE_LINE
                                                     : ICC_FEATURE_POINT;
        static const int least[] = {0, 3, 2, 1};
        m->kind[m->n_features] = kind;
        m->size[m->n_features++] =
            kind == ICC_FEATURE_POINT
                ? 1
                : (size_t)(least[kind] + random_below(&r, MIX_FEATURE - least[kind] + 1));
    }
    m->n_vertices = m->n_outer;
    for (size_t f = 0; f < m->n_features; ++f)
        m->n_vertices += m->size[f];
    for (int side = 0; side < 2; ++side)
        mix_draw_side(m, side, random_below(&r, 2) == 0, &r);
}

static inline void mix_create(feature_mix *m, uint64_t seed)
{
    mix_create_crowded(m, seed, 0);
}

static inline void mix_free(feature_mix *m)
{
    icc_domain_free(m->domain[0]);
    icc_domain_free(m->domain[1]);
}

/* How many coordinates of vertices do not go to those of the target's, or back, bit for bit. */
static inline size_t mix_count_off(const feature_mix *m, const icc_map *map, bool is_swapped)
{
    double found[2 * MIX_VERTICES];
    size_t n_off = 0;
    for (int side = 0; side < 2; ++side) {
        const double *from = m->vertices[side], *to = m->vertices[1 - side];
        const icc_status status =
            (side == 0) != is_swapped
                ? icc_map_apply(map, m->n_vertices, from, found, NULL, NULL, NULL)
                : icc_map_apply_inverse(map, m->n_vertices, from, found, NULL, NULL, NULL);
        if (status != ICC_OK)
            return SIZE_MAX;
        for (size_t k = 0; k < 2 * m->n_vertices; ++k)
            n_off += !(found[k] >= to[k] && found[k] <= to[k]);
    }
    return n_off;
}

/* Points of the source, by chance inside, that do not come back, or back to where rounding does not
 * explain that they have another image. */
static inline size_t mix_count_lost(const feature_mix *m, const icc_map *map, uint64_t seed)
{
    enum { POINTS = 40 };
    double points[2 * POINTS], images[2 * POINTS], back[2 * POINTS], again[2 * POINTS];
    double jacobian[4 * POINTS];
    icc_status status[2][POINTS], ignored[POINTS];
    random_source r = {seed};
    size_t n_lost = 0;
    for (size_t k = 0; k < 2 * POINTS; ++k)
        points[k] = m->offset + random_between(&r, -1, 1);
    if (icc_map_apply(map, POINTS, points, images, status[0], NULL, NULL) != ICC_OK ||
        icc_map_apply_inverse(map, POINTS, images, back, status[1], NULL, NULL) != ICC_OK ||
        icc_map_apply(map, POINTS, back, again, ignored, NULL, NULL) != ICC_OK ||
        icc_map_jacobian(map, POINTS, points, jacobian, ignored, NULL, NULL) != ICC_OK)
        return SIZE_MAX;
    for (size_t k = 0; k < POINTS; ++k) {
        if (status[0][k] == ICC_ERR_OUTSIDE)
            continue;
        const double *j = jacobian + 4 * k, *p = images + 2 * k, *q = again + 2 * k;
        const double factor = 1 + hypot(hypot(j[0], j[1]), hypot(j[2], j[3]));
        const double off = hypot(p[0] - q[0], p[1] - q[1]);
        n_lost += status[0][k] != ICC_OK || status[1][k] != ICC_OK || !(off <= 1e-9 * factor);
    }
    return n_lost;
}

#endif

/* Random networks: a triangulation of random points in a polygon, of which some edges become lines,
 * some triangles holes and some vertices points. The target has the same triangles after many
 * random motions of vertices, so nodes, orders and nesting agree. */
#ifndef TESTS_RANDOM_NETWORKS_H
#define TESTS_RANDOM_NETWORKS_H

#include "icc/icc.h"

#include "random.h"

#include <check.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { NETWORK_CHAIN = 4 };

/* Least doubled area of a triangle after a motion. The polygon has radius 1. */
#define NETWORK_LEAST 1e-5

typedef struct random_network {
    size_t n_outer, n, n_triangles, n_features, n_given;
    double *points[2];
    uint32_t *triangles;
    uint8_t *used; /* of each vertex: 1 if a line or hole has it */
    icc_feature *feature[2];
    double *given[2]; /* vertices of the features */
    uint32_t *vertex; /* of each of them: the point there */
    icc_domain *domain[2];
    icc_error error;
} random_network;

static inline double network_area(const double *p, const uint32_t *t)
{
    const double *a = p + 2 * (size_t)t[0], *b = p + 2 * (size_t)t[1], *c = p + 2 * (size_t)t[2];
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static inline void network_place(random_network *w, random_source *r)
{
    double *p = w->points[0];
    for (size_t k = 0; k < w->n; ++k) {
        const double turn = k < w->n_outer ? (double)k / (double)w->n_outer : random_unit(r);
        const double radius = k < w->n_outer ? 1 : 0.95 * sqrt(random_unit(r));
        p[2 * k] = radius * cos(6.283185307179586 * turn);
        p[2 * k + 1] = radius * sin(6.283185307179586 * turn);
        if (k >= w->n_outer) { /* stay inside the polygon */
            p[2 * k] *= cos(3.141592653589793 / (double)w->n_outer);
            p[2 * k + 1] *= cos(3.141592653589793 / (double)w->n_outer);
        }
    }
    w->triangles = malloc(6 * w->n * sizeof *w->triangles);
    icc_error err = {.size = sizeof err};
    if (icc_triangulate(w->n_outer, w->n, p, w->triangles, NULL, &err) != ICC_OK)
        ck_abort_msg("%s", err.message);
    w->n_triangles = 2 * w->n - w->n_outer - 2;
}

/* Moves vertices inside at random as long as no triangle around them gets too small. */
static inline void network_move(random_network *w, random_source *r, int n_sweeps)
{
    uint32_t *first = calloc(w->n + 1, sizeof *first);
    uint32_t *around = malloc(3 * w->n_triangles * sizeof *around);
    double *p = w->points[1];
    memcpy(p, w->points[0], 2 * w->n * sizeof *p);
    for (size_t c = 0; c < 3 * w->n_triangles; ++c)
        ++first[w->triangles[c]];
    for (size_t v = 0, sum = 0; v <= w->n; ++v)
        first[v] = (uint32_t)(sum += v < w->n ? first[v] : 0);
    for (size_t c = 3 * w->n_triangles; c-- > 0;)
        around[--first[w->triangles[c]]] = (uint32_t)(c / 3);
    const double step = 1 / sqrt((double)w->n);
    for (int sweep = 0; sweep < n_sweeps; ++sweep)
        for (size_t v = w->n_outer; v < w->n; ++v) {
            const double old[2] = {p[2 * v], p[2 * v + 1]};
            bool is_good = true;
            for (int d = 0; d < 2; ++d)
                p[2 * v + (size_t)d] += step * (2 * random_unit(r) - 1);
            for (uint32_t k = first[v]; k < first[v + 1]; ++k)
                is_good &= network_area(p, w->triangles + 3 * (size_t)around[k]) > NETWORK_LEAST;
            if (!is_good)
                memcpy(p + 2 * v, old, sizeof old);
        }
    free(first);
    free(around);
}

static inline void network_add(random_network *w, int32_t kind, size_t n, const uint32_t *vertices)
{
    for (int side = 0; side < 2; ++side) {
        double *at = w->given[side] + 2 * w->n_given;
        w->feature[side][w->n_features] = (icc_feature){
            .size = sizeof(icc_feature), .kind = kind, .n_vertices = n, .vertices = at};
        for (size_t k = 0; k < n; ++k)
            memcpy(at + 2 * k, w->points[side] + 2 * (size_t)vertices[k], 2 * sizeof *at);
    }
    memcpy(w->vertex + w->n_given, vertices, n * sizeof *vertices);
    for (size_t k = 0; k < n; ++k)
        w->used[vertices[k]] = 1;
    w->n_given += n;
    ++w->n_features;
}

/* state[c] of edge c, which faces corner c: 0 free, 1 taken. The same edge in the other triangle
 * has the state of its twin. */
typedef struct network_edges {
    uint32_t *twin;
    uint8_t *is_taken;
} network_edges;

static inline network_edges network_list_edges(const random_network *w)
{
    network_edges e = {malloc(3 * w->n_triangles * sizeof *e.twin), calloc(3 * w->n_triangles, 1)};
    const uint32_t *t = w->triangles;
    uint32_t *head = malloc(w->n * sizeof *head), *next = malloc(3 * w->n_triangles * sizeof *next);
    memset(head, 0xff, w->n * sizeof *head);
    memset(e.twin, 0xff, 3 * w->n_triangles * sizeof *e.twin);
    for (uint32_t c = 0; c < 3 * w->n_triangles; ++c) {
        const uint32_t a = t[c - c % 3 + (c + 1) % 3], b = t[c - c % 3 + (c + 2) % 3];
        for (uint32_t d = head[b]; d != UINT32_MAX; d = next[d])
            if (t[d - d % 3 + (d + 2) % 3] == a) {
                e.twin[c] = d;
                e.twin[d] = c;
            }
        next[c] = head[a];
        head[a] = c;
    }
    free(head);
    free(next);
    return e;
}

static inline void network_take(const network_edges *e, uint32_t c)
{
    e->is_taken[c] = 1;
    if (e->twin[c] != UINT32_MAX)
        e->is_taken[e->twin[c]] = 1;
}

static inline void network_add_holes(random_network *w, const network_edges *e, random_source *r,
                                     double share)
{
    for (uint32_t t = 0; t < w->n_triangles; ++t) {
        bool is_free = random_unit(r) < share;
        for (int side = 0; side < 2; ++side)
            is_free &= network_area(w->points[side], w->triangles + 3 * (size_t)t) > NETWORK_LEAST;
        for (uint32_t c = 3 * t; c < 3 * t + 3; ++c)
            is_free &= e->twin[c] != UINT32_MAX && !e->is_taken[c];
        if (!is_free)
            continue;
        for (uint32_t c = 3 * t; c < 3 * t + 3; ++c)
            network_take(e, c);
        network_add(w, ICC_FEATURE_HOLE, 3, w->triangles + 3 * (size_t)t);
    }
}

/* Lines of one to NETWORK_CHAIN edges. Each goes on in the triangle that it came to. */
static inline void network_add_lines(random_network *w, const network_edges *e, random_source *r,
                                     double share)
{
    const uint32_t *t = w->triangles;
    for (uint32_t begin = 0; begin < 3 * w->n_triangles; ++begin) {
        uint32_t line[NETWORK_CHAIN + 1], c = begin;
        size_t n = 1;
        line[0] = t[c - c % 3 + (c + 1) % 3];
        while (n <= NETWORK_CHAIN && e->twin[c] != UINT32_MAX && !e->is_taken[c] &&
               (n > 1 || random_unit(r) < share)) {
            bool is_new = true;
            const uint32_t v = t[c - c % 3 + (c + 2) % 3];
            for (size_t k = 0; k < n; ++k)
                is_new &= line[k] != v;
            if (!is_new)
                break;
            network_take(e, c);
            line[n++] = v;
            c = e->twin[c];
            c = c - c % 3 + (c + 2) % 3; /* the other edge at v */
        }
        if (n > 1)
            network_add(w, ICC_FEATURE_LINE, n, line);
    }
}

/* Makes a network with n vertices. Both domains are NULL, and `error` tells why, if one is
 * refused. */
static inline void network_create(random_network *w, uint64_t seed, size_t n)
{
    random_source r = {seed};
    *w = (random_network){.n_outer = 3 + (size_t)random_below(&r, 10),
                          .error.size = sizeof w->error};
    w->n = w->n_outer + n;
    for (int side = 0; side < 2; ++side) {
        w->points[side] = malloc(2 * w->n * sizeof(double));
        w->feature[side] = malloc(9 * w->n * sizeof(icc_feature));
        w->given[side] = malloc(36 * w->n * sizeof(double));
    }
    w->vertex = malloc(18 * w->n * sizeof *w->vertex);
    w->used = calloc(w->n, 1);
    network_place(w, &r);
    network_move(w, &r, 1 + random_below(&r, 30));
    const network_edges e = network_list_edges(w);
    network_add_holes(w, &e, &r, random_below(&r, 2) == 0 ? 0 : 0.1 * random_unit(&r));
    network_add_lines(w, &e, &r, random_below(&r, 4) == 0 ? 1 : random_unit(&r));
    for (uint32_t v = (uint32_t)w->n_outer; v < w->n; ++v)
        if (!w->used[v] && random_below(&r, 2) == 0)
            network_add(w, ICC_FEATURE_POINT, 1, &v);
    free(e.twin);
    free(e.is_taken);
    for (int side = 0; side < 2; ++side)
        if (icc_domain_create_features(&w->domain[side], w->n_outer, w->points[side], w->n_features,
                                       w->feature[side], NULL, &w->error) != ICC_OK)
            break;
}

static inline void network_free(random_network *w)
{
    for (int side = 0; side < 2; ++side) {
        icc_domain_free(w->domain[side]);
        free(w->points[side]);
        free(w->feature[side]);
        free(w->given[side]);
    }
    free(w->triangles);
    free(w->vertex);
    free(w->used);
}

#endif

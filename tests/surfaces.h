/* Closed triangle surfaces for tests. */
#ifndef TESTS_SURFACES_H
#define TESTS_SURFACES_H

#include "random.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

enum { SURFACE_VERTICES = 10100, SURFACE_FACES = 20200 };

typedef struct surface {
    size_t n_vertices, n_faces;
    double vertices[3 * SURFACE_VERTICES];
    uint32_t faces[3 * SURFACE_FACES];
} surface;

static inline uint32_t surface_vertex(surface *s, double x, double y, double z)
{
    for (uint32_t i = 0; i < s->n_vertices; ++i) {
        const double *v = s->vertices + 3 * i;
        if (v[0] == x && v[1] == y && v[2] == z)
            return i;
    }
    double *v = s->vertices + 3 * s->n_vertices;
    v[0] = x;
    v[1] = y;
    v[2] = z;
    return (uint32_t)s->n_vertices++;
}

static inline void surface_face(surface *s, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *f = s->faces + 3 * s->n_faces++;
    f[0] = a;
    f[1] = b;
    f[2] = c;
}

/* Corners (+-1, 0, 0) and so on, faces counter-clockwise from outside. */
static inline void surface_octahedron(surface *s)
{
    static const double corners[18] = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
    s->n_vertices = 6;
    s->n_faces = 0;
    memcpy(s->vertices, corners, sizeof corners);
    for (uint32_t i = 0; i < 8; ++i) {
        const uint32_t x = i & 1, y = 2 + (i >> 1 & 1), z = 4 + (i >> 2);
        const int odd = (i ^ i >> 1 ^ i >> 2) & 1;
        surface_face(s, x, odd ? z : y, odd ? y : z);
    }
}

/* Splits each face in four at the middles of its sides. */
static inline void surface_split(surface *s)
{
    static surface from;
    from = *s;
    s->n_faces = 0;
    for (size_t f = 0; f < from.n_faces; ++f) {
        const uint32_t *v = from.faces + 3 * f;
        uint32_t m[3];
        for (int i = 0; i < 3; ++i) {
            const double *a = from.vertices + 3 * v[i], *b = from.vertices + 3 * v[(i + 1) % 3];
            m[i] = surface_vertex(s, 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2]));
        }
        for (int i = 0; i < 3; ++i)
            surface_face(s, v[i], m[i], m[(i + 2) % 3]);
        surface_face(s, m[0], m[1], m[2]);
    }
}

/* Star-shaped about the origin: radii between 1 - roughness and 1. */
static inline void surface_star(surface *s, int splits, double roughness, random_source *r)
{
    surface_octahedron(s);
    for (int i = 0; i < splits; ++i)
        surface_split(s);
    for (size_t i = 0; i < s->n_vertices; ++i) {
        double *v = s->vertices + 3 * i;
        const double radius = 1 - roughness * random_unit(r);
        const double factor = radius / sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        for (int k = 0; k < 3; ++k)
            v[k] *= factor;
    }
}

/* The boundary of the unit cells for which has_cell() holds among 0..n-1 in each direction. */
static inline void surface_cells(surface *s, int n, int (*has_cell)(int x, int y, int z))
{
    s->n_vertices = s->n_faces = 0;
    for (int code = 0; code < n * n * n; ++code)
        for (int side = 0; side < 6; ++side) {
            const int cell[3] = {code % n, code / n % n, code / n / n};
            const int axis = side / 2, up = side % 2, u = (axis + 1) % 3, w = (axis + 2) % 3;
            int other[3] = {cell[0], cell[1], cell[2]};
            other[axis] += up ? 1 : -1;
            const int open =
                other[axis] < 0 || other[axis] >= n || !has_cell(other[0], other[1], other[2]);
            if (!has_cell(cell[0], cell[1], cell[2]) || !open)
                continue;
            uint32_t v[4];
            for (int i = 0; i < 4; ++i) {
                double x[3] = {cell[0], cell[1], cell[2]};
                x[axis] += up;
                x[u] += (i == 1 || i == 2);
                x[w] += i >= 2;
                v[i] = surface_vertex(s, x[0], x[1], x[2]);
            }
            surface_face(s, v[0], v[up ? 1 : 2], v[up ? 2 : 1]);
            surface_face(s, v[0], v[up ? 2 : 3], v[up ? 3 : 2]);
        }
}

#endif

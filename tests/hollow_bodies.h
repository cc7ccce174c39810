/* Surfaces of bodies with handles and voids. */
#ifndef TESTS_HOLLOW_BODIES_H
#define TESTS_HOLLOW_BODIES_H

#include "surfaces.h"

typedef void tube_centre(double angle, double centre[3]);

static inline void tube_circle(double angle, double centre[3])
{
    centre[0] = cos(angle);
    centre[1] = sin(angle);
    centre[2] = 0;
}

static inline void tube_trefoil(double angle, double centre[3])
{
    centre[0] = sin(angle) + 2 * sin(2 * angle);
    centre[1] = cos(angle) - 2 * cos(2 * angle);
    centre[2] = -1.2 * sin(3 * angle);
}

static inline void tube_normalise(double *d)
{
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int k = 0; k < 3; ++k)
        d[k] /= length;
}

static inline void tube_cross(const double *a, const double *b, double *c)
{
    for (int k = 0; k < 3; ++k)
        c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* A tube of n rings of m vertices around a closed curve that never runs along z. */
static inline void surface_tube(surface *s, uint32_t n, uint32_t m, double radius,
                                tube_centre *centre)
{
    const double turn = 2 * 3.141592653589793, up[3] = {0, 0, 1};
    s->n_vertices = s->n_faces = 0;
    for (uint32_t i = 0; i < n; ++i) {
        double at[3], before[3], after[3], along[3], u[3], w[3];
        centre(turn * i / n, at);
        centre(turn * (i + n - 1) / n, before);
        centre(turn * (i + 1) / n, after);
        for (int k = 0; k < 3; ++k)
            along[k] = after[k] - before[k];
        tube_normalise(along);
        tube_cross(up, along, u);
        tube_normalise(u);
        tube_cross(along, u, w);
        for (uint32_t j = 0; j < m; ++j) {
            double *const v = s->vertices + 3 * s->n_vertices++;
            for (int k = 0; k < 3; ++k)
                v[k] = at[k] + radius * (cos(turn * j / m) * u[k] + sin(turn * j / m) * w[k]);
        }
    }
    for (uint32_t i = 0; i < n; ++i)
        for (uint32_t j = 0; j < m; ++j) {
            const uint32_t a = i * m + j, b = i * m + (j + 1) % m;
            const uint32_t c = (i + 1) % n * m + j, d = (i + 1) % n * m + (j + 1) % m;
            surface_face(s, a, b, d);
            surface_face(s, a, d, c);
        }
}

/* Turns the axes, then scales and moves the surface. */
static inline void surface_place(surface *s, int turns, double scale, double x, double y, double z)
{
    const double shift[3] = {x, y, z};
    for (size_t v = 0; v < s->n_vertices; ++v) {
        double *const p = s->vertices + 3 * v, old[3] = {p[0], p[1], p[2]};
        for (int k = 0; k < 3; ++k)
            p[k] = scale * old[(k + turns) % 3] + shift[k];
    }
}

/* Adds another surface, turned inward: a void. */
static inline void surface_add_void(surface *s, const surface *inner)
{
    const uint32_t n = (uint32_t)s->n_vertices;
    memcpy(s->vertices + 3 * n, inner->vertices, 3 * inner->n_vertices * sizeof *inner->vertices);
    s->n_vertices += inner->n_vertices;
    for (size_t f = 0; f < inner->n_faces; ++f) {
        const uint32_t *const v = inner->faces + 3 * f;
        surface_face(s, n + v[1], n + v[0], n + v[2]);
    }
}

#endif

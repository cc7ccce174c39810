/* Closed surfaces that are hard to fill with tetrahedra. */
#ifndef TESTS_HARD_BODIES_H
#define TESTS_HARD_BODIES_H

#include "surfaces.h"

#include <stdbool.h>

static inline void surface_point(surface *s, double x, double y, double z)
{
    double *v = s->vertices + 3 * s->n_vertices++;
    v[0] = x;
    v[1] = y;
    v[2] = z;
}

/* A prism whose top is twisted, so that its sides are bent in: E. Schoenhardt's cannot be filled
 * without another point from -30 degrees on, for n = 3. */
static inline void surface_prism(surface *s, uint32_t n, double twist, double height)
{
    s->n_vertices = s->n_faces = 0;
    for (uint32_t i = 0; i < 2 * n; ++i) {
        const double angle = 2 * 3.141592653589793 * (i % n) / n + (i < n ? 0 : twist);
        surface_point(s, cos(angle), sin(angle), i < n ? 0 : height);
    }
    for (uint32_t i = 1; i + 1 < n; ++i) {
        surface_face(s, 0, i + 1, i);
        surface_face(s, n, n + i, n + i + 1);
    }
    for (uint32_t i = 0; i < n; ++i) {
        const uint32_t j = (i + 1) % n;
        surface_face(s, i, j, twist > 0 ? n + i : n + j);
        surface_face(s, twist > 0 ? j : i, n + j, n + i);
    }
}

/* The walls of a plate of m x m vertices below, numbered row by row, and as many above. */
static inline void surface_plate_faces(surface *s, uint32_t m)
{
    s->n_faces = 0;
    for (uint32_t side = 0; side < 2; ++side)
        for (uint32_t x = 0; x + 1 < m; ++x)
            for (uint32_t y = 0; y + 1 < m; ++y) {
                const uint32_t a = side * m * m + x * m + y, b = a + m, c = b + 1, d = a + 1;
                surface_face(s, a, side ? b : c, side ? c : b);
                surface_face(s, a, side ? c : d, side ? d : c);
            }
    for (uint32_t k = 0; k < 4 * (m - 1); ++k) {
        uint32_t at[2];
        for (uint32_t e = 0; e < 2; ++e) {
            const uint32_t along = (k + e) % (4 * (m - 1)), i = along % (m - 1);
            const uint32_t x[4] = {i, m - 1, m - 1 - i, 0}, y[4] = {0, i, m - 1, m - 1 - i};
            at[e] = x[along / (m - 1)] * m + y[along / (m - 1)];
        }
        surface_face(s, at[0], at[1], m * m + at[1]);
        surface_face(s, at[0], m * m + at[1], m * m + at[0]);
    }
}

/* A slab over the saddle z = xy with wedges cut into it from both sides, after B. Chazelle. */
static inline void surface_saddle(surface *s, uint32_t m, double thickness)
{
    s->n_vertices = 0;
    for (uint32_t i = 0; i < 2 * m * m; ++i) {
        const uint32_t top = i / (m * m), x = i / m % m, y = i % m;
        surface_point(s, 0.5 * x, 0.5 * y,
                      0.25 * x * y + (top ? (x % 2 ? thickness : 3) : -(y % 2 ? thickness : 3)));
    }
    surface_plate_faces(s, m);
}

/* Two sheets a gap apart, of m x m vertices each, and what is between them; bent by so much. */
static inline void surface_sheets(surface *s, uint32_t m, double gap, double bend)
{
    s->n_vertices = 0;
    for (uint32_t i = 0; i < 2 * m * m; ++i) {
        const double x = (double)(i / m % m) / (m - 1), y = (double)(i % m) / (m - 1);
        surface_point(s, x, y, bend * (x * x - x * y) + (i < m * m ? 0 : gap));
    }
    surface_plate_faces(s, m);
}

/* A ring of n corners between two vertices, each of which has all of them round it. */
static inline void surface_double_star(surface *s, uint32_t n, double roughness, random_source *r)
{
    s->n_vertices = s->n_faces = 0;
    for (uint32_t i = 0; i < n; ++i) {
        const double angle = 2 * 3.141592653589793 * i / n;
        const double radius = 1 - roughness * random_unit(r);
        surface_point(s, radius * cos(angle), radius * sin(angle),
                      0.3 * roughness * (random_unit(r) - 0.5));
    }
    surface_point(s, 0, 0, 1);
    surface_point(s, 0, 0, -1);
    for (uint32_t i = 0; i < n; ++i) {
        surface_face(s, i, (i + 1) % n, n);
        surface_face(s, (i + 1) % n, i, n + 1);
    }
}

/* A heap of unit cells in a corner, a union of boxes, whose steps are grids. */
static int surface_boxes[4][3];

static inline int surface_in_boxes(int x, int y, int z)
{
    for (int i = 0; i < 4; ++i)
        if (x >= 0 && y >= 0 && z >= 0 && x < surface_boxes[i][0] && y < surface_boxes[i][1] &&
            z < surface_boxes[i][2])
            return 1;
    return 0;
}

static inline void surface_heap(surface *s, int n, random_source *r)
{
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 3; ++k)
            surface_boxes[i][k] = 1 + random_below(r, n);
    surface_cells(s, n, surface_in_boxes);
}

/* ---- what makes a surface harder ---- */

/* A random turn about the origin. */
static inline void surface_turn(surface *s, random_source *r)
{
    double q[4], square = 0;
    for (int i = 0; i < 4; ++i) {
        q[i] = random_unit(r) - 0.5;
        square += q[i] * q[i];
    }
    const double w = q[0], x = q[1], y = q[2], z = q[3], two = 2 / square;
    const double turn[3][3] = {
        {1 - two * (y * y + z * z), two * (x * y - z * w), two * (x * z + y * w)},
        {two * (x * y + z * w), 1 - two * (x * x + z * z), two * (y * z - x * w)},
        {two * (x * z - y * w), two * (y * z + x * w), 1 - two * (x * x + y * y)}};
    for (size_t i = 0; i < s->n_vertices; ++i) {
        double *v = s->vertices + 3 * i;
        const double from[3] = {v[0], v[1], v[2]};
        for (int k = 0; k < 3; ++k)
            v[k] = turn[k][0] * from[0] + turn[k][1] * from[1] + turn[k][2] * from[2];
    }
}

static inline void surface_stretch(surface *s, int axis, double factor)
{
    for (size_t i = 0; i < s->n_vertices; ++i)
        s->vertices[3 * i + (size_t)axis] *= factor;
}

/* Turned about the third axis, the more so the higher up. */
static inline void surface_twist(surface *s, double twist)
{
    for (size_t i = 0; i < s->n_vertices; ++i) {
        double *v = s->vertices + 3 * i;
        const double c = cos(twist * v[2]), d = sin(twist * v[2]), x = v[0];
        v[0] = c * x - d * v[1];
        v[1] = d * x + c * v[1];
    }
}

/* Vertices in a share of the faces, each very near an edge: from 10^-least to 10^-most. */
static inline void surface_needles(surface *s, double share, double least, double most,
                                   random_source *r)
{
    const size_t n = s->n_faces;
    for (size_t f = 0; f < n; ++f) {
        if (random_unit(r) >= share || s->n_vertices == SURFACE_VERTICES ||
            s->n_faces + 2 > SURFACE_FACES)
            continue;
        uint32_t *v = s->faces + 3 * f;
        const uint32_t c[3] = {v[0], v[1], v[2]}, p = (uint32_t)s->n_vertices;
        const int first = random_below(r, 3);
        double w[3], x[3] = {0};
        w[first] = pow(10, -random_between(r, least, most));
        w[(first + 1) % 3] = random_between(r, .1, .9);
        w[(first + 2) % 3] = 1 - w[first] - w[(first + 1) % 3];
        for (int i = 0; i < 9; ++i)
            x[i % 3] += w[i / 3] * s->vertices[3 * c[i / 3] + (size_t)(i % 3)];
        surface_point(s, x[0], x[1], x[2]);
        v[2] = p;
        surface_face(s, c[1], c[2], p);
        surface_face(s, c[2], c[0], p);
    }
}

/* ---- all together ---- */

/* A random one of the kinds below, whose name is given back. */
static inline const char *surface_hard(surface *s, random_source *r)
{
    static const char *const names[] = {"body",  "rod", "leaf",   "needles", "heap", "round",
                                        "prism", "cap", "saddle", "sheets",  "star"};
    const int kind = random_below(r, (int)(sizeof names / sizeof *names));
    const bool has_steps = random_below(r, 2) == 0; /* of what is stretched */
    const double sign = random_below(r, 2) ? 1 : -1, size = random_unit(r);
    surface_star(s, 2 + random_below(r, 3), 0.7 * random_unit(r), r);
    if ((kind == 1 || kind == 2) && has_steps)
        surface_heap(s, 1 + random_below(r, 10), r);
    switch (kind) {
    case 0:
        surface_twist(s, 2 * sign * size);
        break;
    case 1:
        surface_turn(s, r);
        surface_stretch(s, 0, pow(10, 3 * size));
        break;
    case 2:
        surface_turn(s, r);
        surface_stretch(s, 0, pow(10, -3 * size));
        break;
    case 3:
        surface_needles(s, 0.2, 1, 6, r);
        break;
    case 4:
        surface_heap(s, 1 + random_below(r, 10), r);
        surface_stretch(s, random_below(r, 3), pow(10, 3 * floor(2 * size) - 3));
        break;
    case 5:
        surface_star(s, 1 + random_below(r, 4), 0, r);
        break;
    case 6:
        surface_prism(s, 3, sign * (0.5235 - pow(10, -4 * size) / 2), 1);
        break;
    case 7:
        surface_prism(s, 40, sign * 0.07 * random_unit(r), pow(10, 6 * size - 3));
        break;
    case 8:
        surface_saddle(s, 3 + 2 * (uint32_t)random_below(r, 6), pow(10, -3 * size));
        break;
    case 9:
        surface_sheets(s, 2 + (uint32_t)random_below(r, 15), 1e-12, random_below(r, 2) ? size : 0);
        break;
    default:
        surface_double_star(s, (uint32_t)pow(10, 1 + 2.7 * size), 0.6 * random_unit(r), r);
    }
    if (random_below(r, 4) > 0)
        surface_turn(s, r);
    return names[kind];
}

#endif

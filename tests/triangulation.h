/* What a constrained Delaunay triangulation of a polygon must be, checked exactly; and shapes to
 * try it on. For the tests, the fuzzer and nothing else. */
#ifndef TEST_TRIANGULATION_H
#define TEST_TRIANGULATION_H

#include "math/predicates.h"
#include "mesh/triangulate.h"

#include <stdbool.h>
#include <stdlib.h>

static inline const double *point_at(const double *points, size_t i)
{
    return points + 2 * i;
}

static inline bool is_between(double a, double b, double x)
{
    return (a <= x && x <= b) || (b <= x && x <= a);
}

/* Whether p lies on the closed segment. */
static inline bool is_on(const double *a, const double *b, const double *p)
{
    return iccp_orient2d(a, b, p) == 0 && is_between(a[0], b[0], p[0]) &&
           is_between(a[1], b[1], p[1]);
}

static inline bool segments_meet(const double *a, const double *b, const double *c, const double *d)
{
    if (is_on(a, b, c) || is_on(a, b, d) || is_on(c, d, a) || is_on(c, d, b))
        return true;
    return iccp_orient2d(a, b, c) * iccp_orient2d(a, b, d) < 0 &&
           iccp_orient2d(c, d, a) * iccp_orient2d(c, d, b) < 0;
}

/* Whether no two edges meet but at the vertex that they share. O(n^2). */
static inline bool is_simple(size_t n, const double *points)
{
    for (size_t i = 0; i < n; ++i) {
        const double *a = point_at(points, i), *b = point_at(points, (i + 1) % n);
        if (is_on(a, b, point_at(points, (i + 2) % n)) ||
            is_on(b, point_at(points, (i + 2) % n), a))
            return false;
        for (size_t j = i + 2; j < n; ++j)
            if ((j + 1) % n != i &&
                segments_meet(a, b, point_at(points, j), point_at(points, (j + 1) % n)))
                return false;
    }
    return true;
}

/* +1 inside, 0 on the polygon, -1 outside; exact. */
static inline int place_in_polygon(size_t n, const double *points, const double *p)
{
    int place = -1;
    for (size_t i = 0; i < n; ++i) {
        const double *a = point_at(points, i), *b = point_at(points, (i + 1) % n);
        if (is_on(a, b, p))
            return 0;
        if ((a[1] > p[1]) == (b[1] > p[1]))
            continue;
        if (iccp_orient2d(a, b, p) == (b[1] > a[1] ? 1 : -1))
            place = -place;
    }
    return place;
}

static inline bool is_polygon_edge(size_t n_boundary, size_t a, size_t b)
{
    return a < n_boundary && b < n_boundary &&
           ((a + 1) % n_boundary == b || (b + 1) % n_boundary == a);
}

/* Corner c against its neighbour; counts its edge when it is the polygon's. */
static inline const char *find_corner_defect(size_t n_boundary, size_t n_corners,
                                             const double *points, const uint32_t *triangles,
                                             const uint32_t *neighbours, size_t c, size_t *n_edges)
{
    const size_t t = c - c % 3;
    const uint32_t from = triangles[t + (c + 1) % 3], to = triangles[t + (c + 2) % 3];
    const bool is_edge = is_polygon_edge(n_boundary, from, to);
    const uint32_t other = neighbours[c];
    if ((other == ICCP_NO_NEIGHBOUR) != is_edge)
        return "the rim is not the polygon";
    *n_edges += is_edge;
    if (is_edge)
        return NULL;
    if (other >= n_corners || neighbours[other] != c)
        return "neighbours disagree";
    const size_t u = other - other % 3;
    if (triangles[u + (other + 1) % 3] != to || triangles[u + (other + 2) % 3] != from)
        return "neighbours do not share their edge";
    if (iccp_incircle(point_at(points, triangles[t]), point_at(points, triangles[t + 1]),
                      point_at(points, triangles[t + 2]), point_at(points, triangles[other])) > 0)
        return "an edge is not Delaunay";
    return NULL;
}

/* NULL, or what is wrong. All triangles positive, neighbours consistent, the rim the polygon, once:
 * then the triangles cover the polygon once. The number of triangles shows that no point is
 * missing. */
static inline const char *find_triangulation_defect(size_t n_boundary, size_t n_points,
                                                    const double *points, const uint32_t *triangles,
                                                    const uint32_t *neighbours)
{
    const size_t n_triangles = 2 * n_points - n_boundary - 2;
    size_t n_edges = 0;
    for (size_t c = 0; c < 3 * n_triangles; ++c)
        if (triangles[c] >= n_points)
            return "no such vertex";
    for (size_t t = 0; t < n_triangles; ++t)
        if (iccp_orient2d(point_at(points, triangles[3 * t]),
                          point_at(points, triangles[3 * t + 1]),
                          point_at(points, triangles[3 * t + 2])) <= 0)
            return "a triangle is not counter-clockwise";
    for (size_t c = 0; c < 3 * n_triangles; ++c) {
        const char *defect = find_corner_defect(n_boundary, 3 * n_triangles, points, triangles,
                                                neighbours, c, &n_edges);
        if (defect != NULL)
            return defect;
    }
    return n_edges == n_boundary ? NULL : "an edge of the polygon is missing";
}

#endif

/* What the tests of piecewise linear maps share: maps of shapes, and what holds for all of them. */
#ifndef TESTS_PLMAPS_H
#define TESTS_PLMAPS_H

#include "map/compatible/plmap.h"
#include "mesh/planar.h"

#include "default_env.h"
#include "hard_shapes.h"

#include <check.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

typedef void image_function(const double p[2], double image[2]);

static inline void identity(const double p[2], double image[2])
{
    memcpy(image, p, 2 * sizeof *p);
}

/* One-to-one, and not affine. */
static inline void wave(const double p[2], double image[2])
{
    image[0] = p[0] + 0.2 * sin(3 * p[1]);
    image[1] = 1.5 * p[1] + 0.2 * sin(2 * p[0]);
}

static inline iccp_plmap map_of(const shape *s, int32_t cells, image_function *f, double stretch)
{
    icc_domain *domain;
    iccp_planar mesh;
    iccp_plmap map;
    const iccp_env env = default_env();
    uint32_t pieces[SHAPE_MAX];
    ck_assert_int_eq(icc_domain_create(&domain, 2, s->n, s->xy, 0, NULL, NULL, NULL), ICC_OK);
    iccp_planar_pieces(pieces, domain, NULL, cells);
    ck_assert_int_eq(iccp_planar_create(&mesh, domain, pieces, cells, &env, NULL), ICC_OK);
    double *images = malloc(2 * mesh.n_vertices * sizeof *images);
    ck_assert_ptr_nonnull(images);
    for (size_t v = 0; v < mesh.n_vertices; ++v)
        f(mesh.points + 2 * v, images + 2 * v);
    ck_assert_int_eq(iccp_plmap_create(&map, &mesh, domain, images, stretch, &env.memory), ICC_OK);
    free(images);
    iccp_planar_free(&mesh);
    icc_domain_free(domain);
    return map;
}

static inline bool is_same(const iccp_plmap *a, const iccp_plmap *b)
{
    const size_t n = 3 * a->corners.n_triangles * sizeof(uint32_t);
    return a->n_vertices == b->n_vertices && a->corners.n_triangles == b->corners.n_triangles &&
           memcmp(a->points, b->points, 2 * a->n_vertices * sizeof *a->points) == 0 &&
           memcmp(a->images, b->images, 2 * a->n_vertices * sizeof *a->images) == 0 &&
           memcmp(a->fixed, b->fixed, a->n_vertices) == 0 &&
           memcmp(a->corners.vertex, b->corners.vertex, n) == 0 &&
           memcmp(a->corners.twin, b->corners.twin, n) == 0;
}

/* A disc of triangles that are positive in the source, its boundary vertices and no others
 * fixed. */
static inline void check_mesh(const iccp_plmap *map)
{
    const iccp_corners *c = &map->corners;
    uint8_t *on_boundary = calloc(map->n_vertices, 1);
    ck_assert_ptr_nonnull(on_boundary);
    size_t n_open = 0, n_faults = 0;
    for (uint32_t t = 0; t < c->n_triangles; ++t)
        n_faults += !iccp_plmap_positive_point(map, t);
    for (uint32_t k = 0; k < 3 * c->n_triangles; ++k) {
        const uint32_t twin = c->twin[k];
        if (twin == ICCP_NO_NEIGHBOUR) {
            ++n_open;
            on_boundary[c->vertex[iccp_after(k)]] = on_boundary[c->vertex[iccp_before(k)]] = 1;
        } else
            n_faults += twin >= 3 * c->n_triangles || c->twin[twin] != k ||
                        c->vertex[iccp_after(twin)] != c->vertex[iccp_before(k)] ||
                        c->vertex[iccp_before(twin)] != c->vertex[iccp_after(k)];
    }
    for (size_t v = 0; v < map->n_vertices; ++v)
        n_faults += on_boundary[v] != (map->fixed[v] != ICCP_FREE);
    n_faults += 2 * map->n_vertices != c->n_triangles + n_open + 2;
    ck_assert_uint_eq(n_faults, 0);
    free(on_boundary);
}

static inline double area_of(const iccp_plmap *map)
{
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
    double sum = 0;
    for (uint32_t t = 0; t < map->corners.n_triangles; ++t) {
        double element[ICCP_ELEMENT(2)];
        iccp_simplicial_element(&simplicial, t, element);
        sum += element[0];
    }
    return sum;
}

/* Moves vertices inside at random as long as their triangles stay positive. */
static inline void shake(iccp_plmap *map, uint64_t seed, double amount)
{
    random_source r = {seed};
    for (int round = 0; round < 3; ++round)
        for (size_t v = 0; v < map->n_vertices; ++v) {
            double *image = map->images + 2 * v;
            const double old[2] = {image[0], image[1]};
            if (map->fixed[v])
                continue;
            image[0] += random_between(&r, -amount, amount);
            image[1] += random_between(&r, -amount, amount);
            bool positive = true;
            for (uint32_t c = 0; positive && c < 3 * map->corners.n_triangles; ++c)
                positive = map->corners.vertex[c] != v || iccp_plmap_positive_image(map, c / 3);
            if (!positive)
                memcpy(image, old, sizeof old);
        }
}

static inline void check_certified(const iccp_plmap *map)
{
    check_mesh(map);
    ck_assert_uint_eq(iccp_plmap_count_inverted(map), 0);
}

/* n triangles round a vertex in the middle of a regular polygon. */
static inline iccp_plmap wheel(uint32_t n)
{
    const iccp_env env = default_env();
    iccp_plmap map;
    ck_assert_int_eq(iccp_plmap_begin(&map, n + 1, n, 1, &env.memory), ICC_OK);
    memset(map.along, 0, (n + 1) * sizeof *map.along);
    for (uint32_t v = 0; v <= n; ++v) {
        const double a = 6.28318530717958647692 * (double)v / (double)n, r = v < n;
        map.points[2 * v] = map.images[2 * v] = r * cos(a);
        map.points[2 * v + 1] = map.images[2 * v + 1] = r * sin(a);
        map.fixed[v] = v < n;
        map.facet[v] = v < n ? v : 0;
    }
    for (uint32_t t = 0; t < n; ++t) {
        const uint32_t vertex[3] = {n, t, (t + 1) % n};
        const uint32_t twin[3] = {ICCP_NO_NEIGHBOUR, 3 * ((t + 1) % n) + 2,
                                  3 * ((t + n - 1) % n) + 1};
        memcpy(map.corners.vertex + 3 * (size_t)t, vertex, sizeof vertex);
        memcpy(map.corners.twin + 3 * (size_t)t, twin, sizeof twin);
    }
    return map;
}

#endif

/* Shapes for golden hashes, a source (side 0) and a target (side 1) of each. Their coordinates come
 * of sums, products, quotients and square roots alone, which IEEE 754 rounds alike everywhere. */
#ifndef TESTS_GOLDEN_FIXTURES_H
#define TESTS_GOLDEN_FIXTURES_H

#include "../meshes.h"
#include "../random.h"
#include "../surfaces.h"

#include <icc/icc.h>
#include <stdio.h>
#include <stdlib.h>

/* Nothing here may fail. */
static inline void must(icc_status status, const char *what, const icc_error *err)
{
    if (status == ICC_OK)
        return;
    (void)fprintf(stderr, "%s: %s %s\n", what, icc_status_name(status),
                  err != NULL ? err->message : "");
    exit(EXIT_FAILURE);
}

static inline icc_domain *domain_of(int32_t dim, size_t n_vertices, const double *vertices,
                                    size_t n_facets, const uint32_t *facets)
{
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    must(icc_domain_create(&domain, dim, n_vertices, vertices, n_facets, facets, NULL, &err),
         "icc_domain_create", &err);
    return domain;
}

/* ---- polygons ---- */

/* Side 2 is the target with some corners moved. */
static inline icc_domain *domain_l(int side)
{
    static const double CORNERS[3][12] = {{0, 0, 3, 0, 3, 1, 1, 1, 1, 3, 0, 3},
                                          {0, 0, 4, .5, 3.5, 2, 2, 2, 1.5, 3, -.5, 3.5},
                                          {0, 0, 4, .25, 3.5, 2, 1.75, 2, 1.5, 3, -.75, 3.25}};
    return domain_of(2, 6, CORNERS[side], 0, NULL);
}

/* n corners on rays to points of a diamond's outline, at random shares of the way, `least` at
 * least. */
static inline void ring_outline(size_t n, double least, uint64_t seed, double *xy)
{
    static const double DIAMOND[10] = {1, 0, 0, 1, -1, 0, 0, -1, 1, 0};
    random_source r = {seed};
    for (size_t k = 0; k < n; ++k) {
        const double *from = DIAMOND + 2 * (4 * k / n), share = random_between(&r, least, 1);
        const double u = (double)(4 * k % n) / (double)n;
        for (size_t i = 0; i < 2; ++i)
            xy[2 * k + i] = share * ((1 - u) * from[i] + u * from[2 + i]);
    }
}

static inline icc_domain *domain_ring(int side)
{
    double xy[2 * 40];
    ring_outline(40, side == 0 ? .3 : .6, 11 + (uint64_t)side, xy);
    return domain_of(2, 40, xy, 0, NULL);
}

/* Far from the origin, so that coordinates have few digits left. */
static inline icc_domain *domain_far(int side)
{
    double xy[2 * 24];
    ring_outline(24, .5, 21 + (uint64_t)side, xy);
    for (size_t i = 0; i < sizeof xy / sizeof *xy; ++i)
        xy[i] = 3 * xy[i] + 1e6;
    return domain_of(2, 24, xy, 0, NULL);
}

/* A back with four teeth that lean over. */
static inline icc_domain *domain_comb(int side)
{
    double xy[2 * 18] = {0, 0, 8, 0}, *to = xy + 4;
    const double lean = side == 0 ? 0 : 1.75;
    for (int k = 4; k-- > 0;) {
        const double x = 2 * k,
                     tooth[8] = {x + 2, 1, x + 1.75 + lean, 4, x + .75 + lean, 4, x + .5, 1};
        memcpy(to, tooth, sizeof tooth);
        to += 8;
    }
    return domain_of(2, 18, xy, 0, NULL);
}

/* ---- space and beyond ---- */

static inline icc_domain *domain_interval(int side)
{
    static const double ENDS[2][2] = {{-1, 2}, {.5, 7}};
    static const uint32_t FACETS[2] = {0, 1};
    return domain_of(1, 2, ENDS[side], 2, FACETS);
}

static inline icc_domain *domain_star(int side)
{
    static surface s;
    random_source r = {31 + (uint64_t)side};
    surface_star(&s, 2, .3, &r);
    return domain_of(3, s.n_vertices, s.vertices, s.n_faces, s.faces);
}

static inline icc_domain *domain_of_mesh(const test_mesh *m)
{
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    must(mesh_domain(&domain, m, NULL, &err), "icc_domain_create_mesh", &err);
    return domain;
}

static inline void bend(int32_t dim, const double *x, double *y)
{
    memcpy(y, x, (size_t)dim * sizeof *x);
    y[0] += .25 * x[1] * x[1];
    y[dim - 1] += .125 * x[0] * x[1];
}

/* With a mesh of its inside; the target has the same, bent. */
static inline icc_domain *domain_meshed(int32_t dim, size_t n, int side)
{
    random_source r = {41};
    test_mesh m = mesh_ball(dim, n, .1, &r), bent = mesh_moved(&m, bend);
    icc_domain *domain = domain_of_mesh(side == 0 ? &m : &bent);
    mesh_free(&m);
    mesh_free(&bent);
    return domain;
}

static inline icc_domain *domain_disc_mesh(int side)
{
    return domain_meshed(2, 8, side);
}

static inline icc_domain *domain_ball_mesh(int side)
{
    return domain_meshed(3, 4, side);
}

static inline icc_domain *domain_ball_mesh4(int side)
{
    return domain_meshed(4, 2, side);
}

/* The boundary of a domain with its vertices bent. */
static inline icc_domain *domain_bent(const icc_domain *domain)
{
    icc_domain_info info = {.size = sizeof info};
    (void)icc_domain_get_info(domain, &info);
    const size_t dim = (size_t)info.dim;
    double *vertices = mesh_alloc(2 * info.n_vertices * dim, sizeof *vertices);
    double *moved = vertices + info.n_vertices * dim;
    uint32_t *facets = mesh_alloc(info.n_facets * dim, sizeof *facets);
    (void)icc_domain_get_boundary(domain, vertices, facets);
    for (size_t v = 0; v < info.n_vertices; ++v)
        bend(info.dim, vertices + dim * v, moved + dim * v);
    icc_domain *bent = domain_of(info.dim, info.n_vertices, moved, info.n_facets, facets);
    free(vertices);
    free(facets);
    return bent;
}

/* Cells of a cube but for a corner, as a mask; its target is a surface. */
static inline icc_domain *domain_cells(int32_t dim, int side)
{
    static const size_t SHAPE[ICC_MAX_DIM] = {3, 3, 3, 3, 3, 3};
    uint8_t cells[729];
    icc_domain *domain;
    for (size_t c = 0; c < mesh_power(3, dim); ++c)
        cells[c] = c != 0;
    must(icc_domain_create_mask(&domain, dim, SHAPE, cells, NULL, NULL), "a mask", NULL);
    if (side == 0)
        return domain;
    icc_domain *bent = domain_bent(domain);
    icc_domain_free(domain);
    return bent;
}

static inline icc_domain *domain_cells2(int side)
{
    return domain_cells(2, side);
}

static inline icc_domain *domain_cells3(int side)
{
    return domain_cells(3, side);
}

static inline icc_domain *domain_cells4(int side)
{
    return domain_cells(4, side);
}

#endif

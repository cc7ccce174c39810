/* Meshes with a centre, for tests of fluxes: 2 to 5 dimensions, plain and with what is hard about
 * them. */
#ifndef TESTS_FLUXES_H
#define TESTS_FLUXES_H

#include "domain/domain.h"
#include "shelling/centres.h"

#include "default_env.h"
#include "faulty.h"
#include "meshes.h"

#include <stdbool.h>

typedef struct flux_case {
    char name[64];
    icc_domain *domain;
    const iccp_simplices *mesh;
    uint32_t centre;
} flux_case;

/* A corridor, wide at neither end. */
static inline int flux_in_corridor(int32_t dim, const size_t *cell)
{
    for (int32_t k = 1; k < dim; ++k)
        if (cell[k] > 1)
            return 0;
    return 1;
}

static inline void flux_squeeze(int32_t dim, const double *x, double *y)
{
    for (int32_t k = 0; k < dim; ++k)
        y[k] = k == 1 ? 3e-3 * x[k] + 0.3 * x[0] : x[k];
}

/* All facets of a box with one point inside: the star of that is the mesh. */
static inline test_mesh flux_cone(int32_t dim, random_source *r)
{
    test_mesh box = mesh_cube(dim, 2, 0, r);
    icc_domain *domain;
    ck_assert_int_eq(mesh_domain(&domain, &box, NULL, NULL), ICC_OK);
    const size_t n = (size_t)dim;
    test_mesh cone = mesh_of(dim, domain->n_vertices + 1, domain->n_facets);
    ck_assert_int_eq(icc_domain_get_boundary(domain, cone.vertices, NULL), ICC_OK);
    for (size_t k = 0; k < n; ++k)
        cone.vertices[n * domain->n_vertices + k] = 0.7 + 0.1 * (double)k;
    for (size_t f = 0; f < domain->n_facets; ++f) {
        memcpy(cone.simplices + (n + 1) * f, domain->facets + n * f, n * sizeof *cone.simplices);
        cone.simplices[(n + 1) * f + n] = (uint32_t)domain->n_vertices;
    }
    icc_domain_free(domain);
    mesh_free(&box);
    return cone;
}

enum { FLUX_CUBE = 3, FLUX_KINDS = 6 };

/* The one after these is a cube in 5-D, with enough simplices for iterations. */
enum { FLUX_CASES = 3 * FLUX_KINDS + FLUX_CUBE };

/* Dimension 2 + k / FLUX_KINDS. */
static inline flux_case flux_number(int k)
{
    static const char *const NAMES[FLUX_KINDS] = {
        "one vertex inside", "cone", "corridor", "cube", "ball", "flat"};
    static const size_t FINE[4] = {12, 6, 4, 3}, LONG[4] = {60, 30, 8, 4};
    const int32_t dim = 2 + k / FLUX_KINDS;
    const int kind = k % FLUX_KINDS;
    const iccp_env env = default_env();
    random_source r = {(uint64_t)k};
    icc_error err = {.size = sizeof err};
    flux_case c;
    test_mesh m, square;
    if (kind == 0)
        m = mesh_cube(dim, 2, 0.1, &r);
    else if (kind == 1)
        m = flux_cone(dim, &r);
    else if (kind == 2)
        m = mesh_cells(dim, LONG[dim - 2], flux_in_corridor);
    else if (kind == FLUX_CUBE)
        m = mesh_cube(dim, FINE[dim - 2], 0.1, &r);
    else if (kind == 4)
        m = mesh_ball(dim, FINE[dim - 2], 0, &r);
    else {
        square = mesh_cube(dim, FINE[dim - 2], 0.1, &r);
        m = mesh_moved(&square, flux_squeeze);
        mesh_free(&square);
    }
    (void)snprintf(c.name, sizeof c.name, "%d-D %s", (int)dim, NAMES[kind]);
    ck_assert_msg(mesh_domain(&c.domain, &m, NULL, &err) == ICC_OK, "%s: %s", c.name, err.message);
    c.mesh = c.domain->mesh;
    ck_assert_int_eq(iccp_deepest_centre(c.domain, c.mesh, &c.centre, &env), ICC_OK);
    mesh_free(&m);
    return c;
}

static inline void flux_free(flux_case *c)
{
    icc_domain_free(c->domain);
}

static inline bool flux_in_star(const flux_case *c, size_t simplex)
{
    for (size_t i = 0; i <= c->mesh->dim; ++i)
        if (c->mesh->corners[(c->mesh->dim + 1) * simplex + i] == c->centre)
            return true;
    return false;
}

static inline size_t flux_sides(const iccp_simplices *mesh)
{
    return (mesh->dim + 1) * mesh->n_simplices;
}

/* The sides of a facet agree, inner sides of the star have none, and what comes in goes to the
 * star. */
static inline void flux_check(const flux_case *c, const double *inflow, const double *flux)
{
    double arrived = 0;
    for (uint32_t s = 0; s < flux_sides(c->mesh); ++s) {
        const uint32_t other = c->mesh->across[s];
        const bool in_star = flux_in_star(c, iccp_simplex_of(c->mesh, s));
        if ((other & ICCP_ON_BOUNDARY) != 0)
            ck_assert_msg(flux[s] == -inflow[other & ~ICCP_ON_BOUNDARY], "%s: inflow", c->name);
        else
            ck_assert_msg(flux[s] == -flux[other], "%s: sides differ", c->name);
        if (in_star && c->mesh->corners[s] != c->centre)
            ck_assert_msg(!(fabs(flux[s]) > 0), "%s: flux within the star", c->name);
        arrived -= in_star ? flux[s] : 0;
    }
    ck_assert_msg(fabs(arrived - 1) < 1e-8, "%s: %g arrive", c->name, arrived);
}

#endif

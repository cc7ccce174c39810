/* What the stages of foliations of simplices cost, on cubes in 3 to 5 dimensions and on tetrahedra
 * in surfaces: usage: bench_shelling [NAME.obj ...], with the program tetgen installed for
 * these. */
#include "domain/domain.h"
#include "shelling/centres.h"
#include "shelling/circulation.h"
#include "shelling/shelling_order.h"

#include "../meshes.h"
#include "bench.h"

typedef struct stages {
    const iccp_simplices *mesh;
    uint32_t centre;
    double *inflow, *reference, *potential, *flux;
    uint32_t *rank;
    iccp_env env;
} stages;

static double since(double *then)
{
    const double now = bench_seconds(), passed = 1e3 * (now - *then);
    *then = now;
    return passed;
}

/* ------------------------------------------------------------------ fluxes */

static void bench_reference(stages *s)
{
    double then = bench_seconds();
    bench_check(iccp_inflow(s->mesh, s->centre, 0.5, s->inflow, &s->env), NULL);
    printf("    inflow     %8.1f ms\n", since(&then));
    bench_check(
        iccp_reference_flux(s->mesh, s->centre, s->inflow, s->reference, s->potential, &s->env),
        NULL);
    printf("    reference  %8.1f ms\n", since(&then));
}

static void bench_circulation(stages *s)
{
    enum { SWEEPS = 25 };
    iccp_circulation c;
    double then = bench_seconds();
    bench_check(iccp_circulation_create(&c, s->mesh, s->centre, s->inflow, s->reference, &s->env),
                NULL);
    printf("    rings      %8.1f ms, %zu with %zu steps\n", since(&then), c.links.n,
           c.links.first[c.links.n]);
    bench_check(iccp_circulation_greedy(&c, s->rank, s->flux, &s->env), NULL);
    printf("    greedy     %8.1f ms, energy %.2e, divergence %.0e\n", since(&then),
           iccp_circulation_energy(&c, s->flux), iccp_circulation_divergence(&c, s->flux));
    then = bench_seconds();
    for (int i = 0; i < 3; ++i) {
        bench_check(iccp_circulation_relax(&c, s->rank, SWEEPS, s->flux, &s->env), NULL);
        printf("    %d sweeps  %8.1f ms, energy %.2e\n", SWEEPS, since(&then),
               iccp_circulation_energy(&c, s->flux));
        then = bench_seconds();
    }
    printf("    divergence %.0e\n", iccp_circulation_divergence(&c, s->flux));
    iccp_circulation_free(&c);
}

/* ------------------------------------------------------------------ orders */

/* Whether one is complete. */
static bool bench_orders(stages *s)
{
    iccp_faces faces;
    double then = bench_seconds();
    size_t n_left;
    bench_check(iccp_faces_create(&faces, s->mesh, &s->env), NULL);
    printf("    faces      %8.1f ms\n", since(&then));
    const iccp_order_priority wish = {s->mesh,      &faces, s->centre, s->reference,
                                      s->potential, 32,     NULL};
    bench_check(iccp_order_grow(&wish, s->rank, &n_left, &s->env), NULL);
    printf("    grow       %8.1f ms, %zu left\n", since(&then), n_left);
    bench_check(iccp_order_peel(&wish, s->rank, &n_left, &s->env), NULL);
    printf("    peel       %8.1f ms, %zu left\n", since(&then), n_left);
    iccp_faces_free(&faces);
    return n_left == 0;
}

/* -------------------------------------------------------------------- runs */

static void bench_all(const char *name, const test_mesh *m)
{
    icc_domain *domain;
    icc_error error = {.size = sizeof error};
    stages s;
    double then = bench_seconds();
    bench_check(mesh_domain(&domain, m, NULL, &error), &error);
    s.mesh = domain->mesh;
    const size_t n = s.mesh->n_simplices, n_sides = (s.mesh->dim + 1) * n;
    printf("%s: %zu simplices\n    domain     %8.1f ms\n", name, n, since(&then));
    bench_check(iccp_env_read(&s.env, NULL, &error), &error);
    s.inflow = bench_alloc(s.mesh->n_facets, sizeof(double));
    s.reference = bench_alloc(n_sides, sizeof(double));
    s.flux = bench_alloc(n_sides, sizeof(double));
    s.potential = bench_alloc(n, sizeof(double));
    s.rank = bench_alloc(n, sizeof(uint32_t));
    then = bench_seconds();
    bench_check(iccp_deepest_centre(domain, s.mesh, &s.centre, &s.env), NULL);
    printf("    centre     %8.1f ms\n", since(&then));
    bench_reference(&s);
    if (bench_orders(&s))
        bench_circulation(&s);
    free(s.inflow);
    free(s.reference);
    free(s.flux);
    free(s.potential);
    free(s.rank);
    icc_domain_free(domain);
}

static void bench_cube(int32_t dim, size_t n)
{
    char name[64];
    random_source r = {1};
    test_mesh m = mesh_cube(dim, n, 0.1, &r);
    (void)snprintf(name, sizeof name, "%d-D cube of %zu cells a side", (int)dim, n);
    bench_all(name, &m);
    mesh_free(&m);
}

int main(int n_arguments, char **arguments)
{
    for (int i = 1; i < n_arguments; ++i) {
        obj o;
        test_mesh m;
        if (!obj_read(&o, arguments[i])) {
            fprintf(stderr, "cannot read %s\n", arguments[i]);
            return EXIT_FAILURE;
        }
        if (mesh_tetgen(&m, o.n_vertices, o.vertices, o.n_faces, o.faces, "bench_shelling"))
            bench_all(arguments[i], &m);
        mesh_free(&m);
        obj_free(&o);
    }
    if (n_arguments > 1)
        return EXIT_SUCCESS;
    bench_cube(3, 6);
    bench_cube(3, 12);
    bench_cube(3, 24);
    bench_cube(4, 5);
    bench_cube(5, 3);
    return EXIT_SUCCESS;
}

/* Orders of tetrahedra: usage: bench_order SURFACE.obj ..., with the program tetgen installed. What
 * growing and peeling take, how much of the harmonic flux they reverse before and after facets are
 * turned, the energy of the flux that is fitted, what the contest takes, and how often each way is
 * complete for maxima by chance. Run by hand on a quiet machine. */
#include "base/error.h"
#include "shelling/best_order.h"
#include "shelling/centres.h"
#include "shelling/reverse.h"

#include "../meshes.h"
#include "bench.h"

enum { N_MAXIMA = 12 };

typedef struct subject {
    const char *name;
    icc_domain *domain;
    const iccp_simplices *mesh;
    iccp_env env;
    uint32_t centre;
    double *inflow, *reference, *potential, *flux;
    uint32_t *rank;
    iccp_faces faces;
    iccp_circulation circulation;
} subject;

static void check(icc_status status)
{
    bench_check(status, &(icc_error){.message = "in the library"});
}

static void begin(subject *s, const char *path)
{
    obj o;
    test_mesh mesh;
    icc_error err = {.size = sizeof err};
    *s = (subject){.name = strrchr(path, '/') != NULL ? strrchr(path, '/') + 1 : path};
    check(iccp_env_read(&s->env, NULL, NULL));
    if (!obj_read(&o, path) ||
        !mesh_tetgen(&mesh, o.n_vertices, o.vertices, o.n_faces, o.faces, "bench_order")) {
        fprintf(stderr, "cannot mesh %s\n", path);
        exit(EXIT_FAILURE);
    }
    obj_free(&o);
    bench_check(mesh_domain(&s->domain, &mesh, NULL, &err), &err);
    mesh_free(&mesh);
    s->mesh = s->domain->mesh;
    s->inflow = bench_alloc(s->mesh->n_facets, sizeof *s->inflow);
    s->reference = bench_alloc(4 * s->mesh->n_simplices, sizeof *s->reference);
    s->flux = bench_alloc(4 * s->mesh->n_simplices, sizeof *s->flux);
    s->potential = bench_alloc(s->mesh->n_simplices, sizeof *s->potential);
    s->rank = bench_alloc(s->mesh->n_simplices, sizeof *s->rank);
    const double start = bench_seconds();
    check(iccp_faces_create(&s->faces, s->mesh, &s->env));
    printf("%s: %zu tetrahedra, %zu facets; faces %.1f ms\n", s->name, s->mesh->n_simplices,
           s->mesh->n_facets, 1e3 * (bench_seconds() - start));
}

static void end(subject *s)
{
    iccp_faces_free(&s->faces);
    free(s->inflow);
    free(s->reference);
    free(s->flux);
    free(s->potential);
    free(s->rank);
    icc_domain_free(s->domain);
}

static double aim(subject *s, uint32_t centre)
{
    const double start = bench_seconds();
    s->centre = centre;
    check(iccp_inflow(s->mesh, centre, 0.5, s->inflow, &s->env));
    check(iccp_reference_flux(s->mesh, centre, s->inflow, s->reference, s->potential, &s->env));
    return bench_seconds() - start;
}

static size_t order(const subject *s, double beta, bool peel, double *seconds)
{
    const iccp_order_priority priority = {s->mesh,      &s->faces, s->centre, s->reference,
                                          s->potential, beta,      NULL};
    const double start = bench_seconds();
    size_t n_left = 0;
    check((peel ? iccp_order_peel : iccp_order_grow)(&priority, s->rank, &n_left, &s->env));
    *seconds = bench_seconds() - start;
    return n_left;
}

/* Shares of the facets, and of the flux, that an order turns round, in %. */
static void reversed(const subject *s, double share[2])
{
    double all[2] = {0, 0}, turned[2] = {0, 0};
    for (size_t f = 0; f < s->circulation.links.n_facets; ++f) {
        const uint32_t side = s->circulation.links.side[f];
        const double flux[2] = {1, fabs(s->reference[side])};
        const bool falls = s->rank[side / 4] > s->rank[s->mesh->across[side] / 4];
        for (int k = 0; k < 2; ++k) {
            all[k] += flux[k];
            turned[k] += falls != (s->reference[side] > 0) ? flux[k] : 0;
        }
    }
    for (int k = 0; k < 2; ++k)
        share[k] = 100 * turned[k] / all[k];
}

/* What an order is worth. */
static void tell(subject *s)
{
    double share[2];
    reversed(s, share);
    printf(", reversed %.3f %% of facets, %.4f %% of flux; energy after", share[0], share[1]);
    for (size_t n_sweeps = 0; n_sweeps <= 100; n_sweeps = n_sweeps == 0 ? 1 : 10 * n_sweeps) {
        check(iccp_circulation_greedy(&s->circulation, s->rank, s->flux, &s->env));
        check(iccp_circulation_relax(&s->circulation, s->rank, n_sweeps, s->flux, &s->env));
        printf(" [%zu] %.2e", n_sweeps, iccp_circulation_energy(&s->circulation, s->flux));
    }
    printf("\n");
}

static void turn(subject *s)
{
    const iccp_order_priority priority = {s->mesh,      &s->faces, s->centre, s->reference,
                                          s->potential, 0,         NULL};
    size_t n_turned;
    const double start = bench_seconds();
    check(iccp_order_reverse(&priority, s->rank, &n_turned, &s->env));
    printf("       turned %zu: %.2f us a tetrahedron", n_turned,
           1e6 * (bench_seconds() - start) / (double)s->mesh->n_simplices);
    tell(s);
}

static void compare_orders(subject *s)
{
    check(iccp_circulation_create(&s->circulation, s->mesh, s->centre, s->inflow, s->reference,
                                  &s->env));
    for (int peel = 1; peel >= 0; --peel)
        for (double beta = 2; beta < 5000; beta *= 2) {
            double seconds;
            const size_t n_left = order(s, beta, peel != 0, &seconds);
            printf("  %s %4g: %.2f us a tetrahedron", peel ? "peel" : "grow", beta,
                   1e6 * seconds / (double)s->mesh->n_simplices);
            if (n_left > 0) {
                printf(", %zu left\n", n_left);
                continue;
            }
            tell(s);
            turn(s);
        }
    iccp_circulation_free(&s->circulation);
}

static void compete(subject *s, double seconds_flux)
{
    iccp_best_order_info i;
    icc_error err = {.size = sizeof err};
    const double start = bench_seconds();
    bench_check(iccp_best_order(s->mesh, s->centre, s->inflow, s->reference, s->potential, s->rank,
                                s->flux, &i, &s->env, &err),
                &err);
    const double seconds = bench_seconds() - start;
    printf(
        "  contest: %.3f s, %.1f us a tetrahedron, beside %.3f s for the flux; %s %g, energy %.2e, "
        "%zu reversed, divergence %.0e; %zu of %zu complete\n",
        seconds, 1e6 * seconds / (double)s->mesh->n_simplices, seconds_flux,
        i.peeled ? "peel" : "grow", i.beta, i.energy, i.n_reversed, i.divergence, i.n_finished,
        i.n_orders);
}

static void try_maxima(subject *s)
{
    random_source r = {1};
    size_t n_grown = 0, n_peeled = 0, n_neither = 0;
    for (int k = 0; k < N_MAXIMA; ++k) {
        double seconds;
        (void)aim(s,
                  (uint32_t)s->mesh->n_boundary +
                      (uint32_t)random_below(&r, (int)(s->mesh->n_points - s->mesh->n_boundary)));
        const bool grown = order(s, 8, false, &seconds) == 0,
                   peeled = order(s, 8, true, &seconds) == 0;
        n_grown += grown;
        n_peeled += peeled;
        n_neither += !grown && !peeled;
    }
    printf("  %d maxima by chance: %zu grown, %zu peeled, %zu neither\n", (int)N_MAXIMA, n_grown,
           n_peeled, n_neither);
}

int main(int argc, char **argv)
{
    for (int k = 1; k < argc; ++k) {
        subject s;
        uint32_t centre;
        begin(&s, argv[k]);
        check(iccp_deepest_centre(s.domain, s.mesh, &centre, &s.env));
        const double seconds = aim(&s, centre);
        compare_orders(&s);
        compete(&s, seconds);
        try_maxima(&s);
        end(&s);
    }
    return 0;
}

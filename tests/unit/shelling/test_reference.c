/* What flows in and the reference flux. The flux is without sources and, of all fluxes of constant
 * vectors that are, the one with the least energy: two properties that have it all. */
#include "base/error.h"
#include "math/orient.h"
#include "shelling/arranged.h"
#include "shelling/element.h"
#include "shelling/links.h"
#include "shelling/reference.h"

#include "../../fluxes.h"
#include "../../suite.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>

typedef struct fluxes {
    double *inflow, *flux, *potential;
} fluxes;

static fluxes room_for(const iccp_simplices *mesh)
{
    return (fluxes){mesh_alloc(mesh->n_facets, sizeof(double)),
                    mesh_alloc(flux_sides(mesh), sizeof(double)),
                    mesh_alloc(mesh->n_simplices, sizeof(double))};
}

static void fluxes_free(fluxes *f)
{
    free(f->inflow);
    free(f->flux);
    free(f->potential);
}

static fluxes solve(const flux_case *c, double harmonic)
{
    const iccp_env env = default_env();
    fluxes f = room_for(c->mesh);
    ck_assert_int_eq(iccp_inflow(c->mesh, c->centre, harmonic, f.inflow, &env), ICC_OK);
    ck_assert_int_eq(iccp_reference_flux(c->mesh, c->centre, f.inflow, f.flux, f.potential, &env),
                     ICC_OK);
    return f;
}

/* Gradients are dual to the edges; areas are theirs, and the same from both sides, as are the
 * wires. */
START_TEST(geometry_of_simplices)
{
    for (int k = 0; k < FLUX_CASES; ++k) {
        flux_case c = flux_number(k);
        const size_t dim = c.mesh->dim;
        for (size_t t = 0; t < c.mesh->n_simplices; ++t) {
            double gradient[(ICC_MAX_DIM + 1) * ICC_MAX_DIM];
            const double volume = iccp_element_gradients(c.mesh, t, gradient);
            const double *last = iccp_corner_point(c.mesh, (dim + 1) * t + dim);
            for (size_t i = 0; i <= dim; ++i) {
                const size_t side = (dim + 1) * t + i;
                const uint32_t other = c.mesh->across[side];
                const double *corner = iccp_corner_point(c.mesh, side);
                const double area = iccp_element_area(c.mesh, side);
                double square = 0;
                for (size_t d = 0; d < dim; ++d)
                    square += gradient[dim * i + d] * gradient[dim * i + d];
                ck_assert_msg(fabs(area / ((double)dim * volume * sqrt(square)) - 1) < 1e-9,
                              "%s: area", c.name);
                for (size_t j = 0; j <= dim; ++j) {
                    double along = (double)(j == dim) - (double)(j == i);
                    for (size_t d = 0; d < dim; ++d)
                        along += gradient[dim * j + d] * (corner[d] - last[d]);
                    ck_assert_msg(fabs(along) < 1e-9, "%s: gradient", c.name);
                }
                if ((other & ICCP_ON_BOUNDARY) != 0)
                    continue;
                ck_assert_msg(fabs(iccp_element_area(c.mesh, other) / area - 1) < 1e-12, "%s",
                              c.name);
                ck_assert_msg(fabs(iccp_element_conductance(c.mesh, other) /
                                       iccp_element_conductance(c.mesh, side) -
                                   1) < 1e-12,
                              "%s: wire", c.name);
            }
        }
        flux_free(&c);
    }
}
END_TEST

static void check_inflow(const flux_case *c, const double *inflow)
{
    double sum = 0;
    for (size_t f = 0; f < c->mesh->n_facets; ++f) {
        ck_assert_msg(inflow[f] > 0, "%s: nothing through facet %zu", c->name, f);
        sum += inflow[f];
    }
    ck_assert_msg(fabs(sum - 1) < 1e-12, "%s: %g enters", c->name, sum);
}

START_TEST(inflow_is_positive)
{
    const double shares[] = {0, 0.5, 0.99};
    for (int k = 0; k < FLUX_CASES; ++k) {
        flux_case c = flux_number(k);
        for (int i = 0; i < 3; ++i) {
            const iccp_env env = default_env();
            fluxes f = room_for(c.mesh);
            ck_assert_int_eq(iccp_inflow(c.mesh, c.centre, shares[i], f.inflow, &env), ICC_OK);
            check_inflow(&c, f.inflow);
            fluxes_free(&f);
        }
        flux_free(&c);
    }
}
END_TEST

/* The facets of a cube of lattice cells are all alike. */
START_TEST(uniform_inflow_goes_by_area)
{
    for (int32_t dim = 2; dim <= 5; ++dim) {
        flux_case c = flux_number(FLUX_KINDS * (dim - 2) + FLUX_CUBE);
        const iccp_env env = default_env();
        fluxes f = room_for(c.mesh);
        ck_assert_int_eq(iccp_inflow(c.mesh, c.centre, 0, f.inflow, &env), ICC_OK);
        for (size_t i = 0; i < c.mesh->n_facets; ++i)
            ck_assert_msg(fabs(f.inflow[i] * (double)c.mesh->n_facets - 1) < 1e-12, "%s: facet %zu",
                          c.name, i);
        fluxes_free(&f);
        flux_free(&c);
    }
}
END_TEST

/* Harmonic inflow at the ends of a corridor is small, and to many digits: it falls by the same
 * factor on every stretch of the way. */
START_TEST(harmonic_inflow_falls_along_a_corridor)
{
    test_mesh m = mesh_cells(2, 300, flux_in_corridor);
    icc_domain *domain;
    ck_assert_int_eq(mesh_domain(&domain, &m, NULL, NULL), ICC_OK);
    const iccp_simplices *mesh = domain->mesh;
    const iccp_env env = default_env();
    const double point[2] = {domain->lower[0], 0};
    const uint32_t centre = iccp_nearest_centre(mesh, point);
    fluxes f = room_for(mesh);
    double at[5] = {0};
    ck_assert_int_eq(iccp_inflow(mesh, centre, 1, f.inflow, &env), ICC_OK);
    for (size_t i = 0; i < mesh->n_facets; ++i)
        for (int k = 0; k < 5; ++k) {
            const double *p = domain->vertices + 2 * domain->facets[2 * i];
            const double x = domain->lower[0] +
                             (domain->upper[0] - domain->lower[0]) * (double)(20 + 60 * k) / 300;
            if (fabs(p[0] - x) < 1e-9 && p[1] <= domain->lower[1])
                at[k] = f.inflow[i];
        }
    for (int k = 0; k < 3; ++k) {
        ck_assert(at[k + 1] < 1e-20 * at[k] && at[k + 2] > 0);
        ck_assert_double_eq_tol(log(at[k + 2] / at[k + 1]) / log(at[k + 1] / at[k]), 1, 1e-6);
    }
    fluxes_free(&f);
    icc_domain_free(domain);
    mesh_free(&m);
}
END_TEST

START_TEST(flux_has_no_sources)
{
    for (int k = 0; k <= FLUX_CASES; ++k) {
        flux_case c = flux_number(k);
        fluxes f = solve(&c, 0.5);
        const size_t n_corners = c.mesh->dim + 1;
        flux_check(&c, f.inflow, f.flux);
        for (size_t t = 0; t < c.mesh->n_simplices; ++t) {
            double sum = 0, size = 0;
            for (size_t s = n_corners * t; s < n_corners * (t + 1); ++s) {
                sum += f.flux[s];
                size += fabs(f.flux[s]);
            }
            if (flux_in_star(&c, t))
                ck_assert_msg(!(fabs(f.potential[t]) > 0), "%s: potential", c.name);
            else
                ck_assert_msg(fabs(sum) <= 1e-6 * size, "%s: source of %g of %g", c.name, sum,
                              size);
        }
        fluxes_free(&f);
        flux_free(&c);
    }
}
END_TEST

static double volume_of(const iccp_simplices *mesh, size_t simplex)
{
    const double *corner[ICC_MAX_DIM + 1];
    double volume;
    for (size_t i = 0; i <= mesh->dim; ++i)
        corner[i] = iccp_corner_point(mesh, (mesh->dim + 1) * simplex + i);
    volume = iccp_orient_value(mesh->dim, corner);
    for (size_t k = 2; k <= mesh->dim; ++k)
        volume /= (double)k;
    return volume;
}

/* The vector with given fluxes, which add up to 0, through the sides: the mean of the lowest-order
 * field of P.-A. Raviart and J.-M. Thomas. */
static void vector_of(const iccp_simplices *mesh, size_t simplex, const double *flux, double *u)
{
    const double volume = volume_of(mesh, simplex);
    const double *origin = iccp_corner_point(mesh, (mesh->dim + 1) * simplex);
    for (size_t k = 0; k < mesh->dim; ++k) {
        u[k] = 0;
        for (size_t i = 1; i <= mesh->dim; ++i)
            u[k] -=
                flux[i] * (iccp_corner_point(mesh, (mesh->dim + 1) * simplex + i)[k] - origin[k]);
        u[k] /= (double)mesh->dim * volume;
    }
}

/* What one more unit round a ring would do to the energy, and the sum of the moduli of its
 * terms. */
static double slope(const flux_case *c, const iccp_links *links, size_t ring, const double *flux,
                    double *size)
{
    const iccp_simplices *mesh = c->mesh;
    const size_t n_corners = mesh->dim + 1;
    double sum = 0;
    *size = 0;
    for (size_t p = links->first[ring]; p < links->first[ring + 1]; ++p) {
        const uint32_t side = links->side[links->step[p] / 2];
        const double on = links->step[p] % 2 == 0 ? 1 : -1;
        for (int k = 0; k < 2; ++k) {
            const uint32_t here = k == 0 ? side : mesh->across[side];
            const size_t t = iccp_simplex_of(mesh, here);
            double u[ICC_MAX_DIM];
            if (flux_in_star(c, t))
                continue;
            vector_of(mesh, t, flux + n_corners * t, u);
            /* The ring leaves the simplex as it enters it, so that it does not matter from where
             * this is measured. */
            double product = 0;
            for (size_t d = 0; d < mesh->dim; ++d)
                product += u[d] * (iccp_corner_point(mesh, n_corners * t)[d] -
                                   iccp_corner_point(mesh, here)[d]);
            sum += (k == 0 ? on : -on) * product;
            *size += fabs(product);
        }
    }
    return sum;
}

START_TEST(flux_has_least_energy)
{
    size_t n_links = 0;
    for (int k = 0; k <= FLUX_CASES; ++k) {
        flux_case c = flux_number(k);
        fluxes f = solve(&c, 0.5);
        const iccp_env env = default_env();
        iccp_links links;
        ck_assert_int_eq(iccp_links_create(&links, c.mesh, c.centre, &env), ICC_OK);
        for (size_t r = 0; r < links.n; ++r) {
            double size;
            const double s = slope(&c, &links, r, f.flux, &size);
            ck_assert_msg(fabs(s) <= 1e-7 * size, "%s: ring %zu: %g of %g", c.name, r, s, size);
        }
        n_links += links.n;
        iccp_links_free(&links);
        fluxes_free(&f);
        flux_free(&c);
    }
    ck_assert_uint_gt(n_links, 10000);
}
END_TEST

/* In a round disc with a fine mesh, from the boundary straight to the centre: the potential is
 * log(r), and half of the way has log(2) / (2 pi) of it. */
START_TEST(potential_of_a_disc)
{
    enum { N = 96 };
    double xy[2 * N];
    for (int i = 0; i < N; ++i) {
        xy[2 * i] = cos(2 * 3.14159265358979323846 * i / N);
        xy[2 * i + 1] = sin(2 * 3.14159265358979323846 * i / N);
    }
    test_mesh m = mesh_polygon(N, xy, 0.06);
    flux_case c = {.name = "disc"};
    const double origin[2] = {0, 0};
    double sum[2] = {0, 0}, count[2] = {0, 0};
    ck_assert_int_eq(mesh_domain(&c.domain, &m, NULL, NULL), ICC_OK);
    c.mesh = c.domain->mesh;
    c.centre = iccp_nearest_centre(c.mesh, origin);
    fluxes f = solve(&c, 0.5);
    const double *o = c.mesh->points + 2 * c.centre, scale = c.domain->upper[0] - o[0];
    for (size_t t = 0; t < c.mesh->n_simplices; ++t) {
        double radius = 0;
        for (size_t i = 0; i < 3; ++i) {
            const double *p = iccp_corner_point(c.mesh, 3 * t + i);
            radius += hypot(p[0] - o[0], p[1] - o[1]) / (3 * scale);
        }
        for (int k = 0; k < 2; ++k)
            if (fabs(radius - (k + 1) * 0.4) < 0.05) {
                sum[k] += f.potential[t];
                count[k] += 1;
            }
    }
    ck_assert(count[0] > 20 && count[1] > 20);
    ck_assert_double_eq_tol(sum[1] / count[1] - sum[0] / count[0],
                            log(2) / (2 * 3.14159265358979323846), 0.01);
    fluxes_free(&f);
    icc_domain_free(c.domain);
    mesh_free(&m);
}
END_TEST

/* Moves the first corner inside the cube of a simplex from the k-th on almost to the opposite
 * facet. */
static void flatten(test_mesh *m, size_t k, size_t n, double height)
{
    const size_t dim = (size_t)m->dim;
    for (size_t s = (dim + 1) * k;; ++s) {
        const size_t first = s - s % (dim + 1);
        double *x = m->vertices + dim * m->simplices[s];
        bool is_inner = true;
        for (size_t d = 0; d < dim; ++d)
            is_inner = is_inner && x[d] > 0 && x[d] < (double)n;
        if (!is_inner)
            continue;
        for (size_t d = 0; d < dim; ++d) {
            double mean = 0;
            for (size_t i = first; i <= first + dim; ++i)
                mean += i != s ? m->vertices[dim * m->simplices[i] + d] / (double)dim : 0;
            x[d] = mean + height * (x[d] - mean);
        }
        return;
    }
}

/* Whatever the mesh, there is a reference that is good enough. */
START_TEST(flat_simplices_do_no_harm)
{
    static const size_t FINE[3] = {12, 6, 3};
    int n_meshes = 0;
    for (int32_t dim = 2; dim <= 4; ++dim)
        for (double height = 1e-4; height > 1e-12; height /= 10) {
            const size_t n = FINE[dim - 2];
            const iccp_env env = default_env();
            flux_case c = {.name = "flat simplex"};
            icc_status status = ICC_ERR_BOUNDARY;
            /* Until no other is turned over. */
            for (size_t k = 0; k < 64 && status != ICC_OK; ++k) {
                random_source r = {(uint64_t)dim};
                test_mesh m = mesh_cube(dim, n, 0.1, &r);
                flatten(&m, m.n_simplices / 3 + k, n, height);
                status = mesh_domain(&c.domain, &m, NULL, NULL);
                mesh_free(&m);
            }
            if (status != ICC_OK)
                continue;
            c.mesh = c.domain->mesh;
            ck_assert_int_eq(iccp_deepest_centre(c.domain, c.mesh, &c.centre, &env), ICC_OK);
            fluxes f = solve(&c, 0.5);
            flux_check(&c, f.inflow, f.flux);
            fluxes_free(&f);
            flux_free(&c);
            ++n_meshes;
        }
    ck_assert_int_ge(n_meshes, 16);
}
END_TEST

/* From the middle of a round disc as much reaches every stretch of the boundary. */
START_TEST(harmonic_inflow_of_a_disc)
{
    enum { N = 96 };
    double xy[2 * N];
    for (int i = 0; i < N; ++i) {
        xy[2 * i] = cos(2 * 3.14159265358979323846 * i / N);
        xy[2 * i + 1] = sin(2 * 3.14159265358979323846 * i / N);
    }
    test_mesh m = mesh_polygon(N, xy, 0.06);
    const double origin[2] = {0, 0};
    const iccp_env env = default_env();
    icc_domain *domain;
    double windows[4] = {0};
    ck_assert_int_eq(mesh_domain(&domain, &m, NULL, NULL), ICC_OK);
    fluxes f = room_for(domain->mesh);
    ck_assert_int_eq(
        iccp_inflow(domain->mesh, iccp_nearest_centre(domain->mesh, origin), 1, f.inflow, &env),
        ICC_OK);
    for (size_t i = 0; i < domain->n_facets; ++i) {
        const double *p = domain->vertices + 2 * domain->facets[2 * i];
        const double *q = domain->vertices + 2 * domain->facets[2 * i + 1];
        windows[(p[0] + q[0] > 0) + 2 * (p[1] + q[1] > 0)] += f.inflow[i];
    }
    for (int k = 0; k < 4; ++k)
        ck_assert_double_eq_tol(windows[k], 0.25, 0.02);
    fluxes_free(&f);
    icc_domain_free(domain);
    mesh_free(&m);
}
END_TEST

/* The same simplices with the same neighbours, in an order of their own. */
START_TEST(arranged_meshes_are_the_same)
{
    for (int k = 0; k < FLUX_CASES; ++k) {
        const iccp_env env = default_env();
        flux_case c = flux_number(k);
        const size_t n = c.mesh->dim + 1, n_sides = flux_sides(c.mesh);
        iccp_arranged a;
        ck_assert_int_eq(iccp_arranged_create(&a, c.mesh, &env), ICC_OK);
        double *here = mesh_alloc(n_sides, sizeof *here);
        double *there = mesh_alloc(n_sides, sizeof *there);
        for (size_t s = 0; s < n_sides; ++s) {
            const uint32_t across = a.mesh.across[s];
            const size_t given = n * a.order[s / n] + s % n;
            const uint32_t expected = c.mesh->across[given];
            ck_assert_uint_eq(a.mesh.corners[s], c.mesh->corners[given]);
            if (expected >= ICCP_ON_BOUNDARY)
                ck_assert_uint_eq(across, expected);
            else
                ck_assert_uint_eq(n * a.order[across / n] + across % n, expected);
            here[s] = (double)given;
            there[s] = -1;
        }
        iccp_arranged_restore(&a, here, there);
        for (size_t s = 0; s < n_sides; ++s)
            ck_assert(fabs(there[s] - (double)s) < 0.5);
        iccp_arranged_free(&a);
        free(here);
        free(there);
        flux_free(&c);
    }
}
END_TEST

/* A factor would take a gigabyte. */
static void *small_alloc(void *user, size_t size)
{
    (void)user;
    return size > 64u << 20 ? NULL : malloc(size);
}

static void plain_free(void *user, void *memory)
{
    (void)user;
    free(memory);
}

START_TEST(iterations_take_little_memory)
{
    const icc_env given = {.size = sizeof given, .alloc = small_alloc, .dealloc = plain_free};
    flux_case c = flux_number(FLUX_CASES);
    fluxes f = room_for(c.mesh);
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, &given, NULL), ICC_OK);
    ck_assert_int_eq(iccp_inflow(c.mesh, c.centre, 0.5, f.inflow, &env), ICC_OK);
    ck_assert_int_eq(iccp_reference_flux(c.mesh, c.centre, f.inflow, f.flux, f.potential, &env),
                     ICC_OK);
    fluxes_free(&f);
    flux_free(&c);
}
END_TEST

static icc_status make_fluxes(const icc_env *given, icc_error *err, void *argument)
{
    const flux_case *c = argument;
    iccp_env env;
    fluxes f = room_for(c->mesh);
    icc_status status = iccp_env_read(&env, given, err);
    if (status == ICC_OK)
        status = iccp_inflow(c->mesh, c->centre, 0.5, f.inflow, &env);
    if (status == ICC_OK)
        status = iccp_reference_flux(c->mesh, c->centre, f.inflow, f.flux, f.potential, &env);
    fluxes_free(&f);
    return iccp_explain(err, status);
}

START_TEST(failures_leave_nothing)
{
    flux_case c = flux_number(FLUX_KINDS + FLUX_CUBE);
    faulty_sweep(make_fluxes, &c);
    flux_free(&c);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("reference");
    TCase *test = tcase_create("reference");
    tcase_add_test(test, geometry_of_simplices);
    tcase_add_test(test, inflow_is_positive);
    tcase_add_test(test, uniform_inflow_goes_by_area);
    tcase_add_test(test, harmonic_inflow_falls_along_a_corridor);
    tcase_add_test(test, harmonic_inflow_of_a_disc);
    tcase_add_test(test, arranged_meshes_are_the_same);
    tcase_add_test(test, flux_has_no_sources);
    tcase_add_test(test, flux_has_least_energy);
    tcase_add_test(test, potential_of_a_disc);
    tcase_add_test(test, flat_simplices_do_no_harm);
    tcase_add_test(test, iterations_take_little_memory);
    tcase_add_test(test, failures_leave_nothing);
    suite_add_tcase(suite, test);
    return suite_run(suite);
}

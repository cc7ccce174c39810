/* Centres of meshes, against looking at all vertices. */
#include "../../flat_mesh.h"
#include "base/error.h"
#include "geometry/simplex.h"
#include "shelling/centres.h"

#include "../../fluxes.h"
#include "../../suite.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>

static double depth_of(const icc_domain *domain, uint32_t vertex)
{
    const size_t dim = (size_t)domain->dim;
    double least = HUGE_VAL;
    for (uint32_t f = 0; f < domain->n_facets; ++f) {
        const double *corner[ICC_MAX_DIM];
        double bary[ICC_MAX_DIM];
        for (size_t i = 0; i < dim; ++i)
            corner[i] = domain->vertices + dim * domain->facets[dim * f + i];
        least = fmin(least, iccp_simplex_nearest(dim, dim, corner,
                                                 domain->mesh->points + dim * vertex, bary));
    }
    return sqrt(least);
}

static double greatest_depth(const icc_domain *domain)
{
    double most = 0;
    for (size_t v = domain->mesh->n_boundary; v < domain->mesh->n_points; ++v)
        most = fmax(most, depth_of(domain, (uint32_t)v));
    return most;
}

static bool is_inner(const icc_domain *domain, uint32_t vertex)
{
    return vertex >= domain->mesh->n_boundary && vertex < domain->mesh->n_points;
}

START_TEST(deepest_of_all)
{
    for (int k = 0; k < 3 * FLUX_KINDS; ++k) {
        flux_case c = flux_number(k);
        const double most = greatest_depth(c.domain);
        ck_assert(is_inner(c.domain, c.centre));
        ck_assert_msg(depth_of(c.domain, c.centre) >= most * (1 - 1e-12), "%s: %g of %g", c.name,
                      depth_of(c.domain, c.centre), most);
        flux_free(&c);
    }
}
END_TEST

START_TEST(nearest_of_all)
{
    for (int k = 0; k < FLUX_CASES; ++k) {
        flux_case c = flux_number(k);
        const size_t dim = c.mesh->dim;
        for (size_t v = c.mesh->n_boundary; v < c.mesh->n_points; v += 1 + c.mesh->n_points / 50)
            ck_assert_uint_eq(iccp_nearest_centre(c.mesh, c.mesh->points + dim * v), v);
        ck_assert(is_inner(c.domain, iccp_nearest_centre(c.mesh, c.mesh->points)));
        flux_free(&c);
    }
}
END_TEST

static void bend(int32_t dim, const double *x, double *y)
{
    for (int32_t k = 0; k < dim; ++k)
        y[k] = x[k];
    y[0] = (8 + x[1]) * cos(0.15 * x[0]);
    y[1] = (8 + x[1]) * sin(0.15 * x[0]);
}

/* The same domain, and one bent: both centres are deep. */
START_TEST(pairs_are_deep)
{
    for (int32_t dim = 2; dim <= 4; ++dim)
        for (int bent = 0; bent < 2; ++bent) {
            const iccp_env env = default_env();
            random_source r = {(uint64_t)dim}, other = {99};
            const size_t n = dim == 2 ? 14 : dim == 3 ? 7 : 4;
            test_mesh a = mesh_cube(dim, n, 0.1, &r), b = mesh_cube(dim, n, 0.1, &other);
            test_mesh c = bent ? mesh_moved(&b, bend) : mesh_copy(&a);
            icc_domain *domain[2];
            uint32_t centre[2];
            ck_assert_int_eq(mesh_domain(&domain[0], &a, NULL, NULL), ICC_OK);
            ck_assert_int_eq(mesh_domain(&domain[1], &c, NULL, NULL), ICC_OK);
            const icc_domain *const domains[2] = {domain[0], domain[1]};
            const iccp_simplices *const meshes[2] = {domain[0]->mesh, domain[1]->mesh};
            ck_assert_int_eq(iccp_paired_centres(domains, meshes, NULL, centre, &env), ICC_OK);
            for (int k = 0; k < 2; ++k) {
                ck_assert(is_inner(domain[k], centre[k]));
                ck_assert_double_ge(depth_of(domain[k], centre[k]),
                                    0.5 * greatest_depth(domain[k]));
                icc_domain_free(domain[k]);
            }
            mesh_free(&a);
            mesh_free(&b);
            mesh_free(&c);
        }
}
END_TEST

/* Every vertex of a domain as the given one finds a partner near it in the same domain. */
START_TEST(given_centres_are_kept)
{
    for (int k = 0; k < 2 * FLUX_KINDS; ++k) {
        const iccp_env env = default_env();
        flux_case c = flux_number(k);
        const icc_domain *const domains[2] = {c.domain, c.domain};
        const iccp_simplices *const meshes[2] = {c.mesh, c.mesh};
        for (uint32_t v = (uint32_t)c.mesh->n_boundary; v < c.mesh->n_points; v += 17) {
            uint32_t centre[2];
            double away = 0;
            ck_assert_int_eq(iccp_paired_centres(domains, meshes, &v, centre, &env), ICC_OK);
            ck_assert_uint_eq(centre[0], v);
            ck_assert(is_inner(c.domain, centre[1]));
            for (size_t i = 0; i < c.mesh->dim; ++i)
                away = fmax(away, fabs(c.mesh->points[c.mesh->dim * v + i] -
                                       c.mesh->points[c.mesh->dim * centre[1] + i]));
            ck_assert_msg(away <= 0.35, "%s: %g away", c.name, away);
        }
        flux_free(&c);
    }
}
END_TEST

/* A square and a dart, each with one vertex inside: the mean of the dart's corners is outside. */
START_TEST(no_image_is_inside)
{
    static const double SQUARE[] = {0, 0, 1, 0, 1, 1, 0, 1, 0.5, 0.5};
    static const double DART[] = {0, 0, 1, 0, 0.3, 0.3, 0, 1, 0.1, 0.1};
    static const uint32_t FAN[] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
    const iccp_env env = default_env();
    icc_domain *domain[2];
    uint32_t centre[2];
    ck_assert_int_eq(flat_create_mesh(&domain[0], 2, 5, SQUARE, 4, FAN, 0, NULL, NULL, NULL),
                     ICC_OK);
    ck_assert_int_eq(flat_create_mesh(&domain[1], 2, 5, DART, 4, FAN, 0, NULL, NULL, NULL), ICC_OK);
    const icc_domain *const domains[2] = {domain[0], domain[1]};
    const iccp_simplices *const meshes[2] = {domain[0]->mesh, domain[1]->mesh};
    ck_assert_int_eq(iccp_paired_centres(domains, meshes, NULL, centre, &env), ICC_OK);
    ck_assert_uint_eq(centre[0], 4);
    ck_assert_uint_eq(centre[1], 4);
    icc_domain_free(domain[0]);
    icc_domain_free(domain[1]);
}
END_TEST

static icc_status find(const icc_env *given, icc_error *err, void *argument)
{
    const flux_case *c = argument;
    const icc_domain *const domains[2] = {c->domain, c->domain};
    const iccp_simplices *const meshes[2] = {c->mesh, c->mesh};
    iccp_env env;
    uint32_t centre[2];
    icc_status status = iccp_env_read(&env, given, err);
    if (status == ICC_OK)
        status = iccp_deepest_centre(c->domain, c->mesh, centre, &env);
    if (status == ICC_OK)
        status = iccp_paired_centres(domains, meshes, NULL, centre, &env);
    return iccp_explain(err, status);
}

START_TEST(failures_leave_nothing)
{
    flux_case c = flux_number(FLUX_KINDS + FLUX_CUBE);
    faulty_sweep(find, &c);
    flux_free(&c);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("centres");
    TCase *test = tcase_create("centres");
    tcase_add_test(test, deepest_of_all);
    tcase_add_test(test, nearest_of_all);
    tcase_add_test(test, pairs_are_deep);
    tcase_add_test(test, given_centres_are_kept);
    tcase_add_test(test, no_image_is_inside);
    tcase_add_test(test, failures_leave_nothing);
    suite_add_tcase(suite, test);
    return suite_run(suite);
}

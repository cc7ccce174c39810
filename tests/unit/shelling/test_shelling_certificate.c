/* The certificate of foliations of simplices holds for orders that the library finds, and for
 * nothing that is corrupted. */
#include "shelling/best_order.h"
#include "shelling/centres.h"
#include "shelling/reference.h"
#include "shelling/shelling_certificate.h"

#include "../../faulty.h"
#include "../../meshes.h"
#include "../../share.h"
#include "../../suite.h"

#include <check.h>
#include <stdlib.h>
#include <string.h>

/* A foliation, with everything that can be corrupted. */
typedef struct foliation {
    icc_domain *domain;
    iccp_env env;
    iccp_simplices mesh; /* copies of the domain's arrays */
    size_t n, n_sides;
    uint32_t *facets;
    uint32_t centre;
    uint32_t *rank;
    double *direction;
} foliation;

static void *copy_of(const void *from, size_t size)
{
    void *to = malloc(size + 1);
    ck_assert_ptr_nonnull(to);
    return memcpy(to, from, size);
}

/* Any rates of the right signs will do. */
static void direct(foliation *f)
{
    for (size_t side = 0; side < f->n_sides; ++side) {
        const uint32_t twin = f->mesh.across[side];
        const bool enters =
            (twin & ICCP_ON_BOUNDARY) != 0 || f->rank[twin / f->n] > f->rank[side / f->n];
        f->direction[side] = enters ? 0.5 : -0.25;
    }
}

static void find_order(foliation *f)
{
    const iccp_simplices *mesh = &f->mesh;
    double *inflow = malloc(mesh->n_facets * sizeof *inflow);
    double *flux = malloc(f->n_sides * sizeof *flux),
           *reference = malloc(f->n_sides * sizeof *flux);
    double *potential = malloc(mesh->n_simplices * sizeof *potential);
    iccp_best_order_info info;
    ck_assert_int_eq(iccp_deepest_centre(f->domain, mesh, &f->centre, &f->env), ICC_OK);
    ck_assert_int_eq(iccp_inflow(mesh, f->centre, 0.5, inflow, &f->env), ICC_OK);
    ck_assert_int_eq(iccp_reference_flux(mesh, f->centre, inflow, reference, potential, &f->env),
                     ICC_OK);
    ck_assert_int_eq(iccp_best_order(mesh, f->centre, inflow, reference, potential, f->rank, flux,
                                     &info, &f->env, NULL),
                     ICC_OK);
    free(inflow);
    free(flux);
    free(reference);
    free(potential);
}

/* The mesh is taken over. */
static foliation make(test_mesh m)
{
    foliation f = {.n = (size_t)m.dim + 1};
    const icc_env none = {.size = sizeof none};
    ck_assert_int_eq(iccp_env_read(&f.env, &none, NULL), ICC_OK);
    ck_assert_int_eq(mesh_domain(&f.domain, &m, NULL, NULL), ICC_OK);
    const iccp_simplices *mesh = f.domain->mesh;
    f.mesh = *mesh;
    f.n_sides = f.n * mesh->n_simplices;
    f.mesh.points = copy_of(mesh->points, mesh->n_points * mesh->dim * sizeof *mesh->points);
    f.mesh.corners = copy_of(mesh->corners, f.n_sides * sizeof *mesh->corners);
    f.mesh.across = copy_of(mesh->across, f.n_sides * sizeof *mesh->across);
    f.facets = copy_of(f.domain->facets, mesh->n_facets * mesh->dim * sizeof *f.facets);
    f.rank = malloc(mesh->n_simplices * sizeof *f.rank);
    f.direction = malloc(f.n_sides * sizeof *f.direction);
    find_order(&f);
    direct(&f);
    mesh_free(&m);
    return f;
}

static void foliation_free(foliation *f)
{
    icc_domain_free(f->domain);
    free(f->mesh.points);
    free(f->mesh.corners);
    free(f->mesh.across);
    free(f->facets);
    free(f->rank);
    free(f->direction);
}

static iccp_shelling_certificate look(const foliation *f)
{
    iccp_shelling_certificate c;
    ck_assert_int_eq(
        iccp_certify_shelling(&c, &f->mesh, f->facets, f->centre, f->rank, f->direction, &f->env),
        ICC_OK);
    return c;
}

static bool holds(const foliation *f)
{
    const iccp_shelling_certificate c = look(f);
    return iccp_shelling_certificate_holds(&c);
}

static bool in_star(const foliation *f, size_t simplex)
{
    for (size_t i = 0; i < f->n; ++i)
        if (f->mesh.corners[f->n * simplex + i] == f->centre)
            return true;
    return false;
}

enum { N_SHAPES = 7 };

static foliation shape(int k)
{
    random_source r = {(uint64_t)k};
    switch (k) {
    case 0:
        return make(mesh_cube(2, 4, 0.1, &r));
    case 1:
        return make(mesh_ball(2, 6, 0.1, &r));
    case 2:
        return make(mesh_cube(3, 2, 0.1, &r));
    case 3:
        return make(mesh_cube(3, 4, 0.1, &r));
    case 4:
        return make(mesh_ball(3, 3, 0.1, &r));
    case 5:
        return make(mesh_cube(4, 2, 0.1, &r));
    default:
        return make(mesh_cube(5, 2, 0.05, &r));
    }
}

START_TEST(holds_for_what_is_found)
{
    for (int k = 0; k < N_SHAPES; ++k) {
        foliation f = shape(k);
        ck_assert(holds(&f));
        foliation_free(&f);
    }
}
END_TEST

/* A vertex is drawn through one of its simplices, two corners are exchanged, a corner is another
 * one. */
START_TEST(mesh)
{
    random_source r = {1};
    for (int k = 0; k < N_SHAPES; ++k) {
        foliation f = shape(k);
        const size_t dim = f.n - 1;
        for (int i = 0; i < share_of(30); ++i) {
            uint32_t *v = f.mesh.corners + f.n * (size_t)random_below(&r, (int)f.mesh.n_simplices);
            double *x = f.mesh.points + dim * v[0], keep[ICC_MAX_DIM];
            memcpy(keep, x, dim * sizeof *x);
            for (size_t c = 0; c < dim; ++c) {
                double middle = 0;
                for (size_t j = 1; j < f.n; ++j)
                    middle += f.mesh.points[dim * v[j] + c] / (double)dim;
                x[c] = middle + 0.1 * (middle - x[c]);
            }
            ck_assert_uint_gt(look(&f).n_inverted, 0);
            memcpy(x, keep, dim * sizeof *x);
            ck_assert(holds(&f));

            const uint32_t first = v[0], second = v[1];
            v[0] = second;
            v[1] = first;
            ck_assert_uint_eq(look(&f).n_inverted, 1);
            v[0] = first;
            v[1] = second;

            v[0] = (uint32_t)random_below(&r, (int)f.mesh.n_points);
            ck_assert(v[0] == first || !holds(&f));
            v[0] = (uint32_t)f.mesh.n_points;
            ck_assert(!holds(&f));
            v[0] = first;
        }
        foliation_free(&f);
    }
}
END_TEST

/* A side's other side is a third one, or none, or a facet that it is not; a facet is not the
 * mesh's. */
START_TEST(neighbours)
{
    random_source r = {2};
    for (int k = 0; k < N_SHAPES; ++k) {
        foliation f = shape(k);
        const size_t dim = f.n - 1;
        for (int i = 0; i < share_of(40); ++i) {
            uint32_t *across = &f.mesh.across[random_below(&r, (int)f.n_sides)];
            const uint32_t keep = *across;
            *across = (uint32_t)random_below(&r, (int)f.n_sides);
            ck_assert(*across == keep || !holds(&f));
            *across = ICCP_ON_BOUNDARY | (uint32_t)random_below(&r, (int)f.mesh.n_facets);
            ck_assert(*across == keep || !holds(&f));
            *across = UINT32_MAX;
            ck_assert(!holds(&f));
            *across = keep;
            uint32_t *facet = f.facets + dim * (size_t)random_below(&r, (int)f.mesh.n_facets);
            const uint32_t corner = facet[0];
            facet[0] = (uint32_t)random_below(&r, (int)f.mesh.n_points);
            ck_assert(facet[0] == corner || !holds(&f));
            facet[0] = corner;
        }
        ck_assert(holds(&f));
        foliation_free(&f);
    }
}
END_TEST

/* Simplices s and the last one trade places, then the last one goes: a hole with proper sides. */
static void take_out(foliation *f, uint32_t s)
{
    const uint32_t n = (uint32_t)f->n, last = (uint32_t)f->mesh.n_simplices - 1;
    for (uint32_t i = 0; i < n; ++i) {
        const uint32_t a = f->mesh.across[n * s + i];
        ck_assert(a < f->n_sides);
        f->mesh.across[a] = ICCP_ON_BOUNDARY | ((uint32_t)f->mesh.n_facets + i);
        for (uint32_t j = 0, c = 0; j < n; ++j)
            if (j != a % n)
                f->facets[(f->mesh.n_facets + i) * (n - 1) + c++] = f->mesh.corners[a - a % n + j];
    }
    f->mesh.n_facets += n;
    for (uint32_t i = 0; i < n && s != last; ++i) {
        const uint32_t a = f->mesh.across[n * last + i];
        f->mesh.corners[n * s + i] = f->mesh.corners[n * last + i];
        f->mesh.across[n * s + i] = a;
        if ((a & ICCP_ON_BOUNDARY) == 0)
            f->mesh.across[a] = n * s + i;
    }
    f->rank[s] = f->rank[last];
    --f->mesh.n_simplices;
    f->n_sides -= n;
}

/* Whatever the order: a mesh with a hole has none. */
START_TEST(holes)
{
    random_source r = {3};
    for (int k = 0; k < N_SHAPES; ++k) {
        foliation f = shape(k);
        f.facets = realloc(f.facets, (f.mesh.n_facets + f.n) * f.n * sizeof *f.facets);
        for (uint32_t s = 0;; ++s) {
            bool inner = s < f.mesh.n_simplices && !in_star(&f, s);
            ck_assert(s < f.mesh.n_simplices || k == 0 || k == 2 || k == 5 || k == 7);
            for (size_t i = 0; inner && i < f.n; ++i)
                inner = (f.mesh.across[f.n * s + i] & ICCP_ON_BOUNDARY) == 0;
            if (inner)
                take_out(&f, s);
            if (inner || s >= f.mesh.n_simplices)
                break;
        }
        if (f.n_sides == f.n * f.domain->mesh->n_simplices) {
            foliation_free(&f);
            continue;
        }
        direct(&f);
        ck_assert_uint_eq(look(&f).n_topology, 0);
        ck_assert(!holds(&f));
        for (int i = 0; i < share_of(60); ++i) {
            const size_t a = (size_t)random_below(&r, (int)f.mesh.n_simplices);
            const size_t b = (size_t)random_below(&r, (int)f.mesh.n_simplices);
            if (in_star(&f, a) || in_star(&f, b))
                continue;
            const uint32_t swap = f.rank[a];
            f.rank[a] = f.rank[b];
            f.rank[b] = swap;
            direct(&f);
            ck_assert(!holds(&f));
        }
        foliation_free(&f);
    }
}
END_TEST

/* Neighbours exchange their ranks, with and without directions that fit; ties; the order backwards;
 * ranks in the star. */
START_TEST(order)
{
    for (int k = 0; k < N_SHAPES; ++k) {
        foliation f = shape(k);
        size_t n_refused = 0, n_swaps = 0;
        for (uint32_t side = 0; side < f.n_sides; ++side) {
            const uint32_t twin = f.mesh.across[side];
            const size_t a = side / f.n, b = (twin & ~ICCP_ON_BOUNDARY) / f.n;
            if ((twin & ICCP_ON_BOUNDARY) != 0 || a > b || in_star(&f, a) || in_star(&f, b) ||
                n_swaps > 60)
                continue;
            const uint32_t rank_a = f.rank[a], rank_b = f.rank[b];
            f.rank[a] = rank_b;
            f.rank[b] = rank_a;
            ck_assert_uint_ge(look(&f).n_directions, 2);
            direct(&f);
            n_refused += !holds(&f);
            ++n_swaps;
            f.rank[a] = rank_a;
            ck_assert_uint_ge(look(&f).n_order, 2);
            f.rank[b] = rank_b;
            direct(&f);
        }
        ck_assert(holds(&f));
        ck_assert_uint_gt(n_swaps, 0);
        ck_assert_uint_gt(n_refused, 0);
        for (size_t s = 0; s < f.mesh.n_simplices; ++s)
            f.rank[s] = in_star(&f, s) ? 0 : UINT32_MAX - 1 - f.rank[s];
        direct(&f);
        ck_assert(!holds(&f));
        foliation_free(&f);
    }
}
END_TEST

/* Orders by chance: the star first, then anything. */
START_TEST(any_order)
{
    random_source r = {4};
    for (int k = 0; k < N_SHAPES; ++k) {
        foliation f = shape(k);
        for (int i = 0; i < 20; ++i) {
            for (size_t s = f.mesh.n_simplices; s-- > 1;) {
                const size_t t = (size_t)random_below(&r, (int)s + 1);
                const uint32_t swap = f.rank[s];
                if (in_star(&f, s) || in_star(&f, t))
                    continue;
                f.rank[s] = f.rank[t];
                f.rank[t] = swap;
            }
            direct(&f);
            ck_assert(!holds(&f));
        }
        foliation_free(&f);
    }
}
END_TEST

/* Each rate in turn; in the star none matters. */
START_TEST(directions)
{
    static const double WRONG[] = {0, -1, (double)NAN, HUGE_VAL, -HUGE_VAL};
    for (int k = 0; k < N_SHAPES; ++k) {
        foliation f = shape(k);
        for (size_t side = 0; side < f.n_sides; side += 1 + f.n_sides / 60)
            for (size_t i = 0; i < sizeof WRONG / sizeof *WRONG; ++i) {
                const double keep = f.direction[side];
                f.direction[side] = i == 1 ? -keep : WRONG[i];
                ck_assert_uint_eq(look(&f).n_directions, !in_star(&f, side / f.n));
                f.direction[side] = keep;
            }
        foliation_free(&f);
    }
}
END_TEST

/* Any other vertex as the centre. */
START_TEST(centre)
{
    for (int k = 0; k < N_SHAPES; ++k) {
        foliation f = shape(k);
        const uint32_t keep = f.centre;
        for (f.centre = 0; f.centre <= f.mesh.n_points; ++f.centre) {
            const iccp_shelling_certificate c = look(&f);
            ck_assert(iccp_shelling_certificate_holds(&c) == (f.centre == keep));
            ck_assert((c.n_topology == 0) ==
                      (f.centre >= f.mesh.n_boundary && f.centre < f.mesh.n_points));
        }
        foliation_free(&f);
    }
}
END_TEST

static icc_status call_certify(const icc_env *caller, icc_error *err, void *argument)
{
    foliation *f = argument;
    iccp_env env;
    iccp_shelling_certificate c;
    ck_assert_int_eq(iccp_env_read(&env, caller, err), ICC_OK);
    const icc_status status =
        iccp_certify_shelling(&c, &f->mesh, f->facets, f->centre, f->rank, f->direction, &env);
    /* The text is the caller's business. */
    if (status != ICC_OK) {
        err->status = status;
        err->message[0] = '?';
    }
    return status;
}

START_TEST(failures)
{
    foliation f = shape(3);
    faulty_sweep(call_certify, &f);
    foliation_free(&f);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("shelling certificate");
    TCase *tests = tcase_create("shelling certificate");
    tcase_add_test(tests, holds_for_what_is_found);
    tcase_add_test(tests, mesh);
    tcase_add_test(tests, neighbours);
    tcase_add_test(tests, holes);
    tcase_add_test(tests, order);
    tcase_add_test(tests, any_order);
    tcase_add_test(tests, directions);
    tcase_add_test(tests, centre);
    tcase_add_test(tests, failures);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

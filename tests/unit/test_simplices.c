/* Domains made of meshes: what is accepted, what is refused and how it is named, and what the library
 * keeps of the mesh. */
#include <check.h>
#include <stdio.h>
#include <stdlib.h>

#include "../faulty.h"
#include "../meshes.h"
#include "../shapes.h"
#include "../surfaces.h"
#include "domain/domain.h"
#include "domain/simplices.h"
#include "math/orient.h"

static icc_domain *make(const test_mesh *m)
{
    icc_error err = {.size = sizeof err};
    icc_domain *domain;
    const icc_status status = mesh_domain(&domain, m, NULL, &err);
    ck_assert_msg(status == ICC_OK, "%s", err.message);
    ck_assert_ptr_nonnull(domain);
    return domain;
}

static int compare(const void *a, const void *b)
{
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

static void sorted_side(const iccp_simplices *s, size_t side, uint32_t *v)
{
    const size_t n = s->dim + 1, i = side % n;
    for (size_t k = 0, j = 0; j < n; ++j)
        if (j != i)
            v[k++] = s->corners[side - i + j];
    qsort(v, s->dim, sizeof *v, compare);
}

/* What lib/domain/simplices.h says, and that it is the caller's mesh. */
static void check_mesh(const icc_domain *d, const test_mesh *m)
{
    const iccp_simplices *s = d->mesh;
    const size_t dim = (size_t)m->dim;
    size_t n_rim_sides = 0;
    ck_assert_ptr_nonnull(s);
    ck_assert_uint_eq(s->dim, dim);
    ck_assert_uint_eq(s->n_rim, d->n_vertices);
    ck_assert_uint_eq(s->n_facets, d->n_facets);
    ck_assert_uint_eq(s->n_simplices, m->n_simplices);
    ck_assert_mem_eq(s->points, d->vertices, s->n_rim * dim * sizeof(double));
    for (size_t side = 0; side < (dim + 1) * s->n_simplices; ++side) {
        const uint32_t across = s->across[side];
        uint32_t mine[6], other[6];
        sorted_side(s, side, mine);
        if (across & ICCP_RIM) {
            const uint32_t f = across & ~ICCP_RIM;
            ck_assert_uint_lt(f, d->n_facets);
            memcpy(other, d->facets + dim * f, dim * sizeof *other);
            qsort(other, dim, sizeof *other, compare);
            ++n_rim_sides;
        } else {
            ck_assert_uint_lt(across, (dim + 1) * s->n_simplices);
            ck_assert_uint_eq(s->across[across], side);
            ck_assert_uint_ne(iccp_simplex_of(s, across), iccp_simplex_of(s, (uint32_t)side));
            sorted_side(s, across, other);
        }
        ck_assert_mem_eq(mine, other, dim * sizeof *mine);
    }
    ck_assert_uint_eq(n_rim_sides, d->n_facets);
    for (size_t k = 0; k < s->n_simplices; ++k) {
        const double *corner[7];
        for (size_t i = 0; i <= dim; ++i) {
            double given[6];
            corner[i] = iccp_corner_point(s, (dim + 1) * k + i);
            iccp_frame_out(&d->frame, m->dim, corner[i], given);
            size_t found = 0;
            for (size_t j = 0; j <= dim; ++j)
                found += memcmp(given, m->vertices + dim * m->simplices[(dim + 1) * k + j],
                                dim * sizeof *given) == 0;
            ck_assert_uint_eq(found, 1);
        }
        ck_assert_int_eq(iccp_orient(dim, corner), 1);
    }
}

START_TEST(cubes_of_every_dimension)
{
    random_source r = {1};
    for (int32_t dim = 2; dim <= 6; ++dim)
        for (size_t n = 1; n <= (dim < 4 ? 4u : dim < 6 ? 2u : 1u); ++n) {
            test_mesh m = mesh_cube(dim, n, 0.1, &r);
            icc_domain *d = make(&m);
            icc_domain_info info = {.size = sizeof info};
            check_mesh(d, &m);
            ck_assert_int_eq(icc_domain_get_info(d, &info), ICC_OK);
            ck_assert_int_eq(info.orientation, 1);
            ck_assert(fabs(info.measure - pow((double)n, dim)) < 1e-9);
            icc_domain_free(d);
            mesh_free(&m);
        }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("simplices");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 60);
    tcase_add_test(tests, cubes_of_every_dimension);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int n_failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return n_failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

/* The Hessian of rigid parts: the same by products with the derivatives and as a matrix. */
#include "kernel/pose/rigid_hessian.h"

#include "../../../random.h"
#include "../../../suite.h"
#include "base/error.h"
#include "math/vec.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_NODES = 400, MOST_HANDLES = 11 };

/* Nodes of a grid that are moved a little, and the inner ones as a part. */
typedef struct part {
    iccp_env env;
    iccp_nodes nodes;
    iccp_collocation *collocation;
    double points[3 * MOST_NODES], count[MOST_NODES];
    uint32_t places[MOST_NODES], free[MOST_NODES];
    size_t n_places, n_free;
    iccp_hessian hessian;
} part;

static bool is_inner(const double *x, size_t dim)
{
    for (size_t k = 0; k < dim; ++k)
        if (x[k] < 0.2 || x[k] > 0.8)
            return false;
    return true;
}

/* Every third place is held. */
static void make_part(part *p, size_t dim, size_t side, size_t m, bool tail)
{
    random_source r = {7};
    icc_error err = {.size = sizeof err};
    const iccp_radial radial = iccp_radial_make(ICC_KERNEL_WENDLAND, 1.0 / (double)side, 3);
    *p = (part){.nodes = {.dim = dim, .n = 1, .n_handles = m, .points = p->points}};
    for (size_t k = 0; k < dim; ++k)
        p->nodes.n *= side;
    ck_assert_uint_le(p->nodes.n, MOST_NODES);
    for (size_t i = 0; i < p->nodes.n; ++i) {
        double *x = p->points + dim * i;
        for (size_t k = 0, rest = i; k < dim; ++k, rest /= side)
            x[k] = ((double)(rest % side) + 0.5 + random_between(&r, -0.3, 0.3)) / (double)side;
        if (!is_inner(x, dim))
            continue;
        p->count[p->n_places] = random_between(&r, 0.1, 1);
        if (p->n_places % 3 != 0)
            p->free[p->n_free++] = (uint32_t)i;
        p->places[p->n_places++] = (uint32_t)i;
    }
    ck_assert_int_eq(iccp_env_read(&p->env, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_collocation_create(&p->collocation, dim, p->nodes.n, p->points, &radial,
                                             tail, &p->env, &err),
                     ICC_OK);
    ck_assert_int_eq(iccp_hessian_create(&p->hessian, &p->nodes, p->collocation, p->n_places,
                                         p->places, p->count, p->n_free, p->free, &p->env),
                     ICC_OK);
}

static void free_part(part *p)
{
    iccp_hessian_free(&p->hessian);
    iccp_collocation_free(p->collocation);
}

/* As the matrix, from the derivatives, and as what the energy bends by. Returns whether there was
 * a matrix. */
static bool check_products(size_t dim, size_t side, size_t m, bool tail)
{
    static part p;
    static double x[MOST_NODES * MOST_HANDLES], by_matrix[MOST_NODES * MOST_HANDLES],
        by_map[MOST_NODES * MOST_HANDLES], slopes[3 * MOST_NODES * MOST_HANDLES];
    random_source r = {11};
    double energy = 0;
    make_part(&p, dim, side, m, tail);
    const size_t n = m * p.n_free;
    double *const strips = p.hessian.strips;
    for (size_t i = 0; i < n; ++i)
        x[i] = random_between(&r, -1, 1);
    iccp_hessian_apply(&p.hessian, x, by_matrix);
    p.hessian.strips = NULL;
    iccp_hessian_apply(&p.hessian, x, by_map);
    p.hessian.strips = strips;
    const double size = iccp_vec_norm(n, by_map);
    for (size_t i = 0; i < n; ++i)
        ck_assert_double_le(fabs(by_matrix[i] - by_map[i]), 1e-12 * size);
    iccp_slopes_apply(&p.hessian.map, x, slopes);
    for (size_t i = 0; i < p.n_places * dim * m; ++i)
        energy += p.count[i / (dim * m)] * slopes[i] * slopes[i];
    ck_assert_double_le(fabs(iccp_vec_dot(n, x, by_matrix) - energy), 1e-12 * energy);
    ck_assert_double_gt(energy, 0);
    free_part(&p);
    return strips != NULL;
}

/* Every number of columns that are multiplied at once, and numbers of nodes that are no multiples
 * of four. */
START_TEST(the_matrix_gives_the_same_products)
{
    for (size_t m = 1; m <= MOST_HANDLES; ++m) {
        ck_assert(check_products(2, 9 + m % 4, m, m % 2 == 0));
        ck_assert(check_products(3, 6, m, m % 2 == 0));
    }
}
END_TEST

/* What a product has, divided, is nearly what was multiplied: measured by the energy, which the
 * inverse itself keeps. And it makes no difference which of two is divided. */
static void check_inverse(size_t dim, size_t side, size_t m, bool tail)
{
    static part p;
    static double x[MOST_NODES * MOST_HANDLES], y[MOST_NODES * MOST_HANDLES],
        forces[MOST_NODES * MOST_HANDLES], divided[2][MOST_NODES * MOST_HANDLES];
    random_source r = {13};
    make_part(&p, dim, side, m, tail);
    const size_t n = m * p.n_free;
    ck_assert_ptr_nonnull(p.hessian.inverse.value);
    for (size_t i = 0; i < n; ++i) {
        x[i] = random_between(&r, -1, 1);
        y[i] = random_between(&r, -1, 1);
    }
    iccp_hessian_apply(&p.hessian, x, forces);
    iccp_hessian_divide(&p.hessian, forces, divided[0]);
    const double kept = iccp_vec_dot(n, forces, divided[0]) / iccp_vec_dot(n, forces, x);
    ck_assert_msg(kept > 0.5 && kept < 2, "%g", kept);
    iccp_hessian_divide(&p.hessian, y, divided[1]);
    const double one = iccp_vec_dot(n, y, divided[0]), other = iccp_vec_dot(n, forces, divided[1]);
    ck_assert_double_le(fabs(one - other), 1e-9 * iccp_vec_norm(n, y) * iccp_vec_norm(n, x));
    free_part(&p);
}

START_TEST(products_can_nearly_be_divided)
{
    for (size_t m = 1; m <= MOST_HANDLES; m += 5) {
        check_inverse(2, 9 + m, m, m % 2 == 0);
        check_inverse(3, 7, m, m % 2 == 0);
    }
}
END_TEST

START_TEST(large_parts_make_no_matrix)
{
    part p;
    make_part(&p, 2, 20, 2, true);
    iccp_hessian *h = &p.hessian;
    ck_assert_ptr_nonnull(h->strips);
    iccp_hessian_free(h);
    /* All nodes as a part: more products for each handle than the program has steps. */
    for (uint32_t i = 0; i < p.nodes.n; ++i) {
        p.free[i] = p.places[i] = i;
        p.count[i] = 1;
    }
    ck_assert_int_eq(iccp_hessian_create(h, &p.nodes, p.collocation, p.nodes.n, p.places, p.count,
                                         p.nodes.n, p.free, &p.env),
                     ICC_OK);
    ck_assert_ptr_null(h->strips);
    free_part(&p);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("rigid_hessian");
    TCase *tests = tcase_create("tests");
    tcase_add_test(tests, the_matrix_gives_the_same_products);
    tcase_add_test(tests, products_can_nearly_be_divided);
    tcase_add_test(tests, large_parts_make_no_matrix);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

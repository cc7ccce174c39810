/* Sums of derivatives over the elements of a mesh, and rows cut to what a factorisation reads. */
#include "map/energy/assembly.h"

#include "../../../faulty.h"
#include "../../../random.h"
#include "../../../suite.h"
#include "base/error.h"
#include "math/ldlt.h"

#include <check.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* A lattice whose left and lower sides are fixed. Each cell is cut into two triangles. */
enum { SIDE = 9, N_POINTS = SIDE * SIDE, N_CELLS = (SIDE - 1) * (SIDE - 1) };

typedef struct lattice {
    iccp_simplicial_map map;
    double points[2 * N_POINTS];
    uint8_t fixed[N_POINTS];
    uint32_t corners[6 * N_CELLS];
} lattice;

static void make_lattice(lattice *l)
{
    size_t n = 0;
    for (uint32_t v = 0; v < N_POINTS; ++v) {
        l->points[2 * v] = v % SIDE;
        l->points[2 * v + 1] = v / SIDE;
        l->fixed[v] = v % SIDE == 0 || v < SIDE;
    }
    for (uint32_t j = 0; j + 1 < SIDE; ++j)
        for (uint32_t i = 0; i + 1 < SIDE; ++i) {
            const uint32_t a = SIDE * j + i, c = a + SIDE, cell[6] = {a, a + 1, c, c, a + 1, c + 1};
            for (size_t k = 0; k < 6; ++k)
                l->corners[n++] = cell[k];
        }
    l->map = (iccp_simplicial_map){.dim = 2,
                                   .n_points = N_POINTS,
                                   .n_simplices = 2 * N_CELLS,
                                   .corners = l->corners,
                                   .points = l->points,
                                   .images = l->points,
                                   .fixed = l->fixed,
                                   .stretch = 1};
}

/* Adds a positive definite matrix for each element. */
static void sum(iccp_assembly *assembly)
{
    random_source r = {7};
    iccp_assembly_begin(assembly, 0, assembly->n_free);
    for (size_t e = 0; e < assembly->n_elements; ++e) {
        iccp_local local;
        memset(&local, 0, sizeof local);
        for (size_t i = 0; i < 6; ++i) {
            local.gradient[i] = random_unit(&r);
            for (size_t k = 0; k < i; ++k)
                local.hessian[6 * i + k] = local.hessian[6 * k + i] = random_unit(&r) - 0.5;
            local.hessian[7 * i] = 4;
        }
        iccp_assembly_add(assembly, ICCP_ALL_PARTS, e, &local);
    }
    iccp_assembly_end(assembly);
}

static icc_status begin(iccp_assembly *assembly, iccp_ldlt *factor, const lattice *l,
                        const iccp_env *env)
{
    *factor = (iccp_ldlt){.memory = env->memory};
    icc_status status = iccp_assembly_create(assembly, &l->map, NULL, env);
    if (status == ICC_OK) {
        const iccp_symmetric pattern = iccp_assembly_hessian(assembly);
        status = iccp_ldlt_analyse(factor, &pattern, 2, env);
    }
    return status;
}

static double entry(const iccp_assembly *a, size_t row, size_t column)
{
    for (size_t q = a->first[row]; q < a->first[row + 1]; ++q)
        if (a->column[q] == column)
            return a->value[q];
    return 0;
}

/* Short rows have the same bits as long ones, whether they are summed before they are shortened or
 * afterwards, and so does the factor. */
START_TEST(short_rows_are_long_ones_without_earlier_columns)
{
    iccp_env env;
    lattice l;
    iccp_assembly all;
    iccp_ldlt factor;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    make_lattice(&l);
    ck_assert_int_eq(begin(&all, &factor, &l, &env), ICC_OK);
    ck_assert_int_eq(iccp_assembly_make_room(&all), ICC_OK);
    sum(&all);
    const iccp_symmetric hessian = iccp_assembly_hessian(&all);
    const size_t n = hessian.n, n_all = all.first[n];
    ck_assert_int_eq(iccp_ldlt_factorise(&factor, &hessian, &env), ICC_OK);
    for (int ahead = 0; ahead < 2; ++ahead) {
        iccp_assembly half;
        iccp_ldlt other;
        ck_assert_int_eq(begin(&half, &other, &l, &env), ICC_OK);
        if (ahead) {
            ck_assert_int_eq(iccp_assembly_make_room(&half), ICC_OK);
            sum(&half);
        }
        ck_assert_int_eq(iccp_assembly_divide(&half, other.position, 1, &env), ICC_OK);
        ck_assert_int_eq(iccp_assembly_make_room(&half), ICC_OK);
        if (!ahead)
            sum(&half);
        ck_assert_uint_eq(2 * half.first[n], n_all + n);
        for (size_t i = 0; i < n; ++i) {
            ck_assert(memcmp(&half.diagonal[i], &all.diagonal[i], sizeof(double)) == 0);
            for (size_t q = half.first[i]; q < half.first[i + 1]; ++q) {
                const size_t k = half.column[q];
                const double expected = entry(&all, i, k);
                ck_assert(other.position[k] > other.position[i] || k / 2 == i / 2);
                ck_assert(memcmp(&half.value[q], &expected, sizeof expected) == 0);
            }
        }
        ck_assert(memcmp(half.gradient, all.gradient, n * sizeof *half.gradient) == 0);
        const iccp_symmetric shortened = iccp_assembly_hessian(&half);
        ck_assert_int_eq(iccp_ldlt_factorise(&other, &shortened, &env), ICC_OK);
        ck_assert(memcmp(other.pivot, factor.pivot, n * sizeof *factor.pivot) == 0);
        ck_assert(memcmp(other.value, factor.value,
                         (size_t)factor.nodes.first_value[factor.nodes.n] * sizeof *factor.value) ==
                  0);
        iccp_ldlt_free(&other);
        iccp_assembly_free(&half);
    }
    iccp_ldlt_free(&factor);
    iccp_assembly_free(&all);
}
END_TEST

static icc_status make_both_ways(const icc_env *env, icc_error *err, void *argument)
{
    const lattice *l = argument;
    iccp_env full;
    icc_status status = iccp_env_read(&full, env, err);
    for (int ahead = 0; status == ICC_OK && ahead < 2; ++ahead) {
        iccp_assembly a;
        iccp_ldlt factor;
        status = begin(&a, &factor, l, &full);
        if (status == ICC_OK && ahead)
            status = iccp_assembly_make_room(&a);
        if (status == ICC_OK)
            status = iccp_assembly_divide(&a, factor.position, 3, &full);
        if (status == ICC_OK)
            status = iccp_assembly_make_room(&a);
        iccp_ldlt_free(&factor);
        iccp_assembly_free(&a);
    }
    return iccp_explain(err, status);
}

START_TEST(failures_leave_nothing_behind)
{
    lattice l;
    make_lattice(&l);
    faulty_sweep(make_both_ways, &l);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("assembly");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, short_rows_are_long_ones_without_earlier_columns);
    tcase_add_test(tests, failures_leave_nothing_behind);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

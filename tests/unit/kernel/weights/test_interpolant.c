/* Sums of kernels: what the thesis measures in chapter 3, the affine function, and when there is no
 * solution. Sections and figures are those of Sakaridis, Kernel Coordinates, 2016. */
#include "kernel/weights/interpolant.h"

#include "../../../default_env.h"
#include "../../../faulty.h"
#include "../../../random.h"
#include "../../../suite.h"
#include "base/error.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;
/* Of the Gaussian, in sigma, where the thesis does not cut it off: exp(-32) is 1e-14. */
static const double UNCUT = 8;

/* n * n nodes at a spacing, centred at the origin. */
static double *make_grid(size_t n, double spacing)
{
    double *points = malloc(2 * n * n * sizeof *points);
    ck_assert_ptr_nonnull(points);
    for (size_t i = 0; i < n * n; ++i) {
        points[2 * i] = spacing * ((double)(i % n) - 0.5 * (double)(n - 1));
        points[2 * i + 1] = spacing * ((double)(i / n) - 0.5 * (double)(n - 1));
    }
    return points;
}

/* A grid with every node moved by up to 0.3 of the spacing 1 / n. */
static double *make_jittered(size_t dim, size_t n, size_t *n_nodes)
{
    *n_nodes = dim == 2 ? n * n : n * n * n;
    double *points = malloc(dim * *n_nodes * sizeof *points);
    ck_assert_ptr_nonnull(points);
    random_source r = {5};
    for (size_t i = 0; i < *n_nodes; ++i)
        for (size_t k = 0, rest = i; k < dim; ++k, rest /= n)
            points[dim * i + k] =
                ((double)(rest % n) + 0.5 + random_between(&r, -0.3, 0.3)) / (double)n;
    return points;
}

static iccp_collocation *make(size_t dim, size_t n, const double *points, iccp_radial radial,
                              bool tail)
{
    const iccp_env env = default_env();
    iccp_collocation *c;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(iccp_collocation_create(&c, dim, n, points, &radial, tail, &env, &err) == ICC_OK,
                  "%s", err.message);
    return c;
}

static double *solve(const iccp_collocation *c, size_t rows, size_t m, const double *values)
{
    const iccp_env env = default_env();
    double *coefficients = malloc(rows * m * sizeof *coefficients);
    ck_assert_ptr_nonnull(coefficients);
    ck_assert_int_eq(iccp_collocation_solve(c, m, values, coefficients, &env), ICC_OK);
    return coefficients;
}

/* Rows (1, x, y, ...): what the dual functions' partition of unity and reproduction are measured
 * by. */
static double *affine_values(size_t dim, size_t n, const double *points)
{
    double *values = malloc((dim + 1) * n * sizeof *values);
    ck_assert_ptr_nonnull(values);
    for (size_t i = 0; i < n; ++i) {
        values[(dim + 1) * i] = 1;
        memcpy(values + (dim + 1) * i + 1, points + dim * i, dim * sizeof *values);
    }
    return values;
}

/* Section 3.3.1: row sums of K are 18 / pi away from the border. */
START_TEST(rows_of_a_grid_sum_up_to_the_same)
{
    const size_t n = 101;
    double *points = make_grid(n, 1), worst = 0;
    const iccp_env env = default_env();
    const iccp_radial radial = iccp_radial_make(ICC_KERNEL_GAUSS, 3 / PI, UNCUT);
    iccp_cells cells;
    iccp_kernel_matrix k;
    ck_assert_int_eq(iccp_cells_create(&cells, 2, n * n, points, radial.reach / 2, &env), ICC_OK);
    ck_assert_int_eq(iccp_kernel_matrix_create(&k, &cells, &radial, &env, NULL), ICC_OK);
    for (size_t i = 0; i < n * n; ++i) {
        double sum = k.diagonal[i];
        for (size_t p = k.first[i]; p < k.first[i + 1]; ++p)
            sum += k.value[p];
        if (fabs(points[2 * i]) <= 45 && fabs(points[2 * i + 1]) <= 45)
            worst = fmax(worst, fabs(sum - 18 / PI));
    }
    ck_assert_msg(worst <= 1e-6, "row sums deviate by %g", worst);
    iccp_kernel_matrix_free(&k);
    iccp_cells_free(&cells);
    free(points);
}
END_TEST

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Evaluates rows (1, x, y) at 201 * 201 points of the central quarter. */
static void measure_grid(const iccp_collocation *c, const double *coefficients, double spacing,
                         double *unity, double *reproduction)
{
    *unity = 0;
    for (size_t i = 0; i < 201 * 201; ++i) {
        const double x[2] = {spacing * ((double)(i % 201) - 100) / 10,
                             spacing * ((double)(i / 201) - 100) / 10};
        double values[3];
        iccp_collocation_evaluate(c, 3, coefficients, x, values, NULL);
        *unity = fmax(*unity, fabs(values[0] - 1));
        reproduction[i] = fmax(fabs(values[1] - x[0]), fabs(values[2] - x[1])) / spacing;
    }
}

/* The sum over the nodes in the central quarter of |a_i(x_j) - delta_ij|. */
static double lagrange_sum(const iccp_collocation *c, size_t n, const double *points,
                           double spacing)
{
    size_t inner[21 * 21], m = 0;
    for (size_t i = 0; i < n; ++i)
        if (fabs(points[2 * i]) <= 10 * spacing && fabs(points[2 * i + 1]) <= 10 * spacing)
            inner[m++] = i;
    const iccp_symmetric *k = iccp_collocation_matrix(c);
    double *columns = calloc(n * m, sizeof *columns), sum = 0;
    for (size_t j = 0; j < m; ++j) {
        columns[m * inner[j] + j] = k->diagonal[inner[j]];
        for (size_t p = k->first[inner[j]]; p < k->first[inner[j] + 1]; ++p)
            columns[m * k->column[p] + j] = k->value[p];
    }
    double *dual = solve(c, n + 3, m, columns);
    for (size_t j = 0; j < m; ++j)
        for (size_t i = 0; i < n; ++i)
            sum += fabs(dual[m * i + j] - (i == inner[j]));
    free(columns);
    free(dual);
    return sum;
}

/* Section 3.3.1: 2.2e-4, 5.1e-11, 3.4e-3, .60e-3, .33e-3 for both spacings. */
START_TEST(a_grid_has_the_properties_that_the_thesis_measured)
{
    const double spacing = _i == 0 ? 2 : 0.5;
    const size_t n = 41 * 41, n_points = 201 * 201;
    double *points = make_grid(41, spacing), *values = affine_values(2, n, points);
    double *reproduction = malloc(n_points * sizeof *reproduction), unity, mean = 0;
    iccp_collocation *c =
        make(2, n, points, iccp_radial_make(ICC_KERNEL_GAUSS, 3 * spacing / PI, UNCUT), false);
    double *coefficients = solve(c, n + 3, 3, values);
    measure_grid(c, coefficients, spacing, &unity, reproduction);
    for (size_t i = 0; i < n_points; ++i)
        mean += reproduction[i] / (double)n_points;
    qsort(reproduction, n_points, sizeof *reproduction, compare);
    const double lagrange = lagrange_sum(c, n, points, spacing);
    ck_assert_msg(unity <= 2.3e-4 && unity > 2.1e-4, "unity %g", unity);
    ck_assert_msg(lagrange <= 1e-10, "Lagrange %g", lagrange);
    ck_assert_double_eq_tol(reproduction[n_points - 1], 3.4e-3, 0.05 * 3.4e-3);
    ck_assert_double_eq_tol(mean, 0.6e-3, 0.05 * 0.6e-3);
    ck_assert_double_eq_tol(reproduction[n_points / 2], 0.33e-3, 0.05 * 0.33e-3);
    iccp_collocation_free(c);
    free(points);
    free(values);
    free(coefficients);
    free(reproduction);
}
END_TEST

/* Section 3.4, (3.36): the interpolant of non-negative samples is negative between 0 and 1. */
START_TEST(the_interpolant_has_a_minimum_where_the_thesis_finds_it)
{
    double points[21], values[21], least = HUGE_VAL, place = 0;
    for (int i = 0; i < 21; ++i) {
        points[i] = i - 10;
        values[i] = i < 10 ? (10 - i) / 10.0 : 0;
    }
    iccp_collocation *c =
        make(1, 21, points, iccp_radial_make(ICC_KERNEL_GAUSS, 3 / PI, UNCUT), false);
    double *coefficients = solve(c, 23, 1, values);
    for (int i = 0; i <= 2000; ++i) {
        const double x = i / 2000.0;
        double value;
        iccp_collocation_evaluate(c, 1, coefficients, &x, &value, NULL);
        place = value < least ? x : place;
        least = fmin(least, value);
    }
    ck_assert_double_eq_tol(least, -0.0092, 0.00005);
    ck_assert_double_eq_tol(place, 0.397, 0.0005);
    iccp_collocation_free(c);
    free(coefficients);
}
END_TEST

static iccp_radial radial_of(int kind, double spacing)
{
    return iccp_radial_make(kind, 3 * spacing / PI, kind == ICC_KERNEL_GAUSS ? UNCUT : 0);
}

/* The kernels by themselves: 1 at 0, falling, nothing beyond the reach, and the slope is the
 * derivative. */
START_TEST(kernels_and_their_slopes_agree)
{
    for (int kind = ICC_KERNEL_WENDLAND; kind <= ICC_KERNEL_GAUSS; ++kind) {
        const iccp_radial r = iccp_radial_make(kind, 0.7, 5);
        const double end = r.reach * r.reach, h = 1e-6;
        ck_assert(iccp_radial_value(&r, 0) == 1);
        ck_assert_double_le(iccp_radial_value(&r, end * (1 - 1e-12)), 4e-6);
        for (double d = 0.05; d < end; d += 0.05) {
            const double ahead = iccp_radial_value(&r, d + h),
                         behind = iccp_radial_value(&r, d - h);
            ck_assert_double_lt(ahead, behind);
            ck_assert_double_eq_tol((ahead - behind) / (2 * h), iccp_radial_slope(&r, d), 1e-8);
        }
    }
}
END_TEST

/* Values at the nodes, in 2-D and 3-D, with and without the affine function; the equations
 * themselves. */
START_TEST(values_at_nodes_are_taken)
{
    const size_t dim = _i % 2 ? 3 : 2, m = 5;
    const int kind = _i / 2 % 2 ? ICC_KERNEL_GAUSS : ICC_KERNEL_WENDLAND;
    const bool tail = _i / 4;
    size_t n;
    double *points = make_jittered(dim, dim == 2 ? 20 : 8, &n), tail_sum = 0, worst = 0;
    iccp_collocation *c = make(dim, n, points, radial_of(kind, dim == 2 ? 0.04 : 0.1), tail);
    double *values = malloc(n * m * sizeof *values), *product = malloc(n * m * sizeof *product);
    random_source r = {3};
    for (size_t i = 0; i < n * m; ++i)
        values[i] = random_between(&r, -1, 1);
    double *a = solve(c, n + dim + 1, m, values);
    const iccp_symmetric *k_matrix = iccp_collocation_matrix(c);
    for (size_t k = 0; k < n * m; ++k) {
        const size_t i = k / m;
        product[k] = k_matrix->diagonal[i] * a[k];
        for (size_t p = k_matrix->first[i]; p < k_matrix->first[i + 1]; ++p)
            product[k] += k_matrix->value[p] * a[m * k_matrix->column[p] + k % m];
    }
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j < m; ++j) {
            double at[5], whole = product[m * i + j] + a[m * n + j];
            iccp_collocation_evaluate(c, m, a, points + dim * i, at, NULL);
            for (size_t k = 0; k < dim; ++k)
                whole += a[m * (n + 1 + k) + j] * points[dim * i + k];
            worst = fmax(worst, fabs(whole - values[m * i + j]));
            worst = fmax(worst, fabs(at[j] - values[m * i + j]));
            tail_sum = fmax(tail_sum, fabs(a[m * (n + i % (dim + 1)) + j]));
        }
    ck_assert_msg(worst < 1e-9, "off by %g", worst);
    ck_assert(tail ? tail_sum > 1e-3 : tail_sum <= 0);
    for (size_t k = 0; tail && k <= dim; ++k) {
        double sum = 0, size = 0;
        for (size_t i = 0; i < n; ++i) {
            const double term = a[m * i] * (k == 0 ? 1 : points[dim * i + k - 1]);
            sum += term;
            size += fabs(term);
        }
        ck_assert_double_le(fabs(sum), 1e-11 * size);
    }
    iccp_collocation_free(c);
    free(points);
    free(values);
    free(product);
    free(a);
}
END_TEST

/* (3.43) against central differences. */
START_TEST(gradients_are_those_of_the_values)
{
    const size_t m = 4;
    const int kind = _i % 2 ? ICC_KERNEL_GAUSS : ICC_KERNEL_WENDLAND;
    const double h = 1e-6;
    size_t n;
    double *points = make_jittered(2, 15, &n), worst = 0;
    iccp_collocation *c = make(2, n, points, radial_of(kind, 0.06), _i / 2);
    double *values = malloc(n * m * sizeof *values);
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j < m; ++j)
            values[m * i + j] = sin(3 * points[2 * i] + (double)j) * cos(2 * points[2 * i + 1]);
    double *a = solve(c, n + 3, m, values);
    random_source r = {9};
    for (int q = 0; q < 500; ++q) {
        const double x[2] = {random_unit(&r), random_unit(&r)};
        double at[4], gradients[8], ahead[4], behind[4];
        iccp_collocation_evaluate(c, m, a, x, at, gradients);
        for (size_t k = 0; k < 2; ++k) {
            double y[2] = {x[0], x[1]};
            y[k] = x[k] + h;
            iccp_collocation_evaluate(c, m, a, y, ahead, NULL);
            y[k] = x[k] - h;
            iccp_collocation_evaluate(c, m, a, y, behind, NULL);
            for (size_t j = 0; j < m; ++j)
                worst = fmax(worst, fabs((ahead[j] - behind[j]) / (2 * h) - gradients[2 * j + k]));
        }
    }
    ck_assert_msg(worst <= 1e-7, "gradients deviate by %g", worst);
    iccp_collocation_free(c);
    free(points);
    free(values);
    free(a);
}
END_TEST

/* Sum j of all kernels at a point, and its derivatives, term by term. */
static void sum_plainly(size_t dim, size_t n, const double *nodes, const iccp_radial *radial,
                        size_t m, const double *coefficients, const double *point, size_t j,
                        double sum[4])
{
    for (size_t k = 0; k <= dim; ++k)
        sum[k] = coefficients[m * (n + k) + j];
    for (size_t k = 0; k < dim; ++k)
        sum[0] += sum[k + 1] * point[k];
    for (size_t i = 0; i < n; ++i) {
        double distance2 = 0;
        for (size_t k = 0; k < dim; ++k)
            distance2 += pow(point[k] - nodes[dim * i + k], 2);
        if (distance2 >= radial->reach * radial->reach)
            continue;
        sum[0] += iccp_radial_value(radial, distance2) * coefficients[m * i + j];
        for (size_t k = 0; k < dim; ++k)
            sum[k + 1] += 2 * iccp_radial_slope(radial, distance2) *
                          (point[k] - nodes[dim * i + k]) * coefficients[m * i + j];
    }
}

enum { MOST_SUMS = 13 };

static void compare_sums(size_t dim, size_t n, const double *nodes, const iccp_radial *radial,
                         const iccp_collocation *c, size_t m, const double *a, const double *point)
{
    double values[2][MOST_SUMS], gradients[2][3 * MOST_SUMS], sum[4];
    for (int l = 0; l < 2; ++l)
        iccp_collocation_evaluate_as(l == 0 ? ICCP_SIMD_NONE : iccp_simd(), c, m, a, point,
                                     values[l], gradients[l]);
    ck_assert_mem_eq(values[0], values[1], m * sizeof(double));
    ck_assert_mem_eq(gradients[0], gradients[1], dim * m * sizeof(double));
    for (size_t j = 0; j < m; ++j) {
        sum_plainly(dim, n, nodes, radial, m, a, point, j, sum);
        ck_assert_double_le(fabs(values[0][j] - sum[0]), 1e-12);
        for (size_t k = 0; k < dim; ++k)
            ck_assert_double_le(fabs(gradients[0][dim * j + k] - sum[k + 1]), 1e-10);
    }
}

/* However many nodes are near, hundreds among them, and whatever the processor has. */
START_TEST(sums_are_those_of_all_kernels)
{
    const size_t dim = _i < 2 ? 2 : 3;
    const bool gauss = _i % 2 != 0;
    random_source r = {12};
    size_t n;
    double *nodes = make_jittered(dim, dim == 2 ? 25 : 9, &n);
    const iccp_radial radial = {gauss ? ICC_KERNEL_GAUSS : ICC_KERNEL_WENDLAND,
                                dim == 2 ? 0.03 : 0.08, dim == 2 ? 0.4 : 0.55};
    iccp_collocation *c = make(dim, n, nodes, radial, true);
    double *a = malloc((n + dim + 1) * MOST_SUMS * sizeof *a);
    ck_assert_ptr_nonnull(a);
    for (size_t k = 0; k < (n + dim + 1) * MOST_SUMS; ++k)
        a[k] = random_between(&r, -1, 1);
    for (size_t m = 1; m <= MOST_SUMS; ++m) {
        double point[3];
        for (size_t k = 0; k < dim; ++k)
            point[k] = random_between(&r, -0.1, 1.1);
        compare_sums(dim, n, nodes, &radial, c, m, a, point);
    }
    iccp_collocation_free(c);
    free(nodes);
    free(a);
}
END_TEST

/* What the affine function is for: sums and reproduction between the nodes, and far from them. */
START_TEST(affine_values_are_continued_exactly)
{
    const size_t dim = _i % 2 ? 3 : 2;
    const int kind = _i / 2 ? ICC_KERNEL_GAUSS : ICC_KERNEL_WENDLAND;
    size_t n;
    double *points = make_jittered(dim, dim == 2 ? 50 : 12, &n), with = 0, without = 0;
    double *values = affine_values(dim, n, points);
    const iccp_radial radial = radial_of(kind, dim == 2 ? 0.02 : 0.08);
    iccp_collocation *tail = make(dim, n, points, radial, true);
    iccp_collocation *bare = make(dim, n, points, radial, false);
    double *a = solve(tail, n + dim + 1, dim + 1, values),
           *b = solve(bare, n + dim + 1, dim + 1, values);
    random_source r = {4};
    for (int q = 0; q < 3000; ++q) {
        double x[3], at[4], bare_at[4];
        for (size_t k = 0; k < dim; ++k)
            x[k] = q % 3 ? random_unit(&r) : random_between(&r, -5, 5);
        iccp_collocation_evaluate(tail, dim + 1, a, x, at, NULL);
        iccp_collocation_evaluate(bare, dim + 1, b, x, bare_at, NULL);
        for (size_t k = 0; k <= dim; ++k) {
            with = fmax(with, fabs(at[k] - (k == 0 ? 1 : x[k - 1])));
            without = fmax(without, fabs(bare_at[k] - (k == 0 ? 1 : x[k - 1])));
        }
    }
    ck_assert_msg(with <= 1e-11, "affine values deviate by %g", with);
    ck_assert_double_gt(without, 1e-3);
    iccp_collocation_free(tail);
    iccp_collocation_free(bare);
    free(points);
    free(values);
    free(a);
    free(b);
}
END_TEST

static icc_status try(int kind, size_t n, const double *points, double sigma, icc_error *err)
{
    const iccp_env env = default_env();
    const iccp_radial radial = iccp_radial_make(kind, sigma, 5);
    iccp_collocation *c;
    const icc_status status = iccp_collocation_create(&c, 2, n, points, &radial, false, &env, err);
    ck_assert_int_eq(status == ICC_OK, c != NULL);
    iccp_collocation_free(c);
    return status;
}

/* The cut Gaussian stops being positive definite between 1.2 and 1.4 spacings; Wendland's never
 * does. */
START_TEST(a_cut_gaussian_can_be_too_wide)
{
    const size_t n = 31 * 31;
    double *points = make_grid(31, 1);
    for (double sigma = 0.2; sigma < 4; sigma += 0.2) {
        icc_error err = {.size = sizeof err};
        ck_assert_int_eq(try(ICC_KERNEL_WENDLAND, n, points, sigma, &err), ICC_OK);
        const icc_status status = try(ICC_KERNEL_GAUSS, n, points, sigma, &err);
        if (sigma < 1.3)
            ck_assert_int_eq(status, ICC_OK);
        if (sigma < 1.39)
            continue;
        ck_assert_int_eq(status, ICC_ERR_SOLVER);
        ck_assert_ptr_nonnull(strstr(err.message, "sigma is too large"));
    }
    free(points);
}
END_TEST

/* Where the Gaussian is cut off weights jump; Wendland's function comes down to 0 by itself. */
START_TEST(a_cut_gaussian_jumps)
{
    const double point[2] = {0, 0}, value = 1;
    for (int kind = ICC_KERNEL_WENDLAND; kind <= ICC_KERNEL_GAUSS; ++kind) {
        iccp_collocation *c = make(2, 1, point, iccp_radial_make(kind, 1, 5), false);
        double *a = solve(c, 4, 1, &value), before, after;
        const double reach = iccp_collocation_radial(c)->reach;
        const double near[2] = {reach * (1 - 1e-9), 0}, far[2] = {reach * (1 + 1e-9), 0};
        iccp_collocation_evaluate(c, 1, a, near, &before, NULL);
        iccp_collocation_evaluate(c, 1, a, far, &after, NULL);
        ck_assert(after <= 0);
        if (kind == ICC_KERNEL_GAUSS)
            ck_assert_double_eq_tol(before, 3.7e-6, 1e-7);
        else
            ck_assert_double_lt(before, 1e-20);
        iccp_collocation_free(c);
        free(a);
    }
}
END_TEST

START_TEST(nodes_that_determine_nothing_are_refused)
{
    const iccp_env env = default_env();
    const iccp_radial radial = iccp_radial_make(ICC_KERNEL_WENDLAND, 1, 0);
    const double line[10] = {0, 0, 1, 2, 2, 4, 3, 6, 4, 8}, twice[8] = {0, 0, 1, 0, 0, 1, 1, 0};
    iccp_collocation *c = NULL;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(iccp_collocation_create(&c, 2, 5, line, &radial, true, &env, &err),
                     ICC_ERR_SOLVER);
    ck_assert_ptr_nonnull(strstr(err.message, "affine"));
    ck_assert_ptr_null(c);
    ck_assert_int_eq(iccp_collocation_create(&c, 2, 4, twice, &radial, true, &env, &err),
                     ICC_ERR_SOLVER);
    ck_assert_ptr_nonnull(strstr(err.message, "positive definite"));
    ck_assert_ptr_null(c);
}
END_TEST

/* Each thread solves for some of the columns; some columns alone are what they are with the
 * others. */
START_TEST(columns_do_not_depend_on_each_other)
{
    const size_t m = 21;
    size_t n;
    double *points = make_jittered(2, 30, &n);
    iccp_collocation *c = make(2, n, points, radial_of(ICC_KERNEL_WENDLAND, 0.03), true);
    const size_t rows = n + 3;
    double *values = malloc(n * m * sizeof *values), *some = calloc(rows * m, sizeof *some);
    for (size_t i = 0; i < n * m; ++i)
        values[i] = sin((double)i);
    double *a = solve(c, rows, m, values);
    bool which[21];
    for (size_t j = 0; j < m; ++j)
        which[j] = j % 3 == 1;
    iccp_env env = default_env();
    env.threads = 4;
    ck_assert_int_eq(iccp_collocation_solve_some(c, m, values, which, some, &env), ICC_OK);
    for (size_t i = 0; i < rows * m; ++i)
        ck_assert(some[i] == (which[i % m] ? a[i] : 0));
    iccp_collocation_free(c);
    free(points);
    free(values);
    free(some);
    free(a);
}
END_TEST

static icc_status make_and_solve(const icc_env *given, icc_error *err, void *argument)
{
    const double *points = argument;
    const iccp_radial radial = iccp_radial_make(ICC_KERNEL_WENDLAND, 1, 0);
    double a[52];
    iccp_env env;
    iccp_collocation *c = (iccp_collocation *)&c;
    icc_status status = iccp_env_read(&env, given, err);
    if (status == ICC_OK)
        status = iccp_collocation_create(&c, 2, 49, points, &radial, true, &env, err);
    ck_assert_int_eq(status == ICC_OK, c != NULL);
    if (status == ICC_OK)
        status = iccp_collocation_solve(c, 1, points, a, &env);
    iccp_collocation_free(c);
    return iccp_explain(err, status);
}

START_TEST(failures_are_reported)
{
    double *points = make_grid(7, 1);
    faulty_sweep(make_and_solve, points);
    free(points);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("interpolant");
    TCase *tests = tcase_create("interpolant");
    tcase_add_test(tests, rows_of_a_grid_sum_up_to_the_same);
    tcase_add_loop_test(tests, a_grid_has_the_properties_that_the_thesis_measured, 0, 2);
    tcase_add_test(tests, the_interpolant_has_a_minimum_where_the_thesis_finds_it);
    tcase_add_test(tests, kernels_and_their_slopes_agree);
    tcase_add_loop_test(tests, values_at_nodes_are_taken, 0, 8);
    tcase_add_loop_test(tests, gradients_are_those_of_the_values, 0, 4);
    tcase_add_loop_test(tests, sums_are_those_of_all_kernels, 0, 4);
    tcase_add_loop_test(tests, affine_values_are_continued_exactly, 0, 4);
    tcase_add_test(tests, a_cut_gaussian_can_be_too_wide);
    tcase_add_test(tests, a_cut_gaussian_jumps);
    tcase_add_test(tests, nodes_that_determine_nothing_are_refused);
    tcase_add_test(tests, columns_do_not_depend_on_each_other);
    tcase_add_test(tests, failures_are_reported);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

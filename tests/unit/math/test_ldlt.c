/* The sparse factorisation: its analysis against elimination on paper, its kernels against each
 * other, its factors against dense ones in long double. */
#include "math/dense.h"
#include "math/ldlt.h"
#include "math/subtrees.h"

#include "../../default_env.h"
#include "../../faulty.h"
#include "../../random.h"
#include "../../share.h"
#include "../../suite.h"

#include <check.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { MOST = 160 };

/* A matrix by all its entries, and the same as the library has it. */
typedef struct matrix {
    size_t n;
    double entry[MOST][MOST];
    size_t first[MOST + 1];
    uint32_t column[MOST * MOST];
    double value[MOST * MOST], diagonal[MOST];
    iccp_symmetric m;
} matrix;

static void compress(matrix *a)
{
    size_t k = 0;
    for (size_t i = 0; i < a->n; ++i) {
        a->first[i] = k;
        a->diagonal[i] = a->entry[i][i];
        for (size_t j = 0; j < a->n; ++j)
            if (j != i && fabs(a->entry[i][j]) > 0) {
                a->column[k] = (uint32_t)j;
                a->value[k++] = a->entry[i][j];
            }
    }
    a->first[a->n] = k;
    a->m = (iccp_symmetric){a->n, a->first, a->column, a->value, a->diagonal};
}

/* Each pair has an entry with a given probability; the diagonal dominates. sign: of each row, NULL:
 * all positive. A quasi-definite matrix is one whose rows of either sign by themselves are
 * definite. */
static matrix *random_matrix(size_t n, double density, const int8_t *sign, random_source *r)
{
    matrix *a = calloc(1, sizeof *a);
    a->n = n;
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j < i; ++j)
            if (random_unit(r) < density)
                a->entry[i][j] = a->entry[j][i] = random_between(r, -1, 1);
    for (size_t i = 0; i < n; ++i) {
        double sum = random_between(r, 0.1, 1);
        for (size_t j = 0; j < n; ++j)
            if (sign == NULL || sign[i] == sign[j])
                sum += fabs(a->entry[i][j]);
        a->entry[i][i] = sign == NULL ? sum : sign[i] * sum;
    }
    compress(a);
    return a;
}

static int8_t *random_signs(size_t n, random_source *r)
{
    int8_t *sign = malloc(n + 1);
    for (size_t i = 0; i < n; ++i)
        sign[i] = random_below(r, 2) ? 1 : -1;
    return sign;
}

static uint32_t *random_order(size_t n, random_source *r)
{
    uint32_t *order = malloc((n + 1) * sizeof *order);
    for (uint32_t i = 0; i < n; ++i) {
        const uint32_t j = (uint32_t)random_below(r, (int)i + 1);
        order[i] = order[j];
        order[j] = i;
    }
    return order;
}

/* Numbers of very different size. */
static void fill(double *x, size_t n, random_source *r)
{
    for (size_t i = 0; i < n; ++i)
        x[i] = ldexp(random_between(r, -1, 1), random_below(r, 60) - 30);
}

/* For what this processor has, or less. */
static iccp_dense dense_for_some(random_source *r)
{
    return iccp_dense_as((iccp_simd_level)random_below(r, (int)iccp_simd() + 1));
}

START_TEST(products_have_the_same_bits_everywhere)
{
    enum { DEPTH = 70, STRIDE = 4 * DEPTH + 12, STRIP = 4 * ICCP_TILE };
    static const size_t WIDTHS[] = {1, 2, 4, 6};
    const iccp_dense portable = iccp_dense_as(ICCP_SIMD_NONE);
    random_source r = {1};
    for (int k = 0; k < 3000; ++k) {
        const iccp_dense fast = dense_for_some(&r);
        double a[ICCP_STRIPS * STRIDE], b[ICCP_TILE * DEPTH];
        double x[ICCP_STRIPS * STRIP], y[ICCP_STRIPS * STRIP];
        fill(a, ICCP_STRIPS * STRIDE, &r);
        fill(b, ICCP_TILE * DEPTH, &r);
        const size_t width = WIDTHS[random_below(&r, 4)];
        const size_t n = 1 + (size_t)random_below(&r, ICCP_STRIPS);
        const size_t depth = (size_t)random_below(&r, DEPTH + 1);
        portable.multiply(x, n, width, a, STRIDE, b, depth);
        fast.multiply(y, n, width, a, STRIDE, b, depth);
        for (size_t t = 0; t < n; ++t)
            for (size_t c = 0; c < width; ++c)
                for (size_t i = 0; i < 4; ++i) {
                    double sum = 0;
                    for (size_t d = 0; d < depth; ++d)
                        sum += a[t * STRIDE + 4 * d + i] * b[width * d + c];
                    ck_assert(memcmp(&x[STRIP * t + 4 * c + i], &sum, sizeof sum) == 0);
                    ck_assert(memcmp(&y[STRIP * t + 4 * c + i], &sum, sizeof sum) == 0);
                }
    }
}
END_TEST

START_TEST(quotients_have_the_same_bits_everywhere)
{
    enum { STRIPS = 3, STRIDE = 28, N = STRIPS * STRIDE, SQUARE = ICCP_SQUARE * ICCP_SQUARE };
    const iccp_dense portable = iccp_dense_as(ICCP_SIMD_NONE);
    random_source r = {2};
    for (int k = 0; k < 3000; ++k) {
        const iccp_dense fast = dense_for_some(&r);
        double x[N], y[N], pivot[ICCP_SQUARE], scaled[SQUARE];
        fill(x, N, &r);
        fill(pivot, ICCP_SQUARE, &r);
        fill(scaled, SQUARE, &r);
        memcpy(y, x, sizeof x);
        const size_t width = 1 + (size_t)random_below(&r, ICCP_SQUARE);
        const size_t n = (size_t)random_below(&r, STRIPS + 1);
        portable.divide(x, n, STRIDE, width, pivot, scaled);
        fast.divide(y, n, STRIDE, width, pivot, scaled);
        ck_assert(memcmp(x, y, sizeof x) == 0);
    }
}
END_TEST

/* Four rows in a row that begin at any row of a strip; the other rows stay as they are. */
START_TEST(differences_have_the_same_bits_everywhere)
{
    enum { STRIDE = 60, N = 2 * STRIDE, STRIP = 4 * ICCP_TILE };
    const iccp_dense portable = iccp_dense_as(ICCP_SIMD_NONE);
    random_source r = {3};
    for (int k = 0; k < 3000; ++k) {
        const iccp_dense fast = dense_for_some(&r);
        double x[N], y[N], z[N], tile[STRIP];
        uint32_t column[ICCP_TILE];
        const size_t width = 1 + (size_t)random_below(&r, ICCP_TILE);
        const size_t low = (size_t)random_below(&r, 4);
        fill(x, N, &r);
        fill(tile, STRIP, &r);
        for (size_t c = 0; c < width; ++c)
            column[c] = (uint32_t)c + (uint32_t)random_below(&r, 2) * (STRIDE / 4 - ICCP_TILE);
        memcpy(y, x, sizeof x);
        memcpy(z, x, sizeof x);
        portable.subtract(x, low, STRIDE, column, width, tile);
        fast.subtract(y, low, STRIDE, column, width, tile);
        for (size_t c = 0; c < width; ++c)
            for (size_t i = 0; i < 4; ++i)
                z[(low + i) / 4 * STRIDE + 4 * column[c] + (low + i) % 4] -= tile[4 * c + i];
        ck_assert(memcmp(x, z, sizeof x) == 0);
        ck_assert(memcmp(y, z, sizeof x) == 0);
    }
}
END_TEST

START_TEST(rows_spread_with_the_same_bits_everywhere)
{
    enum { DEPTH = 30 };
    const iccp_dense portable = iccp_dense_as(ICCP_SIMD_NONE);
    random_source r = {4};
    for (int k = 0; k < 3000; ++k) {
        const iccp_dense fast = dense_for_some(&r);
        double x[4 * DEPTH], y[4 * DEPTH], a[4 * DEPTH], rows[16];
        fill(x, 4 * DEPTH, &r);
        fill(a, 4 * DEPTH, &r);
        fill(rows, 16, &r);
        memcpy(y, x, sizeof x);
        const size_t width = k % 2 == 0 ? 1 : 4, depth = (size_t)random_below(&r, DEPTH + 1);
        portable.spread(x, width, a, rows, depth);
        fast.spread(y, width, a, rows, depth);
        ck_assert(memcmp(x, y, sizeof x) == 0);
    }
}
END_TEST

/* Elimination on paper: the entries of each column of L below the diagonal. */
static void eliminate_pattern(const matrix *a, const uint32_t *order, bool fill[MOST][MOST])
{
    for (size_t i = 0; i < a->n; ++i)
        for (size_t j = 0; j < a->n; ++j)
            fill[i][j] = fabs(a->entry[order[i]][order[j]]) > 0;
    for (size_t k = 0; k < a->n; ++k)
        for (size_t i = k + 1; i < a->n; ++i)
            for (size_t j = k + 1; j < a->n; ++j)
                fill[i][j] = fill[i][j] || (fill[i][k] && fill[j][k]);
}

static size_t count_pattern(size_t n, bool fill[MOST][MOST], double *work)
{
    size_t n_entries = 0;
    *work = 0;
    for (size_t j = 0; j < n; ++j) {
        size_t below = 0;
        for (size_t i = j + 1; i < n; ++i)
            below += fill[i][j];
        n_entries += below;
        *work += (double)(below * (below + 1) / 2 + below);
    }
    return n_entries;
}

/* Rows of a panel rise, and it has room for every entry of its columns. */
static void check_panels(const iccp_ldlt *l, bool fill[MOST][MOST])
{
    const iccp_supernodes *nodes = &l->nodes;
    for (size_t s = 0; s < nodes->n; ++s) {
        bool is_row[MOST] = {false};
        const uint32_t end = nodes->column[s + 1];
        for (size_t p = nodes->first_row[s]; p < nodes->first_row[s + 1]; ++p) {
            ck_assert(nodes->row[p] >= end && nodes->row[p] < l->n);
            ck_assert(p == nodes->first_row[s] || nodes->row[p] > nodes->row[p - 1]);
            is_row[nodes->row[p]] = true;
        }
        for (uint32_t j = nodes->column[s]; j < end; ++j)
            for (size_t i = end; i < l->n; ++i)
                ck_assert(is_row[i] || !fill[i][j]);
    }
}

START_TEST(analysis_predicts_the_factor)
{
    static bool given[MOST][MOST], own[MOST][MOST];
    const iccp_env env = default_env();
    random_source r = {2};
    for (int k = 0; k < 300; ++k) {
        const size_t n = 1 + (size_t)random_below(&r, k % 10 == 0 ? MOST : 40);
        matrix *a = random_matrix(n, random_unit(&r) * random_unit(&r), NULL, &r);
        uint32_t *order = random_order(n, &r);
        iccp_ldlt l;
        double work, same_work;
        ck_assert_int_eq(iccp_ldlt_analyse_ordered(&l, &a->m, order, &env), ICC_OK);
        eliminate_pattern(a, order, given);
        eliminate_pattern(a, l.order, own);
        ck_assert_uint_eq(count_pattern(n, own, &work), l.n_entries);
        ck_assert_uint_eq(count_pattern(n, given, &same_work), l.n_entries);
        ck_assert(!(fabs(work - l.work) > 0) && !(fabs(same_work - l.work) > 0));
        ck_assert_double_ge(iccp_ldlt_bytes(&l), 8.0 * (double)(l.n_entries + n));
        ck_assert(l.value == NULL);
        for (size_t i = 0; i < n; ++i)
            ck_assert(l.order[l.position[i]] == i);
        check_panels(&l, own);
        iccp_ldlt_free(&l);
        free(order);
        free(a);
    }
}
END_TEST

/* D of L D L^T in the given order. */
static void eliminate_dense(const matrix *a, const uint32_t *order, double *pivot)
{
    static long double c[MOST][MOST];
    for (size_t i = 0; i < a->n; ++i)
        for (size_t j = 0; j < a->n; ++j)
            c[i][j] = a->entry[order[i]][order[j]];
    for (size_t k = 0; k < a->n; ++k) {
        pivot[k] = (double)c[k][k];
        for (size_t i = k + 1; i < a->n; ++i)
            for (size_t j = k + 1; j < a->n; ++j)
                c[i][j] -= c[i][k] * c[k][j] / c[k][k];
    }
}

/* Solves for a given solution; its largest error. */
static double solve_error(const matrix *a, const iccp_ldlt *l, random_source *r)
{
    double x[MOST], b[MOST], work[MOST], error = 0;
    for (size_t i = 0; i < a->n; ++i)
        x[i] = random_between(r, -1, 1);
    for (size_t i = 0; i < a->n; ++i) {
        b[i] = 0;
        for (size_t j = 0; j < a->n; ++j)
            b[i] += a->entry[i][j] * x[j];
    }
    iccp_ldlt_solve(l, 1, b, work);
    for (size_t i = 0; i < a->n; ++i)
        error = fmax(error, fabs(b[i] - x[i]));
    return error;
}

START_TEST(factors_are_those_of_dense_elimination)
{
    const iccp_env env = default_env();
    random_source r = {3};
    double pivot[MOST];
    for (int k = 0; k < 120; ++k) {
        const size_t n = 1 + (size_t)random_below(&r, MOST);
        int8_t *sign = random_signs(n, &r);
        matrix *a = random_matrix(n, k % 4 == 0 ? 1 : random_unit(&r) / 4, k % 2 ? sign : NULL, &r);
        uint32_t *order = random_order(n, &r);
        iccp_ldlt l;
        ck_assert_int_eq(iccp_ldlt_analyse_ordered(&l, &a->m, order, &env), ICC_OK);
        ck_assert_int_eq(k % 2 ? iccp_ldlt_factorise_signed(&l, &a->m, sign, &env)
                               : iccp_ldlt_factorise(&l, &a->m, &env),
                         ICC_OK);
        eliminate_dense(a, l.order, pivot);
        for (size_t i = 0; i < n; ++i)
            ck_assert_double_le(fabs(l.pivot[i] - pivot[i]), 1e-11 * fabs(pivot[i]));
        ck_assert_double_le(solve_error(a, &l, &r), 1e-10);
        iccp_ldlt_free(&l);
        free(order);
        free(sign);
        free(a);
    }
}
END_TEST

/* A second factorisation gives the same bits, also after one of another matrix or a failed one. */
START_TEST(factorising_again_changes_nothing)
{
    const iccp_env env = default_env();
    random_source r = {4};
    for (int k = 0; k < 40; ++k) {
        const size_t n = 2 + (size_t)random_below(&r, MOST - 1);
        matrix *a = random_matrix(n, k % 4 == 0 ? 1 : 0.1, NULL, &r);
        const size_t row = (size_t)random_below(&r, (int)n);
        const double before = a->diagonal[row];
        double pivot[MOST];
        iccp_ldlt l;
        uint32_t *order = random_order(n, &r);
        ck_assert_int_eq(iccp_ldlt_analyse_ordered(&l, &a->m, order, &env), ICC_OK);
        ck_assert_int_eq(iccp_ldlt_factorise(&l, &a->m, &env), ICC_OK);
        memcpy(pivot, l.pivot, n * sizeof *pivot);
        a->diagonal[row] = k % 2 ? 2 * before : k % 3 ? -before : NAN;
        ck_assert_int_eq(iccp_ldlt_factorise(&l, &a->m, &env), k % 2 ? ICC_OK : ICC_ERR_SOLVER);
        a->diagonal[row] = before;
        ck_assert_int_eq(iccp_ldlt_factorise(&l, &a->m, &env), ICC_OK);
        ck_assert(memcmp(pivot, l.pivot, n * sizeof *pivot) == 0);
        iccp_ldlt_free(&l);
        free(order);
        free(a);
    }
}
END_TEST

START_TEST(wrong_signs_are_refused)
{
    const iccp_env env = default_env();
    random_source r = {5};
    for (int k = 0; k < 60; ++k) {
        const size_t n = 1 + (size_t)random_below(&r, 60), row = (size_t)random_below(&r, (int)n);
        int8_t *sign = random_signs(n, &r);
        matrix *a = random_matrix(n, 0.2, sign, &r);
        uint32_t *order = random_order(n, &r);
        iccp_ldlt l;
        ck_assert_int_eq(iccp_ldlt_analyse_ordered(&l, &a->m, order, &env), ICC_OK);
        ck_assert_int_eq(iccp_ldlt_factorise_signed(&l, &a->m, sign, &env), ICC_OK);
        sign[row] = (int8_t)-sign[row];
        ck_assert_int_eq(iccp_ldlt_factorise_signed(&l, &a->m, sign, &env), ICC_ERR_SOLVER);
        sign[row] = -1;
        a->diagonal[row] = -fabs(a->diagonal[row]);
        ck_assert_int_eq(iccp_ldlt_factorise(&l, &a->m, &env), ICC_ERR_SOLVER);
        iccp_ldlt_free(&l);
        free(order);
        free(sign);
        free(a);
    }
}
END_TEST

/* Seven-point Laplacian of the cells of a box that a rule lets in, 0 round them. */
typedef struct lattice {
    size_t n;
    uint32_t *unknown;
    size_t *first;
    uint32_t *column;
    double *value, *diagonal;
    iccp_symmetric m;
} lattice;

typedef bool (*rule)(int x, int y, int z);

static lattice make_lattice(int width, int height, int depth, rule is_in)
{
    const size_t n_cells = (size_t)width * (size_t)height * (size_t)depth;
    lattice g = {.unknown = calloc(n_cells, sizeof *g.unknown),
                 .first = calloc(n_cells + 1, sizeof *g.first),
                 .column = calloc(6 * n_cells, sizeof *g.column),
                 .value = calloc(6 * n_cells, sizeof *g.value),
                 .diagonal = calloc(n_cells, sizeof *g.diagonal)};
    for (size_t c = 0; c < n_cells; ++c) {
        const int x = (int)c % width, y = (int)c / width % height, z = (int)c / width / height;
        g.unknown[c] = is_in(x, y, z) ? (uint32_t)g.n++ : UINT32_MAX;
    }
    size_t k = 0, row = 0;
    for (size_t c = 0; c < n_cells; ++c) {
        if (g.unknown[c] == UINT32_MAX)
            continue;
        const int at[3] = {(int)c % width, (int)c / width % height, (int)c / width / height};
        const int size[3] = {width, height, depth}, step[3] = {1, width, width * height};
        for (int d = 0; d < 3; ++d)
            for (int s = -1; s <= 1; s += 2) {
                if (at[d] + s < 0 || at[d] + s >= size[d])
                    continue;
                const uint32_t other = g.unknown[(size_t)((int)c + s * step[d])];
                if (other == UINT32_MAX)
                    continue;
                g.column[k] = other;
                g.value[k++] = -1;
            }
        g.diagonal[row] = depth > 1 ? 6 : 4;
        g.first[++row] = k;
    }
    g.m = (iccp_symmetric){g.n, g.first, g.column, g.value, g.diagonal};
    return g;
}

static void lattice_clear(lattice *g)
{
    free(g->unknown);
    free(g->first);
    free(g->column);
    free(g->value);
    free(g->diagonal);
}

/* Corridors of 3 cells to and fro; of 3 by 3 cells on three storeys; a comb of dead ends. */
static bool in_snake(int x, int y, int z)
{
    (void)z;
    return y % 4 != 3 || (y / 4 % 2 ? x < 3 : x >= 197);
}

static bool in_storeys(int x, int y, int z)
{
    const bool floor = y % 4 != 3 || (y / 4 % 2 ? x < 3 : x >= 37);
    return z % 4 == 3 ? x >= 37 && (z / 4 % 2 ? y < 3 : y >= 32) : floor;
}

static bool in_comb(int x, int y, int z)
{
    (void)z;
    return y < 4 || x % 5 != 4;
}

static const struct {
    int width, height, depth;
    rule is_in;
} MAZES[] = {{200, 199, 1, in_snake}, {40, 35, 11, in_storeys}, {149, 150, 1, in_comb}};

/* Solves for a source and checks that every number is positive and satisfies its equation to 1e-12
 * of its own size. Returns the lowest exponent. */
static int32_t check_components(const lattice *g, const iccp_ldlt *l, size_t source)
{
    const iccp_scaled x = {malloc(g->n * sizeof(double)), malloc(g->n * sizeof(int32_t))};
    const iccp_scaled work = {malloc(g->n * sizeof(double)), malloc(g->n * sizeof(int32_t))};
    const iccp_env env = default_env();
    int32_t lowest = 0;
    for (size_t i = 0; i < g->n; ++i)
        iccp_scaled_set(&x, i, i == source, 0);
    ck_assert_int_eq(iccp_ldlt_solve_scaled(l, &x, &work, &env), ICC_OK);
    for (size_t i = 0; i < g->n; ++i) {
        const int32_t unit = x.exponent[i];
        double sum = -g->diagonal[i] * x.fraction[i] + (i == source ? ldexp(1, -unit) : 0);
        for (size_t p = g->first[i]; p < g->first[i + 1]; ++p)
            sum -= g->value[p] * iccp_scaled_get(&x, g->column[p], unit);
        ck_assert(x.fraction[i] > 0 && unit != ICCP_ZERO_EXPONENT);
        ck_assert_double_le(fabs(sum), 1e-12 * g->diagonal[i] * x.fraction[i]);
        lowest = unit < lowest ? unit : lowest;
    }
    free(x.fraction);
    free(x.exponent);
    free(work.fraction);
    free(work.exponent);
    return lowest;
}

START_TEST(mazes_are_solved_in_every_component)
{
    const iccp_env env = default_env();
    lattice g = make_lattice(MAZES[_i].width, MAZES[_i].height, MAZES[_i].depth, MAZES[_i].is_in);
    iccp_ldlt l;
    const icc_status status = iccp_ldlt_analyse(&l, &g.m, 1, &env);
    if (status != ICC_ERR_UNSUPPORTED) {
        ck_assert_int_eq(status, ICC_OK);
        ck_assert_int_eq(iccp_ldlt_factorise(&l, &g.m, &env), ICC_OK);
        const int32_t lowest = check_components(&g, &l, 0);
        ck_assert(_i != 0 || lowest < -10000);
        check_components(&g, &l, g.n - 1);
        check_components(&g, &l, g.n / 2);
        iccp_ldlt_free(&l);
    }
    lattice_clear(&g);
}
END_TEST

static bool in_ring(int x, int y, int z)
{
    const int u = x < y ? x : y, v = x > y ? 399 - x : 399 - y;
    (void)z;
    return (u < v ? u : v) < 2;
}

/* Every row before those that are nearer to the source. */
static uint32_t *falling_distance(const lattice *g, uint32_t source)
{
    uint32_t *order = malloc(g->n * sizeof *order);
    bool *is_seen = calloc(g->n, sizeof *is_seen);
    size_t n_seen = 0;
    order[g->n - ++n_seen] = source;
    is_seen[source] = true;
    for (size_t k = 1; k <= n_seen; ++k) {
        const uint32_t i = order[g->n - k];
        for (size_t p = g->first[i]; p < g->first[i + 1]; ++p)
            if (!is_seen[g->column[p]]) {
                is_seen[g->column[p]] = true;
                order[g->n - ++n_seen] = g->column[p];
            }
    }
    ck_assert_uint_eq(n_seen, g->n);
    free(is_seen);
    return order;
}

/* A ring has no end to begin with, and orders by degree join its two sides. */
START_TEST(rings_are_solved_in_order_of_distance)
{
    const iccp_env env = default_env();
    lattice g = make_lattice(400, 400, 1, in_ring);
    const uint32_t source = (uint32_t)(g.n / 3);
    uint32_t *order = falling_distance(&g, source);
    iccp_ldlt l;
    ck_assert_int_eq(iccp_ldlt_analyse_ordered(&l, &g.m, order, &env), ICC_OK);
    ck_assert_int_eq(iccp_ldlt_factorise(&l, &g.m, &env), ICC_OK);
    ck_assert_int_lt(check_components(&g, &l, source), -1050);
    iccp_ldlt_free(&l);
    free(order);
    lattice_clear(&g);
}
END_TEST

/* Two rows that meet in a third share a panel, with a 0 between them. The first has the larger
 * right side by far, yet what gets from it to the second is less than the second has. */
START_TEST(stored_zeros_carry_nothing)
{
    const size_t first[] = {0, 1, 2, 4};
    const uint32_t column[] = {2, 2, 0, 1}, order[] = {0, 1, 2};
    const double tie = -0x1p-900, value[] = {tie, tie, tie, tie}, diagonal[] = {1, 1, 1};
    const iccp_symmetric m = {3, first, column, value, diagonal};
    const iccp_env env = default_env();
    double fraction[3], work_fraction[3];
    int32_t exponent[3], work_exponent[3];
    const iccp_scaled x = {fraction, exponent}, work = {work_fraction, work_exponent};
    iccp_ldlt l;
    ck_assert_int_eq(iccp_ldlt_analyse_ordered(&l, &m, order, &env), ICC_OK);
    ck_assert_uint_eq(l.nodes.n, 1);
    ck_assert_int_eq(iccp_ldlt_factorise(&l, &m, &env), ICC_OK);
    iccp_scaled_set(&x, 0, 1, 3000);
    iccp_scaled_set(&x, 1, 1, 1500);
    iccp_scaled_set(&x, 2, 0, 0);
    ck_assert_int_eq(iccp_ldlt_solve_scaled(&l, &x, &work, &env), ICC_OK);
    ck_assert_int_eq(exponent[0], 3001);
    ck_assert_int_eq(exponent[1], 1501);
    ck_assert_int_eq(exponent[2], 2101);
    iccp_ldlt_free(&l);
}
END_TEST

static bool everywhere(int x, int y, int z)
{
    (void)x;
    (void)y;
    (void)z;
    return true;
}

/* Where few rows count, the others are not even looked at, and these get the same bits. */
START_TEST(marked_rows_are_solved_alone)
{
    enum { SIDE = 40, CORNER = 5, SIDES = 7, ROWS = SIDE * SIDE };
    lattice g = make_lattice(SIDE, SIDE, 1, everywhere);
    const iccp_env env = default_env();
    random_source r = {8};
    iccp_ldlt l;
    ck_assert_int_eq(iccp_ldlt_analyse(&l, &g.m, 1, &env), ICC_OK);
    ck_assert_int_eq(iccp_ldlt_factorise(&l, &g.m, &env), ICC_OK);
    uint8_t *needed = calloc(l.nodes.n, 1);
    double *whole = calloc(ROWS * SIDES, sizeof *whole), *some = calloc(ROWS * SIDES, sizeof *some);
    double *work = calloc(ROWS * SIDES, sizeof *work);
    uint32_t corner[CORNER * CORNER], *marked = calloc(ROWS, sizeof *marked);
    for (uint32_t k = 0; k < CORNER * CORNER; ++k) {
        corner[k] = k / CORNER * SIDE + k % CORNER;
        fill(whole + SIDES * corner[k], SIDES, &r);
    }
    for (size_t k = 0; k < ROWS * SIDES; ++k)
        some[k] = NAN;
    iccp_ldlt_mark(&l, CORNER * CORNER, corner, needed);
    const size_t n = iccp_ldlt_marked(&l, needed, marked);
    ck_assert(n >= CORNER * CORNER && n < ROWS / 2);
    for (size_t k = 0; k < n; ++k)
        memcpy(some + SIDES * marked[k], whole + SIDES * marked[k], SIDES * sizeof *some);
    iccp_ldlt_solve(&l, SIDES, whole, work);
    iccp_ldlt_solve_marked(&l, needed, SIDES, some, work);
    for (uint32_t i = 0, k = 0; i < ROWS; ++i) {
        const bool is_marked = k < n && marked[k] == i;
        k += is_marked;
        ck_assert(!is_marked ||
                  memcmp(some + SIDES * i, whole + SIDES * i, SIDES * sizeof *some) == 0);
        ck_assert(is_marked || isnan(some[SIDES * i]));
    }
    for (uint32_t k = 0; k < CORNER * CORNER; ++k)
        ck_assert(isfinite(some[SIDES * corner[k]]));
    iccp_ldlt_free(&l);
    free(needed);
    free(whole);
    free(some);
    free(work);
    free(marked);
    lattice_clear(&g);
}
END_TEST

/* b' A^-1 b of sparse b is the product of b and the solution. Working memory is zero again. */
START_TEST(forms_are_those_of_solutions)
{
    enum { SIDE = 40, ROWS = SIDE * SIDE, N = 9, TRIES = 20 };
    lattice g = make_lattice(SIDE, SIDE, 1, everywhere);
    const iccp_env env = default_env();
    random_source r = {9};
    iccp_ldlt l;
    ck_assert_int_eq(iccp_ldlt_analyse(&l, &g.m, 1, &env), ICC_OK);
    ck_assert_int_eq(iccp_ldlt_factorise(&l, &g.m, &env), ICC_OK);
    uint8_t *needed = calloc(l.nodes.n, 1);
    uint32_t *path = calloc(l.nodes.n, sizeof *path);
    double *work = calloc(ICCP_LDLT_FORMS * ROWS, sizeof *work);
    double *b = calloc(ROWS, sizeof *b), *x = calloc(ROWS, sizeof *x);
    double *room = calloc(ROWS, sizeof *room);
    for (int k = 0; k < TRIES; ++k) {
        uint32_t rows[N];
        double values[N * ICCP_LDLT_FORMS], form[ICCP_LDLT_FORMS];
        for (size_t i = 0; i < N; ++i)
            rows[i] = i == 1 ? rows[0] : (uint32_t)random_below(&r, ROWS);
        fill(values, N * ICCP_LDLT_FORMS, &r);
        iccp_ldlt_forms(&l, N, rows, values, form, work, needed, path);
        for (size_t c = 0; c < ICCP_LDLT_FORMS; ++c) {
            memset(b, 0, ROWS * sizeof *b);
            for (size_t i = 0; i < N; ++i)
                b[rows[i]] += values[ICCP_LDLT_FORMS * i + c];
            memcpy(x, b, ROWS * sizeof *b);
            iccp_ldlt_solve(&l, 1, x, room);
            double want = 0;
            for (size_t i = 0; i < ROWS; ++i)
                want += b[i] * x[i];
            ck_assert_double_eq_tol(form[c], want, 1e-11 * want);
        }
        for (size_t i = 0; i < ICCP_LDLT_FORMS * ROWS; ++i)
            ck_assert(!(work[i] > 0) && !(work[i] < 0));
        for (size_t i = 0; i < l.nodes.n; ++i)
            ck_assert_uint_eq(needed[i], 0);
    }
    free(needed);
    free(path);
    free(work);
    free(b);
    free(x);
    free(room);
    iccp_ldlt_free(&l);
    lattice_clear(&g);
}
END_TEST

typedef struct watch {
    int n_reports;
    double share;
} watch;

static int32_t look(void *user, const char *stage, double share)
{
    watch *w = user;
    (void)stage;
    ck_assert(share >= w->share && share <= 1);
    w->share = share;
    ++w->n_reports;
    return 0;
}

/* Whoever waits is asked every 3e7 multiplications, also within a wide panel. */
START_TEST(long_factorisations_report_often)
{
    lattice g = make_lattice(20, 20, 20, everywhere);
    watch w = {0};
    iccp_env env;
    const icc_env outer = {.size = sizeof outer, .user = &w, .progress = look};
    ck_assert_int_eq(iccp_env_read(&env, &outer, NULL), ICC_OK);
    uint32_t *order = malloc(g.n * sizeof *order);
    for (uint32_t i = 0; i < g.n; ++i)
        order[i] = i;
    iccp_ldlt l;
    ck_assert_int_eq(iccp_ldlt_analyse_ordered(&l, &g.m, order, &env), ICC_OK);
    ck_assert(w.n_reports == 3 && w.share > 0.6); /* one for each pass through the matrix */
    w = (watch){0};
    ck_assert_int_eq(iccp_ldlt_factorise(&l, &g.m, &env), ICC_OK);
    ck_assert_double_ge(w.n_reports, l.work / 4e7);
    ck_assert(w.n_reports > 5 && w.share > 0.9);
    iccp_ldlt_free(&l);
    free(order);
    lattice_clear(&g);
}
END_TEST

static void run_backwards(void *user, size_t n_tasks, icc_task task, void *argument)
{
    *(size_t *)user += n_tasks;
    while (n_tasks-- > 0)
        task(argument, n_tasks);
}

/* The same bits for every number of threads, and when tasks come in another order. */
START_TEST(threads_change_nothing)
{
    enum { N = 1600 };
    size_t *first = malloc((N + 1) * sizeof *first), n_tasks = 0;
    uint32_t *column = malloc((size_t)N * N * sizeof *column), order[N];
    double *value = malloc((size_t)N * N * sizeof *value), diagonal[N], pivot[N];
    size_t k = 0;
    for (uint32_t i = 0; i < N; ++i) {
        first[i] = k;
        diagonal[i] = N;
        order[i] = i;
        for (uint32_t j = 0; j < N; ++j)
            if (j != i) {
                column[k] = j;
                value[k++] = cos((double)(i + j) * 0.7) + cos((double)(i * j) * 0.3);
            }
    }
    first[N] = k;
    const iccp_symmetric m = {N, first, column, value, diagonal};
    double *one = NULL;
    for (int32_t run = 0; run < 4; ++run) {
        const icc_env outer = {.size = sizeof outer,
                               .user = &n_tasks,
                               .threads = 1 + 2 * run,
                               .parallel_for = run == 3 ? run_backwards : NULL};
        iccp_env env;
        iccp_ldlt l;
        ck_assert_int_eq(iccp_env_read(&env, &outer, NULL), ICC_OK);
        ck_assert_int_eq(iccp_ldlt_analyse_ordered(&l, &m, order, &env), ICC_OK);
        ck_assert_int_eq(iccp_ldlt_factorise(&l, &m, &env), ICC_OK);
        const size_t n_bytes = l.nodes.first_value[l.nodes.n] * sizeof *one;
        if (run == 0) {
            one = malloc(n_bytes);
            memcpy(one, l.value, n_bytes);
            memcpy(pivot, l.pivot, sizeof pivot);
        }
        ck_assert(memcmp(l.value, one, n_bytes) == 0);
        ck_assert(memcmp(l.pivot, pivot, sizeof pivot) == 0);
        iccp_ldlt_free(&l);
    }
    ck_assert_uint_gt(n_tasks, 0);
    free(one);
    free(first);
    free(column);
    free(value);
}
END_TEST

/* Nested dissection of a square lattice: both halves, then the line between them. */
static void dissect(uint32_t **order, uint32_t side, uint32_t x0, uint32_t x1, uint32_t y0,
                    uint32_t y1)
{
    const bool is_wide = x1 - x0 > y1 - y0;
    const uint32_t x = (x0 + x1) / 2, y = (y0 + y1) / 2;
    if (x0 == x1 || y0 == y1)
        return;
    dissect(order, side, x0, is_wide ? x : x1, y0, is_wide ? y1 : y);
    dissect(order, side, is_wide ? x + 1 : x0, x1, is_wide ? y0 : y + 1, y1);
    for (uint32_t k = is_wide ? y0 : x0; k < (is_wide ? y1 : x1); ++k)
        *(*order)++ = is_wide ? x + side * k : k + side * y;
}

static uint32_t *dissection_of(uint32_t side)
{
    uint32_t *order = malloc((size_t)side * side * sizeof *order), *end = order;
    dissect(&end, side, 0, side, 0, side);
    ck_assert_uint_eq((size_t)(end - order), (size_t)side * side);
    return order;
}

/* Groups of rows with one pattern are analysed as one row each: as if every row had been. */
START_TEST(groups_are_analysed_as_their_rows)
{
    enum { SIDE = 30, BLOCK = 3, N = BLOCK * SIDE * SIDE };
    const iccp_env env = default_env();
    lattice g = make_lattice(SIDE, SIDE, 1, everywhere);
    size_t *first = malloc((N + 1) * sizeof *first), k = 0;
    uint32_t *column = malloc((size_t)N * 5 * BLOCK * sizeof *column);
    iccp_ldlt groups, rows;
    for (uint32_t i = 0; i < N; ++i) {
        first[i] = k;
        for (uint32_t d = 0; d < BLOCK; ++d)
            if (d != i % BLOCK)
                column[k++] = i - i % BLOCK + d;
        for (size_t p = g.first[i / BLOCK]; p < g.first[i / BLOCK + 1]; ++p)
            for (uint32_t d = 0; d < BLOCK; ++d)
                column[k++] = BLOCK * g.column[p] + d;
    }
    first[N] = k;
    const iccp_symmetric m = {N, first, column, NULL, NULL};
    if (iccp_ldlt_analyse(&groups, &m, BLOCK, &env) == ICC_OK) { /* there is an ordering */
        const iccp_supernodes *a = &groups.nodes, *b = &rows.nodes;
        ck_assert_int_eq(iccp_ldlt_analyse_ordered(&rows, &m, groups.order, &env), ICC_OK);
        ck_assert_mem_eq(groups.order, rows.order, N * sizeof *rows.order);
        ck_assert_mem_eq(groups.position, rows.position, N * sizeof *rows.position);
        ck_assert(groups.n_entries == rows.n_entries && a->n == b->n);
        ck_assert_double_eq_tol(groups.work, rows.work, 1e-12 * rows.work);
        ck_assert_mem_eq(a->column, b->column, (a->n + 1) * sizeof *a->column);
        ck_assert_mem_eq(a->parent, b->parent, a->n * sizeof *a->parent);
        ck_assert_mem_eq(a->owner, b->owner, N * sizeof *a->owner);
        ck_assert_mem_eq(a->first_row, b->first_row, (a->n + 1) * sizeof *a->first_row);
        ck_assert_mem_eq(a->first_value, b->first_value, (a->n + 1) * sizeof *a->first_value);
        ck_assert_mem_eq(a->row, b->row, a->first_row[a->n] * sizeof *a->row);
        ck_assert(a->most_rows == b->most_rows && a->most_columns == b->most_columns);
        iccp_ldlt_free(&rows);
        iccp_ldlt_free(&groups);
    }
    free(first);
    free(column);
    lattice_clear(&g);
}
END_TEST

static double work_of(const iccp_supernodes *nodes, size_t s)
{
    const double columns = (double)iccp_supernodes_columns(nodes, s);
    return columns * (columns + (double)iccp_supernodes_below(nodes, s));
}

/* Runs hold whole subtrees, `least` of the work, and none of them much more than its share. */
static void check_runs(const iccp_subtrees *t, const iccp_supernodes *nodes, double share,
                       double least)
{
    double all = 0, inside = 0;
    for (size_t s = 0; s < nodes->n; ++s)
        all += work_of(nodes, s);
    for (size_t k = 0, end = 0; k < t->n; end = t->run[k++].end) {
        double own = 0;
        ck_assert(t->run[k].begin >= end && t->run[k].end > t->run[k].begin);
        for (uint32_t s = t->run[k].begin; s < t->run[k].end; ++s)
            own += work_of(nodes, s);
        ck_assert_double_le(own, 1.6 * share * all);
        inside += own;
    }
    ck_assert_double_eq_tol(inside, t->labour, 1e-9 * all);
    ck_assert_double_gt(inside, least * all);
    /* What is in a run has its children there: nothing outside has its parent in it. */
    for (uint32_t s = 0; s < nodes->n; ++s)
        for (size_t k = 0; k < t->n; ++k) {
            const uint32_t parent = nodes->parent[s];
            const bool is_in = s >= t->run[k].begin && s < t->run[k].end;
            ck_assert(is_in || parent < t->run[k].begin || parent >= t->run[k].end);
        }
}

/* And those of an inner level lie within those of the outer one. */
START_TEST(subtrees_are_independent)
{
    const iccp_env env = default_env();
    lattice g = make_lattice(90, 90, 1, everywhere);
    uint32_t *order = dissection_of(90);
    iccp_ldlt l;
    ck_assert_int_eq(iccp_ldlt_analyse_ordered(&l, &g.m, order, &env), ICC_OK);
    const iccp_supernodes *nodes = &l.nodes;
    for (double large = 0.4; large > 0.1; large *= 0.8) {
        iccp_subtrees outer, inner;
        ck_assert_int_eq(iccp_subtrees_create(&outer, nodes, large, NULL, work_of, &env), ICC_OK);
        ck_assert_int_eq(iccp_subtrees_create(&inner, nodes, 1.0 / 16, &outer, work_of, &env),
                         ICC_OK);
        ck_assert_uint_gt(outer.n, 1);
        ck_assert_uint_gt(inner.n, 4);
        check_runs(&outer, nodes, large, 0.5);
        check_runs(&inner, nodes, 1.0 / 16, 0.4);
        for (size_t k = 0; k < inner.n; ++k) {
            size_t n_around = 0;
            for (size_t j = 0; j < outer.n; ++j)
                n_around += inner.run[k].begin >= outer.run[j].begin &&
                            inner.run[k].end <= outer.run[j].end;
            ck_assert_uint_eq(n_around, 1);
        }
        iccp_subtrees_free(&outer, &env.memory);
        iccp_subtrees_free(&inner, &env.memory);
    }
    iccp_ldlt_free(&l);
    free(order);
    lattice_clear(&g);
}
END_TEST

/* Of a matrix with many subtrees, with the bits of one thread. */
START_TEST(subtrees_change_nothing)
{
    lattice g = make_lattice(90, 90, 1, everywhere);
    uint32_t *order = dissection_of(90);
    double *one = NULL;
    size_t n_tasks = 0;
    for (int32_t run = 0; run < 5; ++run) {
        const icc_env outer = {.size = sizeof outer,
                               .user = &n_tasks,
                               .threads = run == 3 ? 8 : 1 + run,
                               .parallel_for = run == 4 ? run_backwards : NULL};
        iccp_env env;
        iccp_ldlt l;
        ck_assert_int_eq(iccp_env_read(&env, &outer, NULL), ICC_OK);
        ck_assert_int_eq(iccp_ldlt_analyse_ordered(&l, &g.m, order, &env), ICC_OK);
        ck_assert_int_eq(iccp_ldlt_factorise(&l, &g.m, &env), ICC_OK);
        const size_t n_bytes = l.nodes.first_value[l.nodes.n] * sizeof *one;
        if (run == 0) {
            one = malloc(n_bytes);
            memcpy(one, l.value, n_bytes);
        }
        ck_assert(memcmp(l.value, one, n_bytes) == 0);
        iccp_ldlt_free(&l);
    }
    ck_assert_uint_gt(n_tasks, 4);
    free(one);
    free(order);
    lattice_clear(&g);
}
END_TEST

/* Analyses and factorises twice; what fails is tried again at once, with the memory that is
 * there. */
static icc_status make_factor(const matrix *a, const uint32_t *order, const int8_t *sign,
                              const iccp_env *env)
{
    iccp_ldlt l;
    icc_status status = iccp_ldlt_analyse_ordered(&l, &a->m, order, env);
    if (status != ICC_OK) {
        ck_assert(l.order == NULL && l.nodes.column == NULL);
        return status;
    }
    status = iccp_ldlt_factorise_signed(&l, &a->m, sign, env);
    if (status != ICC_OK)
        ck_assert_int_eq(iccp_ldlt_factorise_signed(&l, &a->m, sign, env), ICC_OK);
    iccp_ldlt_free(&l);
    return status;
}

START_TEST(failures_leave_nothing_behind)
{
    random_source r = {6};
    int8_t *sign = random_signs(MOST, &r);
    matrix *a = random_matrix(MOST, 0.05, sign, &r);
    uint32_t *order = random_order(MOST, &r);
    for (int cancels = 0; cancels < 2; ++cancels) {
        icc_status status = -1;
        size_t k = 0;
        while (status != ICC_OK) {
            k = share_next(k);
            faulty f = {.fail_at = cancels ? 0 : k, .cancel_at = cancels ? k : 0};
            const icc_env outer = faulty_env(&f);
            iccp_env env;
            ck_assert_int_eq(iccp_env_read(&env, &outer, NULL), ICC_OK);
            status = make_factor(a, order, sign, &env);
            ck_assert_uint_eq(f.n_live, 0);
            ck_assert(status == ICC_OK || status == (cancels ? ICC_ERR_CANCELLED : ICC_ERR_MEMORY));
        }
        ck_assert_uint_gt(k, 1);
    }
    free(sign);
    free(order);
    free(a);
}
END_TEST

/* A star whose middle is eliminated first, so that the factor is dense: 40 GB. That is no memory for
 * 32 bits, in which the number of bytes, or of values, would be a small one. */
START_TEST(factors_beyond_the_address_space_are_refused)
{
    enum { N = 70000 };
    static size_t first[N + 1];
    static uint32_t column[2 * N], order[N];
    const iccp_env env = default_env();
    iccp_ldlt l;
    for (uint32_t i = 0; i < N; ++i) {
        order[i] = i;
        first[i + 1] = N - 1 + i;
        if (i > 0)
            column[N - 2 + i] = 0;
        if (i + 1 < N)
            column[i] = i + 1;
    }
    const iccp_symmetric star = {N, first, column, NULL, NULL};
    const icc_status status = iccp_ldlt_analyse_ordered(&l, &star, order, &env);
    ck_assert_int_eq(status, SIZE_MAX > UINT32_MAX ? ICC_OK : ICC_ERR_MEMORY);
    if (status != ICC_OK)
        return;
    ck_assert_double_ge(iccp_ldlt_bytes(&l), 8.0 * N * N);
    iccp_ldlt_free(&l);
}
END_TEST

/* Any allocation may fail in any task. */
START_TEST(failures_in_subtrees_leave_nothing_behind)
{
    lattice g = make_lattice(70, 70, 1, everywhere);
    uint32_t *order = dissection_of(70);
    for (int32_t threads = 1; threads <= 3; ++threads)
        for (int cancels = 0; cancels < 2; ++cancels) {
            icc_status status = -1;
            size_t k = 0;
            while (status != ICC_OK) {
                ++k;
                faulty f = {.fail_at = cancels ? 0 : k, .cancel_at = cancels ? k : 0};
                icc_env outer = faulty_env(&f);
                outer.threads = threads;
                iccp_env env;
                iccp_ldlt l;
                ck_assert_int_eq(iccp_env_read(&env, &outer, NULL), ICC_OK);
                status = iccp_ldlt_analyse_ordered(&l, &g.m, order, &env);
                if (status == ICC_OK)
                    status = iccp_ldlt_factorise(&l, &g.m, &env);
                iccp_ldlt_free(&l);
                ck_assert_uint_eq(f.n_live, 0);
                ck_assert(status == ICC_OK ||
                          status == (cancels ? ICC_ERR_CANCELLED : ICC_ERR_MEMORY));
            }
            ck_assert_uint_gt(k, cancels ? 3 : threads > 1 ? 30 : 10);
        }
    free(order);
    lattice_clear(&g);
}
END_TEST

START_TEST(nothing_is_factorised)
{
    const size_t first[1] = {0};
    const iccp_symmetric none = {0, first, NULL, NULL, NULL};
    const iccp_env env = default_env();
    iccp_ldlt l;
    double x = 0;
    ck_assert_int_eq(iccp_ldlt_analyse_ordered(&l, &none, &(uint32_t){0}, &env), ICC_OK);
    ck_assert_int_eq(iccp_ldlt_factorise(&l, &none, &env), ICC_OK);
    iccp_ldlt_solve(&l, 1, &x, &x);
    ck_assert(l.n_entries == 0 && !(l.work > 0));
    iccp_ldlt_free(&l);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("sparse factorisation");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, products_have_the_same_bits_everywhere);
    tcase_add_test(tests, quotients_have_the_same_bits_everywhere);
    tcase_add_test(tests, differences_have_the_same_bits_everywhere);
    tcase_add_test(tests, rows_spread_with_the_same_bits_everywhere);
    tcase_add_test(tests, analysis_predicts_the_factor);
    tcase_add_test(tests, factors_are_those_of_dense_elimination);
    tcase_add_test(tests, factorising_again_changes_nothing);
    tcase_add_test(tests, wrong_signs_are_refused);
    tcase_add_loop_test(tests, mazes_are_solved_in_every_component, 0,
                        sizeof MAZES / sizeof *MAZES);
    tcase_add_test(tests, rings_are_solved_in_order_of_distance);
    tcase_add_test(tests, stored_zeros_carry_nothing);
    tcase_add_test(tests, marked_rows_are_solved_alone);
    tcase_add_test(tests, forms_are_those_of_solutions);
    tcase_add_test(tests, long_factorisations_report_often);
    tcase_add_test(tests, threads_change_nothing);
    tcase_add_test(tests, groups_are_analysed_as_their_rows);
    tcase_add_test(tests, subtrees_are_independent);
    tcase_add_test(tests, subtrees_change_nothing);
    tcase_add_test(tests, failures_leave_nothing_behind);
    tcase_add_test(tests, factors_beyond_the_address_space_are_refused);
    tcase_add_test(tests, failures_in_subtrees_leave_nothing_behind);
    tcase_add_test(tests, nothing_is_factorised);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}

/* The Hessian of a rigid part's program. Each product with E or E' needs a solve with those parts
 * of the factor that its nodes depend on. For a small part of a large shape, that is far more than
 * the part: the way to the root of the elimination tree. So the matrix is computed once, m columns
 * at a time, if it is not too large. */
#include "kernel/pose/rigid_hessian.h"

#include "base/minmax.h"

#include <string.h>

/* A matrix is computed if it takes at most this many products; a program takes 60 to 150. It also
 * must not have more than this many entries per entry of the kernel's. On the star, with parts of
 * 115 to 4,600 among 2,000 and 9,800 nodes, that is 1.0 to 3 times as fast. */
enum { MOST_PRODUCTS = 80, MOST_ENTRIES = 16 };

static size_t n_strips(const iccp_hessian *h)
{
    return (h->map.n_free + 3) / 4;
}

static void by_map(const iccp_hessian *h, const double *weights, double *product)
{
    iccp_slopes_apply(&h->map, weights, h->forces);
    iccp_hessian_gather(h, h->forces, product);
}

void iccp_hessian_gather(const iccp_hessian *hessian, double *derivatives, double *weights)
{
    const iccp_hessian *h = hessian;
    const size_t m = h->map.m, dim = iccp_collocation_dim(h->map.collocation);
    for (size_t row = 0; row < h->map.n_rows; ++row)
        for (size_t j = 0; j < m; ++j)
            derivatives[m * row + j] *= h->count[row / dim];
    iccp_slopes_transpose(&h->map, derivatives, weights);
}

/* Computes the matrix by columns. These are products with unit vectors, one for each handle, so m
 * at a time. */
static icc_status fill(iccp_hessian *h, const iccp_env *env)
{
    const size_t n = h->map.n_free, m = h->map.m;
    double *unit = iccp_alloc_zero(&h->memory, n, m * sizeof *unit);
    double *column = iccp_alloc(&h->memory, n, m * sizeof *column);
    icc_status status = unit == NULL || column == NULL ? ICC_ERR_MEMORY : ICC_OK;
    for (size_t begin = 0; status == ICC_OK && begin < n; begin += m) {
        const size_t width = n - begin < m ? n - begin : m;
        for (size_t j = 0; j < width; ++j)
            unit[m * (begin + j) + j] = 1;
        by_map(h, unit, column);
        for (size_t i = 0; i < n; ++i)
            for (size_t j = 0; j < width; ++j)
                h->strips[4 * (n * (i / 4) + begin + j) + i % 4] = column[m * i + j];
        memset(unit + m * begin, 0, width * m * sizeof *unit);
        status = iccp_progress(env, "weights", 0);
    }
    iccp_free(&h->memory, unit);
    iccp_free(&h->memory, column);
    return status;
}

/* FIXED over sigma squared is the weight of values at nodes that are not free, some thirty times
 * that of derivatives. SHIFT, as a share of the greatest entry, keeps X definite in spite of
 * rounding. */
static const double FIXED = 100, SHIFT = 1e-14;

/* Except for the affine function, E is D K^-1 at the free nodes, and other nodes keep their
 * weights. So the inverse of the Hessian is nearly K_f X^-1 K_f'. K_f has the rows of K for the
 * free nodes, and K_o those for other nodes nearby. The sparse matrix X is D'CD + FIXED / sigma^2
 * K_o'K_o. The condition number of the preconditioned Hessian is 1.4 to 1.9 on the star. There is
 * no inverse if X is not definite in spite of all (one in test_weights_edit.c). */
static icc_status invert(iccp_hessian *h, const iccp_env *env)
{
    const iccp_slopes *map = &h->map;
    const size_t n = map->kernel.n_columns, n_rows = map->kernel.n_rows;
    const double sigma = iccp_collocation_radial(map->collocation)->sigma;
    iccp_gram gram = {.memory = env->memory};
    double *count = iccp_alloc_zero(&env->memory, n_rows, sizeof *count), most = 0;
    icc_status status = count != NULL ? iccp_gram_create(&gram, &map->kernel, env) : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        for (size_t row = 0; row < n_rows; ++row)
            count[row] = row < map->n_rows ? h->count[row / iccp_collocation_dim(map->collocation)]
                         : row < map->n_rows + map->n_free ? 0
                                                           : FIXED / (sigma * sigma);
        iccp_gram_fill(&gram, &map->kernel, count);
        for (size_t i = 0; i < n; ++i)
            most = iccp_max(most, gram.diagonal[i]);
        for (size_t i = 0; i < n; ++i)
            gram.diagonal[i] += SHIFT * most;
        status = iccp_ldlt_analyse(&h->inverse, &gram.matrix, 1, env);
    }
    if (status == ICC_OK) {
        status = iccp_ldlt_factorise(&h->inverse, &gram.matrix, env);
        h->needed = iccp_alloc_zero(&h->memory, h->inverse.nodes.n, sizeof *h->needed);
        if (h->needed == NULL)
            status = ICC_ERR_MEMORY;
        else
            iccp_ldlt_mark(&h->inverse, map->kernel.first[n_rows], map->kernel.column, h->needed);
    }
    if (status == ICC_ERR_SOLVER) {
        iccp_ldlt_free(&h->inverse);
        status = ICC_OK;
    }
    iccp_gram_free(&gram);
    iccp_free(&env->memory, count);
    return status;
}

void iccp_hessian_divide(const iccp_hessian *hessian, const double *side, double *weights)
{
    const iccp_slopes *s = &hessian->map;
    if (hessian->inverse.value == NULL) {
        memcpy(weights, side, s->n_free * s->m * sizeof *side);
        return;
    }
    iccp_slopes_multiply(s, s->n_rows, s->n_free, side, NULL);
    iccp_ldlt_solve_marked(&hessian->inverse, hessian->needed, s->m, s->all, s->work);
    iccp_slopes_multiply(s, s->n_rows, s->n_free, NULL, weights);
}

static bool pays(const iccp_hessian *h)
{
    const double n = (double)h->map.n_free;
    return n <= MOST_PRODUCTS * (double)h->map.m &&
           n * n <= MOST_ENTRIES * (double)iccp_collocation_entries(h->map.collocation);
}

icc_status iccp_hessian_create(iccp_hessian *hessian, const iccp_nodes *nodes,
                               const iccp_collocation *collocation, size_t n_places,
                               const uint32_t *places, const double *count, size_t n_free,
                               const uint32_t *free, const iccp_env *env)
{
    iccp_hessian *h = hessian;
    *h = (iccp_hessian){.memory = env->memory, .count = count, .inverse = {.memory = env->memory}};
    icc_status status =
        iccp_slopes_create(&h->map, nodes, collocation, n_places, places, n_free, free, env);
    if (status != ICC_OK)
        return status;
    h->forces = iccp_alloc(&h->memory, h->map.n_rows, nodes->n_handles * sizeof *h->forces);
    if (h->forces == NULL)
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK && pays(h)) {
        h->strips = iccp_alloc_zero(&h->memory, n_strips(h), 4 * n_free * sizeof *h->strips);
        h->columns = iccp_alloc(&h->memory, n_free, ICCP_TILE * sizeof *h->columns);
        h->kernels = iccp_dense_choose();
        status = h->strips == NULL || h->columns == NULL ? ICC_ERR_MEMORY : fill(h, env);
    }
    if (status == ICC_OK)
        status = invert(h, env);
    if (status != ICC_OK)
        iccp_hessian_free(h);
    return status;
}

void iccp_hessian_free(iccp_hessian *hessian)
{
    iccp_slopes_free(&hessian->map);
    iccp_free(&hessian->memory, hessian->forces);
    iccp_free(&hessian->memory, hessian->strips);
    iccp_free(&hessian->memory, hessian->columns);
    iccp_free(&hessian->memory, hessian->needed);
    iccp_ldlt_free(&hessian->inverse);
    *hessian = (iccp_hessian){.memory = hessian->memory};
}

/* See math/dense.h. */
static size_t columns_at_once(size_t left)
{
    return left >= ICCP_TILE ? ICCP_TILE : left >= 4 ? 4 : left >= 2 ? 2 : 1;
}

/* Multiplies some columns, `width` numbers in every m. */
static void multiply(const iccp_hessian *h, size_t width, const double *x, double *product)
{
    const size_t n = h->map.n_free, m = h->map.m;
    double tile[ICCP_STRIPS * 4 * ICCP_TILE];
    for (size_t k = 0; k < n; ++k)
        memcpy(h->columns + width * k, x + m * k, width * sizeof *x);
    for (size_t t = 0; t < n_strips(h); t += ICCP_STRIPS) {
        h->kernels.multiply(tile, iccp_strips_at_once(n_strips(h) - t), width,
                            h->strips + 4 * n * t, 4 * n, h->columns, n);
        for (size_t i = 4 * t; i < n && i < 4 * (t + ICCP_STRIPS); ++i)
            for (size_t c = 0; c < width; ++c)
                product[m * i + c] = tile[4 * ICCP_TILE * (i / 4 - t) + 4 * c + i % 4];
    }
}

void iccp_hessian_apply(const iccp_hessian *hessian, const double *weights, double *product)
{
    const size_t m = hessian->map.m;
    if (hessian->strips == NULL) {
        by_map(hessian, weights, product);
        return;
    }
    for (size_t begin = 0, width; begin < m; begin += width) {
        width = columns_at_once(m - begin);
        multiply(hessian, width, weights + begin, product + begin);
    }
}

/* Derivatives of the interpolant at places, as a linear map. D has the derivatives of the kernels
 * at the places, and R those of the affine function. K, P, Z and S = P'Z are as in interpolant.c.
 * Then weights w have the derivatives
 *      D (K^-1 w - Z t) + R t,  t = S^-1 Z'w.
 *
 * This is D K^-1 w + B Z'w with B = (R - D Z) S^-1. Only those entries of K^-1 w are needed that D
 * reaches, and w is 0 except at the free nodes. Both lie near the part, and so do the parts of the
 * factor that are read. */
#include "kernel/pose/rigid_slopes.h"

#include "base/compiler.h"
#include "base/simd.h"
#include "math/vec.h"

#include <stdbool.h>
#include <string.h>

/* Lists the nodes that the places reach, the free nodes first, and sets near[i] for them. Returns
 * their number. */
static size_t find_near(const iccp_slopes *s, size_t n_places, const uint32_t *places, bool *near)
{
    const iccp_symmetric *matrix = iccp_collocation_matrix(s->collocation);
    size_t n = 0;
    for (size_t i = 0; i < s->n_free; ++i) {
        near[s->free[i]] = true;
        s->marked[n++] = s->free[i];
    }
    for (size_t k = 0; k < n_places; ++k)
        for (size_t p = matrix->first[places[k]]; p < matrix->first[places[k] + 1]; ++p) {
            const uint32_t j = matrix->column[p];
            if (!near[j])
                s->marked[n++] = j;
            near[j] = true;
        }
    return n;
}

/* A kernel's slope at its own node is 0 and has no entry. */
static void fill_kernel(iccp_slopes *s, const iccp_nodes *nodes, const uint32_t *places,
                        const bool *near)
{
    const iccp_symmetric *matrix = iccp_collocation_matrix(s->collocation);
    const iccp_radial *radial = iccp_collocation_radial(s->collocation);
    const size_t dim = nodes->dim;
    iccp_sparse *out = &s->kernel;
    size_t n = 0;
    for (size_t row = 0; row < out->n_rows; ++row) {
        const bool value = row >= s->n_rows;
        const size_t i = value ? s->marked[row - s->n_rows] : places[row / dim], axis = row % dim;
        const double *x = nodes->points + dim * i;
        out->first[row] = n;
        for (size_t p = matrix->first[i]; p < matrix->first[i + 1]; ++p) {
            const double *y = nodes->points + dim * matrix->column[p];
            const double distance2 = iccp_vec_distance2(dim, x, y);
            out->column[n] = matrix->column[p];
            out->value[n] = value ? matrix->value[p]
                                  : 2 * iccp_radial_slope(radial, distance2) * (x[axis] - y[axis]);
            n += !value || near[matrix->column[p]];
        }
        if (value) {
            out->column[n] = (uint32_t)i;
            out->value[n++] = matrix->diagonal[i];
        }
    }
    out->first[out->n_rows] = n;
}

/* Computes B by rows. S is symmetric. */
static void fill_affine(iccp_slopes *s, size_t dim)
{
    const size_t q = dim + 1;
    const double *z = iccp_collocation_affine(s->collocation);
    for (size_t row = 0; row < s->n_rows; ++row) {
        double *b = s->affine + q * row;
        for (size_t k = 0; k < q; ++k)
            b[k] = k == 1 + row % dim;
        for (size_t p = s->kernel.first[row]; p < s->kernel.first[row + 1]; ++p)
            for (size_t k = 0; k < q; ++k)
                b[k] -= s->kernel.value[p] * z[q * s->kernel.column[p] + k];
        iccp_collocation_solve_affine(s->collocation, b);
    }
}

/* Fills in everything except earlier allocations. `near` is workspace for each node. */
static icc_status fill(iccp_slopes *s, const iccp_nodes *nodes, size_t n_places,
                       const uint32_t *places, bool *near, const iccp_env *env)
{
    const iccp_symmetric *matrix = iccp_collocation_matrix(s->collocation);
    const size_t n_near = find_near(s, n_places, places, near);
    size_t n = 1;
    for (size_t k = 0; k < n_places; ++k)
        n += nodes->dim * (matrix->first[places[k] + 1] - matrix->first[places[k]]);
    for (size_t k = 0; k < n_near; ++k)
        n += matrix->first[s->marked[k] + 1] - matrix->first[s->marked[k]] + 1;
    const icc_status status = iccp_sparse_create(&s->kernel, s->n_rows + n_near, nodes->n, n, env);
    if (status != ICC_OK)
        return status;
    fill_kernel(s, nodes, places, near);
    if (s->affine != NULL)
        fill_affine(s, nodes->dim);
    iccp_collocation_mark(s->collocation, s->n_free, s->free, s->needed);
    iccp_collocation_mark(s->collocation, n_near, s->marked, s->needed);
    s->n_marked = iccp_collocation_marked(s->collocation, s->needed, s->marked);
    return ICC_OK;
}

icc_status iccp_slopes_create(iccp_slopes *slopes, const iccp_nodes *nodes,
                              const iccp_collocation *collocation, size_t n_places,
                              const uint32_t *places, size_t n_free, const uint32_t *free,
                              const iccp_env *env)
{
    iccp_slopes *s = slopes;
    const iccp_memory *memory = &env->memory;
    const size_t dim = nodes->dim, m = nodes->n_handles;
    *s = (iccp_slopes){.memory = *memory,
                       .collocation = collocation,
                       .m = m,
                       .n_free = n_free,
                       .free = free,
                       .n_rows = dim * n_places,
                       .kernel = {.memory = *memory}};
    const bool affine = iccp_collocation_affine(collocation) != NULL;
    bool *near = iccp_alloc_zero(memory, nodes->n, sizeof *near);
    s->affine = affine ? iccp_alloc(memory, dim * n_places, (dim + 1) * sizeof *s->affine) : NULL;
    s->marked = iccp_alloc(memory, nodes->n, sizeof *s->marked);
    s->needed = iccp_alloc_zero(memory, iccp_collocation_marks(collocation), sizeof *s->needed);
    s->all = iccp_alloc(memory, nodes->n, m * sizeof *s->all);
    s->work = iccp_alloc(memory, nodes->n, m * sizeof *s->work);
    icc_status status = ICC_ERR_MEMORY;
    if (near != NULL && (!affine || s->affine != NULL) && s->needed != NULL && s->marked != NULL &&
        s->all != NULL && s->work != NULL)
        status = fill(s, nodes, n_places, places, near, env);
    iccp_free(memory, near);
    if (status != ICC_OK)
        iccp_slopes_free(s);
    return status;
}

void iccp_slopes_free(iccp_slopes *slopes)
{
    iccp_sparse_free(&slopes->kernel);
    iccp_free(&slopes->memory, slopes->affine);
    iccp_free(&slopes->memory, slopes->needed);
    iccp_free(&slopes->memory, slopes->marked);
    iccp_free(&slopes->memory, slopes->all);
    iccp_free(&slopes->memory, slopes->work);
    *slopes = (iccp_slopes){.memory = slopes->memory};
}

/* out += factor * row, m numbers each */
static ICCP_INLINE void add(size_t m, double factor, const double *row, double *out)
{
    for (size_t j = 0; j < m; ++j)
        out[j] += factor * row[j];
}

/* Adds the part of the affine function, one column of Z and of B at a time. `work` is free then. */
static void add_affine(const iccp_slopes *s, size_t n_from, size_t n_to, const double *from,
                       bool transposed, double *to)
{
    const double *z = iccp_collocation_affine(s->collocation);
    const size_t m = s->m, q = iccp_collocation_dim(s->collocation) + 1;
    for (size_t k = 0; s->affine != NULL && k < q; ++k) {
        memset(s->work, 0, m * sizeof *s->work);
        for (size_t i = 0; i < n_from; ++i)
            add(m, transposed ? s->affine[q * i + k] : z[q * s->free[i] + k], from + m * i,
                s->work);
        for (size_t i = 0; i < n_to; ++i)
            add(m, transposed ? z[q * s->free[i] + k] : s->affine[q * i + k], s->work, to + m * i);
    }
}

static void clear(const iccp_slopes *s)
{
    for (size_t k = 0; k < s->n_marked; ++k)
        memset(s->all + s->m * s->marked[k], 0, s->m * sizeof *s->all);
}

/* Rows of the kernel and their factors: see iccp_slopes_multiply(). */
typedef struct product {
    const iccp_slopes *s;
    size_t begin, end;
    const double *from;
    double *to;
} product;

/* The inner loops take a constant number of handles at a time, which stay in registers. Lanes are
 * handles, and no products are fused with sums, so all versions give the same bits. */
static ICCP_INLINE void gather_some(const product *p, size_t begin, size_t width)
{
    const iccp_sparse *a = &p->s->kernel;
    for (size_t row = p->begin; row < p->end; ++row) {
        double sum[8] = {0};
        for (size_t k = a->first[row]; k < a->first[row + 1]; ++k)
            add(width, a->value[k], p->s->all + p->s->m * a->column[k] + begin, sum);
        memcpy(p->to + p->s->m * (row - p->begin) + begin, sum, width * sizeof *sum);
    }
}

static ICCP_INLINE void scatter_some(const product *p, size_t begin, size_t width)
{
    const iccp_sparse *a = &p->s->kernel;
    for (size_t row = p->begin; row < p->end; ++row) {
        double from[8];
        memcpy(from, p->from + p->s->m * (row - p->begin) + begin, width * sizeof *from);
        for (size_t k = a->first[row]; k < a->first[row + 1]; ++k)
            add(width, a->value[k], from, p->s->all + p->s->m * a->column[k] + begin);
    }
}

static ICCP_INLINE void multiply(const product *p, size_t begin, size_t width)
{
    if (p->to != NULL)
        gather_some(p, begin, width);
    else
        scatter_some(p, begin, width);
}

#ifdef ICCP_HAS_SIMD

ICCP_AVX2 static void multiply_avx2(const product *p, size_t begin, size_t width)
{
    if (width == 8)
        multiply(p, begin, 8);
    else if (width == 4)
        multiply(p, begin, 4);
    else if (width == 2)
        multiply(p, begin, 2);
    else
        multiply(p, begin, 1);
}

#else

#define multiply_avx2 multiply

#endif

void iccp_slopes_multiply(const iccp_slopes *slopes, size_t begin, size_t n_rows,
                          const double *from, double *to)
{
    const product p = {slopes, begin, begin + n_rows, from, to};
    const bool wide = iccp_simd() >= ICCP_SIMD_AVX2;
    if (to == NULL)
        clear(slopes);
    for (size_t j = 0, width; j < slopes->m; j += width) {
        const size_t left = slopes->m - j;
        width = left >= 8 ? 8 : left >= 4 ? 4 : left >= 2 ? 2 : 1;
        if (wide)
            multiply_avx2(&p, j, width);
        else
            multiply(&p, j, width);
    }
}

void iccp_slopes_apply(const iccp_slopes *slopes, const double *weights, double *derivatives)
{
    const iccp_slopes *s = slopes;
    const size_t m = s->m;
    clear(s);
    for (size_t i = 0; i < s->n_free; ++i)
        memcpy(s->all + m * s->free[i], weights + m * i, m * sizeof *weights);
    iccp_collocation_invert(s->collocation, s->needed, m, s->all, s->work);
    iccp_slopes_multiply(s, 0, s->n_rows, NULL, derivatives);
    add_affine(s, s->n_free, s->n_rows, weights, false, derivatives);
}

void iccp_slopes_transpose(const iccp_slopes *slopes, const double *derivatives, double *weights)
{
    const iccp_slopes *s = slopes;
    const size_t m = s->m;
    iccp_slopes_multiply(s, 0, s->n_rows, derivatives, NULL);
    iccp_collocation_invert(s->collocation, s->needed, m, s->all, s->work);
    for (size_t i = 0; i < s->n_free; ++i)
        memcpy(weights + m * i, s->all + m * s->free[i], m * sizeof *weights);
    add_affine(s, s->n_rows, s->n_free, derivatives, true, weights);
}

/* With D the derivatives of the kernels at the places, R those of the affine function, and K, P, Z
 * and S = P'Z as in interpolant.c, weights w have the derivatives
 *
 *     D (K^-1 w - Z t) + R t,  t = S^-1 Z'w,
 *
 * which is D K^-1 w + B Z'w with B = (R - D Z) S^-1. Of K^-1 w only what D reaches is needed, and w
 * is 0 but for the free nodes: both lie near the part, and so does what is read of the factor. */
#include "kernel/rigid_slopes.h"

#include "base/compiler.h"
#include "base/simd.h"
#include "math/vec.h"

#include <string.h>

static size_t n_rows(const iccp_slopes *s)
{
    return s->kernel.n_rows;
}

/* A kernel's own slope at its node is 0 and has no entry. */
static void fill_kernel(iccp_sparse *out, const iccp_nodes *nodes,
                        const iccp_collocation *collocation, size_t n_places,
                        const uint32_t *places)
{
    const iccp_symmetric *matrix = iccp_collocation_matrix(collocation);
    const iccp_radial *radial = iccp_collocation_radial(collocation);
    const size_t dim = nodes->dim;
    size_t n = 0;
    for (size_t row = 0; row < dim * n_places; ++row) {
        const double *x = nodes->points + dim * places[row / dim];
        const size_t i = places[row / dim], axis = row % dim;
        out->first[row] = n;
        for (size_t p = matrix->first[i]; p < matrix->first[i + 1]; ++p) {
            const double *y = nodes->points + dim * matrix->column[p];
            const double distance2 = iccp_vec_distance2(dim, x, y);
            out->column[n] = matrix->column[p];
            out->value[n++] = 2 * iccp_radial_slope(radial, distance2) * (x[axis] - y[axis]);
        }
    }
    out->first[dim * n_places] = n;
}

/* B, by rows: S is symmetric. */
static void fill_affine(iccp_slopes *s, size_t dim)
{
    const size_t q = dim + 1;
    const double *z = iccp_collocation_affine(s->collocation);
    for (size_t row = 0; row < n_rows(s); ++row) {
        double *b = s->affine + q * row;
        for (size_t k = 0; k < q; ++k)
            b[k] = k == 1 + row % dim;
        for (size_t p = s->kernel.first[row]; p < s->kernel.first[row + 1]; ++p)
            for (size_t k = 0; k < q; ++k)
                b[k] -= s->kernel.value[p] * z[q * s->kernel.column[p] + k];
        iccp_collocation_solve_affine(s->collocation, b);
    }
}

icc_status iccp_slopes_create(iccp_slopes *slopes, const iccp_nodes *nodes,
                              const iccp_collocation *collocation, size_t n_places,
                              const uint32_t *places, size_t n_free, const uint32_t *free,
                              const iccp_env *env)
{
    iccp_slopes *s = slopes;
    const iccp_memory *memory = &env->memory;
    const iccp_symmetric *matrix = iccp_collocation_matrix(collocation);
    const size_t dim = nodes->dim, m = nodes->n_handles;
    size_t n = 0;
    *s = (iccp_slopes){.memory = *memory,
                       .collocation = collocation,
                       .m = m,
                       .n_free = n_free,
                       .free = free,
                       .kernel = {.memory = *memory}};
    for (size_t k = 0; k < n_places; ++k)
        n += dim * (matrix->first[places[k] + 1] - matrix->first[places[k]]);
    icc_status status = iccp_sparse_create(&s->kernel, dim * n_places, nodes->n, n, env);
    if (status != ICC_OK)
        return status;
    const bool affine = iccp_collocation_affine(collocation) != NULL;
    s->affine = affine ? iccp_alloc(memory, dim * n_places, (dim + 1) * sizeof *s->affine) : NULL;
    s->marked = iccp_alloc(memory, nodes->n, sizeof *s->marked);
    s->needed = iccp_alloc_zero(memory, iccp_collocation_marks(collocation), sizeof *s->needed);
    s->all = iccp_alloc(memory, nodes->n, m * sizeof *s->all);
    s->work = iccp_alloc(memory, nodes->n, m * sizeof *s->work);
    if ((affine && s->affine == NULL) || s->needed == NULL || s->marked == NULL || s->all == NULL ||
        s->work == NULL) {
        iccp_slopes_free(s);
        return ICC_ERR_MEMORY;
    }
    fill_kernel(&s->kernel, nodes, collocation, n_places, places);
    if (affine)
        fill_affine(s, dim);
    iccp_collocation_mark(collocation, n_free, free, s->needed);
    iccp_collocation_mark(collocation, n, s->kernel.column, s->needed);
    s->n_marked = iccp_collocation_marked(collocation, s->needed, s->marked);
    return ICC_OK;
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

/* Of the affine function, for one column of Z and of B after the other: `work` is free then. */
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

/* The inner loops take some handles at a time, a constant number, which stay in registers. Lanes
 * are handles and nothing is contracted: the same bits for all. */
static ICCP_INLINE void gather_some(const iccp_slopes *s, size_t begin, size_t width,
                                    double *derivatives)
{
    for (size_t row = 0; row < n_rows(s); ++row) {
        double sum[8] = {0};
        for (size_t p = s->kernel.first[row]; p < s->kernel.first[row + 1]; ++p)
            add(width, s->kernel.value[p], s->all + s->m * s->kernel.column[p] + begin, sum);
        memcpy(derivatives + s->m * row + begin, sum, width * sizeof *sum);
    }
}

static ICCP_INLINE void scatter_some(const iccp_slopes *s, size_t begin, size_t width,
                                     const double *derivatives)
{
    for (size_t row = 0; row < n_rows(s); ++row) {
        double from[8];
        memcpy(from, derivatives + s->m * row + begin, width * sizeof *from);
        for (size_t p = s->kernel.first[row]; p < s->kernel.first[row + 1]; ++p)
            add(width, s->kernel.value[p], from, s->all + s->m * s->kernel.column[p] + begin);
    }
}

/* all -> to, or from -> all where `to` is NULL */
static ICCP_INLINE void multiply(const iccp_slopes *s, size_t begin, size_t width,
                                 const double *from, double *to)
{
    if (to != NULL)
        gather_some(s, begin, width, to);
    else
        scatter_some(s, begin, width, from);
}

#ifdef ICCP_HAS_SIMD

ICCP_AVX2 static void multiply_avx2(const iccp_slopes *s, size_t begin, size_t width,
                                    const double *from, double *to)
{
    if (width == 8)
        multiply(s, begin, 8, from, to);
    else if (width == 4)
        multiply(s, begin, 4, from, to);
    else if (width == 2)
        multiply(s, begin, 2, from, to);
    else
        multiply(s, begin, 1, from, to);
}

#else

#define multiply_avx2 multiply

#endif

/* all -> to, or from -> all where `to` is NULL */
static void multiply_kernel(const iccp_slopes *s, const double *from, double *to)
{
    const bool wide = iccp_simd() >= ICCP_SIMD_AVX2;
    for (size_t begin = 0, width; begin < s->m; begin += width) {
        const size_t left = s->m - begin;
        width = left >= 8 ? 8 : left >= 4 ? 4 : left >= 2 ? 2 : 1;
        if (wide)
            multiply_avx2(s, begin, width, from, to);
        else
            multiply(s, begin, width, from, to);
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
    multiply_kernel(s, NULL, derivatives);
    add_affine(s, s->n_free, n_rows(s), weights, false, derivatives);
}

void iccp_slopes_transpose(const iccp_slopes *slopes, const double *derivatives, double *weights)
{
    const iccp_slopes *s = slopes;
    const size_t m = s->m;
    clear(s);
    multiply_kernel(s, derivatives, NULL);
    iccp_collocation_invert(s->collocation, s->needed, m, s->all, s->work);
    for (size_t i = 0; i < s->n_free; ++i)
        memcpy(weights + m * i, s->all + m * s->free[i], m * sizeof *weights);
    add_affine(s, n_rows(s), s->n_free, derivatives, true, weights);
}

/* Functions on the vertices of a tree, and what is to be true of them, found from the public
 * interface alone: equations, energies, inequalities, residuals. */
#ifndef TESTS_FUNCTIONS_H
#define TESTS_FUNCTIONS_H

#include "hard_masks.h"

#include "icc/stages.h"

#include <string.h>

/* A tree on a mask, with what one needs to know at hand. */
typedef struct ground {
    icc_grid *grid;
    icc_tree *tree;
    icc_grid_info info;
    size_t stride[ICC_MAX_DIM];
    const uint32_t *parent;
    const int32_t *generation;
    uint32_t root;
    size_t n;           /* vertices inside that the tree reaches */
    uint32_t *order;    /* those, parents before children */
    uint8_t *has_child; /* per vertex of the grid: whether a vertex inside has it as its parent */
} ground;

static inline bool ground_holds(const ground *g, uint32_t v)
{
    return icc_grid_inside(g->grid)[v] && g->generation[v] >= 0;
}

/* Neighbour d of 2 dim; UINT32_MAX beyond the grid. */
static inline uint32_t ground_neighbour(const ground *g, uint32_t v, int32_t d)
{
    const size_t stride = g->stride[d / 2], shape = g->info.shape[d / 2];
    const size_t at = v / stride % shape;
    if (at == (d % 2 ? shape - 1 : 0))
        return UINT32_MAX;
    return (uint32_t)(d % 2 ? v + stride : v - stride);
}

static inline double ground_get(const ground *g, const double *f, uint32_t v)
{
    return v != UINT32_MAX && ground_holds(g, v) ? f[v] : 0;
}

/* From the root through its children and theirs. */
static inline void ground_sort(ground *g)
{
    g->n = 0;
    g->order[g->n++] = g->root;
    for (size_t i = 0; i < g->n; ++i)
        for (int32_t d = 0; d < 2 * g->info.dim; ++d) {
            const uint32_t p = g->order[i], v = ground_neighbour(g, p, d);
            if (v != UINT32_MAX && ground_holds(g, v) && g->parent[v] == p) {
                g->order[g->n++] = v;
                g->has_child[p] = 1;
            }
        }
}

static inline void ground_free(ground *g)
{
    icc_tree_free(g->tree);
    icc_grid_free(g->grid);
    free(g->order);
    free(g->has_child);
}

/* Grows a tree from `root`; UINT32_MAX: from the grassfire's maximum. On failure there is nothing
 * to free. */
static inline icc_status ground_create(ground *g, const mask *m, uint32_t root, int32_t form)
{
    const icc_tree_options options = {.size = sizeof options, .form = form};
    *g = (ground){.info = {.size = sizeof g->info}, .root = root};
    icc_status status = icc_grid_create_mask(&g->grid, m->dim, m->shape, m->inside, NULL, NULL);
    if (status == ICC_OK && root == UINT32_MAX)
        status = icc_grid_find_maximum(g->grid, &g->root, NULL, NULL, NULL);
    if (status == ICC_OK)
        status = icc_tree_create(&g->tree, g->grid, g->root, &options, NULL, NULL);
    if (status == ICC_OK)
        status = icc_grid_get_info(g->grid, &g->info);
    g->order = malloc(m->n_vertices * sizeof *g->order);
    g->has_child = calloc(m->n_vertices, 1);
    if (status == ICC_OK && (g->order == NULL || g->has_child == NULL))
        status = ICC_ERR_MEMORY;
    if (status != ICC_OK) {
        ground_free(g);
        return status;
    }
    g->stride[0] = 1;
    for (int32_t k = 1; k < m->dim; ++k)
        g->stride[k] = g->stride[k - 1] * m->shape[k - 1];
    g->parent = icc_tree_parents(g->tree);
    g->generation = icc_tree_generations(g->tree);
    ground_sort(g);
    return ICC_OK;
}

/* The Laplacian of f at any vertex: 2 dim f less the neighbours; 0 outside. */
static inline double ground_laplacian(const ground *g, const double *f, uint32_t v)
{
    double sum = 2 * g->info.dim * ground_get(g, f, v);
    for (int32_t d = 0; d < 2 * g->info.dim; ++d)
        sum -= ground_get(g, f, ground_neighbour(g, v, d));
    return sum;
}

/* Where a function's energy takes the square of the Laplacian. Clamped: also next to the inside; a
 * mask must not reach the grid's border then. */
static inline bool ground_counts(const ground *g, int32_t function, uint32_t v)
{
    if (v == UINT32_MAX || ground_holds(g, v) || function != ICC_FUNCTION_CLAMPED)
        return v != UINT32_MAX && ground_holds(g, v);
    for (int32_t d = 0; d < 2 * g->info.dim; ++d) {
        const uint32_t u = ground_neighbour(g, v, d);
        if (u != UINT32_MAX && ground_holds(g, u))
            return true;
    }
    return false;
}

/* Laplace: half the sum of f L f; otherwise half the sum of (L f)^2. */
static inline double ground_energy(const ground *g, int32_t function, const double *f)
{
    double sum = 0;
    for (uint32_t v = 0; v < g->info.n_vertices; ++v)
        if (ground_counts(g, function, v)) {
            const double l = ground_laplacian(g, f, v);
            sum += l * (function == ICC_FUNCTION_LAPLACE ? ground_get(g, f, v) : l);
        }
    return sum / 2;
}

/* The energy's derivative by the value at v. */
static inline double ground_gradient(const ground *g, int32_t function, const double *f, uint32_t v)
{
    const double l = ground_laplacian(g, f, v);
    if (function == ICC_FUNCTION_LAPLACE)
        return l;
    double sum = 2 * g->info.dim * l;
    for (int32_t d = 0; d < 2 * g->info.dim; ++d) {
        const uint32_t u = ground_neighbour(g, v, d);
        if (ground_counts(g, function, u))
            sum -= ground_laplacian(g, f, u);
    }
    return sum;
}

/* How far a positive function is from being the mean of its neighbours, relative to itself: the
 * largest over all vertices but the root. From logarithms, so that nothing underflows. */
static inline double ground_imbalance(const ground *g, const double *logs)
{
    double worst = 0;
    for (size_t i = 1; i < g->n; ++i) {
        const uint32_t v = g->order[i];
        double mean = 0;
        for (int32_t d = 0; d < 2 * g->info.dim; ++d) {
            const uint32_t u = ground_neighbour(g, v, d);
            if (u != UINT32_MAX && ground_holds(g, u))
                mean += exp(logs[u] - logs[v]) / (2 * g->info.dim);
        }
        worst = fmax(worst, fabs(mean - 1));
    }
    return worst;
}

/* Tree edges inside on which (1 + eta) f(child), rounded, exceeds f(parent). */
static inline size_t ground_violated(const ground *g, double eta, const double *f)
{
    size_t n_violated = 0;
    for (size_t i = 1; i < g->n; ++i)
        n_violated += (1 + eta) * f[g->order[i]] > f[g->parent[g->order[i]]];
    return n_violated;
}

/* The Karush-Kuhn-Tucker residual of a function under f_parent >= (1 + eta) f_child: multipliers by
 * one sweep from the leaves to the root, so that the gradient of the Lagrange function is 0, then
 * the largest |min(slack, multiplier)|. `sum`: room for a number per vertex of the grid. */
static inline double ground_residual(const ground *g, int32_t function, double eta, const double *f,
                                     double *sum)
{
    double worst = 0;
    memset(sum, 0, g->info.n_vertices * sizeof *sum);
    for (size_t i = g->n; i-- > 1;) {
        const uint32_t v = g->order[i], p = g->parent[v];
        const double multiplier = (sum[v] - ground_gradient(g, function, f, v)) / (1 + eta);
        sum[p] += multiplier;
        worst = fmax(worst, fabs(fmin(f[p] - (1 + eta) * f[v], multiplier)));
    }
    return worst;
}

#endif

/* The quadratic program on a coarser grid. */
#include "gradient/solver/coarse_qp.h"

#include "base/minmax.h"

#include <string.h>

/* A coarse tree that reaches less than this share of the expected vertices is useless. A comb with
 * teeth of one vertex has such trees (test_bilaplace.c). */
static const double LEAST_SHARE = 0.5;

/* A multiplier is the sum of forces along a path. In grid units, doubling the spacing makes forces
 * 16 times and paths twice as large. */
static const double MULTIPLIER_RATIO = 0.125;

/* Coarse coordinates are the fine ones, minus 0 or 1, halved. */
static uint32_t shift(const icc_tree *fine, int32_t axis)
{
    return iccp_grid_coordinate(fine->grid, fine->root, axis) % 2;
}

static icc_status create_grid(icc_grid **out, const icc_tree *fine, const iccp_env *env)
{
    const icc_grid *grid = fine->grid;
    size_t shape[ICC_MAX_DIM];
    icc_error err = {.size = sizeof err};
    for (int32_t a = 0; a < grid->dim; ++a)
        shape[a] = (grid->shape[a] - shift(fine, a) + 1) / 2;
    const icc_status status = iccp_grid_new(out, grid->dim, shape, env, &err);
    if (status != ICC_OK)
        return status;
    icc_grid *coarse = *out;
    for (uint32_t v = 0; v < coarse->n_vertices; ++v) {
        size_t u = 0;
        for (int32_t a = 0; a < grid->dim; ++a)
            u += (2 * iccp_grid_coordinate(coarse, v, a) + shift(fine, a)) * grid->stride[a];
        coarse->inside[v] = grid->inside[u];
        coarse->n_inside += grid->inside[u];
    }
    return ICC_OK;
}

static icc_status create_tree(icc_tree **out, const icc_tree *fine, const iccp_env *env)
{
    icc_grid *grid;
    icc_error err = {.size = sizeof err};
    icc_status status = create_grid(&grid, fine, env);
    if (status != ICC_OK)
        return status;
    size_t root = 0;
    for (int32_t a = 0; a < grid->dim; ++a)
        root += iccp_grid_coordinate(fine->grid, fine->root, a) / 2 * grid->stride[a];
    status = iccp_tree_create(out, grid, (uint32_t)root, fine->form, fine->axis_order, env, &err);
    iccp_grid_release(grid);
    return status;
}

static icc_status number_vertices(iccp_coarse_qp *c, const iccp_env *env)
{
    const size_t n_vertices = c->tree->grid->n_vertices;
    c->unknown_of = iccp_alloc(&env->memory, n_vertices, sizeof *c->unknown_of);
    if (c->unknown_of == NULL)
        return ICC_ERR_MEMORY;
    memset(c->unknown_of, 0xff, n_vertices * sizeof *c->unknown_of); /* ICCP_NONE */
    for (uint32_t k = 0; k < c->unknowns.n; ++k)
        c->unknown_of[c->unknowns.vertex[k]] = k;
    return ICC_OK;
}

icc_status iccp_coarse_qp_create(iccp_coarse_qp *coarse, bool *useful, const iccp_qp *fine,
                                 int32_t function, const iccp_env *env)
{
    iccp_coarse_qp *c = coarse;
    const icc_tree *tree = fine->unknowns->tree;
    *c = (iccp_coarse_qp){.memory = env->memory, .fine = fine};
    c->unknowns.memory = c->qp.a.memory = env->memory;
    icc_status status = create_tree(&c->tree, tree, env);
    double expected = (double)fine->unknowns->n;
    for (int32_t a = 0; a < tree->grid->dim; ++a)
        expected /= 2;
    *useful = status == ICC_OK && (double)c->tree->n_inside >= LEAST_SHARE * expected &&
              c->tree->n_inside > 1;
    if (*useful)
        status = iccp_unknowns_create(&c->unknowns, c->tree, env);
    if (*useful && status == ICC_OK)
        status = iccp_qp_create(&c->qp, &c->unknowns, function, fine->sigma * fine->sigma - 1,
                                fine->leaf, env);
    if (*useful && status == ICC_OK)
        status = number_vertices(c, env);
    if (!*useful || status != ICC_OK)
        iccp_coarse_qp_free(c);
    return status;
}

void iccp_coarse_qp_free(iccp_coarse_qp *coarse)
{
    iccp_free(&coarse->memory, coarse->unknown_of);
    iccp_qp_free(&coarse->qp);
    iccp_unknowns_free(&coarse->unknowns);
    iccp_tree_release(coarse->tree);
    coarse->unknown_of = NULL;
    coarse->tree = NULL;
}

/* Finds the coarse unknowns at the corners of the smallest coarse cell, edge or vertex that
 * contains a fine vertex, or ICCP_NONE. Returns the number of corners. */
static size_t find_corners(const iccp_coarse_qp *c, uint32_t vertex,
                           uint32_t corner[1 << ICC_MAX_DIM])
{
    const icc_tree *fine = c->fine->unknowns->tree;
    const icc_grid *grid = c->tree->grid;
    size_t n = 1;
    corner[0] = 0;
    for (int32_t a = 0; a < grid->dim; ++a) {
        const uint32_t x = iccp_grid_coordinate(fine->grid, vertex, a), s = shift(fine, a);
        const bool between = x % 2 != s;
        const size_t n_sides = between ? 2 : 1;
        for (size_t side = n_sides; side-- > 0;) {
            /* There is nothing below a shift of 1, or beyond the last coarse plane. */
            const int64_t at = ((int64_t)x - s - between) / 2 + (int64_t)side;
            const bool exists = x + side >= s + (size_t)between && at < (int64_t)grid->shape[a];
            for (size_t k = 0; k < n; ++k)
                corner[side * n + k] = exists && corner[k] != ICCP_NONE
                                           ? corner[k] + (uint32_t)at * (uint32_t)grid->stride[a]
                                           : ICCP_NONE;
        }
        n *= n_sides;
    }
    for (size_t k = 0; k < n; ++k)
        corner[k] = corner[k] != ICCP_NONE ? c->unknown_of[corner[k]] : ICCP_NONE;
    return n;
}

/* Returns the number of the neighbour that is the parent of unknown k > 0. */
static int32_t direction(const iccp_unknowns *unknowns, uint32_t k)
{
    const uint32_t *neighbour = unknowns->neighbour + k * (size_t)unknowns->n_neighbours;
    int32_t d = 0;
    while (d + 1 < unknowns->n_neighbours && neighbour[d] != unknowns->parent[k])
        ++d;
    return d;
}

/* `bound` has the multiplier of each coarse unknown's bound, if any. */
static void prolong_unknown(const iccp_coarse_qp *c, uint32_t k, const double *coarse_f,
                            const double *coarse_multiplier, const double *bound, double *f,
                            double *multiplier, double *bound_multiplier)
{
    uint32_t corner[1 << ICC_MAX_DIM];
    const size_t n = find_corners(c, c->fine->unknowns->vertex[k], corner);
    const int32_t d = k > 0 ? direction(c->fine->unknowns, k) : -1;
    double sum = 0, sum_of_multipliers = 0, largest_bound = 0;
    size_t n_alike = 0;
    for (size_t i = 0; i < n; ++i) {
        const uint32_t z = corner[i];
        if (z == ICCP_NONE)
            continue;
        sum += coarse_f[z];
        largest_bound = iccp_max(largest_bound, bound[z]);
        if (z > 0 && direction(&c->unknowns, z) == d) {
            sum_of_multipliers += coarse_multiplier[z - 1];
            ++n_alike;
        }
    }
    *f = iccp_max(c->fine->leaf, sum / (double)n);
    *multiplier = n_alike > 0 ? MULTIPLIER_RATIO * sum_of_multipliers / (double)n_alike : 0.0;
    *bound_multiplier = MULTIPLIER_RATIO * largest_bound;
}

icc_status iccp_coarse_qp_prolong(const iccp_coarse_qp *coarse, const double *coarse_f,
                                  const double *coarse_multiplier, double *f, double *multiplier,
                                  const iccp_env *env)
{
    const iccp_qp *fine = coarse->fine, *qp = &coarse->qp;
    const size_t n = fine->unknowns->n, n_coarse = coarse->unknowns.n;
    double *bound = iccp_alloc_zero(&env->memory, n_coarse, sizeof *bound);
    if (bound == NULL)
        return ICC_ERR_MEMORY;
    for (size_t j = 0; j < qp->n_leaves; ++j)
        bound[qp->leaf_unknown[j]] = coarse_multiplier[n_coarse - 1 + j];
    size_t j = 0;
    for (uint32_t k = 0; k < n; ++k) {
        double of_edge, of_bound;
        prolong_unknown(coarse, k, coarse_f, coarse_multiplier, bound, &f[k], &of_edge, &of_bound);
        if (k > 0)
            multiplier[k - 1] = of_edge;
        if (j < fine->n_leaves && fine->leaf_unknown[j] == k)
            multiplier[n - 1 + j++] = of_bound;
    }
    f[0] = 1;
    iccp_free(&env->memory, bound);
    return ICC_OK;
}

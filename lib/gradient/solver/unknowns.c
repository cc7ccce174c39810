/* The inside vertices as unknowns of a linear system. */
#include "gradient/solver/unknowns.h"

#include "base/minmax.h"

#include <string.h>

/* Vertices at the border of the grid have fewer neighbours. One division per axis finds them. */
static void find_neighbours(iccp_unknowns *unknowns, const uint32_t *unknown_of, uint32_t k)
{
    const icc_grid *grid = unknowns->tree->grid;
    const uint32_t v = unknowns->vertex[k];
    uint32_t *neighbour = unknowns->neighbour + (size_t)k * (size_t)unknowns->n_neighbours;
    uint32_t rest = v;
    for (int32_t axis = 0; axis < grid->dim; ++axis) {
        const uint32_t length = (uint32_t)grid->shape[axis], stride = (uint32_t)grid->stride[axis];
        const uint32_t next = rest / length, at = rest - next * length;
        *neighbour++ = at == 0 ? ICCP_NONE : unknown_of[v - stride];
        *neighbour++ = at + 1 == length ? ICCP_NONE : unknown_of[v + stride];
        rest = next;
    }
    const uint32_t parent = unknowns->tree->parent[v];
    unknowns->parent[k] = parent == ICCP_NONE ? ICCP_NONE : unknown_of[parent];
}

icc_status iccp_unknowns_create(iccp_unknowns *unknowns, const icc_tree *tree, const iccp_env *env)
{
    const size_t n = tree->n_inside;
    *unknowns = (iccp_unknowns){.memory = env->memory,
                                .tree = tree,
                                .n = n,
                                .n_neighbours = 2 * tree->grid->dim,
                                .vertex = tree->order};
    uint32_t *unknown_of = iccp_alloc(&env->memory, tree->grid->n_vertices, sizeof *unknown_of);
    unknowns->parent = iccp_alloc(&env->memory, n, sizeof *unknowns->parent);
    unknowns->neighbour =
        iccp_alloc(&env->memory, n, (size_t)unknowns->n_neighbours * sizeof *unknowns->neighbour);
    icc_status status = ICC_ERR_MEMORY;
    if (unknown_of != NULL && unknowns->parent != NULL && unknowns->neighbour != NULL) {
        memset(unknown_of, 0xff, tree->grid->n_vertices * sizeof *unknown_of); /* ICCP_NONE */
        for (uint32_t k = 0; k < n; ++k)
            unknown_of[unknowns->vertex[k]] = k;
        status = ICC_OK;
    }
    for (uint32_t k = 0; k < n && status == ICC_OK; ++k) {
        if (k % ICCP_VERTICES_PER_REPORT == 0)
            status = iccp_progress(env, "solve", (double)k / (double)n);
        find_neighbours(unknowns, unknown_of, k);
    }
    iccp_free(&env->memory, unknown_of);
    if (status != ICC_OK)
        iccp_unknowns_free(unknowns);
    return status;
}

/* Nearer zeros would only make numbers large, and move the function by less than this. */
static const double LEAST_REACH = 1e-6;

/* Returns where the boundary lies between two vertices, as a share of the way. */
static double find_reach(const icc_grid *grid, uint32_t from, uint32_t to)
{
    double ends[2][ICC_MAX_DIM], bary[ICC_MAX_DIM], share;
    uint32_t facet;
    for (int32_t k = 0; k < grid->dim; ++k) {
        ends[0][k] = grid->origin[k] + grid->spacing * iccp_grid_coordinate(grid, from, k);
        ends[1][k] = grid->origin[k] + grid->spacing * iccp_grid_coordinate(grid, to, k);
    }
    if (!iccp_domain_cross(grid->domain, ends[0], ends[1], &share, &facet, bary))
        return 1;
    return iccp_max(LEAST_REACH, iccp_min(share, 1));
}

icc_status iccp_unknowns_reach_boundary(iccp_unknowns *unknowns, const iccp_env *env)
{
    const icc_grid *grid = unknowns->tree->grid;
    const size_t degree = (size_t)unknowns->n_neighbours;
    icc_status status = ICC_OK;
    unknowns->reach = iccp_alloc(&env->memory, unknowns->n, degree * sizeof *unknowns->reach);
    if (unknowns->reach == NULL)
        return ICC_ERR_MEMORY;
    for (size_t k = 0; k < unknowns->n && status == ICC_OK; ++k) {
        if (k % ICCP_VERTICES_PER_REPORT == 0)
            status = iccp_progress(env, "solve", (double)k / (double)unknowns->n);
        for (int32_t d = 0; d < unknowns->n_neighbours; ++d) {
            const uint32_t u =
                unknowns->neighbour[k * degree + (size_t)d] != ICCP_NONE
                    ? ICCP_NONE
                    : iccp_grid_neighbour(grid, unknowns->vertex[k], d / 2, 2 * (d % 2) - 1);
            unknowns->reach[k * degree + (size_t)d] =
                u == ICCP_NONE ? 1 : find_reach(grid, unknowns->vertex[k], u);
        }
    }
    return status;
}

void iccp_unknowns_free(iccp_unknowns *unknowns)
{
    iccp_free(&unknowns->memory, unknowns->reach);
    unknowns->reach = NULL;
    iccp_free(&unknowns->memory, unknowns->parent);
    iccp_free(&unknowns->memory, unknowns->neighbour);
    unknowns->parent = unknowns->neighbour = NULL;
}

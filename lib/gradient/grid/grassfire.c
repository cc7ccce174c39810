/* Finds the maximum by grassfire. Based on: L. Huynh, Bijective Deformations in R^n via Integral
 * Curve Coordinates, thesis, 2013, section 4.1, Algorithm 1 (Huynh and Gingold, section 5.1).
 *
 * Round r of the algorithm burns the vertices at axis-by-axis (L1) distance r from the outside. So
 * the vertices that stay longest have the largest distance. Two sweeps over the grid compute that
 * distance, because a shortest path from the outside may take all its steps towards larger indices
 * first. The first sweep follows these, and the second the steps towards smaller indices. */
#include "gradient/grid/grassfire.h"

#include "base/error.h"

/* Lowers the distance of a vertex to one more than that of its neighbour on one side. */
static void relax(const icc_grid *grid, uint32_t *distance, uint32_t vertex, int32_t step)
{
    for (int32_t k = 0; k < grid->dim; ++k) {
        const uint32_t other = iccp_grid_neighbour(grid, vertex, k, step);
        const uint32_t through = other == ICCP_NONE ? 1 : distance[other] + 1;
        if (through < distance[vertex])
            distance[vertex] = through;
    }
}

static icc_status sweep(const icc_grid *grid, uint32_t *distance, int32_t step, const iccp_env *env)
{
    const size_t n = grid->n_vertices;
    for (size_t i = 0; i < n; ++i) {
        if (i % ICCP_VERTICES_PER_REPORT == 0) {
            const double share = (double)i / (double)n;
            if (iccp_progress(env, "grid", 0.5 * (step > 0 ? 1.0 + share : share)) != ICC_OK)
                return ICC_ERR_CANCELLED;
        }
        const size_t v = step < 0 ? i : n - 1 - i;
        if (distance[v] > 0)
            relax(grid, distance, (uint32_t)v, step);
    }
    return ICC_OK;
}

/* Returns the squared distance of a vertex from the mean of `count` vertices, times count^2. Their
 * coordinates have the sum `sum`. The result is an integer, so vertices on opposite sides of the
 * mean tie. */
static double from_mean(const icc_grid *grid, uint32_t vertex, uint64_t count, const uint64_t *sum)
{
    double square = 0.0;
    for (int32_t k = 0; k < grid->dim; ++k) {
        const uint64_t scaled = count * iccp_grid_coordinate(grid, vertex, k);
        const double off = scaled > sum[k] ? (double)(scaled - sum[k]) : (double)(sum[k] - scaled);
        square += off * off;
    }
    return square;
}

/* Returns, of the vertices at a distance, the one nearest to their mean. */
static uint32_t central(const icc_grid *grid, const uint32_t *distance, uint32_t wanted)
{
    uint64_t count = 0, sum[ICC_MAX_DIM] = {0};
    for (uint32_t v = 0; v < grid->n_vertices; ++v)
        if (distance[v] == wanted) {
            ++count;
            for (int32_t k = 0; k < grid->dim; ++k)
                sum[k] += iccp_grid_coordinate(grid, v, k);
        }
    uint32_t best = ICCP_NONE;
    double least = 0.0;
    for (uint32_t v = 0; v < grid->n_vertices; ++v)
        if (distance[v] == wanted) {
            const double square = from_mean(grid, v, count, sum);
            if (best == ICCP_NONE || square < least) {
                best = v;
                least = square;
            }
        }
    return best;
}

icc_status iccp_grassfire(const icc_grid *grid, uint32_t *vertex, uint32_t *rounds,
                          const iccp_env *env, icc_error *err)
{
    if (grid->n_inside == 0)
        return iccp_fail(err, ICC_ERR_RESOLUTION, "no grid vertex lies inside");
    uint32_t *distance = iccp_alloc(&env->memory, grid->n_vertices, sizeof *distance);
    if (distance == NULL)
        return iccp_fail_memory(err);
    for (size_t v = 0; v < grid->n_vertices; ++v)
        distance[v] = grid->inside[v] ? UINT32_MAX : 0;
    icc_status status = sweep(grid, distance, -1, env);
    if (status == ICC_OK)
        status = sweep(grid, distance, +1, env);
    if (status == ICC_OK) {
        uint32_t farthest = 0;
        for (size_t v = 0; v < grid->n_vertices; ++v)
            if (distance[v] > farthest)
                farthest = distance[v];
        *vertex = central(grid, distance, farthest);
        if (rounds != NULL)
            *rounds = farthest - 1;
    }
    iccp_free(&env->memory, distance);
    return status;
}

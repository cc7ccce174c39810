/* Connected pieces of the inside of a grid. */
#include "gradient/grid/pieces.h"

typedef struct flood {
    const icc_grid *grid;
    const iccp_env *env;
    uint8_t *reached; /* by grid vertex */
    uint32_t *queue;  /* n_reached grid vertices, one piece after another */
    size_t n_reached;
} flood;

static void reach(flood *f, uint32_t vertex)
{
    f->reached[vertex] = 1;
    f->queue[f->n_reached++] = vertex;
}

/* Adds the piece of a vertex to the queue. */
static icc_status flood_from(flood *f, uint32_t vertex)
{
    size_t next = f->n_reached;
    reach(f, vertex);
    for (; next < f->n_reached; ++next) {
        if (next % ICCP_VERTICES_PER_REPORT == 0 &&
            iccp_progress(f->env, "grid", (double)next / (double)f->grid->n_inside) != ICC_OK)
            return ICC_ERR_CANCELLED;
        for (int32_t k = 0; k < f->grid->dim; ++k)
            for (int32_t step = -1; step <= 1; step += 2) {
                const uint32_t u = iccp_grid_neighbour(f->grid, f->queue[next], k, step);
                if (u != ICCP_NONE && f->grid->inside[u] && !f->reached[u])
                    reach(f, u);
            }
    }
    return ICC_OK;
}

/* Finds the part of the queue with the largest piece. */
static icc_status find_largest(flood *f, size_t *begin, size_t *end)
{
    *begin = *end = 0;
    for (uint32_t v = 0; v < f->grid->n_vertices; ++v) {
        if (!f->grid->inside[v] || f->reached[v])
            continue;
        const size_t first = f->n_reached;
        const icc_status status = flood_from(f, v);
        if (status != ICC_OK)
            return status;
        if (f->n_reached - first > *end - *begin) {
            *begin = first;
            *end = f->n_reached;
        }
    }
    return ICC_OK;
}

icc_status iccp_grid_keep_largest(icc_grid *grid, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    flood f = {.grid = grid, .env = env};
    f.reached = iccp_alloc_zero(memory, grid->n_vertices, sizeof *f.reached);
    f.queue = iccp_alloc(memory, grid->n_inside, sizeof *f.queue);
    size_t begin = 0, end = 0;
    icc_status status = ICC_ERR_MEMORY;
    if (f.reached != NULL && f.queue != NULL)
        status = find_largest(&f, &begin, &end);
    if (status == ICC_OK) {
        for (size_t i = 0; i < f.n_reached; ++i)
            grid->inside[f.queue[i]] = i >= begin && i < end;
        grid->n_stray = grid->n_inside - (end - begin);
        grid->n_inside = end - begin;
    }
    iccp_free(memory, f.reached);
    iccp_free(memory, f.queue);
    return status;
}

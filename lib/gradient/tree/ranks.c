/* Checks orders that are given by ranks, and lowers functions to fall with them. */
#include "gradient/tree/ranks.h"

#include "gradient/grid/critical_count.h"

typedef struct ranks {
    const icc_tree *tree;
    const uint32_t *rank; /* by grid vertex */
} ranks;

static bool is_ranked(const void *context, uint32_t v)
{
    const ranks *r = context;
    return r->tree->grid->inside[v] && r->tree->generation[v] >= 0;
}

static bool is_higher(const void *context, uint32_t u, uint32_t v)
{
    const ranks *r = context;
    return r->rank[u] < r->rank[v] || (r->rank[u] == r->rank[v] && u > v);
}

static icc_status judge_chunk(void *argument, size_t begin, size_t end)
{
    return iccp_critical_chunk(argument, begin, end, is_ranked, is_higher);
}

icc_status iccp_tree_verify_ranks(const icc_tree *tree, const uint32_t *rank,
                                  icc_function_report *report, const iccp_env *env)
{
    const ranks context = {tree, rank};
    return iccp_critical_count(tree->grid, &context, tree->n_inside, tree->root, judge_chunk,
                               report, env);
}

static void lower(const iccp_star *star, const uint32_t *rank, uint32_t v, double gap,
                  double *values)
{
    const iccp_link_set within =
        iccp_star_is_cut(star, v) ? iccp_star_within(star, v) : star->kuhn.all;
    for (int i = 0; i < star->kuhn.n_neighbours; ++i) {
        const uint32_t u = iccp_star_vertex(star, v, i);
        if (iccp_link_has(&within, i) && rank[u] < rank[v] && values[v] > values[u] - gap)
            values[v] = values[u] - gap;
    }
}

icc_status iccp_tree_lower(const icc_tree *tree, const uint32_t *rank, double gap, double *values,
                           const iccp_env *env)
{
    uint32_t *order = iccp_alloc(&env->memory, tree->n_inside, sizeof *order);
    if (order == NULL)
        return ICC_ERR_MEMORY;
    for (size_t i = 0; i < tree->n_inside; ++i)
        order[rank[tree->order[i]]] = tree->order[i];
    iccp_star star;
    iccp_star_init(&star, tree->grid, 0);
    icc_status status = ICC_OK;
    for (size_t i = 0; i < tree->n_inside && status == ICC_OK; ++i) {
        if (i % ICCP_VERTICES_PER_REPORT == 0)
            status = iccp_progress(env, "tree", (double)i / (double)tree->n_inside);
        lower(&star, rank, order[i], gap, values);
    }
    iccp_free(&env->memory, order);
    return status;
}

/* Critical points of a piecewise linear function on a grid. */
#include "gradient/function/critical_points.h"

#include "gradient/grid/critical_count.h"
#include "gradient/grid/star.h"

#include <math.h>

static bool is_ranked(const void *context, uint32_t v)
{
    const icc_function *function = context;
    return function->tree->grid->inside[v] && !isnan(function->values[v]);
}

static bool is_higher(const void *context, uint32_t u, uint32_t v)
{
    const int order = iccp_function_compare(context, u, v);
    return order > 0 || (order == 0 && u > v);
}

static icc_status judge_chunk(void *argument, size_t begin, size_t end)
{
    return iccp_critical_chunk(argument, begin, end, is_ranked, is_higher);
}

icc_status iccp_function_verify(const icc_function *function, icc_function_report *report,
                                const iccp_env *env)
{
    const icc_tree *tree = function->tree;
    return iccp_critical_count(tree->grid, function, tree->n_inside, tree->root, judge_chunk,
                               report, env);
}

icc_status iccp_function_is_regular(const icc_function *function, bool *regular,
                                    const iccp_env *env)
{
    const icc_tree *tree = function->tree;
    icc_function_report report = {0};
    const icc_status status = iccp_function_verify(function, &report, env);
    *regular = report.n_maxima == 1 && report.n_minima == 0 &&
               (report.n_saddles == 0 || tree->grid->dim == 2);
    for (size_t i = 1; i < tree->n_inside && *regular; ++i)
        *regular = iccp_function_compare(function, tree->order[i], tree->root) < 0;
    return status;
}

uint32_t iccp_function_above(const icc_function *function, uint32_t vertex)
{
    iccp_star star;
    iccp_star_init(&star, function->tree->grid, 0);
    const iccp_link_set within = iccp_star_within(&star, vertex);
    for (int i = 0; i < star.kuhn.n_neighbours; ++i) {
        if (!iccp_link_has(&within, i))
            continue;
        const uint32_t u = iccp_star_vertex(&star, vertex, i);
        if (is_ranked(function, u) && iccp_function_compare(function, u, vertex) > 0)
            return u;
    }
    return ICCP_NONE;
}

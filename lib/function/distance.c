/* Based on: L. Huynh, Bijective Deformations in R^n via Integral Curve Coordinates, thesis, 2013,
 * section 4.2, equation 4.1; tree distance: Huynh and Gingold, section 5.2. */
#include "function/distance.h"

#include <float.h>

/* The value one generation further from the root. */
static double fall(int32_t function, double value)
{
    const double next = 0.95 * value;
    return function == ICC_FUNCTION_DECAY && next >= DBL_MIN ? next : floor(value) - 1.0;
}

/* The value of each generation, so that equal generations have equal bits. */
static icc_status tabulate(double **out, const icc_tree *tree, int32_t function,
                           const iccp_env *env)
{
    int32_t last = 0;
    for (size_t i = 0; i < tree->n_reached; ++i)
        if (tree->generation[tree->order[i]] > last)
            last = tree->generation[tree->order[i]];
    double *value = iccp_alloc(&env->memory, (size_t)last + 1, sizeof *value);
    *out = value;
    if (value == NULL)
        return ICC_ERR_MEMORY;
    value[0] = function == ICC_FUNCTION_DECAY ? 10.0 : 0.0;
    for (int32_t g = 0; g < last; ++g)
        value[g + 1] = fall(function, value[g]);
    return ICC_OK;
}

icc_status iccp_distance(icc_function *function, int32_t kind, const iccp_env *env)
{
    const icc_tree *tree = function->tree;
    double *of_generation;
    icc_status status = tabulate(&of_generation, tree, kind, env);
    for (size_t i = 0; i < tree->n_reached && status == ICC_OK; ++i) {
        if (i % ICCP_VERTICES_PER_REPORT == 0)
            status = iccp_progress(env, "function", (double)i / (double)tree->n_reached);
        const uint32_t v = tree->order[i];
        function->values[v] = of_generation[tree->generation[v]];
    }
    iccp_free(&env->memory, of_generation);
    return status;
}

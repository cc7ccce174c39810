#include "function/make_function.h"

#include "base/error.h"
#include "function/distance.h"
#include "function/laplace.h"

#include <math.h>

static icc_function_options complete(const icc_function_options *options)
{
    icc_function_options full = *options;
    if (full.function == 0)
        full.function = ICC_FUNCTION_DECAY;
    if (full.constraints == 0)
        full.constraints = ICC_CONSTRAINTS_NEEDED;
    if (!(full.min_fall > 0))
        full.min_fall = 1e-6; /* gradients keep 10 digits; 1e-12 to 1e-3 give the same active set */
    if (!(full.leaf_min > 0))
        full.leaf_min = 1e-9;
    return full;
}

/* The root, unless the function is greater elsewhere: the greatest vertex that the tree reaches
 * first. */
static void find_highest(icc_function *function)
{
    const icc_tree *tree = function->tree;
    uint32_t ends[2] = {tree->root, tree->root};
    double local[2];
    for (size_t i = 1; i < tree->n_inside; ++i)
        if (iccp_function_compare(function, tree->order[i], ends[1]) > 0)
            ends[1] = tree->order[i];
    function->info.highest = ends[1];
    function->info.beside = ends[1] != tree->root;
    if (function->info.beside) {
        iccp_function_local(function, 2, ends, local);
        function->info.excess = (local[1] - local[0]) / fabs(local[0]);
    }
}

icc_status iccp_function_create(icc_function **out, const icc_tree *tree,
                                const icc_function_options *options, const iccp_env *env,
                                icc_error *err)
{
    icc_function *function;
    *out = NULL;
    icc_status status = iccp_function_new(&function, tree, env);
    if (status != ICC_OK)
        return iccp_explain(err, status);
    const icc_function_options full = complete(options);
    function->info.function = full.function;
    if (full.function == ICC_FUNCTION_DECAY || full.function == ICC_FUNCTION_DISTANCE)
        status = iccp_distance(function, full.function, env);
    else
        status = iccp_laplace(function, &full, env, err);
    if (status == ICC_OK) {
        find_highest(function);
        *out = function;
    } else {
        iccp_function_release(function);
    }
    return iccp_explain(err, status);
}

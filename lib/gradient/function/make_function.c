/* Makes functions of all kinds. Functions of the generation alone are based on: L. Huynh, Bijective
 * Deformations in R^n via Integral Curve Coordinates, thesis, 2013, section 4.2, equation 4.1; tree
 * distance: Huynh and Gingold, section 5.2. */
#include "gradient/function/make_function.h"

#include "base/error.h"
#include "gradient/function/laplace.h"

#include <float.h>
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

/* ---- functions of the generation ---- */

/* Returns the value one generation further from the root. */
static double fall(int32_t function, double value)
{
    const double next = 0.95 * value;
    return function == ICC_FUNCTION_DECAY && next >= DBL_MIN ? next : floor(value) - 1.0;
}

/* Computes the value of each generation once, so that equal generations have equal bits. */
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

/* Gives values to a new function of kind ICC_FUNCTION_DECAY or ICC_FUNCTION_DISTANCE. The decay
 * would underflow from some 13,850 generations on, which cells = 16384 can reach. From there on the
 * values are -1, -2, .., so that they always fall from one generation to the next. */
static icc_status set_by_generation(icc_function *function, int32_t kind, const iccp_env *env)
{
    const icc_tree *tree = function->tree;
    double *of_generation;
    icc_status status = tabulate(&of_generation, tree, kind, env);
    for (size_t i = 0; i < tree->n_reached && status == ICC_OK; ++i) {
        if (i % ICCP_VERTICES_PER_REPORT == 0)
            status = iccp_progress(env, "solve", (double)i / (double)tree->n_reached);
        const uint32_t v = tree->order[i];
        function->values[v] = of_generation[tree->generation[v]];
    }
    iccp_free(&env->memory, of_generation);
    return status;
}

/* ---- all functions ---- */

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
    function->made = full;
    function->info.function = full.function;
    if (full.function == ICC_FUNCTION_DECAY || full.function == ICC_FUNCTION_DISTANCE)
        status = set_by_generation(function, full.function, env);
    else
        status = iccp_laplace(function, &full, env, err);
    if (status == ICC_OK) {
        iccp_function_find_highest(function);
        *out = function;
    } else {
        iccp_function_release(function);
    }
    return iccp_explain(err, status);
}

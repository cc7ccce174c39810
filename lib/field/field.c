/* Based on: L. Huynh, Bijective Deformations in R^n via Integral Curve Coordinates, thesis, 2013,
 * section 4.2, equation 4.1; tree distance: Huynh and Gingold, section 5.2. */
#include "field/field.h"

#include "base/error.h"

#include <float.h>
#include <math.h>

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

static icc_status assign(icc_field *field, const iccp_env *env)
{
    const icc_tree *tree = field->tree;
    const size_t n = tree->grid->n_vertices;
    double *of_generation;
    icc_status status = tabulate(&of_generation, tree, field->function, env);
    for (size_t v = 0; v < n && status == ICC_OK; ++v) {
        if (v % ICCP_VERTICES_PER_REPORT == 0)
            status = iccp_progress(env, "function", (double)v / (double)n);
        field->values[v] = tree->generation[v] < 0 ? NAN : of_generation[tree->generation[v]];
    }
    iccp_free(&env->memory, of_generation);
    return status;
}

icc_status iccp_field_create(icc_field **out, const icc_tree *tree, int32_t function,
                             const iccp_env *env, icc_error *err)
{
    *out = NULL;
    icc_field *field = iccp_alloc_zero(&env->memory, 1, sizeof *field);
    if (field == NULL)
        return iccp_fail_memory(err);
    field->memory = env->memory;
    field->tree = iccp_tree_retain(tree);
    field->function = function;
    field->values = iccp_alloc(&env->memory, tree->grid->n_vertices, sizeof *field->values);
    icc_status status = field->values != NULL ? assign(field, env) : ICC_ERR_MEMORY;
    if (status != ICC_OK) {
        iccp_field_release(field);
        return status == ICC_ERR_MEMORY ? iccp_fail_memory(err) : status;
    }
    *out = field;
    return ICC_OK;
}

void iccp_field_release(icc_field *field)
{
    if (field == NULL)
        return;
    const iccp_memory memory = field->memory;
    iccp_tree_release(field->tree);
    iccp_free(&memory, field->values);
    iccp_free(&memory, field);
}

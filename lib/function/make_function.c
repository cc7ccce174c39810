#include "function/make_function.h"

#include "base/error.h"
#include "function/distance.h"
#include "function/laplace.h"

#include <math.h>

static icc_field_options complete(const icc_field_options *options)
{
    icc_field_options full = *options;
    if (full.function == 0)
        full.function = ICC_FUNCTION_DECAY;
    if (full.constraints == 0)
        full.constraints = ICC_CONSTRAINTS_NEEDED;
    if (!(full.eta > 0))
        full.eta = 1e-6; /* gradients keep 10 digits; 1e-12 to 1e-3 give the same active set */
    if (!(full.leaf > 0))
        full.leaf = 1e-9;
    return full;
}

/* The root, unless the function is greater elsewhere: the greatest vertex that the tree reaches
 * first. */
static void find_highest(icc_field *field)
{
    const icc_tree *tree = field->tree;
    uint32_t ends[2] = {tree->root, tree->root};
    double local[2];
    for (size_t i = 1; i < tree->n_inside; ++i)
        if (iccp_field_compare(field, tree->order[i], ends[1]) > 0)
            ends[1] = tree->order[i];
    field->info.highest = ends[1];
    field->info.beside = ends[1] != tree->root;
    if (field->info.beside) {
        iccp_field_local(field, 2, ends, local);
        field->info.excess = (local[1] - local[0]) / fabs(local[0]);
    }
}

icc_status iccp_field_create(icc_field **out, const icc_tree *tree,
                             const icc_field_options *options, const iccp_env *env, icc_error *err)
{
    icc_field *field;
    *out = NULL;
    icc_status status = iccp_field_new(&field, tree, env);
    if (status != ICC_OK)
        return iccp_explain(err, status);
    const icc_field_options full = complete(options);
    field->info.function = full.function;
    if (full.function == ICC_FUNCTION_DECAY || full.function == ICC_FUNCTION_DISTANCE)
        status = iccp_distance(field, full.function, env);
    else
        status = iccp_laplace(field, &full, env, err);
    if (status == ICC_OK) {
        find_highest(field);
        *out = field;
    } else {
        iccp_field_release(field);
    }
    return iccp_explain(err, status);
}

/* Checks the arguments of the function that solves for a function of a tree. */
#include "api/check.h"
#include "api/new_function.h"
#include "base/options.h"
#include "gradient/function/make_function.h"
#include "icc/stages.h"

icc_status icc_function_create(icc_function **out, const icc_tree *tree,
                               const icc_function_options *options, const icc_env *env,
                               icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    iccp_env full_env;
    const char *missing = out == NULL ? "out" : tree == NULL ? "tree" : NULL;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    icc_function_options full;
    status = iccp_read_struct(&full, sizeof full, options, "icc_function_options", err);
    if (status != ICC_OK)
        return status;
    status = iccp_check_function(&full, "icc_function_options", err);
    if (status != ICC_OK)
        return status;
    status = iccp_with_logs(out, iccp_function_create(out, tree, &full, &full_env, err), err);
    return iccp_end_function(status, out, &full_env, err);
}

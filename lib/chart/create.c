#include "chart/create.h"

#include "base/error.h"
#include "chart/chart_gradient.h"

icc_status iccp_chart_create(icc_chart **out, const icc_domain *domain,
                             const icc_chart_options *options, const iccp_env *env,
                             icc_error *err)
{
    icc_chart_options full = *options;
    if (full.method == 0)
        full.method = ICC_METHOD_GRADIENT;
    if (full.method != ICC_METHOD_GRADIENT)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED, -1, "method %ld is not available",
                         (long)full.method);
    if (full.function == 0)
        full.function = ICC_FUNCTION_DECAY;
    if (full.tree == 0)
        full.tree = ICC_TREE_THESIS;
    if (full.cells == 0)
        full.cells = 50;
    return iccp_explain(err, iccp_chart_gradient_create(out, domain, &full, env, err));
}

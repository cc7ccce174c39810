/* Completes the options of a chart and calls its method. */
#include "method/chart_create.h"

#include "base/error.h"
#include "base/threads.h"
#include "domain/domain.h"
#include "method/methods.h"

static const char CHART_DOMAIN[] = "the domain of a chart";

/* Replaces defaults, which are 0, by their values in this dimension. Refuses combinations that
 * no method offers. `has_mesh` means that the domain has a mesh of its inside, and in a pair
 * both domains. */
static icc_status complete_options(icc_chart_options *options, int32_t dim, bool has_mesh,
                                   icc_error *err)
{
    if (options->method == 0)
        options->method = dim == 2 || has_mesh ? ICC_METHOD_FOLIATION : ICC_METHOD_FIELD;
    const iccp_chart_ops *method = iccp_method_find(options->method, has_mesh);
    if (options->function == 0)
        options->function = ICC_FUNCTION_DECAY;
    if (options->tree == 0)
        options->tree = ICC_TREE_THESIS;
    if (method == NULL)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED, "icc_chart_options.method %ld is not available",
                         (long)options->method);
    if (options->cells == 0 && method->is_planar)
        options->cells = 50;
    if (options->method == ICC_METHOD_FOLIATION && method->is_planar && dim > 2)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED,
                         "method foliation needs a mesh of the inside in dimension %ld: make the "
                         "domain by %sicc_domain_create_mesh()",
                         (long)dim, dim == 3 ? "icc_domain_fill() or " : "");
    if (method->is_planar ? dim != 2 : dim < 2)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED,
                         "method %ld is not available for domains of dimension %ld",
                         (long)options->method, (long)dim);
    return ICC_OK;
}

/* Creates one chart or two. Defaults are filled in to `options`. */
static icc_status create(size_t n, icc_chart **out, const icc_domain *const *domain,
                         icc_chart_options *options, const iccp_env *env, icc_error *err)
{
    bool has_mesh = true;
    icc_status status = ICC_OK;
    for (size_t k = 0; k < n; ++k) {
        out[k] = NULL;
        has_mesh = has_mesh && domain[k]->mesh != NULL;
    }
    for (size_t k = 0; k < n && status == ICC_OK; ++k) {
        status = iccp_domain_require_ball(domain[k], CHART_DOMAIN, err);
        if (status != ICC_OK && n > 1)
            return iccp_fail_side(err, status, (int32_t)k + 1);
    }
    for (size_t k = 0; k < n && status == ICC_OK; ++k)
        status = complete_options(&options[k], domain[k]->dim, has_mesh, err);
    if (status != ICC_OK)
        return status;
    return iccp_method_find(options->method, has_mesh)->create(n, out, domain, options, env, err);
}

icc_status iccp_chart_create(icc_chart **out, const icc_domain *domain,
                             const icc_chart_options *options, const iccp_env *env, icc_error *err)
{
    icc_chart_options full = *options;
    iccp_team team;
    iccp_env with;
    iccp_with_team(&with, &team, env);
    const icc_status status = create(1, out, &domain, &full, &with, err);
    iccp_without_team(&with, env);
    return status;
}

icc_status iccp_chart_create_pair(icc_chart *out[2], const icc_domain *const domain[2],
                                  const icc_chart_options options[2], const iccp_env *env,
                                  icc_error *err)
{
    icc_chart_options full[2] = {options[0], options[1]};
    return create(2, out, domain, full, env, err);
}

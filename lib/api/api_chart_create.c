/* Checks the arguments of the function that makes a chart by a method. */
#include "api/check.h"
#include "method/chart_create.h"

ICCP_END(chart)

icc_status icc_chart_create(icc_chart **out, const icc_domain *domain,
                            const icc_chart_options *options, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    const char *missing = out == NULL ? "out" : domain == NULL ? "domain" : NULL;
    iccp_env full_env;
    icc_chart_options full;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status == ICC_OK)
        status = iccp_read_chart_options(&full, options, domain->dim, err);
    return status == ICC_OK ? iccp_end_chart(iccp_chart_create(out, domain, &full, &full_env, err),
                                             out, &full_env, err)
                            : status;
}

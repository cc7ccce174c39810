/* Checks the arguments of the functions that save and load charts. */
#include "api/check.h"
#include "method/load.h"

ICCP_END(chart)

icc_status icc_chart_save(const icc_chart *chart, size_t capacity, void *data, size_t *n_bytes)
{
    ICCP_ENTER;
    if (chart == NULL || n_bytes == NULL || (capacity > 0 && data == NULL))
        return ICC_ERR_ARGUMENT;
    iccp_chart_save(chart, capacity, data, n_bytes);
    return ICC_OK;
}

icc_status icc_chart_load(icc_chart **out, size_t n_bytes, const void *data, const icc_env *env,
                          icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    const char *missing = out == NULL ? "out" : data == NULL ? "data" : NULL;
    iccp_env full_env;
    const icc_status status = iccp_begin(&full_env, env, missing, err);
    return status == ICC_OK ? iccp_end_chart(iccp_chart_load(out, n_bytes, data, &full_env, err),
                                             out, &full_env, err)
                            : status;
}

/* How a call that makes a function of a tree ends. */
#ifndef ICCP_NEW_FUNCTION_H
#define ICCP_NEW_FUNCTION_H

#include "api/check.h"
#include "gradient/function/function.h"

ICCP_END(function)

/* Makes the logarithms of a new function, so that icc_function_logs() cannot fail. */
static inline icc_status iccp_with_logs(icc_function **out, icc_status status, icc_error *err)
{
    if (status != ICC_OK || !(*out)->has_logs || iccp_function_logs(*out) != NULL)
        return iccp_explain(err, status);
    iccp_function_release(*out);
    *out = NULL;
    return iccp_fail_memory(err);
}

#endif

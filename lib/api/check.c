#include "api/check.h"

#include "base/error.h"
#include "base/options.h"

#include <math.h>

static const int32_t MIN_CELLS = 2, MAX_CELLS = 16384;

icc_status iccp_check_maximum(const double *maximum, int32_t dim, icc_error *err)
{
    for (int32_t k = 0; maximum != NULL && k < dim; ++k)
        if (!isfinite(maximum[k]))
            return iccp_fail(err, ICC_ERR_ARGUMENT, -1, "the maximum is not finite");
    return ICC_OK;
}

icc_status iccp_read_chart_options(icc_chart_options *full, const icc_chart_options *options,
                                   int32_t dim, icc_error *err)
{
    const icc_status status =
        iccp_read_struct(full, sizeof *full, options, "icc_chart_options", err);
    if (status != ICC_OK)
        return status;
    if (full->function < 0 || full->function > ICC_FUNCTION_DISTANCE)
        return iccp_fail(err, ICC_ERR_ARGUMENT, -1, "icc_chart_options.function is %ld",
                         (long)full->function);
    if (full->tree < 0 || full->tree > ICC_TREE_PAPER)
        return iccp_fail(err, ICC_ERR_ARGUMENT, -1, "icc_chart_options.tree is %ld",
                         (long)full->tree);
    if (full->cells != 0 && (full->cells < MIN_CELLS || full->cells > MAX_CELLS))
        return iccp_fail(err, ICC_ERR_ARGUMENT, -1,
                         "icc_chart_options.cells is %ld; it must lie in %ld..%ld",
                         (long)full->cells, (long)MIN_CELLS, (long)MAX_CELLS);
    if (full->method == ICC_METHOD_DISC && full->maximum != NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, -1,
                         "method disc has its own maximum: icc_chart_options.maximum must be NULL");
    return iccp_check_maximum(full->maximum, dim, err);
}

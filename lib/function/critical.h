/* Critical points of a piecewise linear function on the Kuhn triangulation of a grid. */
#ifndef ICCP_CRITICAL_H
#define ICCP_CRITICAL_H

#include "function/function.h"

/* See icc_function_get_report(). Only vertices inside that have a value are judged; vertices outside count as
 * lower than they are, whatever their value. Fills in everything but `size`; ICC_ERR_MEMORY or
 * ICC_ERR_CANCELLED leave the report as it was. */
icc_status iccp_function_verify(const icc_function *function, icc_function_report *report, const iccp_env *env);

#endif

/* Critical points of a piecewise linear function on the Kuhn triangulation of a grid. */
#ifndef ICCP_CRITICAL_H
#define ICCP_CRITICAL_H

#include "field/field.h"

/* Fills in everything but `size`. Only vertices inside are judged. */
icc_status iccp_field_verify(const icc_field *field, icc_field_report *report,
                             const iccp_env *env);

#endif

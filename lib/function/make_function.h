/* Making a field, whatever its function. */
#ifndef ICCP_MAKE_FUNCTION_H
#define ICCP_MAKE_FUNCTION_H

#include "function/field.h"

/* See icc_field_create(); the options are checked; zeros are completed here. */
icc_status iccp_field_create(icc_field **out, const icc_tree *tree,
                             const icc_field_options *options, const iccp_env *env, icc_error *err);

#endif

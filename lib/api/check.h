/* Argument checks that several functions share. */
#ifndef ICCP_CHECK_H
#define ICCP_CHECK_H

#include "base/env.h"
#include "base/error.h"
#include "base/fpenv.h"
#include "icc/stages.h"

/* Reads the caller's options (which may be NULL). Members that are not given stay 0. */
icc_status iccp_read_chart_options(icc_chart_options *full, const icc_chart_options *options,
                                   int32_t dim, icc_error *err);

/* How a function is made: by the options of a field and of a chart alike. `name`: of the struct. */
icc_status iccp_check_function(const icc_function_options *options, const char *name,
                               icc_error *err);

/* A maximum that the caller wants; NULL is fine. */
icc_status iccp_check_maximum(const double *maximum, int32_t dim, icc_error *err);

/* How a call begins: `missing` names the first argument that is NULL, or is NULL itself. Reads the
 * caller's environment. */
icc_status iccp_begin(iccp_env *full, const icc_env *env, const char *missing, icc_error *err);

/* How a call ends that makes an object: by its last report. Whoever wants to stop even then gets
 * no object. */
#define ICCP_END(type)                                                                             \
    static inline icc_status iccp_end_##type(icc_status status, icc_##type **out,                  \
                                             const iccp_env *env, icc_error *err)                  \
    {                                                                                              \
        const icc_status end = iccp_finish(env, status);                                           \
        if (status == ICC_OK && end != ICC_OK) {                                                   \
            iccp_##type##_release(*out);                                                           \
            *out = NULL;                                                                           \
        }                                                                                          \
        return status == ICC_OK ? iccp_explain(err, end) : status;                                 \
    }

#endif

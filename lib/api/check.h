/* Argument checks that several functions share. */
#ifndef ICCP_CHECK_H
#define ICCP_CHECK_H

#include "icc/icc.h"

/* Reads the caller's options (which may be NULL). Members that are not given stay 0. */
icc_status iccp_read_chart_options(icc_chart_options *full, const icc_chart_options *options,
                                   int32_t dim, icc_error *err);

/* A maximum that the caller wants; NULL is fine. */
icc_status iccp_check_maximum(const double *maximum, int32_t dim, icc_error *err);

#endif

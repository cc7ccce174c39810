/* Charts as bytes. Format: docs/reference/formats.md. */
#ifndef ICCP_CHART_LOAD_H
#define ICCP_CHART_LOAD_H

#include "chart/chart.h"

/* Writes a chart as part of other bytes, without its domain. */
void iccp_chart_write(const icc_chart *chart, iccp_blob *w);

/* Reads such a chart. Fails with ICC_ERR_VERSION and a message if the chart gives different
 * values here, and with other errors without a message. */
icc_status iccp_chart_read(icc_chart **out, const icc_domain *domain, iccp_blob *r,
                           const iccp_env *env, icc_error *err);

/* See icc_chart_save() and icc_chart_load(). */
void iccp_chart_save(const icc_chart *chart, size_t capacity, void *data, size_t *n_bytes);
icc_status iccp_chart_load(icc_chart **out, size_t n_bytes, const void *data, const iccp_env *env,
                           icc_error *err);

#endif

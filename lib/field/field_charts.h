/* Charts of method field for one domain, or for two domains that correspond. Source:
 * docs/theory/charts-space.md, "fields on grids". */
#ifndef ICCP_FIELD_CHARTS_H
#define ICCP_FIELD_CHARTS_H

#include "chart/chart.h"

/* See iccp_chart_ops. */
icc_status iccp_field_charts_create(size_t n, icc_chart **out, const icc_domain *const *domain,
                                    const icc_chart_options *options, const iccp_env *env,
                                    icc_error *err);

#endif

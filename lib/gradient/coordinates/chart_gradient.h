/* Method gradient: Integral Curve Coordinates as published. */
#ifndef ICCP_CHART_GRADIENT_H
#define ICCP_CHART_GRADIENT_H

#include "chart/chart.h"

/* `options` is complete: function and tree are not 0. */
icc_status iccp_chart_gradient_create(icc_chart **out, const icc_domain *domain,
                                      const icc_chart_options *options, const iccp_env *env,
                                      icc_error *err);

/* Makes again what the chart has saved: ICC_ERR_FORMAT for what no chart saves, ICC_ERR_VERSION,
 * with its reason, if it comes out otherwise. */
icc_status iccp_chart_gradient_read(icc_chart **out, const icc_domain *domain, iccp_blob *r,
                                    const iccp_env *env, icc_error *err);

#endif

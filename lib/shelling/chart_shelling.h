/* Method foliation on the caller's mesh, in any dimension from 2: coordinates along leaves that are
 * straight in every simplex. */
#ifndef ICCP_CHART_SHELLING_H
#define ICCP_CHART_SHELLING_H

#include "chart/chart.h"

/* Charts of one domain, or of two that correspond, whose maxima are then paired; the domains have
 * meshes. Of the options `maximum` is used. ICC_ERR_CERTIFICATE when a chart cannot be certified,
 * with the reason. */
icc_status iccp_chart_shelling_create(size_t n, icc_chart **out, const icc_domain *const *domain,
                                      const icc_chart_options *options, const iccp_env *env,
                                      icc_error *err);

#endif

/* Method foliation in 2-D: coordinates along the level lines of an angle-valued function. */
#ifndef ICCP_CHART_FOLIATION_H
#define ICCP_CHART_FOLIATION_H

#include "chart/chart.h"
#include "foliation/harmonic.h"

extern const iccp_chart_ops iccp_foliation_ops;

/* Makes the chart with the given vertex of the base's mesh as its maximum, and takes the mesh over
 * on success. ICC_ERR_CERTIFICATE when it cannot be certified, with the reason. */
icc_status iccp_chart_foliation_create(icc_chart **out, const icc_domain *domain,
                                       iccp_harmonic *base, uint32_t centre, const iccp_env *env,
                                       icc_error *err);

/* What the chart has saved, certified anew: ICC_ERR_FORMAT if that fails. The domain has no mesh of
 * its own. */
icc_status iccp_chart_foliation_read(icc_chart **out, const icc_domain *domain, iccp_blob *r,
                                     const iccp_env *env, icc_error *err);

#endif

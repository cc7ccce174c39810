/* Method field: curves of a Lipschitz field along which a function on a grid rises, in any
 * dimension. */
#ifndef ICCP_CHART_FIELD_H
#define ICCP_CHART_FIELD_H

#include "chart/chart.h"
#include "gradient/function/function.h"

extern const iccp_chart_ops iccp_field_ops;

/* `options` is complete. `maximum` (local coordinates) is where the maximum shall be, whatever the
 * options say, or NULL. */
icc_status iccp_chart_field_create(icc_chart **out, const icc_domain *domain,
                                   const icc_chart_options *options, const double *maximum,
                                   const iccp_env *env, icc_error *err);

/* Whether nothing but vertices that were given up, or a few contacts that are not inward, denies
 * the certificate, which chance may have put where they are. */
bool iccp_chart_field_is_unlucky(const icc_chart *chart);

/* The same with one cell more, and so with the grid elsewhere, or, where the number was open, a
 * quarter or a half more; the first that is certified, or NULL. */
icc_status iccp_chart_field_shift(icc_chart **out, const icc_chart *chart, const iccp_env *env);

/* Makes again what the chart has saved: ICC_ERR_FORMAT for what no chart saves, ICC_ERR_VERSION,
 * with its reason, if it comes out otherwise. */
icc_status iccp_chart_field_read(icc_chart **out, const icc_domain *domain, iccp_blob *r,
                                 const iccp_env *env, icc_error *err);

#endif

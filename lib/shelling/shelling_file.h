/* Reading charts of method foliation on a caller-supplied mesh; see docs/formats.md. */
#ifndef ICCP_SHELLING_FILE_H
#define ICCP_SHELLING_FILE_H

#include "chart/chart.h"

/* What the chart has saved, of a domain with a mesh: certified anew, ICC_ERR_FORMAT if that
 * fails. */
icc_status iccp_chart_shelling_read(icc_chart **out, const icc_domain *domain, iccp_blob *b,
                                    const iccp_env *env, icc_error *err);

#endif

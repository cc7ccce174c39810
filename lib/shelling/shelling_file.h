/* Reads charts of method foliation on a caller-supplied mesh. Format: docs/reference/formats.md. */
#ifndef ICCP_SHELLING_FILE_H
#define ICCP_SHELLING_FILE_H

#include "chart/chart.h"

/* Reads a saved chart of a domain with a mesh and certifies it anew. Fails with ICC_ERR_FORMAT
 * if that is not possible. */
icc_status iccp_chart_shelling_read(icc_chart **out, const icc_domain *domain, iccp_blob *b,
                                    const iccp_env *env, icc_error *err);

#endif

/* Method disc: polar coordinates of the harmonic map to a disc. */
#ifndef ICCP_CHART_DISC_H
#define ICCP_CHART_DISC_H

#include "chart/chart.h"
#include "foliation/harmonic.h"

extern const iccp_chart_ops iccp_disc_ops;

/* Makes the chart from the base's map to the disc (`image`, as iccp_harmonic_disc() gives it), and
 * takes the mesh and the image over on success. ICC_ERR_CERTIFICATE when the map is not
 * one-to-one. */
icc_status iccp_chart_disc_create(icc_chart **out, const icc_domain *domain, iccp_harmonic *base,
                                  double **image, const iccp_env *env, icc_error *err);

/* What the chart has saved, certified anew: ICC_ERR_FORMAT or ICC_ERR_CERTIFICATE if that fails. */
icc_status iccp_chart_disc_read(icc_chart **out, const icc_domain *domain, iccp_blob *r,
                                const iccp_env *env, icc_error *err);

#endif

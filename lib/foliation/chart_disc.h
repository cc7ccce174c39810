/* Method disc: polar coordinates of the harmonic map to a disc. Source:
 * docs/theory/charts-plane.md, "method disc". */
#ifndef ICCP_CHART_DISC_H
#define ICCP_CHART_DISC_H

#include "chart/chart.h"
#include "foliation/harmonic.h"

extern const iccp_chart_ops iccp_disc_ops;

/* Creates the chart from the base's map to the disc (`image`, from iccp_harmonic_disc()). On
 * success it takes over the mesh and the image. Fails with ICC_ERR_CERTIFICATE if the map is not
 * one-to-one. */
icc_status iccp_chart_disc_create(icc_chart **out, const icc_domain *domain, iccp_harmonic *base,
                                  double **image, const iccp_env *env, icc_error *err);

/* Reads a saved chart and certifies it anew. Fails with ICC_ERR_FORMAT or ICC_ERR_CERTIFICATE. */
icc_status iccp_chart_disc_read(icc_chart **out, const icc_domain *domain, iccp_blob *r,
                                const iccp_env *env, icc_error *err);

#endif

/* Method foliation in 2-D: coordinates along the level lines of an angle-valued function.
 *
 * Source: docs/theory/charts-plane.md, "method foliation". A caller's own mesh uses lib/shelling
 * instead.
 *
 * Words of this folder (methods foliation and disc in the plane)
 * - base: the mesh of the domain, its Laplacian, and the factor of that (harmonic.h).
 * - centre: the vertex of the chart's maximum, where all leaves end.
 * - star: the triangles at the centre. There, leaves are straight lines to it.
 * - psi: a function to R/Z that winds once round the centre, as the hand of a clock does.
 * - label: an integer value of psi. ICCP_TURN units are one turn (psi.h).
 * - rise: the difference of two labels along a half-edge, lifted from R/Z to R.
 * - leaf: a level line of psi, from the boundary to the centre (leaf2.h).
 * - crossing: the place where a leaf crosses an edge.
 * - flux: the positive share of the turn that a boundary edge gets; shares sum to 1.
 * - rim: a boundary of the mesh without the centre, or of the image in the disc.
 *
 * Invariants: labels and rises are integers, so all decisions on leaves are exact. A chart exists
 * only if its certificate holds (certificate.h). Then leaves never meet, and each meets a triangle
 * once.
 *
 * Ways: harmonic_charts.c creates the charts of both methods. psi.c and chart_foliation.c serve
 * method foliation, chart_disc.c serves method disc. harmonic_file.h and psi_file.h read and write
 * bytes.
 *
 * Begin with psi.h and leaf2.h. */
#ifndef ICCP_CHART_FOLIATION_H
#define ICCP_CHART_FOLIATION_H

#include "chart/chart.h"
#include "foliation/harmonic.h"

extern const iccp_chart_ops iccp_foliation_ops;

/* Creates the chart whose maximum is the given vertex of the base's mesh. On success it takes
 * over the mesh. Fails with ICC_ERR_CERTIFICATE and the reason if the chart cannot be certified. */
icc_status iccp_chart_foliation_create(icc_chart **out, const icc_domain *domain,
                                       iccp_harmonic *base, uint32_t centre, const iccp_env *env,
                                       icc_error *err);

/* Reads a saved chart and certifies it anew, or fails with ICC_ERR_FORMAT. The domain has no
 * mesh of its own. */
icc_status iccp_chart_foliation_read(icc_chart **out, const icc_domain *domain, iccp_blob *r,
                                     const iccp_env *env, icc_error *err);

#endif

/* Method field: a chart whose curves follow a Lipschitz field on a grid, in any dimension.
 *
 * Source: docs/theory/charts-space.md, "fields on grids". Grid, tree and function are those of
 * lib/gradient.
 *
 * Words of this folder
 * - function: the piecewise linear function on the grid that rises along every curve.
 * - vector: the direction of the field at a vertex of the grid. It is interpolated linearly.
 * - uphill: a vector is uphill if the function rises along it in every simplex at its vertex.
 * - root: the vertex of the maximum, where all curves end. Next to it, curves are straight.
 * - order: an order of the axes. It names one Kuhn simplex of a cell.
 * - contact: a pair of a simplex and a boundary facet that runs through it.
 * - sector: a part of the simplices at a vertex that has a vector of its own (sectors.h).
 * - stray: a vertex that was inside and was given up, so that it counts as outside.
 * - walk, piece: a curve on its way, and its part within one simplex (flow.h).
 * - jet: derivatives of a place and of a length by several parameters (flow_jet.h).
 *
 * Invariants: a certified chart has uphill vectors at all vertices, vectors that point inward at
 * all contacts, and no inside vertex that was given up. So its curves never merge, and each crosses
 * the boundary once.
 *
 * Ways
 * - Making: chart_field.c makes a chart, field_charts.h pairs maxima (pairing.h) and shifts grids.
 *   incidence.h finds the simplices, of some masks by incidence_mask.h; extension.h finds values,
 *   vectors.h vectors (by minnorm.h, the nearest point of a hull). field_certificate.h certifies.
 * - Following: flow.h one curve, flow_follow.h many, side by side in flow_batch.h. flow_step.h
 *   tries the end of a piece, flow_exit.h finds it slowly, flow_leave.c finds the boundary.
 * - Coordinates: field_encode.c, field_decode.c; field_trace.c has whole curves. field_state.h has
 *   the operations, field_measure.h samples.
 *
 * Begin with vectors.h and flow.h. */
#ifndef ICCP_CHART_FIELD_H
#define ICCP_CHART_FIELD_H

#include "chart/chart.h"
#include "gradient/function/function.h"

extern const iccp_chart_ops iccp_field_ops;

/* Creates a chart. `options` must be complete. `maximum` (local coordinates) overrides the
 * maximum in the options unless it is NULL. */
icc_status iccp_chart_field_create(icc_chart **out, const icc_domain *domain,
                                   const icc_chart_options *options, const double *maximum,
                                   const iccp_env *env, icc_error *err);

/* Returns true if another grid may get the certificate. The certificate then fails only because of
 * vertices that were given up, or of a few contacts that are not inward. Both depend on where the
 * grid lies. */
bool iccp_chart_field_is_unlucky(const icc_chart *chart);

/* Makes the chart again with one cell more, so that the grid lies elsewhere. If the caller left
 * the number of cells open, it also tries a quarter and a half more. `*out` is the first chart
 * that is certified, or NULL. */
icc_status iccp_chart_field_shift(icc_chart **out, const icc_chart *chart, const iccp_env *env);

/* Creates a saved chart again. Fails with ICC_ERR_FORMAT for bytes that no chart saves, and with
 * ICC_ERR_VERSION and a message if the result differs from the saved one. */
icc_status iccp_chart_field_read(icc_chart **out, const icc_domain *domain, iccp_blob *r,
                                 const iccp_env *env, icc_error *err);

#endif

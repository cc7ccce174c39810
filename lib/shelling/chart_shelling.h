/* Method foliation on the caller's mesh, in any dimension from 2: coordinates along leaves that are
 * straight in every simplex.
 *
 * Source: docs/theory/charts-space.md, "foliations of simplices"; Campen, Silva, Zorin 2016.
 *
 * Words of this folder
 * - side: a facet of the mesh as seen from one of its simplices; see geometry/simplices.h.
 * - face: a set of corners of a simplex, of any dimension (faces.h).
 * - centre, star: the vertex where all leaves end, and the simplices at it.
 * - order, rank: the sequence in which simplices join a growing ball; a simplex's number in it.
 * - leaf: a curve from the boundary to the centre through simplices of ever smaller rank.
 * - enter, leave: as seen by a leaf that rises to the centre.
 * - direction: the rates of the barycentric coordinates along a leaf.
 * - flux: amount that leaves a simplex through a side; negative if it enters (reference.h).
 * - potential: a function on the simplices that rises with the distance from the star.
 * - link: the cycle of simplices round a face of dimension dim - 2 (links.h).
 * - grow, peel, reverse: ways to make an order (shelling_order.h) and to improve it (reverse.h).
 * - place, note: a point as simplex and barycentric coordinates; a place saved with its length.
 *
 * Invariants: along an order, every union of simplices is a ball. Leaves enter a simplex from
 * greater rank and leave it to smaller rank. A chart exists only if shelling_certificate.h accepts
 * it.
 *
 * Ways
 * - Centres: centres.h; shelling_split.h adds a vertex if the mesh has none inside.
 * - Flux that is wanted: inflow.c at the boundary, reference.h inside.
 * - Order: shelling_order.h grows and peels, reverse.h improves, best_order.h chooses and repeats
 *   what got stuck. circulation.h makes the flux along an order.
 * - Chart: shelling_certificate.h proves it, leafn.h follows leaves (leafn_find.c finds the simplex
 *   of a point), shelling_state.c has the coordinates, shelling_file.h reads saved bytes.
 * - Equations: solve.h, on stiffness.h and element.h. Memory: arranged.h orders simplices in space.
 *
 * Begin with shelling_order.h and leafn.h. */
#ifndef ICCP_CHART_SHELLING_H
#define ICCP_CHART_SHELLING_H

#include "chart/chart.h"

/* Creates the chart of one domain, or the charts of two that correspond, whose maxima are then
 * paired. The domains must have meshes. Only the option `maximum` is used. Fails with
 * ICC_ERR_CERTIFICATE and the reason if a chart cannot be certified. */
icc_status iccp_chart_shelling_create(size_t n, icc_chart **out, const icc_domain *const *domain,
                                      const icc_chart_options *options, const iccp_env *env,
                                      icc_error *err);

#endif

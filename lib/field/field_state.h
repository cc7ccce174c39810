/* The state of a chart of method field, and its operations. Source: docs/theory/charts-space.md,
 * "fields on grids". */
#ifndef ICCP_FIELD_STATE_H
#define ICCP_FIELD_STATE_H

#include "field/flow_follow.h"
#include "field/vectors.h"
#include "gradient/coordinates/chart_parameters.h"

#include <assert.h>
#include <string.h>

typedef struct iccp_field_state {
    iccp_chart_parameters parameters;
    icc_tree *tree;
    icc_function *field; /* the function on the tree; the field itself is `vectors` */
    iccp_incidence incidence;
    iccp_vectors vectors;
    iccp_flow flow;
} iccp_field_state;

/* ---- places ---- */

static_assert(sizeof(iccp_flow_place) <= sizeof(iccp_chart_place), "there is room for a place");

static inline iccp_flow_place iccp_field_place(const iccp_chart_place *place)
{
    iccp_flow_place own;
    memcpy(&own, place->bytes, sizeof own);
    return own;
}

/* Finds the simplex that a curve enters from a local point of the boundary. Fails with
 * ICC_ERR_TRACE if there is none. */
icc_status iccp_field_entry(const icc_chart *chart, const double *point, iccp_flow_place *place);

/* The local coordinates of the point `at` in a place's simplex. */
void iccp_field_place_out(const iccp_field_state *state, const iccp_flow_place *place,
                          const double *at, double *local);

/* Logarithm of local volume per area of the boundary and share of the curve. `volume` is the
 * same quantity of a curve in lattice units, and `length` that curve's whole length there. */
double iccp_field_volume(const iccp_field_state *state, double volume, double length);

/* ---- operations of iccp_chart_ops ---- */

/* iccp_field_locate() finds the place of a point. In a simplex that no facet runs through, a point
 * is inside if the vertices are. Otherwise the domain is asked. */
int32_t iccp_field_locate(const icc_chart *chart, const double *point, iccp_chart_place *place,
                          iccp_coords *coords);
icc_status iccp_field_encode(const icc_chart *chart, const double *point,
                             const iccp_chart_place *place, iccp_coords *coords,
                             iccp_encode_jet *jet);
icc_status iccp_field_encode_many(const icc_chart *chart, size_t n, const size_t *which,
                                  const iccp_chart_place *place, iccp_coords *coords,
                                  double *volume, icc_status *status, iccp_path *path);
icc_status iccp_field_decode(const icc_chart *chart, const iccp_coords *coords, double *point,
                             iccp_decode_jet *jet, iccp_path *path);
icc_status iccp_field_decode_many(const icc_chart *chart, size_t n, const size_t *which,
                                  const iccp_coords *coords, double *points, double *volume,
                                  icc_status *status, iccp_path *path);
icc_status iccp_field_trace(const icc_chart *chart, const double *point,
                            const iccp_chart_place *place, const iccp_coords *boundary,
                            iccp_path *path, iccp_emit emit, void *argument);

#endif

/* What a chart of method field knows, and what it can do. */
#ifndef ICCP_FIELD_STATE_H
#define ICCP_FIELD_STATE_H

#include "chart/recipe.h"
#include "field/cones.h"
#include "field/flow_follow.h"

typedef struct iccp_field_state {
    iccp_recipe recipe;
    icc_tree *tree;
    icc_function *field;
    iccp_cover cover;
    iccp_cones cones;
    iccp_flow flow;
    double root[ICC_MAX_DIM]; /* local */
} iccp_field_state;

/* ---- places ---- */

/* ICC_INSIDE and so on for a local point, with its place if it is inside, or its facet and
 * barycentric coordinates on the boundary. A simplex that no facet runs through is inside with its
 * vertices. */
int32_t iccp_field_locate(const icc_chart *chart, const double *point, iccp_flow_place *place,
                          iccp_coords *coords);

/* A local point of the boundary, in the simplex that the curve enters from there, or
 * ICC_ERR_TRACE. */
icc_status iccp_field_entry(const icc_chart *chart, const double *point, iccp_flow_place *place);

/* The local point `at` of a place's simplex. */
void iccp_field_place_out(const iccp_field_state *state, const iccp_flow_place *place,
                          const double *at, double *local);

bool iccp_field_at_maximum(const icc_chart *chart, const double *point);

/* The logarithm of local volume per area of the boundary and share of the way, from that of a curve
 * in lattice units, and its whole length there. */
double iccp_field_volume(const iccp_field_state *state, double volume, double length);

/* The curves of points that need some, and whose they are. */
typedef struct iccp_field_many {
    iccp_flow_curve *curves;
    size_t n, point[ICCP_CHART_MANY];
} iccp_field_many;

/* Makes room in the path's memory; `curves` are the caller's to free. False if there is none. */
bool iccp_field_many_begin(iccp_field_many *many, size_t n_curves, const iccp_path *path);

/* ---- as iccp_chart_ops has them ---- */

icc_status iccp_field_encode(const icc_chart *chart, const double *point, iccp_coords *coords,
                             iccp_encode_jet *jet, iccp_path *path);
icc_status iccp_field_encode_many(const icc_chart *chart, size_t n, const double *points,
                                  iccp_coords *coords, double *volume, icc_status *status,
                                  iccp_path *path);
icc_status iccp_field_decode(const icc_chart *chart, const iccp_coords *coords, double *point,
                             iccp_decode_jet *jet, iccp_path *path);
icc_status iccp_field_decode_many(const icc_chart *chart, size_t n, const iccp_coords *coords,
                                  double *points, double *volume, icc_status *status,
                                  iccp_path *path);
icc_status iccp_field_trace(const icc_chart *chart, const double *point, iccp_path *path,
                            iccp_emit emit, void *argument);

#endif

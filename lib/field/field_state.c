/* Converts between points of the domain and places in the grid of a chart of method field. */
#include "field/field_state.h"

#include "math/elementary.h"

#include <math.h>

static void to_lattice(const iccp_field_state *state, const double *local, double *x)
{
    const icc_grid *grid = state->tree->grid;
    for (int32_t k = 0; k < grid->dim; ++k)
        x[k] = (local[k] - grid->origin[k]) / grid->spacing;
}

void iccp_field_place_out(const iccp_field_state *state, const iccp_flow_place *place,
                          const double *at, double *local)
{
    const icc_grid *grid = state->tree->grid;
    iccp_flow_position(&state->flow, place, at, local);
    for (int32_t k = 0; k < grid->dim; ++k)
        local[k] = grid->origin[k] + grid->spacing * local[k];
}

icc_status iccp_field_entry(const icc_chart *chart, const double *point, iccp_flow_place *place)
{
    const iccp_field_state *state = chart->state;
    double x[ICC_MAX_DIM], ahead[ICC_MAX_DIM];
    to_lattice(state, point, x);
    if (!iccp_flow_find(&state->flow, x, NULL, place))
        return ICC_ERR_TRACE;
    iccp_flow_vector(&state->flow, place, ahead);
    return iccp_flow_find(&state->flow, x, ahead, place) ? ICC_OK : ICC_ERR_TRACE;
}

int32_t iccp_field_locate(const icc_chart *chart, const double *point, iccp_chart_place *place,
                          iccp_coords *coords)
{
    const iccp_field_state *state = chart->state;
    iccp_flow_place own;
    double x[ICC_MAX_DIM];
    to_lattice(state, point, x);
    const bool found = iccp_flow_find(&state->flow, x, NULL, &own);
    const uint32_t lowest = found ? own.simplex.corner[0] : 0;
    if (found)
        memcpy(place->bytes, &own, sizeof own);
    if (found && !iccp_band_is_wide(&chart->domain->band) && state->incidence.bits[lowest] == 0 &&
        state->tree->grid->inside[lowest])
        return ICC_INSIDE;
    const int32_t where =
        iccp_domain_locate(chart->domain, point, true, &coords->facet, coords->bary);
    return where == ICC_INSIDE && !found ? ICC_OUTSIDE : where;
}

double iccp_field_volume(const iccp_field_state *state, double volume, double length)
{
    return volume + iccp_ln(state->tree->grid->spacing * length);
}

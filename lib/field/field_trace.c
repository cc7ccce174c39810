/* Traces the whole curve of a point, from the boundary to the maximum. */
#include "field/field_state.h"

/* Emits the places of a path's marks, starting with the first or with the last. */
static icc_status emit_marks(const iccp_field_state *state, const iccp_path *path, bool reversed,
                             iccp_emit emit, void *argument)
{
    icc_status status = ICC_OK;
    for (size_t i = 0; status == ICC_OK && i < path->n_marks; ++i) {
        const iccp_flow_mark *mark = path->marks + (reversed ? path->n_marks - 1 - i : i);
        double local[ICC_MAX_DIM];
        iccp_field_place_out(state, &mark->place, mark->place.at, local);
        status = emit(argument, local);
    }
    return status;
}

/* Emits the curve from the boundary up to the point. The point is the last mark and is left out. */
static icc_status trace_below(const icc_chart *chart, const iccp_flow_place *place, iccp_path *path,
                              iccp_emit emit, void *argument)
{
    const iccp_field_state *state = chart->state;
    iccp_flow_walk walk;
    iccp_coords coords;
    double s, local[ICC_MAX_DIM];
    path->n_marks = 0;
    icc_status status = iccp_flow_start(&walk, &state->flow, -1, place);
    while (status == ICC_OK && !iccp_flow_leaves(&walk, &s, &coords.facet, coords.bary)) {
        status = iccp_flow_next(&walk);
        if (status == ICC_OK)
            status = iccp_flow_note(&walk, path);
    }
    if (status != ICC_OK)
        return status;
    iccp_domain_facet_point(chart->domain, coords.facet, coords.bary, local);
    status = emit(argument, local);
    return status == ICC_OK ? emit_marks(state, path, true, emit, argument) : status;
}

/* Finds the place where a curve enters the domain from the boundary. */
static icc_status find_entry(const icc_chart *chart, const double *point,
                             const iccp_coords *boundary, iccp_flow_place *place)
{
    double local[ICC_MAX_DIM];
    if (iccp_field_entry(chart, point, place) == ICC_OK)
        return ICC_OK;
    /* A point in the boundary's tolerance band may lie beyond the grid, so its nearest boundary
     * point is used. */
    iccp_domain_facet_point(chart->domain, boundary->facet, boundary->bary, local);
    return iccp_field_entry(chart, local, place);
}

icc_status iccp_field_trace(const icc_chart *chart, const double *point,
                            const iccp_chart_place *place, const iccp_coords *boundary,
                            iccp_path *path, iccp_emit emit, void *argument)
{
    const iccp_field_state *state = chart->state;
    iccp_flow_place start;
    iccp_flow_walk walk;
    icc_status status;
    if (boundary != NULL) {
        status = find_entry(chart, point, boundary, &start);
    } else {
        start = iccp_field_place(place);
        status = trace_below(chart, &start, path, emit, argument);
    }
    path->n_marks = 0;
    if (status == ICC_OK)
        status = iccp_flow_start(&walk, &state->flow, +1, &start);
    for (bool more = true; status == ICC_OK && more;) {
        status = iccp_flow_note(&walk, path);
        more = !walk.ends;
        if (status == ICC_OK && more)
            status = iccp_flow_next(&walk);
    }
    if (status == ICC_OK)
        status = emit_marks(state, path, false, emit, argument);
    return status == ICC_OK ? emit(argument, chart->maximum) : status;
}

/* From coordinates to the point: the curve from the boundary, as far as t says. */
#include "chart/field_state.h"
#include "field/flow_jet.h"

#include <math.h>
#include <string.h>

/* The whole curve from a boundary point, its pieces noted. */
static icc_status climb(const icc_chart *chart, const double *point, iccp_flow_walk *walk,
                        iccp_path *path)
{
    const iccp_field_state *state = chart->state;
    iccp_flow_place place;
    path->n_marks = 0;
    icc_status status = iccp_field_entry(chart, point, &place);
    if (status == ICC_OK)
        status = iccp_flow_start(walk, &state->flow, +1, &place);
    if (status == ICC_OK)
        status = iccp_flow_note(walk, path);
    while (status == ICC_OK && !walk->ends) {
        status = iccp_flow_next(walk);
        if (status == ICC_OK)
            status = iccp_flow_note(walk, path);
    }
    return status;
}

/* By the barycentric coordinates but the first: the walk once more with derivatives, those at the
 * start of the piece that holds the point kept. */
static icc_status fill_decode_jet(const icc_chart *chart, const iccp_coords *coords,
                                  const iccp_path *path, const iccp_flow_walk *end, double s,
                                  double total, iccp_decode_jet *jet)
{
    const iccp_field_state *state = chart->state;
    const int32_t dim = chart->domain->dim;
    const double h = state->tree->grid->spacing;
    const double *corner[ICC_MAX_DIM];
    iccp_flow_jet whole = {.n = dim - 1}, part = {0};
    iccp_flow_walk walk;
    iccp_facet_corners(&chart->domain->tree, coords->facet, corner);
    for (int32_t c = 0; c + 1 < dim; ++c)
        for (int32_t k = 0; k < dim; ++k)
            whole.place[c][k] = (corner[c + 1][k] - corner[0][k]) / h;
    icc_status status = iccp_flow_start(&walk, &state->flow, +1, &path->marks[0].place);
    for (bool more = true; status == ICC_OK && more;) {
        if (walk.length <= end->length)
            part = whole;
        more = !walk.ends;
        if (!iccp_flow_jet_pass(&walk, &whole) && more)
            return ICC_ERR_TRACE;
        if (more)
            status = iccp_flow_next(&walk);
    }
    if (status != ICC_OK)
        return status;
    double ahead[ICC_MAX_DIM];
    iccp_flow_jet_within(end, s, &part);
    for (int32_t c = 0; c + 1 < dim; ++c)
        ahead[c] = coords->t * whole.length[c] - part.length[c];
    iccp_flow_jet_advance(end, s, ahead, &part);
    for (int32_t i = 0; i < dim; ++i) {
        jet->bary[i * dim] = 0;
        for (int32_t c = 0; c + 1 < dim; ++c)
            jet->bary[i * dim + c + 1] = h * part.place[c][i];
    }
    /* By t: along the curve. */
    part = (iccp_flow_jet){.n = 1};
    iccp_flow_jet_advance(end, s, &total, &part);
    for (int32_t i = 0; i < dim; ++i)
        jet->t[i] = h * part.place[0][i];
    return ICC_OK;
}

/* The point where its curve starts, or the point itself; then returns true. */
static bool is_at_end(const icc_chart *chart, const iccp_coords *coords, double *point)
{
    const iccp_field_state *state = chart->state;
    if (coords->t >= 1)
        memcpy(point, state->root, (size_t)chart->domain->dim * sizeof *point);
    else
        iccp_domain_facet_point(chart->domain, coords->facet, coords->bary, point);
    return coords->t <= 0 || coords->t >= 1;
}

icc_status iccp_field_decode(const icc_chart *chart, const iccp_coords *coords, double *point,
                             iccp_decode_jet *jet, iccp_path *path)
{
    const iccp_field_state *state = chart->state;
    iccp_flow_walk walk;
    double at[ICC_MAX_DIM];
    if (is_at_end(chart, coords, point))
        return jet == NULL ? ICC_OK : ICC_ERR_TRACE;
    icc_status status = climb(chart, point, &walk, path);
    if (status != ICC_OK)
        return status;
    const double total = walk.length + walk.end_length, length = coords->t * total;
    status = iccp_flow_rewind(&walk, path, length);
    if (status != ICC_OK)
        return status;
    const double s = iccp_flow_at_length(&walk, length - walk.length);
    iccp_flow_at(&walk, s, at);
    iccp_field_place_out(state, &walk.place, at, point);
    return jet == NULL ? ICC_OK : fill_decode_jet(chart, coords, path, &walk, s, total, jet);
}

/* One pass prepares the curves that have to be followed, these are followed side by side, and a
 * second pass writes where they lead. */
icc_status iccp_field_decode_many(const icc_chart *chart, size_t n, const iccp_coords *coords,
                                  double *points, double *volume, icc_status *status,
                                  iccp_path *path)
{
    const iccp_field_state *state = chart->state;
    const size_t dim = (size_t)chart->domain->dim;
    iccp_field_many m;
    if (!iccp_field_many_begin(&m, n, path))
        return ICC_ERR_MEMORY;
    for (size_t i = 0; i < n; ++i) {
        double *point = points + dim * i;
        if (volume != NULL)
            volume[i] = NAN;
        if (status[i] != ICC_OK || is_at_end(chart, &coords[i], point))
            continue;
        m.curves[m.n] = (iccp_flow_curve){
            .sign = +1, .share = coords[i].t, .measured = volume != NULL, .facet = coords[i].facet};
        status[i] = iccp_field_entry(chart, point, &m.curves[m.n].start);
        m.point[m.n] = i;
        m.n += status[i] == ICC_OK;
    }
    const icc_status all = iccp_flow_follow(&state->flow, m.n, m.curves, path->memory);
    for (size_t j = 0; all == ICC_OK && j < m.n; ++j) {
        const iccp_flow_place *place = &m.curves[j].place;
        iccp_field_place_out(state, place, place->at, points + dim * m.point[j]);
        if (volume != NULL)
            volume[m.point[j]] = iccp_field_volume(state, m.curves[j].volume, m.curves[j].length);
        status[m.point[j]] = m.curves[j].status;
    }
    iccp_free(path->memory, m.curves);
    return all;
}

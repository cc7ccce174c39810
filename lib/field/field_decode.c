/* Decodes coordinates to a point: follows the curve from the boundary by the share t of its
 * length. Source: docs/theory/charts-space.md, "fields on grids". */
#include "field/field_state.h"
#include "field/flow_jet.h"

/* Follows the whole curve from a boundary point and notes its pieces. */
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

/* Derivatives by the barycentric coordinates except the first. It walks again with derivatives,
 * and keeps those at the start of the piece that holds the point. */
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
    /* The derivative by t points along the curve. */
    part = (iccp_flow_jet){.n = 1};
    iccp_flow_jet_advance(end, s, &total, &part);
    for (int32_t i = 0; i < dim; ++i)
        jet->t[i] = h * part.place[0][i];
    return ICC_OK;
}

icc_status iccp_field_decode(const icc_chart *chart, const iccp_coords *coords, double *point,
                             iccp_decode_jet *jet, iccp_path *path)
{
    const iccp_field_state *state = chart->state;
    iccp_flow_walk walk;
    double at[ICC_MAX_DIM];
    iccp_domain_facet_point(chart->domain, coords->facet, coords->bary, point);
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

/* A point whose curve cannot start fails, and the others continue. */
icc_status iccp_field_decode_many(const icc_chart *chart, size_t n, const size_t *which,
                                  const iccp_coords *coords, double *points, double *volume,
                                  icc_status *status, iccp_path *path)
{
    const iccp_field_state *state = chart->state;
    const size_t dim = (size_t)chart->domain->dim;
    size_t n_curves = 0, own[ICCP_CHART_MANY];
    iccp_flow_curve *curves = iccp_alloc(path->memory, n, sizeof *curves);
    if (curves == NULL)
        return ICC_ERR_MEMORY;
    for (size_t j = 0; j < n; ++j) {
        const size_t i = which[j];
        double start[ICC_MAX_DIM];
        iccp_domain_facet_point(chart->domain, coords[i].facet, coords[i].bary, start);
        curves[n_curves] = (iccp_flow_curve){
            .sign = +1, .share = coords[i].t, .measured = volume != NULL, .facet = coords[i].facet};
        status[i] = iccp_field_entry(chart, start, &curves[n_curves].start);
        own[n_curves] = i;
        n_curves += status[i] == ICC_OK;
    }
    const icc_status all = iccp_flow_follow(&state->flow, n_curves, curves, path->memory);
    for (size_t j = 0; all == ICC_OK && j < n_curves; ++j) {
        const iccp_flow_place *place = &curves[j].place;
        iccp_field_place_out(state, place, place->at, points + dim * own[j]);
        if (volume != NULL)
            volume[own[j]] = iccp_field_volume(state, curves[j].volume, curves[j].length);
        status[own[j]] = curves[j].status;
    }
    iccp_free(path->memory, curves);
    return all;
}

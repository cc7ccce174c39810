/* Encodes a point of the domain: follows its curve downhill to the boundary, and uphill to the
 * maximum. Source: docs/theory/charts-space.md, "fields on grids". */
#include "field/field_state.h"
#include "field/flow_jet.h"

#include <string.h>

/* Follows the curve downhill. `jet` may be NULL. Otherwise it starts as the derivative of the
 * place by the point, and ends as that of the place on the boundary. */
static icc_status walk_down(const iccp_field_state *state, const iccp_flow_place *place,
                            iccp_coords *coords, double *length, iccp_flow_jet *jet)
{
    const size_t dim = (size_t)state->tree->grid->dim;
    iccp_flow_walk walk;
    icc_status status = iccp_flow_start(&walk, &state->flow, -1, place);
    double s;
    while (status == ICC_OK && !iccp_flow_leaves(&walk, &s, &coords->facet, coords->bary)) {
        if (jet != NULL && !iccp_flow_jet_pass(&walk, jet))
            return ICC_ERR_TRACE;
        status = iccp_flow_next(&walk);
    }
    if (status != ICC_OK)
        return status;
    *length = walk.length + iccp_flow_length(&walk, s);
    if (jet == NULL)
        return ICC_OK;
    iccp_flow_jet_within(&walk, s, jet);
    const double *normal = state->incidence.normal + dim * coords->facet;
    return iccp_flow_jet_onto(&walk, s, normal, jet) ? ICC_OK : ICC_ERR_TRACE;
}

/* Follows the curve to the maximum, with derivatives if `jet` is not NULL. The last piece's jet
 * may fail at the root, where the curve's direction ends. Its length is right nevertheless. */
static icc_status walk_up(const iccp_field_state *state, const iccp_flow_place *place,
                          double *length, iccp_flow_jet *jet)
{
    iccp_flow_walk walk;
    icc_status status = iccp_flow_start(&walk, &state->flow, +1, place);
    while (status == ICC_OK && !walk.ends) {
        if (jet != NULL && !iccp_flow_jet_pass(&walk, jet))
            return ICC_ERR_TRACE;
        status = iccp_flow_next(&walk);
    }
    if (status == ICC_OK && jet != NULL)
        (void)iccp_flow_jet_pass(&walk, jet);
    if (status == ICC_OK)
        *length = walk.length + walk.end_length;
    return status;
}

/* Sets one parameter for each axis, which moves the point along that axis. */
static void unit_jet(iccp_flow_jet *jet, int32_t dim)
{
    *jet = (iccp_flow_jet){.n = dim};
    for (int32_t k = 0; k < dim; ++k)
        jet->place[k][k] = 1;
}

/* Converts movements of a point on a facet to changes of its barycentric coordinates. It solves
 * the normal equations of the facet's edges, which are independent. */
static void facet_slopes(const icc_domain *domain, uint32_t facet, const double *movement,
                         double *slope)
{
    const int32_t dim = domain->dim, n = dim - 1;
    const double *corner[ICC_MAX_DIM];
    double gram[ICC_MAX_DIM][ICC_MAX_DIM] = {{0}}, right[ICC_MAX_DIM] = {0};
    iccp_facet_corners(&domain->tree, facet, corner);
    for (int32_t i = 0; i < n; ++i)
        for (int32_t k = 0; k < dim; ++k) {
            const double edge = corner[i + 1][k] - corner[0][k];
            right[i] += edge * movement[k];
            for (int32_t j = 0; j < n; ++j)
                gram[i][j] += edge * (corner[j + 1][k] - corner[0][k]);
        }
    for (int32_t c = 0; c < n; ++c)
        for (int32_t r = 0; r < n; ++r) {
            const double factor = r != c ? gram[r][c] / gram[c][c] : 0;
            for (int32_t k = c; k < n; ++k)
                gram[r][k] -= factor * gram[c][k];
            right[r] -= factor * right[c];
        }
    slope[0] = 0;
    for (int32_t i = 0; i < n; ++i) {
        slope[i + 1] = right[i] / gram[i][i];
        slope[0] -= slope[i + 1];
    }
}

/* Fills in the derivatives of t and the slopes of the boundary point's barycentric coordinates.
 * d t = (d down * up - down * d up) / length^2. */
static void fill_encode_jet(const icc_chart *chart, uint32_t facet, const iccp_flow_jet *down,
                            double s_down, const iccp_flow_jet *up, double s_up,
                            iccp_encode_jet *jet)
{
    const iccp_field_state *state = chart->state;
    const int32_t dim = chart->domain->dim;
    const double h = state->tree->grid->spacing, length = s_down + s_up;
    for (int32_t j = 0; j < dim; ++j) {
        double slope[ICC_MAX_DIM];
        facet_slopes(chart->domain, facet, down->place[j], slope);
        for (int32_t i = 0; i < dim; ++i)
            jet->bary[i * dim + j] = slope[i];
        jet->t[j] = (down->length[j] * s_up - s_down * up->length[j]) / (length * length * h);
    }
}

icc_status iccp_field_encode(const icc_chart *chart, const double *point,
                             const iccp_chart_place *place, iccp_coords *coords,
                             iccp_encode_jet *jet)
{
    (void)point;
    const iccp_field_state *state = chart->state;
    const iccp_flow_place start = iccp_field_place(place);
    double s_down = 0, s_up = 0;
    iccp_flow_jet down, up;
    if (jet != NULL) {
        unit_jet(&down, chart->domain->dim);
        unit_jet(&up, chart->domain->dim);
    }
    icc_status status = walk_down(state, &start, coords, &s_down, jet != NULL ? &down : NULL);
    if (status == ICC_OK)
        status = walk_up(state, &start, &s_up, jet != NULL ? &up : NULL);
    if (status != ICC_OK)
        return status;
    coords->t = s_down / (s_down + s_up);
    if (jet != NULL)
        fill_encode_jet(chart, coords->facet, &down, s_down, &up, s_up, jet);
    return ICC_OK;
}

/* Follows two curves for each point, the one downhill first. */
icc_status iccp_field_encode_many(const icc_chart *chart, size_t n, const size_t *which,
                                  const iccp_chart_place *place, iccp_coords *coords,
                                  double *volume, icc_status *status, iccp_path *path)
{
    const iccp_field_state *state = chart->state;
    const size_t dim = (size_t)chart->domain->dim;
    iccp_flow_curve *curves = iccp_alloc(path->memory, 2 * n, sizeof *curves);
    if (curves == NULL)
        return ICC_ERR_MEMORY;
    for (size_t j = 0; j < n; ++j) {
        const iccp_flow_place start = iccp_field_place(&place[j]);
        curves[2 * j] =
            (iccp_flow_curve){.start = start, .sign = -1, .share = 0, .measured = volume != NULL};
        curves[2 * j + 1] = (iccp_flow_curve){.start = start, .sign = +1};
    }
    const icc_status all = iccp_flow_follow(&state->flow, 2 * n, curves, path->memory);
    for (size_t j = 0; all == ICC_OK && j < n; ++j) {
        const iccp_flow_curve *down = curves + 2 * j, *up = down + 1;
        iccp_coords *own = coords + which[j];
        own->facet = down->facet;
        memcpy(own->bary, down->bary, dim * sizeof *own->bary);
        own->t = down->length / (down->length + up->length);
        if (volume != NULL)
            volume[which[j]] = iccp_field_volume(state, down->volume, down->length + up->length);
        status[which[j]] = down->status != ICC_OK ? down->status : up->status;
    }
    iccp_free(path->memory, curves);
    return all;
}

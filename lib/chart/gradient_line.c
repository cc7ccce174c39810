#include "chart/gradient_line.h"

#include "trace/walkn.h"

#include <string.h>

static bool is_plane(const iccp_gradient_state *state)
{
    return state->tree->grid->dim == 2;
}

static icc_status down_in_plane(const iccp_gradient_state *state, const double *from,
                                iccp_path *path, iccp_jet2 *jet, iccp_gradient_line *line)
{
    iccp_walk2 walk;
    iccp_fence_hit hit;
    icc_status status =
        iccp_walk2_start(&walk, state->field, ICCP_DOWNHILL, from[0], from[1], jet);
    if (status == ICC_OK)
        status = iccp_trace_downhill(&walk, &state->fence, path, &hit);
    if (status == ICC_OK)
        *line = (iccp_gradient_line){.s = walk.s,
                                     .merged = walk.merged,
                                     .facet = hit.facet,
                                     .bary = {1 - hit.along, hit.along}};
    return status;
}

icc_status iccp_gradient_down(const iccp_gradient_state *state, const double *from,
                              iccp_path *path, iccp_jet2 *jet, iccp_gradient_line *line)
{
    if (is_plane(state))
        return down_in_plane(state, from, path, jet, line);
    iccp_walkn walk;
    iccp_cage_hit hit;
    icc_status status = iccp_walkn_start(&walk, state->field, ICCP_DOWNHILL, from, NULL);
    if (status == ICC_OK)
        status = iccp_walkn_downhill(&walk, &state->cage, path, &hit);
    if (status != ICC_OK)
        return status;
    *line = (iccp_gradient_line){.s = walk.s, .merged = walk.merged, .facet = hit.facet};
    memcpy(line->bary, hit.bary, sizeof line->bary);
    return ICC_OK;
}

static icc_status climb_in_plane(iccp_walk2 *walk, iccp_path *path, iccp_gradient_line *line)
{
    double alone;
    const icc_status status = iccp_trace_uphill(walk, path, &alone);
    *line = (iccp_gradient_line){.s = walk->s, .merged = walk->merged, .alone = alone};
    return status;
}

static icc_status climb(iccp_walkn *walk, iccp_path *path, iccp_gradient_line *line)
{
    double alone;
    const icc_status status = iccp_walkn_uphill(walk, path, &alone);
    *line = (iccp_gradient_line){.s = walk->s, .merged = walk->merged, .alone = alone};
    return status;
}

icc_status iccp_gradient_up(const iccp_gradient_state *state, const double *from, iccp_path *path,
                            iccp_jet2 *jet, iccp_gradient_line *line)
{
    icc_status status;
    if (is_plane(state)) {
        iccp_walk2 walk;
        status = iccp_walk2_start(&walk, state->field, ICCP_UPHILL, from[0], from[1], jet);
        return status == ICC_OK ? climb_in_plane(&walk, path, line) : status;
    }
    iccp_walkn walk;
    status = iccp_walkn_start(&walk, state->field, ICCP_UPHILL, from, NULL);
    return status == ICC_OK ? climb(&walk, path, line) : status;
}

icc_status iccp_gradient_up_from(const icc_chart *chart, uint32_t facet, const double *point,
                                 iccp_path *path, iccp_gradient_line *line)
{
    const iccp_gradient_state *state = chart->state;
    icc_status status;
    if (is_plane(state)) {
        iccp_walk2 walk;
        status = iccp_gradient_depart(chart, facet, point, &walk, NULL);
        return status == ICC_OK ? climb_in_plane(&walk, path, line) : status;
    }
    iccp_walkn walk;
    double from[ICC_MAX_DIM], inward[ICC_MAX_DIM];
    iccp_gradient_to_lattice(state, point, from);
    iccp_gradient_inward(chart->domain, facet, inward);
    status = iccp_walkn_start(&walk, state->field, ICCP_UPHILL, from, inward);
    return status == ICC_OK ? climb(&walk, path, line) : status;
}

int iccp_gradient_slope_sign(const iccp_gradient_state *state, const double *at,
                             const double *direction)
{
    return is_plane(state) ? iccp_slope_sign(state->field, at, direction)
                           : iccp_walkn_slope_sign(state->field, at, direction);
}

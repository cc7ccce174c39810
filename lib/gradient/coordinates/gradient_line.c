/* Follows gradient lines from a point to the boundary or to the maximum. */
#include "gradient/coordinates/gradient_line.h"

#include <string.h>

static bool is_plane(const iccp_gradient_state *state)
{
    return state->tree->grid->dim == 2;
}

static void to_plane(const iccp_jetn *jet, iccp_jet2 *flat)
{
    for (int c = 0; c < 2; ++c) {
        flat->x[c] = jet->x[0][c];
        flat->y[c] = jet->x[1][c];
        flat->s[c] = jet->s[c];
    }
}

static void from_plane(const iccp_jet2 *flat, iccp_jetn *jet)
{
    for (int c = 0; c < 2; ++c) {
        jet->x[0][c] = flat->x[c];
        jet->x[1][c] = flat->y[c];
        jet->s[c] = flat->s[c];
    }
}

/* Follows a line downhill in the plane (Algorithm 3). Converts the two-dimensional jet if there is
 * one. */
static icc_status down_in_plane(const iccp_gradient_state *state, const double *from,
                                iccp_path *path, iccp_jetn *jet, iccp_gradient_line *line)
{
    iccp_walk2 walk;
    iccp_boundary_hit2 hit = {0};
    iccp_jet2 flat;
    if (jet != NULL)
        to_plane(jet, &flat);
    icc_status status = iccp_walk2_start(&walk, state->field, ICCP_DOWNHILL, from[0], from[1],
                                         jet != NULL ? &flat : NULL);
    if (status != ICC_OK)
        return status;
    status =
        iccp_trace_downhill(&walk, state->cells2.first != NULL ? &state->cells2 : NULL, path, &hit);
    *line = (iccp_gradient_line){.s = walk.s,
                                 .merged = walk.merged,
                                 .alone = walk.alone,
                                 .facet = hit.facet,
                                 .bary = {1 - hit.along, hit.along}};
    if (status == ICC_OK && jet != NULL)
        from_plane(&flat, jet);
    return status;
}

icc_status iccp_gradient_down(const iccp_gradient_state *state, const double *from, iccp_path *path,
                              iccp_jetn *jet, iccp_gradient_line *line)
{
    if (is_plane(state))
        return down_in_plane(state, from, path, jet, line);
    iccp_walkn walk;
    iccp_boundary_hitn hit = {0};
    icc_status status = iccp_walkn_start(&walk, state->field, ICCP_DOWNHILL, from, NULL, jet);
    if (status != ICC_OK)
        return status;
    status = iccp_walkn_downhill(&walk, state->cellsn.domain != NULL ? &state->cellsn : NULL, path,
                                 &hit);
    *line = (iccp_gradient_line){
        .s = walk.s, .merged = walk.merged, .alone = walk.alone, .facet = hit.facet};
    memcpy(line->bary, hit.bary, sizeof line->bary);
    return status;
}

static icc_status climb_in_plane(iccp_walk2 *walk, iccp_path *path, iccp_gradient_line *line)
{
    const icc_status status = iccp_trace_uphill(walk, path);
    *line = (iccp_gradient_line){.s = walk->s, .merged = walk->merged, .alone = walk->alone};
    return status;
}

static icc_status climb(iccp_walkn *walk, iccp_path *path, iccp_gradient_line *line)
{
    const icc_status status = iccp_walkn_uphill(walk, path);
    *line = (iccp_gradient_line){.s = walk->s, .merged = walk->merged, .alone = walk->alone};
    return status;
}

icc_status iccp_gradient_up(const iccp_gradient_state *state, const double *from, iccp_path *path,
                            iccp_jetn *jet, iccp_gradient_line *line)
{
    icc_status status;
    if (!is_plane(state)) {
        iccp_walkn walk;
        status = iccp_walkn_start(&walk, state->field, ICCP_UPHILL, from, NULL, jet);
        return status == ICC_OK ? climb(&walk, path, line) : status;
    }
    iccp_walk2 walk;
    iccp_jet2 flat;
    if (jet != NULL)
        to_plane(jet, &flat);
    status = iccp_walk2_start(&walk, state->field, ICCP_UPHILL, from[0], from[1],
                              jet != NULL ? &flat : NULL);
    if (status == ICC_OK)
        status = climb_in_plane(&walk, path, line);
    if (status == ICC_OK && jet != NULL)
        from_plane(&flat, jet);
    return status;
}

icc_status iccp_gradient_depart(const iccp_gradient_state *state, uint32_t facet,
                                const double point[2], iccp_walk2 *walk, iccp_jet2 *jet)
{
    double p[2], inward[2];
    iccp_gradient_to_lattice(state, point, p);
    iccp_facet_inward(state->tree->grid->domain, facet, inward);
    const icc_status status = iccp_walk2_start(walk, state->field, ICCP_UPHILL, p[0], p[1], jet);
    if (status == ICC_OK)
        iccp_walk2_face(walk, inward);
    return status;
}

/* iccp_gradient_depart() in other dimensions. */
static icc_status depart(const iccp_gradient_state *state, uint32_t facet, const double *point,
                         iccp_walkn *walk, iccp_jetn *jet)
{
    double from[ICC_MAX_DIM], inward[ICC_MAX_DIM];
    iccp_gradient_to_lattice(state, point, from);
    iccp_facet_inward(state->tree->grid->domain, facet, inward);
    return iccp_walkn_start(walk, state->field, ICCP_UPHILL, from, inward, jet);
}

icc_status iccp_gradient_up_from(const iccp_gradient_state *state, uint32_t facet,
                                 const double *point, iccp_path *path, iccp_gradient_line *line)
{
    icc_status status;
    if (is_plane(state)) {
        iccp_walk2 walk;
        status = iccp_gradient_depart(state, facet, point, &walk, NULL);
        return status == ICC_OK ? climb_in_plane(&walk, path, line) : status;
    }
    iccp_walkn walk;
    status = depart(state, facet, point, &walk, NULL);
    return status == ICC_OK ? climb(&walk, path, line) : status;
}

icc_status iccp_gradient_up_again(const iccp_gradient_state *state, uint32_t facet,
                                  const double *point, const iccp_jetn *jet, size_t piece,
                                  size_t n_steps, iccp_gradient_replay *replay)
{
    const bool plane = is_plane(state);
    iccp_walkn walk;
    iccp_walk2 walk2;
    iccp_jet2 flat;
    replay->end = *jet;
    to_plane(jet, &flat);
    icc_status status = plane ? iccp_gradient_depart(state, facet, point, &walk2, &flat)
                              : depart(state, facet, point, &walk, &replay->end);
    for (size_t k = 0; status == ICC_OK && k < n_steps; ++k) {
        if (k == piece)
            replay->before = replay->end;
        status = plane ? iccp_walk2_step(&walk2) : iccp_walkn_step(&walk);
        if (plane)
            from_plane(&flat, &replay->end);
        if (k == piece)
            replay->after = replay->end;
    }
    return status;
}

int iccp_gradient_slope_sign(const iccp_gradient_state *state, const double *at,
                             const double *direction)
{
    return is_plane(state) ? iccp_slope_sign(state->field, at, direction)
                           : iccp_walkn_slope_sign(state->field, at, direction);
}

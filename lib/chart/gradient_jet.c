#include "chart/gradient_jet.h"

/* d t = (d down * up - down * d up) / length^2, and d along = dq . (b - a) / |b - a|^2. */
void iccp_gradient_encode_jet(const iccp_gradient_state *state, const iccp_gradient_line *down,
                              const iccp_jet2 *down_jet, const iccp_gradient_line *up,
                              const iccp_jet2 *up_jet, iccp_encode_jet *jet)
{
    const iccp_fence *fence = &state->fence;
    const double *a = fence->vertices + 2 * (size_t)fence->ends[2 * (size_t)down->facet];
    const double *b = fence->vertices + 2 * (size_t)fence->ends[2 * (size_t)down->facet + 1];
    const double dx = b[0] - a[0], dy = b[1] - a[1];
    const double length = down->s + up->s, scale = 1 / state->tree->grid->spacing;
    for (int c = 0; c < 2; ++c) {
        const double along =
            (down_jet->x[c] * dx + down_jet->y[c] * dy) / (dx * dx + dy * dy) * scale;
        jet->bary[c] = -along;
        jet->bary[2 + c] = along;
        jet->t[c] =
            (down_jet->s[c] * up->s - down->s * up_jet->s[c]) / (length * length) * scale;
    }
}

/* The derivative by the boundary parameter needs the walk up to the piece that holds the point, and the
 * whole length's: walk again with a jet. The path tells how far. */
icc_status iccp_gradient_decode_jet(const icc_chart *chart, const iccp_coords *coords,
                                    const double boundary[2], const iccp_path *path, size_t piece,
                                    double share, iccp_decode_jet *jet)
{
    const iccp_gradient_state *state = chart->state;
    const uint32_t *ends = chart->domain->facets + 2 * (size_t)coords->facet;
    const double *from = state->fence.vertices + 2 * (size_t)ends[0];
    const double *to = state->fence.vertices + 2 * (size_t)ends[1];
    iccp_jet2 moving = {{to[0] - from[0], 0}, {to[1] - from[1], 0}, {0, 0}};
    iccp_jet2 before = moving, after = moving;
    iccp_walk2 walk;
    icc_status status = iccp_gradient_depart(chart, coords->facet, boundary, &walk, &moving);
    for (size_t k = 0; status == ICC_OK && k + 1 < path->n; ++k) {
        if (k == piece)
            before = moving;
        status = iccp_walk2_step(&walk);
        if (k == piece)
            after = moving;
    }
    if (status != ICC_OK)
        return status;
    const double *a = iccp_path_at(path, piece), *b = iccp_path_at(path, piece + 1);
    const double length = b[2] - a[2], total = iccp_path_length(path);
    const double ds = coords->t * moving.s[0] - before.s[0] - share * (after.s[0] - before.s[0]);
    const double ux = (b[0] - a[0]) / length, uy = (b[1] - a[1]) / length;
    const double h = state->tree->grid->spacing;
    *jet = (iccp_decode_jet){.t = {h * total * ux, h * total * uy}};
    jet->bary[1] = h * (before.x[0] + share * (after.x[0] - before.x[0]) + ds * ux);
    jet->bary[3] = h * (before.y[0] + share * (after.y[0] - before.y[0]) + ds * uy);
    return ICC_OK;
}

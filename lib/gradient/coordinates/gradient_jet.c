/* Derivatives of gradient coordinates. */
#include "gradient/coordinates/gradient_jet.h"

#include "math/vec.h"

#include <math.h>
#include <string.h>

void iccp_gradient_identity(int32_t dim, iccp_jetn *jet)
{
    memset(jet, 0, sizeof *jet);
    for (int32_t k = 0; k < dim; ++k)
        jet->x[k][k] = 1;
}

/* Computes the edges of a facet from its first corner, in local coordinates. */
static void find_edges(const icc_domain *domain, uint32_t facet,
                       double edge[ICC_MAX_DIM][ICC_MAX_DIM])
{
    const double *corners[ICC_MAX_DIM];
    iccp_facet_corners(&domain->tree, facet, corners);
    for (int32_t i = 1; i < domain->dim; ++i)
        for (int32_t k = 0; k < domain->dim; ++k)
            edge[i - 1][k] = corners[i][k] - corners[0][k];
}

/* Writes a vector in the facet's plane as a combination of the edges: least squares, by
 * elimination. */
static void along_edges(int32_t dim, double edge[ICC_MAX_DIM][ICC_MAX_DIM], const double *vector,
                        double *share)
{
    const int32_t n = dim - 1;
    double gram[ICC_MAX_DIM][ICC_MAX_DIM];
    for (int32_t i = 0; i < n; ++i) {
        share[i] = iccp_vec_dot((size_t)dim, edge[i], vector);
        for (int32_t j = 0; j < n; ++j)
            gram[i][j] = iccp_vec_dot((size_t)dim, edge[i], edge[j]);
    }
    for (int32_t c = 0; c < n; ++c)
        for (int32_t i = c + 1; i < n; ++i) {
            const double factor = gram[i][c] / gram[c][c];
            share[i] -= factor * share[c];
            for (int32_t j = c; j < n; ++j)
                gram[i][j] -= factor * gram[c][j];
        }
    for (int32_t i = n; i-- > 0;) {
        for (int32_t j = i + 1; j < n; ++j)
            share[i] -= gram[i][j] * share[j];
        share[i] /= gram[i][i];
    }
}

/* d t = (d down * up - down * d up) / length^2. */
void iccp_gradient_encode_jet(const icc_chart *chart, const iccp_gradient_line *down,
                              const iccp_jetn *down_jet, const iccp_gradient_line *up,
                              const iccp_jetn *up_jet, iccp_encode_jet *jet)
{
    const iccp_gradient_state *state = chart->state;
    const int32_t dim = chart->domain->dim;
    const double length = down->s + up->s, scale = 1 / state->tree->grid->spacing;
    double edge[ICC_MAX_DIM][ICC_MAX_DIM];
    find_edges(chart->domain, down->facet, edge);
    for (int32_t c = 0; c < dim; ++c) {
        double foot[ICC_MAX_DIM], share[ICC_MAX_DIM], sum = 0;
        /* Both the point and its foot are local, so the spacing cancels. */
        for (int32_t k = 0; k < dim; ++k)
            foot[k] = down_jet->x[k][c];
        along_edges(dim, edge, foot, share);
        for (int32_t i = 1; i < dim; ++i) {
            jet->bary[i * dim + c] = share[i - 1];
            sum += share[i - 1];
        }
        jet->bary[c] = -sum;
        jet->t[c] = (down_jet->s[c] * up->s - down->s * up_jet->s[c]) / (length * length) * scale;
    }
}

/* The derivative with respect to the boundary point needs the walk up to the piece that contains
 * the point, and that of the whole length. So the walk is repeated with a jet. The path tells how
 * far to go. */
icc_status iccp_gradient_decode_jet(const icc_chart *chart, const iccp_coords *coords,
                                    const double *boundary, const iccp_path *path, size_t piece,
                                    double share, iccp_decode_jet *jet)
{
    const iccp_gradient_state *state = chart->state;
    const int32_t dim = chart->domain->dim;
    const double h = state->tree->grid->spacing;
    double edge[ICC_MAX_DIM][ICC_MAX_DIM];
    iccp_jetn moving = {{{0}}, {0}};
    iccp_gradient_replay line;
    find_edges(chart->domain, coords->facet, edge);
    for (int32_t k = 0; k < dim; ++k)
        for (int32_t c = 0; c + 1 < dim; ++c)
            moving.x[k][c] = edge[c][k] / h;
    const icc_status status = iccp_gradient_up_again(chart->state, coords->facet, boundary, &moving,
                                                     piece, path->n - 1, &line);
    if (status != ICC_OK)
        return status;
    const double *a = iccp_path_at(path, piece), *b = iccp_path_at(path, piece + 1);
    const double length = b[dim] - a[dim], total = iccp_path_length(path);
    *jet = (iccp_decode_jet){.t = {0}};
    for (int32_t k = 0; k < dim; ++k) {
        const double direction = (b[k] - a[k]) / length;
        jet->t[k] = h * total * direction;
        for (int32_t c = 0; c + 1 < dim; ++c) {
            const double before = line.before.x[k][c], after = line.after.x[k][c];
            const double ds = coords->t * line.end.s[c] - line.before.s[c] -
                              share * (line.after.s[c] - line.before.s[c]);
            jet->bary[k * dim + c + 1] = h * (before + share * (after - before) + ds * direction);
        }
    }
    return ICC_OK;
}

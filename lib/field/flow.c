/* Curves of a field that is linear in each simplex, piece by piece. flow_piece.c explains what a
 * piece is. Source: docs/theory/charts-space.md, "fields on grids", step 3. */
#include "field/flow_piece.h"

#include "base/minmax.h"
#include "geometry/simplex.h"

#include <math.h>
#include <string.h>

/* ---- places ---- */

bool iccp_flow_find(const iccp_flow *flow, const double *x, const double *ahead,
                    iccp_flow_place *place)
{
    static const double NUDGE = 1e-12; /* lattice units; more than the rounding of x */
    const icc_grid *grid = flow->grid;
    const int32_t dim = grid->dim;
    double nudged[ICC_MAX_DIM] = {0}, lambda[ICC_MAX_DIM + 1];
    for (int32_t k = 0; k < dim; ++k)
        nudged[k] = x[k] + (ahead != NULL ? NUDGE * ahead[k] : 0);
    if (!iccp_kuhn_simplex_at(&place->simplex, grid, nudged, lambda))
        return false;
    place->entry = ICCP_FLOW_WITHIN;
    double above = 1;
    for (int32_t k = 0; k < dim; ++k) {
        const int8_t axis = place->simplex.axis[k];
        const double at = x[axis] - iccp_grid_coordinate(grid, place->simplex.corner[0], axis);
        place->at[axis] = iccp_min(iccp_max(at, 0), above);
        above = place->at[axis];
    }
    return true;
}

void iccp_flow_position(const iccp_flow *flow, const iccp_flow_place *place, const double *at,
                        double *x)
{
    for (int32_t k = 0; k < flow->grid->dim; ++k)
        x[k] = iccp_grid_coordinate(flow->grid, place->simplex.corner[0], k) + at[k];
}

void iccp_flow_vector(const iccp_flow *flow, const iccp_flow_place *place, double *vector)
{
    const int32_t dim = flow->grid->dim;
    const int32_t r = iccp_order_rank(dim, place->simplex.axis);
    double above = 1;
    memset(vector, 0, (size_t)dim * sizeof *vector);
    for (int32_t i = 0; i <= dim; ++i) {
        const double below = i < dim ? place->at[place->simplex.axis[i]] : 0;
        const float *x = iccp_vectors_at(flow->vectors, place->simplex.corner[i], r, i);
        for (int32_t k = 0; k < dim; ++k)
            vector[k] += (above - below) * (double)x[k];
        above = below;
    }
}

bool iccp_flow_near_boundary(const iccp_flow *flow, const iccp_flow_place *place)
{
    const uint32_t lowest = place->simplex.corner[0];
    return flow->incidence->bits[lowest] != 0 &&
           iccp_incidence_has(flow->incidence, lowest,
                              iccp_order_rank(flow->grid->dim, place->simplex.axis));
}

/* ---- walking ---- */

icc_status iccp_flow_cross(iccp_flow_walk *walk)
{
    return walk->flow->grid->dim == 3 ? iccp_flow_cross_in(walk, 3)
                                      : iccp_flow_cross_in(walk, walk->flow->grid->dim);
}

void iccp_flow_begin(iccp_flow_walk *walk, const iccp_flow *flow, int32_t sign,
                     const iccp_flow_place *place)
{
    walk->flow = flow;
    walk->sign = sign;
    walk->place = *place;
    walk->length = 0;
    walk->growth = 0;
    walk->n_steps = 0;
    walk->ends = false;
}

icc_status iccp_flow_start(iccp_flow_walk *walk, const iccp_flow *flow, int32_t sign,
                           const iccp_flow_place *place)
{
    iccp_flow_begin(walk, flow, sign, place);
    return iccp_flow_find_piece(walk);
}

icc_status iccp_flow_next(iccp_flow_walk *walk)
{
    const icc_status status = iccp_flow_cross(walk);
    return status == ICC_OK ? iccp_flow_find_piece(walk) : status;
}

icc_status iccp_flow_note(const iccp_flow_walk *walk, iccp_path *path)
{
    if (path->n_marks == path->mark_capacity) {
        const size_t capacity = path->mark_capacity > 0 ? 2 * path->mark_capacity : 256;
        iccp_flow_mark *marks =
            iccp_grow(path->memory, path->marks, path->n_marks, capacity, sizeof *marks);
        if (marks == NULL)
            return ICC_ERR_MEMORY;
        path->marks = marks;
        path->mark_capacity = capacity;
    }
    path->marks[path->n_marks++] = (iccp_flow_mark){walk->place, walk->length, walk->growth};
    return ICC_OK;
}

icc_status iccp_flow_rewind(iccp_flow_walk *walk, const iccp_path *path, double length)
{
    size_t low = 0, high = path->n_marks;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (path->marks[middle].length <= length)
            low = middle;
        else
            high = middle;
    }
    const icc_status status =
        iccp_flow_start(walk, walk->flow, walk->sign, &path->marks[low].place);
    walk->length = path->marks[low].length;
    walk->growth = path->marks[low].growth;
    return status;
}

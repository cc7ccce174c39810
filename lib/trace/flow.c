/* Curves of a field that is linear in each simplex, piece by piece. What a piece is: flow_piece.c. */
#include "trace/flow_piece.h"

#include "domain/simplex.h"

#include <math.h>
#include <string.h>

/* ---- places ---- */

bool iccp_flow_find(const iccp_flow *flow, const double *x, const double *ahead,
                    iccp_flow_place *place)
{
    static const double NUDGE = 1e-12; /* lattice units: beyond the rounding of x */
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
        place->at[axis] = fmin(fmax(at, 0), above);
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
        const float *x = iccp_cones_vector(flow->cones, place->simplex.corner[i], r, i);
        for (int32_t k = 0; k < dim; ++k)
            vector[k] += (above - below) * (double)x[k];
        above = below;
    }
}

bool iccp_flow_near_boundary(const iccp_flow *flow, const iccp_flow_place *place)
{
    const uint32_t lowest = place->simplex.corner[0];
    return flow->cover->bits[lowest] != 0 &&
           iccp_cover_has(flow->cover, lowest,
                          iccp_order_rank(flow->grid->dim, place->simplex.axis));
}

static ICCP_INLINE void load_corner(iccp_flow_walk *w, int32_t dim, int32_t i)
{
    const uint32_t v = w->place.simplex.corner[i];
    const float *x = w->flow->cones->vector + (size_t)dim * v;
    if (ICCP_UNLIKELY(x[0] >= ICCP_SEVERAL))
        x = iccp_cones_vector(w->flow->cones, v, iccp_order_rank(dim, w->place.simplex.axis), i);
    for (int32_t k = 0; k < dim; ++k)
        w->corner[i][k] = w->sign * (double)x[k];
}

/* ---- walking ---- */

/* Onto the facet, exactly, and no corner's weight negative; then across. */
static ICCP_INLINE icc_status cross(iccp_flow_walk *w, int32_t dim)
{
    iccp_flow_place *p = &w->place;
    const int32_t i = w->exit;
    const int8_t *axis = p->simplex.axis;
    double above = 1, *at = w->finish;
    if (i > 0 && i < dim)
        at[axis[i - 1]] = at[axis[i]] = 0.5 * (at[axis[i - 1]] + at[axis[i]]);
    for (int32_t k = 0; k < dim; ++k) {
        double x = at[axis[k]];
        x = x > above ? above : x;
        x = x < 0 ? 0 : x;
        p->at[axis[k]] = above = x;
    }
    p->entry = ICCP_FLOW_WITHIN;
    if (i == ICCP_FLOW_WITHIN)
        return ICC_OK;
    if (i == 0)
        p->at[axis[0]] = 0;
    if (i == dim)
        p->at[axis[dim - 1]] = 1;
    if (!iccp_kuhn_simplex_cross(&p->simplex, w->flow->grid, i, &p->entry))
        return ICC_ERR_TRACE;
    for (int32_t c = 0; i == 0 && c < dim; ++c)
        for (int32_t k = 0; k < dim; ++k)
            w->corner[c][k] = w->corner[c + 1][k];
    for (int32_t c = dim; i == dim && c > 0; --c)
        for (int32_t k = 0; k < dim; ++k)
            w->corner[c][k] = w->corner[c - 1][k];
    load_corner(w, dim, p->entry);
    return ICC_OK;
}

static ICCP_INLINE icc_status start(iccp_flow_walk *w, int32_t dim)
{
    for (int32_t i = 0; i <= dim; ++i)
        load_corner(w, dim, i);
    return iccp_flow_find_piece(w);
}

icc_status iccp_flow_start(iccp_flow_walk *walk, const iccp_flow *flow, int32_t sign,
                           const iccp_flow_place *place)
{
    walk->flow = flow;
    walk->sign = sign;
    walk->place = *place;
    walk->length = 0;
    walk->n_steps = 0;
    walk->ends = false;
    return flow->grid->dim == 3 ? start(walk, 3) : start(walk, flow->grid->dim);
}

static ICCP_INLINE icc_status go_on(iccp_flow_walk *w, int32_t dim)
{
    w->length += w->end_length;
    if (++w->n_steps > w->flow->most_steps)
        return ICC_ERR_TRACE;
    const icc_status status = cross(w, dim);
    return status == ICC_OK ? iccp_flow_find_piece(w) : status;
}

icc_status iccp_flow_next(iccp_flow_walk *walk)
{
    return walk->flow->grid->dim == 3 ? go_on(walk, 3) : go_on(walk, walk->flow->grid->dim);
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
    path->marks[path->n_marks++] = (iccp_flow_mark){walk->place, walk->length};
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
    return status;
}

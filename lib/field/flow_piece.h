/* One piece of a curve: from its place in a simplex to where it leaves that simplex. Source:
 * docs/theory/charts-space.md, "fields on grids", step 3. */
#ifndef ICCP_FLOW_PIECE_H
#define ICCP_FLOW_PIECE_H

#include "field/flow.h"

/* Finds the piece that starts at walk->place. */
icc_status iccp_flow_find_piece(iccp_flow_walk *walk);

/* Like iccp_flow_find_piece(), with all safeguards. `end` is a guess of walk->end if it is
 * positive. */
icc_status iccp_flow_find_piece_slowly(iccp_flow_walk *walk, double end);

/* The corner of a place's simplex that is the root, or ICCP_FLOW_WITHIN. */
static inline int32_t iccp_flow_root_corner(const iccp_flow *flow, const iccp_flow_place *place,
                                            int32_t dim)
{
    int32_t corner = ICCP_FLOW_WITHIN;
    for (int32_t i = 0; i <= dim; ++i)
        corner = place->simplex.corner[i] == flow->root ? i : corner;
    return corner;
}

/* Finds a piece in a simplex at the root: straight to the root, or away from it to the opposite
 * facet. */
icc_status iccp_flow_find_radial(iccp_flow_walk *walk, int32_t corner);

/* Puts the end of a piece exactly on the facet, with no negative weight of a corner. Then
 * crosses into the next simplex. */
static ICCP_INLINE icc_status iccp_flow_cross_in(iccp_flow_walk *w, int32_t dim)
{
    w->length += w->end_length;
    w->growth += w->end_growth;
    if (++w->n_steps > w->flow->most_steps)
        return ICC_ERR_TRACE;
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
    if (!iccp_kuhn_simplex_cross_in(&p->simplex, dim, w->flow->grid, i, &p->entry))
        return ICC_ERR_TRACE;
    ICCP_PREFETCH(w->flow->vectors->vector + (size_t)dim * p->simplex.corner[p->entry]);
    return ICC_OK;
}

/* Goes from the end of a piece into the next simplex. */
icc_status iccp_flow_cross(iccp_flow_walk *walk);

#endif

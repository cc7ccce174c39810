/* Finds where a piece of a curve meets the boundary. Source: docs/theory/charts-space.md, "fields
 * on grids", step 4. */
#include "field/flow.h"

#include "base/minmax.h"
#include "geometry/simplex.h"

#include <math.h>
#include <string.h>

/* The local coordinates of a place in the cell. */
static void local_of(const iccp_flow_walk *w, const double *at, double *local)
{
    const icc_grid *grid = w->flow->grid;
    iccp_flow_position(w->flow, &w->place, at, local);
    for (int32_t k = 0; k < grid->dim; ++k)
        local[k] = grid->origin[k] + grid->spacing * local[k];
}

/* Finds near `guess` where the piece meets the plane of a facet. Returns the squared distance of
 * that point from the facet. */
static double meet_plane(const iccp_flow_walk *w, uint32_t facet, double guess, double *s,
                         double *bary)
{
    const icc_domain *domain = w->flow->domain;
    const icc_grid *grid = w->flow->grid;
    const int32_t dim = grid->dim;
    const double *normal = w->flow->incidence->normal + (size_t)dim * facet;
    const double *corner[ICC_MAX_DIM];
    double height[ICCP_FLOW_TERMS + 1] = {0}, local[ICC_MAX_DIM], at[ICC_MAX_DIM];
    iccp_facet_corners(&domain->tree, facet, corner);
    local_of(w, w->place.at, local);
    for (int32_t k = 0; k < dim; ++k) {
        height[0] += normal[k] * ((local[k] - corner[0][k]) / grid->spacing);
        for (int32_t j = 0; j < w->n_terms; ++j)
            height[j + 1] += normal[k] * w->term[j][k] * (w->scale / (j + 1));
    }
    double share = guess / w->scale;
    for (int step = 0; step < 8; ++step) {
        double value = 0, slope = 0;
        for (int32_t j = w->n_terms + 1; j-- > 0;) {
            slope = slope * share + value;
            value = value * share + height[j];
        }
        if (!(fabs(value / slope) * w->scale <= w->end))
            break;
        share = iccp_min(iccp_max(share - value / slope, 0), w->end / w->scale);
    }
    *s = share * w->scale;
    iccp_flow_at(w, *s, at);
    local_of(w, at, local);
    return iccp_simplex_nearest((size_t)dim, (size_t)dim, corner, local, bary);
}

bool iccp_flow_leaves(const iccp_flow_walk *walk, double *s, uint32_t *facet, double *bary)
{
    static const double SAME = 1e-11;   /* lattice units; the curve meets the facet itself */
    static const double FURTHER = 1e-9; /* relative to the piece, which may end on the boundary up
                                           to rounding */
    const icc_domain *domain = walk->flow->domain;
    const icc_grid *grid = walk->flow->grid;
    double from[ICC_MAX_DIM], to[ICC_MAX_DIM], share;
    if (!iccp_flow_near_boundary(walk->flow, &walk->place))
        return false;
    local_of(walk, walk->place.at, from);
    local_of(walk, walk->finish, to);
    for (int32_t k = 0; k < grid->dim; ++k)
        to[k] += FURTHER * (to[k] - from[k]);
    if (!iccp_domain_cross(domain, from, to, &share, facet, bary))
        return false;
    const double same2 = SAME * grid->spacing * SAME * grid->spacing;
    const double guess = share * walk->end;
    if (meet_plane(walk, *facet, guess, s, bary) <= same2)
        return true;
    /* The curve bulges to one side of the chord and may meet another facet close by. */
    iccp_facet_query query;
    double box[2 * ICC_MAX_DIM], best = HUGE_VAL;
    const int32_t dim = grid->dim;
    for (int32_t k = 0; k < dim; ++k) {
        const double reach = 0.1 * grid->spacing;
        box[k] = iccp_min(from[k], to[k]) - reach;
        box[dim + k] = iccp_max(from[k], to[k]) + reach;
    }
    uint32_t other;
    iccp_facet_query_start(&query, iccp_domain_tree(domain), box);
    while (iccp_facet_query_next(&query, &other)) {
        double other_s, other_bary[ICC_MAX_DIM];
        const double distance2 = meet_plane(walk, other, guess, &other_s, other_bary);
        if (distance2 <= same2 && fabs(other_s - guess) < best) {
            best = fabs(other_s - guess);
            *s = other_s;
            *facet = other;
            memcpy(bary, other_bary, (size_t)dim * sizeof *bary);
        }
    }
    if (best < HUGE_VAL)
        return true;
    (void)meet_plane(walk, *facet, guess, s, bary);
    return true;
}

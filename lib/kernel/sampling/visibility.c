/* Where points are in a shape, and what they see. Exact signs decide whether a wall is in
 * between. */
#include "kernel/sampling/shape.h"

#include "base/minmax.h"
#include "geometry/away.h"
#include "geometry/crossings.h"
#include "geometry/inside.h"
#include "geometry/simplex.h"
#include "math/orient.h"
#include "math/vec.h"

#include <math.h>

/* In units of the straight way. Points on two legs of a curve see each other down to an angle of 60
 * degrees. */
static const double LONGEST_DETOUR = 2 * (1 + 1e-12);

/* Returns the smallest of the nested regions around a point, which is on no wall except perhaps on
 * those of the region `except`. That region does not count. */
static uint32_t innermost(const icc_shape *shape, const double *point, uint32_t except)
{
    uint32_t found = ICCP_NOWHERE;
    double least = HUGE_VAL;
    for (uint32_t r = 0; r < shape->n_regions; ++r) {
        const icc_domain *d = shape->regions[r];
        double local[3];
        if (r == except)
            continue;
        iccp_frame_in(&d->frame, d->dim, point, local);
        if (iccp_domain_locate(d, local, true, NULL, NULL) == ICC_OUTSIDE)
            continue;
        double size = d->measure;
        for (int32_t k = 0; k < d->dim; ++k)
            size *= d->frame.out[0] * shape->frame.in[0] * (d->frame.out[1] * shape->frame.in[1]);
        if (found == ICCP_NOWHERE || size < least) {
            found = r;
            least = size;
        }
    }
    return found;
}

iccp_spot iccp_shape_spot(const icc_shape *shape, const double *point)
{
    double local[3], bary[3], distance2;
    iccp_spot spot = {
        .clearance = HUGE_VAL, .wall = ICCP_NOWHERE, .region = ICCP_NOWHERE, .curve = ICCP_NOWHERE};
    iccp_frame_in(&shape->frame, (int32_t)shape->dim, point, local);
    iccp_away_reach(shape->dim, local, spot.at);
    if (shape->walls.n > 0) {
        const uint32_t f = iccp_facet_tree_nearest(&shape->walls, spot.at, bary, &distance2);
        spot.clearance = sqrt(distance2);
        spot.wall = spot.clearance <= shape->tolerance ? f : ICCP_NOWHERE;
        spot.region =
            spot.wall != ICCP_NOWHERE ? shape->owner[f] : innermost(shape, point, ICCP_NOWHERE);
    }
    if (shape->curves.n > 0) {
        const uint32_t s = iccp_facet_tree_nearest(&shape->curves, spot.at, bary, &distance2);
        if (sqrt(distance2) <= ICCP_ON_LINE + shape->tolerance)
            spot.curve = s;
    }
    return spot;
}

iccp_spot iccp_shape_spot_beside(const icc_shape *shape, const iccp_spot *other,
                                 const double *point, double reach)
{
    iccp_spot spot = *other;
    double local[3];
    iccp_frame_in(&shape->frame, (int32_t)shape->dim, point, local);
    iccp_away_reach(shape->dim, local, spot.at);
    spot.clearance = other->clearance - iccp_vec_distance(shape->dim, spot.at, other->at);
    if (!(spot.clearance > reach + shape->tolerance))
        return iccp_shape_spot(shape, point);
    spot.curve = ICCP_NOWHERE;
    spot.beside = true;
    return spot;
}

uint32_t iccp_shape_region(const icc_shape *shape, const double *point)
{
    return iccp_shape_spot(shape, point).region;
}

uint32_t iccp_shape_parent(const icc_shape *shape, uint32_t region)
{
    const icc_domain *d = shape->regions[region];
    double point[3];
    iccp_domain_given(d, d->facets[0], point);
    return innermost(shape, point, region);
}

bool iccp_shape_holds(const icc_shape *shape, const double *point)
{
    const iccp_spot spot = iccp_shape_spot(shape, point);
    return spot.region != ICCP_NOWHERE || spot.curve != ICCP_NOWHERE;
}

/* -------------------------------------------------------------- visibility */

static bool stands_on(const icc_shape *shape, const iccp_spot *spot, uint32_t wall)
{
    const double *corners[3];
    double bary[3];
    if (spot->wall == ICCP_NOWHERE)
        return false;
    iccp_facet_corners(&shape->walls, wall, corners);
    const double distance2 = iccp_simplex_nearest(shape->dim, shape->dim, corners, spot->at, bary);
    return sqrt(distance2) <= shape->tolerance;
}

/* Returns true if a spot is in the plane of a wall, to the precision known at its distance. */
static bool in_plane(const icc_shape *shape, const iccp_spot *spot, uint32_t wall)
{
    const size_t dim = shape->dim;
    const double *c[4];
    iccp_facet_corners(&shape->walls, wall, c);
    c[dim] = spot->at;
    double size = iccp_vec_distance(dim, c[0], c[1]), area = size;
    if (dim == 3) {
        const double b = iccp_vec_distance(3, c[1], c[2]), d = iccp_vec_distance(3, c[2], c[0]),
                     h = 0.5 * (size + b + d);
        area = 2 * sqrt(iccp_max(h * (h - size) * (h - b) * (h - d), 0));
        size = sqrt(area);
    }
    const double slack = shape->tolerance * (1 + iccp_vec_distance(dim, c[0], spot->at) / size);
    return fabs(iccp_orient_value(dim, c)) <= slack * area;
}

/* The wall on which an end stands is met only there, except for rounding. If both points are on
 * walls, the segment may also meet, up to rounding, a straight continuation of these walls. */
static bool passes(const icc_shape *shape, const iccp_spot *a, const iccp_spot *b, uint32_t wall)
{
    if (stands_on(shape, a, wall) || stands_on(shape, b, wall))
        return true;
    return a->wall != ICCP_NOWHERE && b->wall != ICCP_NOWHERE && in_plane(shape, a, wall) &&
           in_plane(shape, b, wall);
}

/* Returns true if a wall crosses the segment between two spots, except those that passes()
 * allows. */
static bool blocked(const icc_shape *shape, const iccp_spot *a, const iccp_spot *b)
{
    const size_t dim = shape->dim;
    double box[6], share;
    iccp_facet_query query;
    uint32_t wall;
    for (size_t k = 0; k < dim; ++k) {
        box[k] = iccp_min(a->at[k], b->at[k]);
        box[dim + k] = iccp_max(a->at[k], b->at[k]);
    }
    iccp_facet_query_start(&query, &shape->walls, box);
    query.from = a->at;
    query.to = b->at;
    while (iccp_facet_query_next(&query, &wall))
        if (iccp_segment_meets(&shape->walls, wall, a->at, b->at, &share) &&
            !passes(shape, a, b, wall))
            return true;
    return false;
}

/* Returns the region of a segment that meets no wall between its ends. */
static uint32_t region_between(const icc_shape *shape, const iccp_spot *a, const iccp_spot *b)
{
    double middle[3], point[3];
    if (a->wall == ICCP_NOWHERE)
        return a->region;
    if (b->wall == ICCP_NOWHERE)
        return b->region;
    for (size_t k = 0; k < shape->dim; ++k)
        middle[k] = 0.5 * (a->at[k] + b->at[k]);
    iccp_frame_out(&shape->frame, (int32_t)shape->dim, middle, point);
    return iccp_shape_region(shape, point);
}

/* Tries the cheap tests first: most pairs of neighbours are in one ball that no wall reaches. */
static bool sees_through_region(const icc_shape *shape, const iccp_spot *a, const iccp_spot *b)
{
    if (a->region == ICCP_NOWHERE && a->curve != ICCP_NOWHERE)
        return false;
    if (a->wall != ICCP_NOWHERE && a->wall == b->wall)
        return true;
    /* Both are well within a ball without walls. */
    if (iccp_vec_distance(shape->dim, a->at, b->at) <
        iccp_max(a->clearance, b->clearance) - 2 * shape->tolerance)
        return true;
    return !blocked(shape, a, b) && region_between(shape, a, b) == a->region;
}

typedef struct step {
    uint32_t segment, vertex; /* where it comes from, and where it goes */
    double way;
} step;

/* Follows the curves, at forks all of them, as long as the way is short. The limits are reached
 * only in dense tangles, where a point need not see every other one. */
static bool sees_along_curve(const icc_shape *shape, const iccp_spot *a, const iccp_spot *b)
{
    enum { MOST_OPEN = 32, MOST_STEPS = 512 };
    const iccp_segment_graph *graph = &shape->graph;
    step open[MOST_OPEN];
    size_t n = 0;
    if (a->curve == ICCP_NOWHERE || b->curve == ICCP_NOWHERE || a->curve == b->curve)
        return a->curve != ICCP_NOWHERE && a->curve == b->curve;
    const double longest = LONGEST_DETOUR * iccp_vec_distance(shape->dim, a->at, b->at);
    for (int i = 0; i < 2; ++i) {
        const uint32_t v = shape->segments[2 * (size_t)a->curve + (size_t)i];
        open[n++] = (step){
            a->curve, v, iccp_vec_distance(shape->dim, a->at, iccp_segment_graph_vertex(graph, v))};
    }
    for (int steps = 0; n > 0 && steps < MOST_STEPS; ++steps) {
        const step at = open[--n];
        const double rest =
            iccp_vec_distance(shape->dim, b->at, iccp_segment_graph_vertex(graph, at.vertex));
        if (at.way + rest > longest)
            continue;
        for (uint32_t i = graph->first[at.vertex]; i < graph->first[at.vertex + 1]; ++i) {
            const uint32_t s = graph->incident[i],
                           v = iccp_segment_graph_other_end(graph, s, at.vertex);
            if (s == b->curve)
                return true;
            if (s != at.segment && n < MOST_OPEN)
                open[n++] = (step){s, v, at.way + iccp_segment_graph_length(graph, at.vertex, v)};
        }
    }
    return false;
}

bool iccp_spot_sees(const icc_shape *shape, const iccp_spot *a, const iccp_spot *b)
{
    return sees_through_region(shape, a, b) || sees_along_curve(shape, a, b);
}

bool iccp_shape_sees(const icc_shape *shape, const double *a, const double *b)
{
    const iccp_spot from = iccp_shape_spot(shape, a), to = iccp_shape_spot(shape, b);
    return iccp_spot_sees(shape, &from, &to);
}

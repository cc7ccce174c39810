/* Writes the knots of a chain that slides. It merges the corners of source and target, as a curve
 * takes lengths of the one to lengths of the other. */
#include "map/slide/merge_corners.h"

#include "base/minmax.h"

#include <math.h>

/* A corner whose image comes so close to a corner of the target goes there, because slivers beside
 * the chain cost more than it loses. The unit is the shortest side at each of the two corners. */
static const double NEAR = 0.05;

/* Returns the length on the other side where the curve has a length of this side. *at is the point
 * of the curve before it; let lengths rise from call to call. */
static double look_up(const iccp_chain_way *way, int side, double length, size_t *at)
{
    while (*at + 2 < way->n_points && way->curve[2 * (*at + 1) + (size_t)side] < length)
        ++*at;
    const double *a = way->curve + 2 * *at, *b = a + 2;
    const double share = (length - a[side]) / (b[side] - a[side]);
    return a[1 - side] + iccp_min(iccp_max(share, 0), 1) * (b[1 - side] - a[1 - side]);
}

static double corner_length(const iccp_chain_way *way, size_t corner, int side)
{
    return way->corner[2 * corner + (size_t)side];
}

/* Returns the shorter of the two sides at a corner. */
static double shortest_side(const iccp_chain_way *way, size_t corner, int side)
{
    const double at = corner_length(way, corner, side);
    return iccp_min(at - corner_length(way, corner - 1, side),
                    corner_length(way, corner + 1, side) - at);
}

/* Writes a knot behind the last one: at a corner of the source, of the target, or of both. Where it
 * is at no corner, its length is `at`. Returns false if that is not behind the last knot. */
static bool add_knot(iccp_knot *last, const iccp_chain_way *way, const size_t corner[2],
                     const bool is_corner[2], double at)
{
    iccp_knot knot = {{0}, {0}};
    bool is_good = true;
    for (int side = 0; side < 2; ++side) {
        knot.at[side] = (uint32_t)(is_corner[side] ? corner[side] : corner[side] - 1);
        if (is_corner[side])
            continue;
        const double begin = corner_length(way, corner[side] - 1, side);
        const double end = corner_length(way, corner[side], side);
        knot.along[side] = (at - begin) / (end - begin);
        is_good &= knot.along[side] > (last->at[side] == knot.at[side] ? last->along[side] : 0) &&
                   knot.along[side] < 1;
    }
    last[1] = knot;
    return is_good;
}

bool iccp_merge_corners(iccp_knot *knot, size_t *n_knots, const iccp_chain_way *way)
{
    const size_t n_sides = way->n_sides;
    size_t corner[2] = {1, 1}, at[2] = {0, 0};
    bool is_good = true;
    while (is_good && (corner[0] < n_sides || corner[1] < n_sides)) {
        const size_t p = corner[0], q = corner[1];
        const double here[2] = {corner_length(way, p, 0), corner_length(way, q, 1)};
        const double there[2] = {look_up(way, 0, here[0], &at[0]),
                                 look_up(way, 1, here[1], &at[1])};
        bool is[2] = {p < n_sides && (q == n_sides || there[0] < here[1]), false};
        is[1] = !is[0];
        if (p < n_sides && q < n_sides &&
            fabs(there[0] - here[1]) <= NEAR * shortest_side(way, q, 1) &&
            fabs(there[1] - here[0]) <= NEAR * shortest_side(way, p, 0))
            is[0] = is[1] = true;
        is_good = add_knot(&knot[*n_knots - 1], way, corner, is, is[0] ? there[0] : there[1]);
        ++*n_knots;
        corner[0] += is[0];
        corner[1] += is[1];
    }
    return is_good;
}

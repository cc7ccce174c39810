/* Writes the knots of a chain that slides, from lengths along it. */
#ifndef ICCP_MERGE_CORNERS_H
#define ICCP_MERGE_CORNERS_H

#include "map/slide/knots.h"

/* How a chain is mapped. Lengths come in pairs, before and after the map. */
typedef struct iccp_chain_way {
    size_t n_sides;
    double *corner; /* 2 (n_sides + 1): of the chain up to each corner of the source and target */
    size_t n_points;
    double *curve; /* 2 n_points, rising: a length of the chain goes to another one */
} iccp_chain_way;

/* Adds a knot for each corner of source and target, in the order of the curve. Corners that are
 * near each other get one knot. `knot` has *n_knots knots, the last of them at the stop where the
 * chain begins. The other stop is not added. Returns false if rounding would swap knots. */
bool iccp_merge_corners(iccp_knot *knot, size_t *n_knots, const iccp_chain_way *way);

#endif

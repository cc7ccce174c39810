/* Finds pairs of items that meet among many long, thin ones that come near one another. */
#ifndef ICCP_NEAR_PAIRS_H
#define ICCP_NEAR_PAIRS_H

#include "base/env.h"

#include <stdbool.h>
#include <stdint.h>

enum { ICCP_PIECE_CORNERS = 8 };

/* The part of an item within a part of space: a convex polygon, a segment or a point. */
typedef struct iccp_piece {
    double corner[ICCP_PIECE_CORNERS][3];
    uint32_t n; /* corners */
    uint32_t n_cuts;
    uint32_t item, group;
} iccp_piece;

typedef struct iccp_near_pairs {
    const iccp_env *env;
    bool (*meet)(void *context, uint32_t a, uint32_t b); /* decides about two items, exactly */
    void *context;
    double share;  /* of the call, to report */
    double n_free; /* pieces that may be looked at before a budget pays for them */
    double size;   /* no coordinate of a piece is greater */
    iccp_piece *pieces;
    size_t n, capacity;
    double *spans; /* two for each piece */
    size_t n_spans;
    bool met;          /* two items meet: nothing else is compared */
    icc_status status; /* ICC_ERR_CANCELLED also where a budget does not allow the work */
} iccp_near_pairs;

/* Adds a piece without corners. Without memory it returns NULL and sets `status`. */
iccp_piece *iccp_near_pairs_add(iccp_near_pairs *pairs);

/* Cuts off the part of a piece with u . x > beyond. Returns false if nothing is left. May leave too
 * much, but takes too much only by rounding. */
bool iccp_piece_cut(iccp_piece *piece, const double *u, double beyond);

/* Compares pieces `begin` to `end` with one another, but not those of the same group, which stand
 * together. */
void iccp_near_pairs_within(iccp_near_pairs *pairs, size_t begin, size_t end);

/* Compares pieces `begin` to `middle` with those from there to `end`. */
void iccp_near_pairs_between(iccp_near_pairs *pairs, size_t begin, size_t middle, size_t end);

void iccp_near_pairs_free(iccp_near_pairs *pairs);

#endif

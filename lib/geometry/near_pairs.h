/* Finds pairs of items that meet, among many long, thin items that come near one another. */
#ifndef ICCP_NEAR_PAIRS_H
#define ICCP_NEAR_PAIRS_H

#include "base/env.h"

#include <stdbool.h>
#include <stdint.h>

enum { ICCP_PIECE_CORNERS = 8 };

/* The part of an item inside a region of space: a convex polygon, a segment or a point. */
typedef struct iccp_piece {
    double corner[ICCP_PIECE_CORNERS][3];
    uint32_t n; /* number of corners */
    uint32_t n_cuts;
    uint32_t item, group;
} iccp_piece;

typedef struct iccp_near_pairs {
    const iccp_env *env;
    /* Decides exactly whether two items meet */
    bool (*meet)(void *context, uint32_t a, uint32_t b);
    void *context;
    double share;  /* share of the call, for progress reports */
    double n_free; /* pieces that may be visited before a budget pays */
    double size;   /* bound of the coordinates of all pieces */
    iccp_piece *pieces;
    size_t n, capacity;
    double *spans; /* two per piece */
    size_t n_spans;
    bool met;          /* two items meet; then nothing else is compared */
    icc_status status; /* ICC_ERR_CANCELLED also if a budget forbids the work */
} iccp_near_pairs;

/* Adds a piece without corners. Returns NULL and sets `status` if there is no memory. */
iccp_piece *iccp_near_pairs_add(iccp_near_pairs *pairs);

/* Cuts off the part of a piece with u . x > beyond. Returns false if nothing is left. The result
 * may be too large, but it is too small only by rounding. */
bool iccp_piece_cut(iccp_piece *piece, const double *u, double beyond);

/* Compares pieces `begin` to `end` with one another, except pieces of the same group, which are
 * adjacent. */
void iccp_near_pairs_within(iccp_near_pairs *pairs, size_t begin, size_t end);

/* Compares pieces `begin` to `middle` with pieces `middle` to `end`. */
void iccp_near_pairs_between(iccp_near_pairs *pairs, size_t begin, size_t middle, size_t end);

void iccp_near_pairs_free(iccp_near_pairs *pairs);

#endif

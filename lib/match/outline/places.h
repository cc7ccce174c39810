/* Places of one outline that may be paired with places of another, and the chords between them. */
#ifndef ICCP_PLACES_H
#define ICCP_PLACES_H

#include "match/outline/elastic.h"

/* Chords lead over so many edges at most. */
enum { ICCP_CHORD = 4 };

/* How far a place may be paired from where a pairing that is to be refined takes it, of the
 * perimeter. */
static const double iccp_near = .03;

/* Parts of a chord: the vector over the root of the arc's length, and this root. Lengths are shares
 * of the perimeter. */
enum { ICCP_CHORD_X, ICCP_CHORD_Y, ICCP_CHORD_ROOT, ICCP_CHORD_PARTS };

typedef struct iccp_places {
    size_t n;
    double *share;
    float *chord[ICCP_CHORD][ICCP_CHORD_PARTS]; /* to each place from 1 .. ICCP_CHORD before it */
} iccp_places;

/* Of rotations and slopes that a pairing has, by the source's share. */
enum { ICCP_BENDS = 1024 };
typedef struct iccp_bend {
    double rotation[2], root; /* of the slope */
} iccp_bend;

/* Room for all places between two shares of an outline that are at most a turn apart. */
icc_status iccp_places_create(iccp_places *places, const iccp_outline *outline,
                              const iccp_outline *other, const iccp_memory *memory);

/* Accepts one that is all zero. */
void iccp_places_free(iccp_places *places, const iccp_memory *memory);

/* The ends, the vertices between, and on edges that `knots` pair with many of the other outline's,
 * near every second vertex of these and near all that are far from others. */
void iccp_places_find(iccp_places *places, const iccp_outline *outline, const iccp_outline *other,
                      const iccp_pairing_knots *knots, double from, double to);

/* Fills in the chords, turned and stretched by `bends`; NULL: as they are. */
void iccp_places_chords(iccp_places *places, const iccp_outline *outline, const iccp_bend *bends);

/* What a pairing does to the source's chords of 1/128 to 1/32 of the perimeter, at ICCP_BENDS
 * shares. */
void iccp_bends_find(iccp_bend *bends, const iccp_pairing_knots *knots, const iccp_outline *source,
                     const iccp_outline *target);

#endif

/* Places of one outline that may be paired with places of another, and the chords between them. */
#ifndef ICCP_PLACES_H
#define ICCP_PLACES_H

#include "match/outline/elastic.h"

/* The largest number of edges under a chord. */
enum { ICCP_CHORD = 4 };

/* A refined pairing may move a place by at most this share of the perimeter. */
static const double iccp_near = 0.03;

/* The parts of a chord: its vector divided by the root of the arc's length, and this root. Lengths
 * are shares of the perimeter. */
enum { ICCP_CHORD_X, ICCP_CHORD_Y, ICCP_CHORD_ROOT, ICCP_CHORD_PARTS };

typedef struct iccp_places {
    size_t n;
    double *share;
    float *chord[ICCP_CHORD][ICCP_CHORD_PARTS]; /* to each place, from the places 1 .. ICCP_CHORD
                                                   before it */
} iccp_places;

/* The rotations and slopes of a pairing, by the source's share. */
enum { ICCP_BENDS = 1024 };
typedef struct iccp_bend {
    double rotation[2], root; /* root of the slope */
} iccp_bend;

/* Makes room for all places between two shares of an outline that are at most one turn apart. */
icc_status iccp_places_create(iccp_places *places, const iccp_outline *outline,
                              const iccp_outline *other, const iccp_memory *memory);

/* Accepts a struct of zeros. */
void iccp_places_free(iccp_places *places, const iccp_memory *memory);

/* Finds the places between two shares: both ends and all vertices. An edge that `knots` pair with
 * many vertices of the other outline gets further places. They are close to every second of these
 * vertices, and to all that are far from others. */
void iccp_places_find(iccp_places *places, const iccp_outline *outline, const iccp_outline *other,
                      const iccp_pairing_knots *knots, double from, double to);

/* Fills in the chords, turned and stretched by `bends`. If `bends` is NULL, they stay as they
 * are. */
void iccp_places_chords(iccp_places *places, const iccp_outline *outline, const iccp_bend *bends);

/* Finds how a pairing turns and stretches the source's chords of 1/128 to 1/32 of the perimeter, at
 * ICCP_BENDS shares. */
void iccp_bends_find(iccp_bend *bends, const iccp_pairing_knots *knots, const iccp_outline *source,
                     const iccp_outline *target);

#endif

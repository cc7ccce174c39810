/* What lies inside a cage in the plane: holes, lines and points, and the ties that say which way
 * round a map goes. Here is the one place that knows their order, names and partners. */
#ifndef CAGE_FEATURES_H
#define CAGE_FEATURES_H

#include "cage/cage.h"

/* ---- for the readers ---- */

/* Ends a ring that begins at vertex `first` of the cage: drops the last vertex if it repeats the
 * first. Rings behind the outer one become holes; no lines and points may have been added yet. */
bool cage_end_ring(cage *c, size_t first, problem *wrong);

/* Takes the vertices from `first` on out of the cage, and makes a feature of them. */
void cage_add_feature(cage *c, int32_t kind, int64_t number, size_t first);

/* Puts all that was read in order: holes as they came, then lines and points together by their
 * numbers, then ties by theirs. False: two have the same number. */
bool cage_sort_features(cage *c, problem *wrong);

/* ---- afterwards ---- */

typedef char feature_text[48];

/* What a feature is called: "hole 2", "line 7", "point 9", "tie 1". Returns `out`. */
const char *feature_name(feature_text out, const cage_feature *f);

/* How many of a kind there are. */
size_t cage_count(const cage *c, int32_t kind);

/* How many points have a radius. */
size_t cage_circles(const cage *c);

/* Feature `number` of the domain: of the circles round points, which are behind the features of the
 * cage, the point; NULL: there is none. */
const cage_feature *cage_find_feature(const cage *c, size_t number);

/* ", with 2 holes, 1 line and 3 points inside", or nothing. Returns `out`. */
const char *cage_inside_text(char out[120], const cage *c);

/* Whether each feature has its partner in the other cage; `wrong` is about the target. */
bool features_correspond(const cage *source, const cage *target, problem *wrong);

/* Writes a message of the library with names instead of its "feature 3" or "feature 3 (a line)",
 * and with the numbers of the file for its "tie 3". */
void features_translate(char *out, size_t room, const cage *c, const char *message);

#endif

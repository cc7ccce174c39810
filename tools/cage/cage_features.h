/* Features of a cage in the plane: holes, regions, lines and points. Also ties, which say on which
 * side a map passes them. Only this file knows their order, names and partners. */
#ifndef CAGE_FEATURES_H
#define CAGE_FEATURES_H

#include "cage/cage.h"

/* ---- for the readers ---- */

/* Ends a ring that begins at vertex `first` of the cage. Drops the last vertex if it repeats the
 * first. Rings after the outer one become holes. No lines and points may have been added yet. */
bool cage_end_ring(cage *c, size_t first, problem *wrong);

/* Removes the vertices from `first` on from the cage and makes them a feature. */
void cage_add_feature(cage *c, int32_t kind, int64_t number, size_t first);

/* Ends ring `like->ring` of a region, which begins at vertex `first` of the cage. It is a hole or
 * an outer ring of the region: `like->kind`. */
bool cage_end_region_ring(cage *c, const cage_feature *like, size_t first, problem *wrong);

/* Sorts all features: holes and outlines as they came, then regions, lines and points together by
 * their numbers, then ties by theirs. False if two have the same number. */
bool cage_sort_features(cage *c, problem *wrong);

/* Adds an empty polygon to several. */
cage *cage_add_polygon(cage *c);

/* Makes the outer ring with its holes, and the further polygons, outlines among the features. So one
 * domain has them all. Call it before other features are added. */
void cage_join_outlines(cage *c);

/* ---- after reading ---- */

/* Makes the holes of outlines closed lines, so that their insides belong to the domain. */
void cage_fill_holes(cage *c);

typedef char feature_text[48];

/* The name of a feature: "hole 2", "hole 1 of region 3", "line 7", "point 9", "tie 1". Returns
 * `out`. */
const char *feature_name(feature_text out, const cage_feature *f);

/* The number of features of a kind: of holes those of outlines, of regions those with numbers,
 * however many rings they have. */
size_t cage_count(const cage *c, int32_t kind);

/* The number of outlines, also if it is one. */
size_t cage_outlines(const cage *c);

/* True if a feature is a closed ring without a last vertex that repeats the first. */
bool feature_is_ring(const cage_feature *f);

/* The number of points with a radius. */
size_t cage_circles(const cage *c);

/* Returns feature `number` of the domain. For circles around points, which come after the features
 * of the cage, it returns the point. NULL if there is none. */
const cage_feature *cage_find_feature(const cage *c, size_t number);

/* "4 vertices" of the outer ring, or of all rings if there is none. A cage without an outer ring begins
 * with "3 polygons, " or "48 regions, ". Returns `out`. */
const char *cage_rings_text(char out[80], const cage *c);

/* ", with 2 holes, 1 line and 3 points inside", or nothing. Without an outer ring the regions are
 * not inside and are left out. Returns `out`. */
const char *cage_inside_text(char out[120], const cage *c);

/* True if each feature has its partner in the other cage. `wrong` is about the target. */
bool features_correspond(const cage *source, const cage *target, problem *wrong);

/* Writes a message of the library with names instead of "feature 3", "feature 3 (a line)" or
 * "features 3, 4 and 7", and with the file's numbers instead of "tie 3". */
void features_translate(char *out, size_t room, const cage *c, const char *message);

#endif

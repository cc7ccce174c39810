/* Ties: polylines from vertex to vertex, in both cages, that say on which side a map passes
 * features. */
#ifndef CAGE_TIES_H
#define CAGE_TIES_H

#include "cage/cage.h"

/* Finds the ends of tie i among the vertices, exactly. The ring's vertices come first, then those
 * of the features, numbered as in the domain. */
bool tie_find_ends(uint32_t ends[2], const cage *c, size_t i, problem *wrong);

/* True if partner ties of two cages join the same vertices. `wrong` is about the target, or about
 * the source if *side becomes 1. */
bool ties_correspond(const cage *source, const cage *target, int *side, problem *wrong);

/* The ties of two corresponding cages in the library's form; free() the list, which points into the
 * cages. NULL if there are none. */
icc_tie *ties_list(const cage *source, const cage *target);

#endif

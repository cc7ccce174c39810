/* Ties: polylines from a vertex to a vertex, in both cages, that say which way round a map goes. */
#ifndef CAGE_TIES_H
#define CAGE_TIES_H

#include "cage/cage.h"

/* Finds the ends of tie i of a cage among the vertices, exactly: those of the ring, then those of
 * the features, numbered through as in the domain. */
bool tie_find_ends(uint32_t ends[2], const cage *c, size_t i, problem *wrong);

/* Whether the ties of two cages, which have partners, join the same vertices; `wrong` is about the
 * target, or about the source if *side becomes 1. */
bool ties_correspond(const cage *source, const cage *target, int *side, problem *wrong);

/* The ties of two cages that correspond, as the library takes them; free() the list, which points
 * into the cages. NULL: there are none. */
icc_tie *ties_list(const cage *source, const cage *target);

#endif

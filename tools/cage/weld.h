/* Vertices at one place, as in files that give every face vertices of its own. */
#ifndef WELD_H
#define WELD_H

#include "cage/cage.h"

/* How many vertices of a surface in space lie exactly where an earlier one does. */
size_t weld_count(const cage *c);

/* Joins vertices no farther apart than `tolerance` with the first of them; 0: only those at exactly
 * one place. Drops the faces that are left with fewer than three corners. The order of vertices and
 * faces stays. Returns how many vertices have gone. */
size_t weld(cage *c, double tolerance);

#endif

/* Joins vertices at one place. Some files give every face its own vertices. */
#ifndef WELD_H
#define WELD_H

#include "cage/cage.h"

/* Counts the vertices of a surface in space that lie exactly at an earlier vertex. */
size_t weld_count(const cage *c);

/* Joins vertices that are at most `tolerance` apart with the first of them. With 0 it joins only
 * vertices at exactly one place. Drops the faces that are left with fewer than three corners. The
 * order of vertices and faces stays. Returns the number of removed vertices. */
size_t weld(cage *c, double tolerance);

#endif

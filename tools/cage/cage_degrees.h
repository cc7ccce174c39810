/* Checks cages in degrees, whose longitudes wrap around at the antimeridian. */
#ifndef CAGE_DEGREES_H
#define CAGE_DEGREES_H

#include "cage/cage.h"

/* Refuses a cage in degrees if an edge jumps by more than 180. Such an edge may be meant to cross
 * the antimeridian, or to go the long way around the earth. Also sets c->cut if several polygons
 * seem to be the parts of a shape that was cut there. A cage whose coordinates cannot be degrees
 * passes. */
bool cage_check_degrees(cage *c, problem *wrong);

/* A hint for messages if c->cut is set, otherwise "". */
const char *cage_cut_text(const cage *c);

#endif

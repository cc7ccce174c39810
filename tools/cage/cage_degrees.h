/* Cages in degrees, whose longitudes begin anew at the antimeridian. */
#ifndef CAGE_DEGREES_H
#define CAGE_DEGREES_H

#include "cage/cage.h"

/* Whether no edge of a cage in degrees jumps from one side of the antimeridian to the other, or the
 * long way round the earth: which of them is meant cannot be told. Also notes in c->cut whether
 * several polygons are the halves of what goes over it. What has other coordinates than degrees is
 * good. */
bool cage_check_degrees(cage *c, problem *wrong);

/* "" or, where c->cut is set, what can be done about it. */
const char *cage_cut_text(const cage *c);

#endif

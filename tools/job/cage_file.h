/* Writes cages in the plane. */
#ifndef CAGE_FILE_H
#define CAGE_FILE_H

#include "cage/cage.h"

#include <stdio.h>

/* Writes the outer ring with its holes, and all other features, as GeoJSON features with the cage's
 * role and the numbers that pair them. */
void cage_write(FILE *stream, const cage *c, cage_role role);

/* Writes a line, a point or a tie. `first`: no feature comes before it in the list. */
void cage_write_feature(FILE *stream, const cage *c, const cage_feature *f, cage_role role,
                        bool first);

/* Writes one cage as text. It writes two, or one to a name in .geojson or .json, as a
 * FeatureCollection that --source accepts. Either may be NULL. DONE, or FAILED with a message on
 * stderr. */
int cages_write(const char *name, const cage *source, const cage *target);

#endif

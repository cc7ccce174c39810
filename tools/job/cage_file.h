/* Writes cages in the plane. */
#ifndef CAGE_FILE_H
#define CAGE_FILE_H

#include "cage/cage.h"

#include <stdio.h>

/* Writes the positions of a polyline, or of a ring if `closed`, as GeoJSON. */
void positions_write(FILE *stream, const cage *c, size_t n, const double *points, bool closed);

/* Writes the outline and the holes as a GeoJSON feature with the cage's role. */
void cage_write_polygon(FILE *stream, const cage *c, cage_role role);

/* Writes one cage as text. It writes two, or one to a name in .geojson or .json, as a
 * FeatureCollection that --source accepts. Either may be NULL. DONE, or FAILED with a message on
 * stderr. */
int cages_write(const char *name, const cage *source, const cage *target);

#endif

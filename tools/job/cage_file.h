/* Writing cages in the plane. */
#ifndef CAGE_FILE_H
#define CAGE_FILE_H

#include "cage/cage.h"

#include <stdio.h>

/* The positions of a polyline or, closed, of a ring of a cage, as GeoJSON has them. */
void positions_write(FILE *stream, const cage *c, size_t n, const double *points, bool closed);

/* The outline and the holes as a GeoJSON feature with the cage's role. */
void cage_write_polygon(FILE *stream, const cage *c, cage_role role);

/* Writes one cage as text; two, or where the name ends in .geojson or .json, as a FeatureCollection
 * that --source takes. Either may be NULL. DONE, or FAILED with a line on stderr. */
int cages_write(const char *name, const cage *source, const cage *target);

#endif

/* Landmarks: pairs of points that go together, a line each. */
#ifndef LANDMARK_FILE_H
#define LANDMARK_FILE_H

#include "base/table.h"

/* Reads rows of a point and its partner, of `dim` coordinates each, or, in the plane, what the
 * georeferencer of QGIS saves (.points), whose points that are not enabled are left out, from
 * text[0..n), with text[n] == '\0'. False: see `wrong`. The table is to be freed in either case. */
bool landmarks_decode(table *out, const char *text, size_t n, size_t dim, problem *wrong);

/* The same from a file. The table is to be freed if it is DONE; else said why. */
int landmarks_read(table *out, const char *name, size_t dim);

#endif

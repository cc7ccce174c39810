/* Reading a cage, whatever format its file has. */
#ifndef CAGE_READ_H
#define CAGE_READ_H

#include "cage/cage.h"

/* Reads a cage from text[0..n), with text[n] == '\0'; its content decides the format. `choice`
 * is among several shapes; by its role: the GeoJSON feature with the property `role` "source" or
 * "target", the SVG element with that id or inkscape:label. A text file has `dim` numbers on a line; beyond 2
 * they are vertices without facets. False: see `wrong`, and `out` is empty. */
bool cage_read(cage *out, const cage_choice *choice, size_t dim, const char *text, size_t n,
               problem *wrong);

/* Whether the file names a shape with the role, so that it holds this cage for sure. */
bool cage_is_named(cage_role role, const char *text, size_t n);

#endif

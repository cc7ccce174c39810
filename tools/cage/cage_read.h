/* Reads a cage from a file of any format. */
#ifndef CAGE_READ_H
#define CAGE_READ_H

#include "cage/cage.h"

/* Reads a cage from text[0..n), with text[n] == '\0'. The content decides the format. `choice`
 * selects one of several shapes. By role it is the GeoJSON feature whose property `role` is
 * "source" or "target", or the SVG element with that id or inkscape:label. A text file has `dim`
 * numbers in a line. With more than 2 these are vertices without facets. False: see `wrong`, and
 * `out` is empty. */
bool cage_read(cage *out, const cage_choice *choice, size_t dim, const char *text, size_t n,
               problem *wrong);

/* True if the file names a shape with the role, so that it certainly contains this cage. */
bool cage_is_named(cage_role role, const char *text, size_t n);

#endif

/* Writes the coordinates of a carried geometry as text in the style of the original. */
#ifndef GEO_WRITE_H
#define GEO_WRITE_H

#include "base/edits.h"
#include "geo/densify.h"
#include "geo/geo_shape.h"

/* A rectangle around images; empty if lower > upper. */
typedef struct geo_box {
    double lower[2], upper[2];
} geo_box;

geo_box geo_box_empty(void);
void geo_box_add(geo_box *box, const double lower[2], const double upper[2]);

typedef struct geo_writer {
    edits *edits;
    const char *text;
    const geo_shape *shape;
    geo_box *box; /* grows by everything that is written */
} geo_writer;

/* Replaces the coordinates by the images of lines that have every position of the shape in its
 * order. The text between positions stays. */
void geo_write_in_place(geo_writer *w, geo_span coordinates, size_t n_lines, const polyline *lines);

/* Adds the vertices first .. end - 1 of a line as a list of positions. */
void geo_write_list(geo_writer *w, const polyline *line, size_t first, size_t end);

#endif

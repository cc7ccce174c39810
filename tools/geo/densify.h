/* Lines that stay true when they are mapped: with more vertices where the map bends them. */
#ifndef DENSIFY_H
#define DENSIFY_H

#include "base/say.h"
#include "geo/carrier.h"

/* A vertex, and where it is from: a position of a shape, or a share of the way to the next one. */
typedef struct vertex {
    double point[2], image[2]; /* NaN: no image */
    bool position;             /* the position itself */
    size_t from;
    double along;
    bool open; /* the piece up to the next vertex is to be looked at */
} vertex;

typedef struct polyline {
    size_t n, room;
    vertex *vertices;
} polyline;

void polyline_add(polyline *line, const vertex *v);
void polyline_free(polyline *line);

/* Inserts vertices until no open piece's image is farther than `tolerance` from a straight line, as
 * seen at three points of the piece; at most 4096 pieces between two vertices. Where the map has a
 * gap there is a vertex without image. DONE, or FAILED: see `wrong`. */
int polyline_densify(polyline *line, const carrier *c, double tolerance, problem *wrong);

#endif

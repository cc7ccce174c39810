/* Adds vertices to lines where the map bends them, so that the mapped lines stay accurate or are
 * exact. */
#ifndef DENSIFY_H
#define DENSIFY_H

#include "base/say.h"
#include "geo/map_edges.h"

/* A vertex and its origin: a position of a shape, or a share of the way to the next one. */
typedef struct vertex {
    double point[2], image[2]; /* NaN if there is no image */
    bool position;             /* it is the position itself */
    size_t from;
    double along;
    bool on_cage;
    bool open; /* the piece up to the next vertex still has to be tested */
} vertex;

typedef struct polyline {
    size_t n, room;
    vertex *vertices;
} polyline;

void polyline_add(polyline *line, const vertex *v);
void polyline_free(polyline *line);

/* Adds vertices to n lines until the image of each open piece is within `tolerance` of a straight
 * line, as tested at three points of the piece. There are at most 4096 pieces between two vertices.
 * Where the map has a gap there is a vertex without an image. Many lines at once take less time than
 * one after the other. DONE, or FAILED: see `wrong`. */
int polylines_densify(size_t n, polyline *const *lines, const carrier *c, double tolerance,
                      problem *wrong);

/* Cuts each open piece at the map's edges, which makes its image exact. With tolerance > 0, cuts
 * are then left out as long as the image stays that close. A piece gets the same vertices, bit by
 * bit, in either direction. */
void polyline_cut(polyline *line, map_edges *edges, double tolerance);

#endif

/* Control points: places whose places in the target are known. In the plane only.
 *
 * Words of this folder
 * - control point: a pair of a place in the source and its place in the target.
 * - link: a line that is drawn from the one to the other.
 * - tolerance: how far the target may be missed; 0: not at all.
 * - rows run down: the source counts rows of a picture from the top, so its y points down.
 *
 * Ways
 * - control_read.h recognises the format of a file. A format is a file control_NAME.c with one
 *   reader (control_readers.h).
 * - affine_fit.h: the affine map that misses the points least.
 *
 * Begin with control_read.c. */
#ifndef CONTROL_POINTS_H
#define CONTROL_POINTS_H

#include "base/say.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct control_points {
    const char *format; /* for messages: "control points of QGIS" */
    size_t n;
    double *from, *to;  /* 2 n each */
    double *tolerances; /* n */
    size_t *lines;      /* n: the line of each point in its file, from 1 */
    char **names;       /* n; each may be NULL */
    size_t n_disabled;  /* points that the file says to leave out */
    double *turns; /* n: degrees from x to y by which the surroundings turn; NaN: as they like */
    size_t n_bones;
    uint32_t *bones; /* 2 n_bones points: the ends of lines that stay straight */
    bool has_tolerances, has_names, has_turns;
    bool rows_down; /* the format counts the source's rows from the top */
    char *crs;      /* the name of the target's reference system, or NULL */
    size_t room_from, room_to, room_tolerances, room_lines, room_names, room_turns;
} control_points;

/* Adds a point, exact and without a name. */
void control_add(control_points *c, const double from[2], const double to[2], size_t line);

/* Names the last point by n characters, unless there are none. What is not printable becomes a
 * '?'. */
void control_name(control_points *c, const char *name, size_t n);

/* Sets the tolerance of the last point. */
void control_tolerance(control_points *c, double tolerance);

/* Sets by how much the surroundings of the last point turn. */
void control_turn(control_points *c, double degrees);

void control_free(control_points *c);

/* Finds the line of places in a text, which are asked for in rising order. */
typedef struct line_finder {
    const char *at;
    size_t line;
} line_finder;

size_t line_finder_at(line_finder *f, const char *place);

#endif

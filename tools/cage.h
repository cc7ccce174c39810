/* Cages in the plane: one ring of vertices, read from text, GeoJSON, WKT or SVG.
 *
 * A ring is taken as it is written, never re-wound, because source and target correspond by index.
 * A last vertex that repeats the first closes the ring and is dropped. */
#ifndef CAGE_H
#define CAGE_H

#include "say.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum cage_role { CAGE_SOURCE = 1, CAGE_TARGET = 2 } cage_role;

typedef struct cage {
    size_t n;       /* vertices */
    double *points; /* n * 2 */
    size_t *lines;  /* line of each vertex in its file, or 0 where the format does not tell */
    size_t room_points, room_lines;
} cage;

/* Reads a cage from text[0..n), with text[n] == '\0'; the format is told by the content. `role`
 * chooses among several shapes: the GeoJSON feature with the property `role` "source" or "target",
 * the SVG element with that id. False: see `wrong`, and `out` is empty. */
bool cage_read(cage *out, cage_role role, const char *text, size_t n, problem *wrong);

void cage_free(cage *c);

/* ---- for the readers ---- */

void cage_add(cage *c, double x, double y, size_t line);

/* Drops the last vertex if it repeats the first. */
void cage_open_ring(cage *c);

/* The name of a role: "source" or "target". */
const char *cage_role_name(cage_role role);

/* The line that `at` stands on, from 1. */
size_t cage_line(const char *text, const char *at);

bool cage_read_text(cage *out, const char *text, size_t n, problem *wrong);
bool cage_read_geojson(cage *out, cage_role role, const char *text, size_t n, problem *wrong);
bool cage_read_wkt(cage *out, const char *text, size_t n, problem *wrong);
bool cage_read_svg(cage *out, cage_role role, const char *text, size_t n, problem *wrong);

/* The data of an SVG path that stands at `line` of its file, ended by `end` or '\0'. */
bool cage_read_path(cage *out, const char *data, const char *end, size_t line, problem *wrong);

#endif

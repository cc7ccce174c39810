/* Points and lines inside a solid, read from files.
 *
 * Words of this folder
 * - mark: a named point or line, with its place in the source, in the target, or in both.
 * - part: an object or a group of an OBJ file. It becomes the outer surface, a void, or a surface
 *   inside.
 *
 * Ways
 * - marks.c recognises the format. A format is a file marks_NAME.c with one reader.
 * - solid_cage.h makes a cage of surfaces and marks.
 *
 * Coordinates are kept as the file has them. Files of 3D Slicer name a system of axes, RAS or LPS;
 * surfaces that Slicer saves beside them are in the same system if the same was chosen there.
 *
 * Begin with marks.c. */
#ifndef MARKS_H
#define MARKS_H

#include "base/json_tree.h"
#include "base/say.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct mark {
    char *name;        /* "" if the file has none */
    size_t n[2];       /* vertices in the source and in the target; 0: the file does not say */
    double *points[2]; /* 3 n each; a file with one side has it in points[0] */
    size_t line;       /* in the file, or 0 */
} mark;

typedef struct marks {
    size_t n, room;
    mark *items;
    char axes[8]; /* "RAS" or "LPS" if the file says so, else "" */
} marks;

typedef enum mark_kind { MARK_POINT, MARK_LINE } mark_kind;

/* Reads points or lines from text[0..n), with text[n] == '\0':
 * - a table of points `x y z`, or `name,x,y,z`, or these and the places in the target
 * - points as 3D Slicer saves them (.fcsv), or points and curves (.mrk.json)
 * - a list in JSON of objects {"name", "source", "target"}
 * - OBJ: its lines, or its vertices as points
 * False: see `wrong`. Free the marks in either case. */
bool marks_read(marks *out, mark_kind kind, const char *text, size_t n, problem *wrong);
void marks_free(marks *m);

/* ---- for the readers ---- */

/* Adds a mark without points. The name has n characters. */
mark *marks_add(marks *m, const char *name, size_t n, size_t line);

bool marks_read_table(marks *out, const char *text, problem *wrong);
bool marks_read_fcsv(marks *out, const char *text, problem *wrong);
bool marks_read_json(marks *out, mark_kind kind, const json_tree *tree, const char *text,
                     problem *wrong);
bool marks_read_obj(marks *out, mark_kind kind, const char *text, size_t n, problem *wrong);

#endif

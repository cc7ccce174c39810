/* Files that tell where vertices of a mesh go. */
#ifndef MOVES_FILE_H
#define MOVES_FILE_H

#include "control/control_points.h"

#include <stdint.h>

typedef struct moves {
    /* Vertices by their numbers from 0. A vertex that may slide has nan for its place. */
    size_t n;
    uint32_t *vertices;
    double *to; /* 2 n */
    size_t *lines;
    size_t room_vertices, room_to, room_lines;
    control_points points; /* vertices by their places */
} moves;

/* Reads text[0..n), with text[n] == '\0': lines `vertex x y` and `vertex slide`, or any file of
 * control points. There are n_vertices vertices. False: see `wrong`. Free it in either case. */
bool moves_decode(moves *out, const char *text, size_t n, size_t n_vertices, problem *wrong);

/* Reads a file. Returns DONE, or FAILED with a message on stderr. Free it in either case. */
int moves_read(moves *out, const char *name, size_t n_vertices);
void moves_free(moves *m);

#endif

/* Triangle meshes in the plane, from OBJ and OFF.
 *
 * The file is kept as it is; only the first two coordinates of each vertex are looked at and, on
 * writing, replaced. Faces with more than three corners are looked at as fans of triangles. */
#ifndef MESH_FILE_H
#define MESH_FILE_H

#include "say.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

typedef struct mesh_file {
    const char *text; /* borrowed */
    size_t n_text;
    size_t n_vertices;
    double *points; /* n_vertices * 2 */
    size_t *spans;  /* n_vertices * 2: where the two numbers of each begin and end in the text */
    size_t n_triangles;
    uint32_t *triangles; /* n_triangles * 3 */
    size_t room_points, room_spans, room_triangles;
} mesh_file;

/* Reads text[0..n), with text[n] == '\0'. False: see `wrong`. Free the mesh in either case. */
bool mesh_read(mesh_file *out, const char *text, size_t n, problem *wrong);
void mesh_free(mesh_file *m);

/* Writes the file with other coordinates. */
void mesh_write(const mesh_file *m, const double *points, FILE *stream);

#endif

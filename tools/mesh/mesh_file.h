/* Meshes in the plane and in space: OBJ, OFF, Medit (.mesh) and legacy VTK as text, PLY as text or
 * binary.
 *
 * The file is kept as it is; only the first coordinates of each vertex, as many as the mesh has
 * dimensions, are looked at and, on writing, replaced. Faces with more than three corners are
 * looked at as fans of triangles. Other elements than triangles and tetrahedra are carried along
 * unseen. */
#ifndef MESH_FILE_H
#define MESH_FILE_H

#include "base/say.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

typedef enum mesh_form { MESH_TEXT, MESH_LITTLE, MESH_BIG } mesh_form; /* binary: doubles */

typedef struct mesh_file {
    const char *text; /* borrowed */
    size_t n_text;
    size_t dim;
    size_t n_vertices;
    double *points;     /* n_vertices * dim */
    const char *format; /* its name, for messages */
    mesh_form form;     /* of the numbers */
    /* Where the numbers of each vertex begin and end in the text, ascending: n_vertices * n_spans
     * pairs. One span holds all of its coordinates (n_spans is 1), or span k the coordinate
     * order[k] (dim spans). */
    size_t *spans, n_spans;
    unsigned char order[3];
    size_t types[3][2], n_types; /* words before them: how precise the numbers are (VTK, PLY) */
    size_t n_faces;
    size_t n_triangles;
    uint32_t *triangles;    /* n_triangles * 3 */
    size_t *triangle_lines; /* of each triangle, from 1 */
    size_t n_tetrahedra;
    uint32_t *tetrahedra; /* n_tetrahedra * 4 */
    size_t room_points, room_spans, room_triangles, room_triangle_lines, room_tetrahedra;
} mesh_file;

/* The name of the format that a mesh of this text, which ends with a '\0', has: VTK, PLY, Medit,
 * OFF; else OBJ. */
const char *mesh_format(const char *text);

/* Reads text[0..n), with text[n] == '\0', as a mesh of dimension 2 or 3. False: see `wrong`. Free
 * the mesh in either case. */
bool mesh_read(mesh_file *out, size_t dim, const char *text, size_t n, problem *wrong);
void mesh_free(mesh_file *m);

/* Writes the file with other coordinates, all of which must be finite. */
void mesh_write(const mesh_file *m, const double *points, FILE *stream);

#endif

/* Meshes in the plane and in space: OBJ, OFF and Medit (.mesh) as text, legacy VTK, PLY and STL as
 * text or binary, binary glTF.
 *
 * The file is kept as it is; only the first coordinates of each vertex, as many as the mesh has
 * dimensions, are looked at and, on writing, replaced. All elements are known by their kinds; faces
 * with more than three corners are also there as fans of triangles. The normals of STL are computed
 * again, in space. What nodes of glTF do to their meshes is applied on reading and undone on writing. */
#ifndef MESH_FILE_H
#define MESH_FILE_H

#include "base/say.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

typedef enum mesh_form {
    MESH_TEXT,
    MESH_LITTLE,
    MESH_BIG
} mesh_form; /* binary: which byte is first */

/* Normals of vertices, each in one span or in three. */
typedef struct mesh_normals {
    size_t n, n_uses;
    double *values;         /* 3 n; a normal that is not finite was not read, and stays */
    size_t *spans;          /* 2 n n_spans, ascending: where they stand in the text */
    size_t n_spans;         /* of each normal */
    unsigned char order[3]; /* span k is of coordinate order[k] */
    size_t width;           /* in binary files: bytes of a number */
    uint32_t *uses;         /* pairs: a normal, and a vertex that has it */
    size_t room_values, room_spans, room_uses;
} mesh_normals;

/* Vertices from `first` on that a node of glTF places elsewhere. */
typedef struct mesh_place {
    size_t first, n;
    double out[12], in[12]; /* affine_map.h: from the file to the scene, and back */
} mesh_place;

typedef struct mesh_file {
    const char *text; /* borrowed, or `own` */
    size_t n_text;
    char *own;    /* a copy of the text with new normals and the like, or NULL */
    bool carried; /* `own` has been made */
    size_t dim;
    size_t n_vertices;
    double *points;     /* n_vertices * dim */
    const char *format; /* its name, for messages */
    mesh_form form;     /* of the numbers */
    bool floats;        /* numbers are written as floats; otherwise as doubles */
    /* Where the numbers of each vertex begin and end in the text, ascending: n_vertices * n_spans
     * pairs. One span holds all of its coordinates (n_spans is 1), or span k the coordinate
     * order[k] (dim spans). 0: glTF, which is written by its accessors. */
    size_t *spans, n_spans;
    unsigned char order[3];
    size_t types[3][2], n_types; /* words before them: how precise the numbers are (VTK, PLY) */
    bool has_rest;   /* behind each span a third coordinate stands as a float, to become a double */
    size_t *normals; /* where that of each triangle begins and ends, before its corners, or NULL */
    mesh_normals vertex_normals; /* of OBJ and PLY */
    size_t n_places;
    mesh_place *places; /* of glTF, ascending */
    size_t n_faces;
    size_t n_triangles;
    uint32_t *triangles;    /* n_triangles * 3 */
    size_t *triangle_lines; /* of each triangle, from 1 */
    size_t n_tetrahedra;
    uint32_t *tetrahedra; /* n_tetrahedra * 4 */
    /* All elements in the order of the file, triangles and tetrahedra among them: number i has the
     * nodes nodes[node_starts[i] .. node_starts[i + 1]). */
    size_t n_elements;
    unsigned char *kinds; /* VTK's numbers: mesh/element_kinds.h */
    size_t *node_starts;
    uint32_t *nodes;
    size_t room_kinds, room_node_starts, room_nodes;
    size_t room_points, room_spans, room_triangles, room_triangle_lines, room_tetrahedra;
    size_t room_normals;
} mesh_file;

/* The name of the format that a mesh of text[0..n), with text[n] == '\0', has: VTK, PLY, Medit, OFF,
 * STL, glTF; else OBJ. */
const char *mesh_format(const char *text, size_t n);

/* Whether it is STL, or binary glTF. */
bool mesh_is_stl(const char *text, size_t n);
bool mesh_is_glb(const char *text, size_t n);

/* Reads text[0..n), with text[n] == '\0', as a mesh of dimension 2 or 3. False: see `wrong`. Free
 * the mesh in either case. */
bool mesh_read(mesh_file *out, size_t dim, const char *text, size_t n, problem *wrong);
void mesh_free(mesh_file *m);

/* Rounds coordinates to what the file can hold; those that are not finite stay. False: vertex *beyond
 * has one that is too large. */
bool mesh_round(const mesh_file *m, double *points, size_t *beyond);

/* Writes the file with other coordinates, all of which must be finite, and rounded. */
void mesh_write(const mesh_file *m, const double *points, FILE *stream);

#endif

/* Functions that readers of meshes share, most of them for text. Each takes one line or one word at
 * a time. Blanks and comments (from # on) are skipped. A function that returns false has filled in
 * the reason. */
#ifndef MESH_LINES_H
#define MESH_LINES_H

#include "mesh/mesh_file.h"

typedef struct lines {
    mesh_file *mesh;
    const char *at, *end; /* of the current line */
    size_t line;
    problem *wrong;
    bool wraps;          /* a vertex may continue in the next line */
    uint32_t corners[3]; /* of the fan of the current face */
    size_t n_corners;
} lines;

/* Goes to the next line. False at the end of the file, which is no failure. */
bool lines_next(lines *r);

void lines_skip_blanks(lines *r);

/* If `word` comes next, moves after it and returns true. */
bool lines_take(lines *r, const char *word);

/* Moves to the next word of the file, whatever line it is on. */
bool lines_word(lines *r);

/* Reads a number in this line. */
bool lines_number(lines *r, double *value);

/* Reads an integer from 0 to below `limit`: in this line, or as the next word of the file. */
bool lines_count(lines *r, double limit, uint32_t *count);
bool lines_next_count(lines *r, double limit, uint32_t *count);

/* Makes room for one more vertex. */
void mesh_make_room(mesh_file *m);

/* Reads the coordinates of the next vertex, which begin in this line. */
bool lines_vertex(lines *r);

/* Reads faces corner by corner. The third corner makes a face an element. */
void lines_begin_face(lines *r);
void lines_corner(lines *r, uint32_t vertex);
bool lines_end_face(lines *r);

/* Adds an element of any kind with n nodes, all of them vertices of the mesh. An element of
 * dimension 2 with straight sides is a face, too. False if the kind has another number of nodes. */
bool lines_element(lines *r, int kind, size_t n, const uint32_t *nodes);

/* The name of the format of a file of n bytes. Moves from its beginning to its first mark. */
const char *lines_format(lines *r, size_t n);

/* Gives element i its region. A number that is no 32-bit integer is ignored. */
void mesh_set_region(mesh_file *m, size_t i, double region);

/* Name k of VTK's cell data with regions, as several programs write it; NULL after the last. */
const char *mesh_region_name(size_t k);

/* ---- the formats ---- */

bool mesh_read_obj(lines *r);
bool mesh_read_off(lines *r);
bool mesh_read_medit(lines *r);
bool mesh_read_vtk(lines *r);
bool mesh_read_vtu(lines *r);
bool mesh_read_gmsh(lines *r);
bool mesh_read_ply(lines *r);
bool mesh_read_stl(lines *r);
bool mesh_read_glb(lines *r);

/* For glTF: the place of the vertices from `first` on, or NULL, its versions of mesh_round() and
 * mesh_write(), and whether a file of that name is JSON. */
const mesh_place *glb_place(const mesh_file *m, size_t first);
bool glb_round(const mesh_file *m, double *points, size_t *beyond);
void glb_write(const mesh_file *m, const double *points, bool as_json, FILE *stream);
bool glb_is_json(const char *name);

/* For VTU: its version of mesh_write(). */
void vtu_write(const mesh_file *m, const double *points, FILE *stream);

#endif

/* Rotates the vectors of a mesh file with the map that its vertices follow. A vector is an item of an
 * array of three floating-point numbers, at each vertex or in each element: in VTU, in legacy VTK
 * (VECTORS, NORMALS and arrays of FIELD) and in Gmsh ($NodeData and $ElementData).
 *
 * The derivative of the map is a rotation times a stretch (polar decomposition). Vectors get the
 * rotation only and keep their length. Normals follow the surface and keep their length. */
#ifndef MESH_VECTORS_H
#define MESH_VECTORS_H

#include "mesh/mesh_carry.h"

/* An array of vectors. */
typedef struct mesh_vectors {
    bool in_elements, are_normals;
    size_t n;
    uint32_t *items; /* the vertex or the element of each */
    double *values;  /* 3 n; they may be infinite or NaN */
    /* Where the numbers of each begin and end in the text: n pairs. NULL for VTU, whose array it
     * is. */
    size_t *spans;
    struct vtu_array *array;
    size_t width; /* in binary files: bytes of a number */
    size_t room_items, room_values, room_spans;
} mesh_vectors;

typedef struct mesh_vector_list {
    size_t n, room;
    mesh_vectors *arrays;
} mesh_vector_list;

/* Rotates them in the text of m. Its points must be those of the file. False: see `wrong`. If its
 * text is empty, the mover has printed a message. */
bool mesh_rotate_vectors(mesh_file *m, const mesh_mover *mover, mesh_rotated *out, problem *wrong);

/* ---- for the formats ---- */

/* Begins another array, and adds a vector to the last one. */
mesh_vectors *vectors_begin(mesh_vector_list *l, bool in_elements);
void vectors_add(mesh_vectors *v, uint32_t item, const double value[3], size_t begin, size_t end);

bool vtk_find_vectors(const mesh_file *m, mesh_vector_list *out, problem *wrong);
bool vtu_find_vectors(const mesh_file *m, mesh_vector_list *out, problem *wrong);
bool gmsh_find_vectors(const mesh_file *m, mesh_vector_list *out, problem *wrong);

#endif

/* Reads and writes meshes in the plane and in space: OBJ, OFF and Medit (.mesh) as text, legacy
 * VTK, VTU, Gmsh, PLY and STL as text or binary, glTF (JSON is made binary first: gltf_pack.h).
 *
 * The file is kept as it is. Only the first coordinates of each vertex are read and, on writing,
 * replaced, as many as the mesh has dimensions. All elements are known by their kinds. Faces with
 * more than three corners are also listed as fans of triangles. Normals of STL in space are
 * computed again. Transformations of glTF's nodes are applied on reading and undone on writing.
 *
 * Words of this folder
 * - span: the place of a number, or of a vertex's numbers, in the text of the file.
 * - kind: a type of element by VTK's number (element_kinds.h).
 * - vectors: fields of three numbers at vertices or in elements (mesh_vectors.h).
 * - carried: normals, tangents and morph targets after they have been mapped (mesh_carry.h).
 * - tally: counts of elements by the sign of their images (tally.h).
 * - plan: tables that prove the sign of a curved element (element_plan.h, element_sign.h).
 *
 * Ways
 * - Text formats read by mesh_lines.h; numbers of VTK by vtk_numbers.h. VTU: vtu.h finds arrays,
 *   vtu_read.c reads and vtu_put.c writes their numbers. glTF: glb.h finds places,
 *   glb_nodes.h nodes and skins, glb_places.c what they place, glb_vectors.c normals and morph
 *   targets, glb_joints.h moves joints, glb_write.c writes; affine_map.h.
 * - A new kind of element: element_kinds.h. The boundary of a mesh: mesh_boundary.h.
 *
 * A format is a file mesh_NAME.c with one reader. Begin with mesh_file.c. */
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
} mesh_form; /* binary: the order of bytes */

/* Normals of vertices, each in one span or in three. */
typedef struct mesh_normals {
    size_t n, n_uses;
    double *values;         /* 3 n; a normal that is not finite was not read and stays */
    size_t *spans;          /* 2 n n_spans, in rising order: their places in the text */
    size_t n_spans;         /* of each normal */
    unsigned char order[3]; /* span k has coordinate order[k] */
    size_t width;           /* in binary files: bytes of a number */
    uint32_t *uses;         /* pairs: a normal, and a vertex that has it */
    size_t room_values, room_spans, room_uses;
} mesh_normals;

/* Vertices from `first` on that a node of glTF transforms. */
typedef struct mesh_place {
    size_t first, n;
    double out[12], in[12]; /* affine_map.h: from the file to the scene, and back */
} mesh_place;

/* An object or a group of OBJ, up to the next one. */
typedef struct mesh_part {
    const char *name; /* in the text */
    size_t n_name;
    bool is_group; /* by `g`, not by `o` */
    size_t first_triangle, first_line;
} mesh_part;

typedef struct mesh_file {
    const char *text; /* borrowed, or `own` */
    size_t n_text;
    char *own;    /* a copy of the text with changes, such as other normals, or NULL */
    bool carried; /* `own` is complete */
    size_t dim;
    size_t n_vertices;
    double *points;     /* n_vertices * dim */
    const char *format; /* its name, for messages */
    mesh_form form;     /* of the numbers */
    bool floats;        /* numbers are written as floats; otherwise as doubles */
    /* Where the numbers of each vertex begin and end in the text, in rising order: n_vertices *
     * n_spans pairs. Either one span has all coordinates (n_spans is 1), or span k has the
     * coordinate order[k] (dim spans). 0 for glTF and VTU, which are written by their arrays. */
    size_t *spans, n_spans;
    unsigned char order[3];
    size_t types[3][2], n_types; /* type words before the numbers, which set their precision
                                    (VTK, PLY) */
    size_t types_end; /* of VTK: where the types of cells end, and data of points and cells begin */
    bool has_rest;    /* after each span there is a third coordinate as a float, which must become
                        a double */
    size_t *normals;  /* where the normal of each triangle begins and ends, before its corners, or
                        NULL */
    mesh_normals vertex_normals; /* of OBJ and PLY */
    size_t n_places;
    mesh_place *places; /* of glTF, in rising order */
    size_t n_copies;    /* of glTF: meshes that were copied, because nodes draw them elsewhere */
    struct vtu *vtu;    /* the arrays of VTU (mesh/vtu.h), or NULL */
    size_t n_faces;
    size_t n_triangles;
    uint32_t *triangles;    /* n_triangles * 3 */
    size_t *triangle_lines; /* of each triangle, counted from 1 */
    size_t n_tetrahedra;
    uint32_t *tetrahedra; /* n_tetrahedra * 4 */
    /* All elements in the order of the file, including triangles and tetrahedra. Number i has the
     * nodes nodes[node_starts[i] .. node_starts[i + 1]). */
    size_t n_elements;
    unsigned char *kinds; /* VTK's numbers: mesh/element_kinds.h */
    size_t *node_starts;
    uint32_t *nodes;
    size_t room_kinds, room_node_starts, room_nodes;
    /* The region of each of the first n_regions elements, as the file numbers them: Medit's
     * reference, Gmsh's physical tag or entity, or cell data of VTK. Other elements have none. */
    size_t n_regions, room_regions;
    int32_t *regions;
    size_t n_parts; /* of OBJ */
    mesh_part *parts;
    /* Polylines of OBJ. Number i has the vertices line_nodes[line_starts[i] .. line_starts[i + 1]).
     * A line that begins where the one before it ends continues that one. */
    size_t n_lines;
    size_t *line_starts;
    uint32_t *line_nodes;
    size_t room_parts, room_line_starts, room_line_nodes;
    size_t room_points, room_spans, room_triangles, room_triangle_lines, room_tetrahedra;
    size_t room_normals;
} mesh_file;

/* The name of the format of text[0..n), with text[n] == '\0': VTK, VTU, PLY, Medit, Gmsh, OFF, STL,
 * glTF, or else OBJ. */
const char *mesh_format(const char *text, size_t n);

/* True if the text begins like one of these formats. OBJ has no mark at its beginning. */
bool mesh_told(const char *text, size_t n);

/* True if it is STL, or binary glTF. */
bool mesh_is_stl(const char *text, size_t n);
bool mesh_is_glb(const char *text, size_t n);

/* Reads text[0..n), with text[n] == '\0', as a mesh of dimension 2 or 3. False: see `wrong`. Free
 * the mesh in either case. */
bool mesh_read(mesh_file *out, size_t dim, const char *text, size_t n, problem *wrong);
void mesh_free(mesh_file *m);

/* The regions of all tetrahedra in their order, or NULL if none has a number. Free them. */
int32_t *mesh_tetrahedron_regions(const mesh_file *m);

/* Rounds coordinates to the precision of the file. Those that are not finite stay. False: vertex
 * *beyond has one that is too large. */
bool mesh_round(const mesh_file *m, double *points, size_t *beyond);

/* Writes the file with other coordinates. All must be finite and rounded. A scene of glTF becomes
 * JSON if `name`, that of the output, ends in .gltf, else one binary file. */
void mesh_write(const mesh_file *m, const double *points, const char *name, FILE *stream);

#endif

/* Writes meshes of triangles or tetrahedra with a number for each region. */
#ifndef NUMBERED_MESH_H
#define NUMBERED_MESH_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* The formats, for output_fits(). */
#define NUMBERED_MESHES "Medit, Gmsh, VTK, VTU"

typedef struct numbered_mesh {
    size_t dim; /* 2: triangles, 3: tetrahedra */
    size_t n_points, n_cells;
    const double *points;    /* n_points * dim */
    const uint32_t *cells;   /* n_cells * (dim + 1) */
    const uint32_t *regions; /* of each cell, from 0 as in icc_map_get_regions() */
    /* Faces of the surface, of 3 points each, or NULL. Only Medit has them. */
    size_t n_faces;
    const uint32_t *faces;
} numbered_mesh;

/* Writes a mesh as text, in the format of this name (output_format()); NULL or another one means
 * Medit. In files, regions count from 1, because Gmsh keeps 0 for elements without a number.
 * Region k of the library has number k + 1: as Medit's reference, as Gmsh's physical and
 * elementary tag, and as VTK's cell data `region`. */
void numbered_mesh_write(const numbered_mesh *m, const char *format, FILE *out);

#endif

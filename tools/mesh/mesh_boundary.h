/* Finds the boundary of a mesh of triangles or tetrahedra: the facets that belong to only one
 * element. */
#ifndef MESH_BOUNDARY_H
#define MESH_BOUNDARY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct mesh_boundary {
    size_t n, dim;
    uint32_t *facets; /* n * dim vertices; facets are sorted by their vertices, in any order */
    size_t *elements; /* the element of each facet */
    size_t n_shared;  /* facets that belong to more than two elements */
} mesh_boundary;

/* Finds edges (a, b), (b, c), (c, a) of triangles, or faces of tetrahedra. Faces look outwards if
 * the determinant of b - a, c - a, d - a is positive. Takes O(n log n), because it sorts. */
void mesh_boundary_find(mesh_boundary *out, size_t dim, size_t n, const uint32_t *elements);
void mesh_boundary_free(mesh_boundary *b);

/* Tells for each of n vertices whether it is on the boundary. free() the result. */
bool *mesh_boundary_vertices(const mesh_boundary *b, size_t n);

#endif

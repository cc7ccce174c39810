/* Meshes in the plane: files whose vertices have two coordinates, or all the same third one. */
#ifndef MESH_FLAT_H
#define MESH_FLAT_H

#include "mesh/mesh_file.h"

/* True if it has elements of three dimensions. */
bool mesh_has_bodies(const mesh_file *m);

/* Reads a mesh in the plane if all its faces lie in one plane z = constant, else in space.
 * *n_heights is the number of vertices whose third coordinate is not 0 and was left out. False: see
 * `wrong`. Free the mesh in either case. */
bool mesh_read_in_own_space(mesh_file *out, const char *text, size_t n, size_t *n_heights,
                            problem *wrong);

#endif

/* Features of a solid in space: surfaces and lines of an OBJ file by the names of its objects, and
 * the pairing of two cages by these names. */
#ifndef CAGE_PARTS_H
#define CAGE_PARTS_H

#include "cage/cage.h"
#include "mesh/mesh_file.h"

/* Takes the objects of an OBJ file apart, or its groups if it has no objects. The object `outer` is
 * the outer surface, or else the largest one. An object whose name begins with `void` is a void, and
 * every other one is a surface inside. Lines become features if none of their vertices belong to a
 * face. *is_divided is false if there is nothing to take apart: a single object without lines, or
 * objects that share vertices and have none of these names. False: see `wrong`. */
bool cage_take_parts(cage *out, const mesh_file *m, const size_t *vertex_lines, bool *is_divided,
                     problem *wrong);

/* Adds a feature to a cage in space, with copies of n vertices, of n_facets triangles, and of a
 * label of n_label characters. */
cage_feature *cage_add_solid_feature(cage *c, int32_t kind, size_t n, const double *points,
                                     size_t n_facets, const uint32_t *facets, const char *label,
                                     size_t n_label);

/* Brings the features of the target into the order of the source's by their names. Features without
 * names keep their order. False if one has no partner: see `wrong`, which is about the target. */
bool cage_pair_parts(const cage *source, cage *target, problem *wrong);

#endif

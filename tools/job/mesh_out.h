/* Writes the tetrahedra of a map in space: before and after, as Medit. */
#ifndef MESH_OUT_H
#define MESH_OUT_H

#include "job/job.h"

/* True if one of the options --mesh-out and --target-mesh-out is given. */
bool mesh_out_is_wanted(const job *j);

/* Checks that the cages, if they have been read, are in space. */
int mesh_out_check(job *j);

/* Writes the files of the options, if given. Both have the same tetrahedra, with the numbers of
 * their regions: 1 at the outer surface, and 2, 3, .. within the first, the second, .. surface
 * inside. */
int mesh_out_write(const job *j);

#endif

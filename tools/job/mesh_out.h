/* Writes the mesh of a map before and after, with region numbers (mesh/numbered_mesh.h). */
#ifndef MESH_OUT_H
#define MESH_OUT_H

#include "job/job.h"

/* True if one of the options --mesh-out and --target-mesh-out is given. */
bool mesh_out_is_wanted(const job *j);

/* Checks that the cages have two or three dimensions. */
int mesh_out_check(job *j);

/* Writes the files of the options, if given. Both have the same cells and region numbers. */
int mesh_out_write(const job *j);

#endif

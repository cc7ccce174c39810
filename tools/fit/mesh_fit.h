/* Maps of a mesh onto itself with other places of its vertices: where some are told, or near a given
 * warp. */
#ifndef MESH_FIT_H
#define MESH_FIT_H

#include "job/job.h"
#include "mesh/mesh_file.h"

/* Makes the map of `mesh --fit`, and the images of all vertices of the mesh. Vertices of no face
 * stay. Returns PARTIAL if some told vertices do not reach their places, after it has named them;
 * FAILED after a message; or DONE. */
int mesh_fit(job *j, const mesh_file *m, double *images);

/* Makes the map of `mesh --nearest` and the images of all vertices. Prints what has changed. */
int mesh_nearest(job *j, const mesh_file *m, double *images);

#endif

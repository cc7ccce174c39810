/* Carries normals, tangents and morph targets of a mesh by the map of a job (mesh_carry.h). */
#ifndef ATTACHED_H
#define ATTACHED_H

#include "job/job.h"
#include "mesh/mesh_carry.h"

/* Carries them after the vertices have images. Vertices whose `status` is not ICC_OK stay. With
 * --rotate-vectors it also rotates vectors at vertices and in elements (mesh_vectors.h). */
int attached_carry(job *j, mesh_file *m, const double *images, const icc_status *status,
                   mesh_carried *out);

/* Prints a message and returns PARTIAL if morph targets displace vertices to places without an
 * image. */
int attached_beyond(const job *j, const mesh_carried *c);

/* Prints which of them stay as in `file`, and which are not exact. */
void attached_tell(const char *file, const mesh_carried *c);

/* Prints which of them a pose does not carry. False: see `wrong`. */
bool attached_left(mesh_file *m, const char *file, problem *wrong);

#endif

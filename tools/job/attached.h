/* What is attached to the vertices of a mesh, carried by the map of a job. */
#ifndef ATTACHED_H
#define ATTACHED_H

#include "job/job.h"
#include "mesh/mesh_carry.h"

/* Carries it, once the vertices have images: those of `status` ICC_OK; the others stay. */
int attached_carry(job *j, mesh_file *m, const double *images, const icc_status *status,
                   mesh_carried *out);

/* Says that a target displaces vertices to where there is no image; PARTIAL if so. */
int attached_beyond(const job *j, const mesh_carried *c);

/* Says what of `file` has stayed, or is not exact. */
void attached_tell(const char *file, const mesh_carried *c);

/* Says what would have to be carried, and is not: of a pose. False: see `wrong`. */
bool attached_left(mesh_file *m, const char *file, problem *wrong);

#endif

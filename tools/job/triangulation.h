/* The triangles of a map in the plane, for other programs. */
#ifndef TRIANGULATION_H
#define TRIANGULATION_H

#include "job/job.h"

/* Whether the cages are such that --triangulation, if it was given, can be written. */
int triangulation_check(job *j);

/* Writes the file of --triangulation, if it was given, once there is a map. */
int triangulation_write(const job *j);

/* Says how many of the triangles written are not positive. Returns PARTIAL if there are any. */
int triangulation_tell(const job *j);

#endif

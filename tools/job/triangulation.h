/* Writes the triangles of a plane map for other programs. */
#ifndef TRIANGULATION_H
#define TRIANGULATION_H

#include "job/job.h"

/* Checks that --triangulation, if given, can be written for these cages. */
int triangulation_check(job *j);

/* Writes the file of --triangulation, if given, for the map. */
int triangulation_write(const job *j);

/* Prints how many of the written triangles are not positive. Returns PARTIAL if there are any. */
int triangulation_tell(const job *j);

#endif

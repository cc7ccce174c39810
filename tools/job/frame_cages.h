/* Frames around cages in the plane, so that a map covers what lies outside the cages as well. */
#ifndef FRAME_CAGES_H
#define FRAME_CAGES_H

#include "job/job.h"

/* Puts a rectangle around each cage, --frame of its longest side away. Outlines and holes become
 * closed lines inside. DONE, or FAILED with a message on stderr. */
int frame_cages(job *j);

#endif

/* Shapes of several polygons: each polygon has its own map. */
#ifndef PARTS_H
#define PARTS_H

#include "job/job.h"

/* Checks that the cages correspond, polygon by polygon, after they have been read. Makes a part of
 * the job for each polygon except the first. With --fill-holes it also makes one for the inside of
 * each hole. Lines and points go to the polygon in which they lie. */
int parts_make(job *j);

/* Checks that the polygons of each side do not meet one another, exactly. All must have domains. */
int parts_check(job *j);

#endif

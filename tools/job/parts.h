/* Shapes of several polygons: each has a map of its own. */
#ifndef PARTS_H
#define PARTS_H

#include "job/job.h"

/* Once the cages have been read: makes sure that they correspond, polygon by polygon, and makes a
 * part of the job of each but the first; with --fill-holes also of what lies in each hole. Lines and
 * points go to the polygon that they lie in. */
int parts_make(job *j);

/* Whether the polygons of each side are apart from one another, exactly, once all have domains. */
int parts_check(job *j);

#endif

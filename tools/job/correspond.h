/* Checks that source and target correspond. */
#ifndef CORRESPOND_H
#define CORRESPOND_H

#include "job/job.h"

/* Checks that the target has the source's dimension, vertices and facets. A target without facets
 * gets the source's. Does nothing without a target, or if a mask has no boundary yet. Returns DONE,
 * or FAILED with a message on stderr. */
int correspond(job *j);

/* Gives a mask the vertices and facets of the boundary of its domain. */
void cage_take_boundary(cage *c, const icc_domain *domain);

#endif

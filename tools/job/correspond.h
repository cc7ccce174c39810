/* How source and target belong together. */
#ifndef CORRESPOND_H
#define CORRESPOND_H

#include "job/job.h"

/* Checks that the target has the source's dimension, vertices and facets; takes over the facets if
 * it has none of its own. Nothing to do without a target, or while a mask does not know its
 * boundary. Returns DONE, or FAILED with a line on stderr. */
int correspond(job *j);

/* Gives a mask the vertices and facets of the boundary of its domain. */
void cage_take_boundary(cage *c, const icc_domain *domain);

#endif

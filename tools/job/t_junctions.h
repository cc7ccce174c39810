/* Vertices of one feature that lie on a side of another one, as parcels often have them. */
#ifndef T_JUNCTIONS_H
#define T_JUNCTIONS_H

#include "job/job.h"

/* Adds each vertex that lies on a side of another feature, or of the outer ring, to that side, if it
 * does so in the source and in the target. Both cages must correspond. Sets j->n_added. If a vertex
 * lies on a side in only one of them, the library will refuse that cage, and j->one_sided says what
 * to do. */
void t_junctions_add(job *j);

#endif

/* The apex: a point inside a star-shaped region that sees all of its boundary. */
#ifndef ICCP_APEX_H
#define ICCP_APEX_H

#include "geometry/simplices.h"

/* Finds a point that sees all of the image of a mesh's boundary, with some room. *sees is false if
 * none was found. The mesh must know its neighbours. `boundary`: 3 coordinates of the image of each
 * boundary point. */
icc_status iccp_find_apex(bool *sees, double apex[3], const iccp_simplices *mesh,
                          const double *boundary, const iccp_memory *memory);

#endif

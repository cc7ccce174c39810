/* Splits slivers, which are nearly flat tetrahedra. */
#ifndef ICCP_SLIVERS_H
#define ICCP_SLIVERS_H

#include "fill/tets.h"

/* Replaces an edge of each sliver by a point if the least angle there at least doubles, as long as
 * there are fewer than `most` points. */
void iccp_split_slivers(iccp_tets *m, uint64_t most);

#endif

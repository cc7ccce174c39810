/* Splits slivers, which are nearly flat tetrahedra. */
#ifndef ICCP_SLIVERS_H
#define ICCP_SLIVERS_H

#include "fill/tets.h"

/* Replaces an edge of each sliver by a point if the square of the least sine there at least
 * doubles, as long as there are fewer than `most` points. After the first time, tries only what has
 * changed. The mesh's measure must be the angle. */
void iccp_split_slivers(iccp_tets *m, bool first, uint64_t most);

#endif

/* Finds intersections of surfaces with common triangles. */
#ifndef ICCP_INTERSECTIONS_H
#define ICCP_INTERSECTIONS_H

#include "match/common_mesh/common_surface.h"

/* Marks the corners of triangles of either surface that have no area, or meet others except in what
 * they share. *any becomes true if there are any, and is otherwise unchanged. Exact. False if there
 * is no memory. */
bool iccp_intersections_mark(uint8_t *is_bad, bool *any, const iccp_common_surface *c,
                             const iccp_memory *memory);

#endif

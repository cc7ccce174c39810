/* What meets on two surfaces with common triangles, and should not. */
#ifndef ICCP_INTERSECTIONS_H
#define ICCP_INTERSECTIONS_H

#include "match/common_mesh/common_surface.h"

/* Marks the corners of triangles of either surface that meet others beside what they share, or have
 * no area; *any if there are such, else as it was. Exact. False if there is no memory. */
bool iccp_intersections_mark(uint8_t *is_bad, bool *any, const iccp_common_surface *c,
                             const iccp_memory *memory);

#endif

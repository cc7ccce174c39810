/* Replaces the inverted triangles of a map whose vertices are all fixed. */
#ifndef ICCP_MEND_INVERTED_H
#define ICCP_MEND_INVERTED_H

#include "map/compatible/plmap.h"
#include "map/energy/work.h"

/* Makes all triangles of a map positive before and after it, exactly. Vertices stay, and new ones
 * come after them. *done is false, with ICC_OK, if that was not possible: triangles that belong
 * together are too many, or have a vertex inside. Then the map is of no use. O(n). */
icc_status iccp_mend_inverted(iccp_plmap *map, bool *done, iccp_work *work, const iccp_env *env);

#endif

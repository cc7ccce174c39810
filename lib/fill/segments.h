/* Recovers the edges of the surface as edges of the mesh. */
#ifndef ICCP_SEGMENTS_H
#define ICCP_SEGMENTS_H

#include "fill/surface.h"

/* Changes the mesh so that each edge of the surface is a chain of its edges. Returns
 * ICC_ERR_RESOLUTION if an edge cannot be distinguished from its surroundings, and names a facet of
 * it. */
icc_status iccp_recover_segments(iccp_tets *m, iccp_surface *s, const iccp_env *env,
                                 icc_error *err);

#endif

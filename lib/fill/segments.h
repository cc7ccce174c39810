/* The edges of the surface become edges of the mesh. */
#ifndef ICCP_SEGMENTS_H
#define ICCP_SEGMENTS_H

#include "fill/surface.h"

/* Afterwards each edge of the surface is a chain of edges of the mesh. ICC_ERR_RESOLUTION naming a
 * facet of one that is not told from its surroundings. */
icc_status iccp_recover_segments(iccp_tets *m, iccp_surface *s, const iccp_env *env,
                                 icc_error *err);

#endif

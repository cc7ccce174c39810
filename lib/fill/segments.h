/* Recovers the edges of the surfaces and lines as edges of the mesh. */
#ifndef ICCP_SEGMENTS_H
#define ICCP_SEGMENTS_H

#include "fill/constraints.h"

/* Changes the mesh so that each edge of the surface is a chain of its edges. Returns
 * ICC_ERR_RESOLUTION if an edge cannot be distinguished from its surroundings, and names a facet of
 * it. */
icc_status iccp_recover_segments(iccp_tets *m, iccp_constraints *s, const iccp_env *env,
                                 icc_error *err);

/* Does the same for the segments of lines, before those of surfaces. Points on them are as near as
 * doubles can be. Afterwards no step moves these points or removes the edges between them. */
icc_status iccp_recover_lines(iccp_tets *m, iccp_constraints *s, const iccp_env *env,
                              icc_error *err);

#endif

/* Turns a map of a mesh onto a ball into a map onto a star-shaped region, one that a point inside
 * sees all of. */
#ifndef ICCP_COAT_MAP_H
#define ICCP_COAT_MAP_H

#include "geometry/simplices.h"

/* Takes a mesh that knows its neighbours, and its images. The vertices of the boundary have the
 * directions from the origin that the vertices of the target, `boundary`, have from the apex.
 * Replaces both by a finer mesh, which does not know its neighbours, and its images. The images of
 * the boundary are then the target's vertices.
 *
 * Every tetrahedron stays positive up to rounding, so the caller must check this. If doubles leave
 * no room, *done is false and nothing has changed. */
icc_status iccp_coat_put_on(iccp_simplices **mesh, double **images, const double *boundary,
                            const double apex[3], bool *done, const iccp_env *env);

#endif

/* Maps of a mesh in space onto a ball, put on what can be seen from one point inside. */
#ifndef ICCP_COAT_MAP_H
#define ICCP_COAT_MAP_H

#include "geometry/simplices.h"

/* Takes a mesh that knows its neighbours and its images, on which the vertices of the boundary have
 * the directions from the origin that those of the target, `boundary`, have from the apex. Both are
 * replaced by a finer mesh, which does not know its neighbours, and its images; the boundary has
 * the target's vertices for images. Every tetrahedron stays positive but for rounding, which is to
 * be checked. *done is false, and nothing has changed, where there is no room in doubles. */
icc_status iccp_coat_put_on(iccp_simplices **mesh, double **images, const double *boundary,
                            const double apex[3], bool *done, const iccp_env *env);

#endif

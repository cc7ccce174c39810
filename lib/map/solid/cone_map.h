/* Maps of a mesh in space onto a region that can be seen from one point inside. */
#ifndef ICCP_CONE_MAP_H
#define ICCP_CONE_MAP_H

#include "geometry/simplices.h"

/* Where a point sees all of the boundary's image, with some room; false for *sees where none was
 * found. The mesh knows its neighbours. */
icc_status iccp_cone_apex(bool *sees, double apex[3], const iccp_simplices *mesh,
                          const double *boundary, const iccp_env *env);

/* Images of a mesh that fills a ball, 3 coordinates each: of the points of its boundary they are
 * given, those of the others are found such that every tetrahedron is positive, exactly. That may
 * take a mesh with more points inside: *out, which does not know its neighbours nor the caller's
 * numbers. Both are NULL, with ICC_OK, where no point sees all of the boundary's image, or no such
 * map was found: the mesh may have become MOST_GROWTH times as large, or no tetrahedron be left
 * that can be taken from what is left of the ball without its ceasing to be one. */
icc_status iccp_cone_map(iccp_simplices **out, double **images, const iccp_simplices *mesh,
                         const double *boundary, const iccp_env *env);

#endif

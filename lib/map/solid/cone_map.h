/* Maps a mesh in space onto a star-shaped region: one that a point inside sees all of. */
#ifndef ICCP_CONE_MAP_H
#define ICCP_CONE_MAP_H

#include "geometry/simplices.h"

/* Finds a point that sees all of the boundary's image, with some room. *sees is false if none was
 * found. The mesh must know its neighbours. */
icc_status iccp_cone_apex(bool *sees, double apex[3], const iccp_simplices *mesh,
                          const double *boundary, const iccp_env *env);

/* Finds images, 3 coordinates each, for a mesh that fills a ball, so that every tetrahedron is
 * positive, exactly. The images of boundary points are given. The mesh may need more points inside.
 * So *out is a new mesh, which knows neither its neighbours nor the caller's numbers.
 *
 * Both results are NULL, with ICC_OK, if no point sees all of the boundary's image or if no such
 * map was found. The search ends when the mesh is MOST_GROWTH times as large, or when no
 * tetrahedron can be taken from the rest of the ball. */
icc_status iccp_cone_map(iccp_simplices **out, double **images, const iccp_simplices *mesh,
                         const double *boundary, const iccp_env *env);

#endif

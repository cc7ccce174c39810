/* Making a certified piecewise linear map fairer without losing its certificate. */
#ifndef ICCP_IMPROVE_H
#define ICCP_IMPROVE_H

#include "map/plmap.h"

typedef struct iccp_improvement {
    double energy; /* the map's at the end */
    size_t n_iterations;
    size_t n_levels; /* refinements */
} iccp_improvement;

/* Lowers the symmetric Dirichlet energy of a map in the plane or in space, all of whose simplices
 * are positive, which they stay: at most `iterations` steps, the first `majorised` ones by SLIM's
 * model, until one gains less than `tolerance` of the energy. Adds to improvement->n_iterations. On
 * any failure the map is as good. */
icc_status iccp_improve_images(const iccp_simplicial_map *map, size_t majorised, size_t iterations,
                               double tolerance, iccp_improvement *improvement,
                               const iccp_env *env);

/* Lowers the symmetric Dirichlet energy of a map whose triangles are all positive, which they stay,
 * with the boundary fixed: at most `iterations` steps, until one gains less than `tolerance` of the
 * energy; then cuts the triangles with the most energy and continues, at most `levels` times. On
 * any failure, ICC_ERR_CANCELLED included, the map is valid and no worse than before. */
icc_status iccp_improve(iccp_plmap *map, size_t iterations, double tolerance, size_t levels,
                        iccp_improvement *improvement, const iccp_env *env);

#endif

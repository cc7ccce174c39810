/* Making a certified piecewise linear map fairer without losing its certificate. */
#ifndef ICCP_IMPROVE_H
#define ICCP_IMPROVE_H

#include "map/plmap.h"
#include "map/work.h"

typedef struct iccp_improvement {
    double energy; /* the map's at the end */
    size_t n_iterations;
    size_t n_levels;   /* refinements */
    bool is_converged; /* the last step gained no more than the tolerance */
} iccp_improvement;

/* When steps on one mesh end. */
typedef struct iccp_descent {
    size_t majorised;  /* the first steps are by SLIM's model */
    size_t iterations; /* at most so many, */
    double tolerance;  /* until one gains no more than this share of the energy, */
    double slow;       /* or two in turn no more than this share each */
} iccp_descent;

/* Lowers the symmetric Dirichlet energy of a map in the plane or in space, all of whose simplices
 * are positive, which they stay. Ends, too, when there is no work left for a step. Adds to
 * improvement->n_iterations. On any failure the map is as good. */
icc_status iccp_improve_images(const iccp_simplicial_map *map, const iccp_descent *descent,
                               iccp_work *work, iccp_improvement *improvement, const iccp_env *env);

/* How far a map is improved. */
typedef struct iccp_schedule {
    size_t iterations; /* on each mesh at most */
    double tolerance;  /* on the last mesh, until a step gains no more than this share */
    size_t levels;     /* refinements at most, */
    double most;       /* to no more triangles than this */
    bool both_sides;   /* the points of inner vertices move, too */
} iccp_schedule;

/* Lowers the symmetric Dirichlet energy of a map whose triangles are all positive, which they stay,
 * with what is fixed fixed: by steps as long as they gain enough; then cuts the triangles with the
 * most energy, flips edges and continues, as long as that gains enough and there is work left; the
 * last mesh takes steps down to the tolerance. On any failure, ICC_ERR_CANCELLED included, the map
 * is valid and no worse than before. */
icc_status iccp_improve(iccp_plmap *map, const iccp_schedule *schedule, iccp_work *work,
                        iccp_improvement *improvement, const iccp_env *env);

/* Cuts the triangles that carry most of the energy above an isometry's; each keeps its map. */
icc_status iccp_refine(iccp_plmap *map, size_t *n_cut, const iccp_env *env);

#endif

/* Lowers the energy of a map by steps on one mesh. */
#ifndef ICCP_DESCENT_H
#define ICCP_DESCENT_H

#include "map/energy/newton.h"
#include "map/energy/work.h"

typedef struct iccp_improvement {
    double energy; /* the map's at the end */
    size_t n_iterations;
    size_t n_levels;   /* refinements */
    bool is_converged; /* the last step gained no more than the tolerance */
} iccp_improvement;

/* When steps on one mesh end. The first `majorised` steps do not count for the last three. */
typedef struct iccp_descent {
    size_t majorised;  /* so many steps use SLIM's model first */
    size_t iterations; /* the most steps */
    double tolerance;  /* steps end when one gains no more than this share of the energy */
    double slow;       /* a step is slow if it gains no more than this share */
    bool is_hasty;     /* one slow step ends them; otherwise two in turn */
} iccp_descent;

/* Lowers the symmetric Dirichlet energy of a map in the plane or in space whose simplices are all
 * positive. They stay so. Ends earlier if there is no work left for a step. Adds to
 * improvement->n_iterations and sets is_converged, unless it is NULL. On any failure the map is no
 * worse. */
icc_status iccp_take_steps(const iccp_simplicial_map *map, const iccp_descent *descent,
                           iccp_work *work, iccp_improvement *improvement, const iccp_env *env);

/* Does the same as iccp_take_steps() and sets improvement->energy. `improvement` must not be NULL.
 * `newton` begins empty and keeps what these steps prepare, for more steps on the same mesh. The
 * caller frees it before the mesh or its points change. */
icc_status iccp_improve_images(const iccp_simplicial_map *map, const iccp_descent *descent,
                               iccp_newton *newton, iccp_work *work, iccp_improvement *improvement,
                               const iccp_env *env);

#endif
